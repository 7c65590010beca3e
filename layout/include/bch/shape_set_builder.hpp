// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
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

}  // namespace bch
