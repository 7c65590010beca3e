// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <bch/shape_set.hpp>

namespace bch::detail {
struct BuilderEnd;
struct FlatBody;
}  // namespace bch::detail

namespace bch {

/// Holds a shape in its flat form, ready to be added to a set. Preparing shapes is nearly all the work of making a set; an object keeps
/// its memory for the next shape. Only one thread may use it at a time, and an object that was moved from can only be assigned to or
/// destroyed.
class PreparedShape {
 public:
  /// Takes the plan of the sets that the shapes are for.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit PreparedShape(const ShapeSetPlan& plan);
  PreparedShape(PreparedShape&&) noexcept;
  PreparedShape& operator=(PreparedShape&&) noexcept;
  ~PreparedShape();

  /// Makes a shape flat, in place of the previous one.
  /// Errors:  throws std::invalid_argument as ShapeSet does, naming the shape by `index`; then prepare another shape.
  void prepare(const Shape& shape, std::size_t index);

  // For the library's own parts, which alone know these types.
  /// Returns the arrays that builders and sets copy.
  detail::FlatBody& flat() noexcept;
  const detail::FlatBody& flat() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Builds a set shape by shape, without all shapes in memory. The set is the same, byte for byte, as ShapeSet makes of all at once.
/// An object that was moved from can only be assigned to or destroyed.
class ShapeSetBuilder {
 public:
  /// Begins an empty set of a plan. `expected_shapes` is an estimate for which memory is reserved; any number may be added.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes = 0);
  ShapeSetBuilder(ShapeSetBuilder&&) noexcept;
  ShapeSetBuilder& operator=(ShapeSetBuilder&&) noexcept;
  ~ShapeSetBuilder();

  /// Adds a shape that was prepared with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 numbers in nodes or 2^32 roots. Shapes that were added before are then unchanged.
  void add(const PreparedShape& shape);
  /// Returns the set of the shapes so far. It can be queried until the next call of another function; more shapes may follow.
  const ShapeSet& set();
  /// Returns the set of the shapes that were added. Where memory runs out, the shapes stay in the builder.
  ShapeSet finish() &&;

  // For the library's own parts, which alone know these types.
  /// Returns the nodes of the shapes so far, as the set is going to have them, or none for sets of only roots. They are
  /// valid until the next call of another function.
  std::span<const float> nodes() const noexcept;
  /// Returns the present end of the set, for go_back().
  detail::BuilderEnd end() const noexcept;
  /// Removes all that was added since end() returned `to`. Allocates nothing.
  void go_back(const detail::BuilderEnd& to) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Holds a set whose shapes are replaced while it lives, for characters whose poses are new in every frame. Queries take
/// set() like any other, and answer as for a set that was built from the present shapes.
///
/// Each array of a shape (nodes, supports, contours, points) has a place of fixed size. An array that outgrows its place moves
/// to a new one at the end, 1.5 times as large as it needs. So after some frames every place is
/// large enough and nothing is allocated any more. All places together take at most 4.5 times what the largest shapes
/// need. An object that was moved from can only be assigned to or destroyed.
///
///     PoseShaper shaper(character);                  // each thread has its own shaper and prepared shape
///     PreparedShape prepared(dynamic.set().plan());
///     prepared.prepare(shaper.shape({clip, seconds}), shape);
///     if (!dynamic.try_replace(shape, prepared)) later.push_back(shape);  // for replace(), by one thread
class DynamicShapeSet {
 public:
  /// Copies a set, another one's set() for instance, with its plan and without its unused gaps. In a set of
  /// single discs every shape stays a single disc.
  explicit DynamicShapeSet(const ShapeSet& start);
  DynamicShapeSet(DynamicShapeSet&&) noexcept;
  DynamicShapeSet& operator=(DynamicShapeSet&&) noexcept;
  ~DynamicShapeSet();

  /// Returns the present shapes. Once a shape has been replaced, the set can be queried and copied but not baked, because its
  /// arrays may have gaps. To bake it, copy it.
  const ShapeSet& set() const noexcept;

  /// Replaces a shape by one that was prepared with set().plan(), if the new one fits into its place. Threads may replace
  /// different shapes at the same time, while no query runs. Allocates nothing.
  /// Returns: whether it fitted. If not, the set is unchanged and replace() is needed. The first single disc
  ///          does not fit into a set without any.
  /// Errors:  throws std::out_of_range on an index out of range, std::invalid_argument on a shape of another plan.
  bool try_replace(std::uint32_t shape, const PreparedShape& by);

  /// Replaces a shape, if need be in a new place. Only one thread may call it at a time: arrays may move, and earlier views of set()
  /// are then invalid. Takes time linear in the number of shapes where try_replace() would refuse.
  /// Errors:  as try_replace(); std::length_error as ShapeSet. The shape is then the previous one.
  void replace(std::uint32_t shape, const PreparedShape& by);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
