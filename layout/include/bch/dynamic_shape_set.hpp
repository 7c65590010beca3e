// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>

#include <bch/shape_set.hpp>
#include <bch/shape_set_builder.hpp>

namespace bch {

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
