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

/// A shape in its flat form, ready to take a place in a set. Making it takes nearly all the time that a set takes; it keeps its
/// memory for the next one. One thread may use it at a time, and one that was moved from can only be assigned to or
/// destroyed.
class PreparedShape {
 public:
  /// Takes the plan of the sets that the shapes are for.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit PreparedShape(const ShapeSetPlan& plan);
  PreparedShape(PreparedShape&&) noexcept;
  PreparedShape& operator=(PreparedShape&&) noexcept;
  ~PreparedShape();

  /// Makes a shape flat, in place of the one before.
  /// Errors:  throws std::invalid_argument as ShapeSet does, naming the shape by `index`; prepare another then.
  void prepare(const Shape& shape, std::size_t index);

  /// For the library's own parts, which alone know this type.
  detail::FlatBody& flat() noexcept;
  const detail::FlatBody& flat() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Builds a set shape by shape: the same one as from all shapes at once, byte for byte, without all of them in memory.
/// One that was moved from can only be assigned to or destroyed.
class ShapeSetBuilder {
 public:
  /// Begins an empty set of a plan. `expected_shapes`: how many there may be in the end, for the room that is made at once. More
  /// and fewer are right.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes = 0);
  ShapeSetBuilder(ShapeSetBuilder&&) noexcept;
  ShapeSetBuilder& operator=(ShapeSetBuilder&&) noexcept;
  ~ShapeSetBuilder();

  /// Adds a shape that was prepared with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 numbers in nodes or 2^32 roots. What was added before is then as it was.
  void add(const PreparedShape& shape);
  /// Returns the set of the shapes so far, for queries until the next call of another function, after which more may be added.
  const ShapeSet& set();
  /// Returns the set of the shapes that were added. Where memory runs out they stay.
  ShapeSet finish() &&;

  /// For the library's own parts: the nodes of the shapes so far, as the set is going to have them, none for roots alone. Valid
  /// until the next call of another function.
  std::span<const float> nodes() const noexcept;
  /// Returns where the set ends at present, for go_back().
  detail::BuilderEnd end() const noexcept;
  /// Ends the set there again, as if nothing had been added since. Allocates nothing.
  void go_back(const detail::BuilderEnd& to) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
