// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/query.hpp>

#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_intervals.hpp"
#include "kernel/penetration/free_task.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/simd/transform.hpp"

namespace bch::detail {

/// Holds what an agent is made of, in A's frame, in memory of its own.
class FreeBody {
 public:
  FreeBody() = default;
  FreeBody(FreeBody&&) noexcept = default;
  FreeBody& operator=(FreeBody&&) noexcept = default;

  /// Begins with room for so many elements.
  void begin(std::size_t elements, std::uint32_t leaf_size);
  void add(const FreeElement& element) noexcept;
  void add_node(const Cylinder& node) noexcept;
  /// Adds the segments between consecutive points. Segments come along contours, so that they make leaves.
  void add_segments(const Kernels& kernels, const Vec2* points, std::uint32_t count,
                    const Transform& to_a) noexcept;
  /// Fills the last leaf, with the last element, and makes nodes where there are none.
  void finish() noexcept;

  std::uint32_t size() const noexcept { return size_; }
  const FreeLeaves& leaves() const noexcept { return leaves_; }
  FreeElement element(std::uint32_t i) const noexcept;

 private:
  FreeLeaves leaves_{};
  std::uint32_t size_ = 0, nodes_ = 0;
  std::vector<float> memory_;
};

/// Finds how far an agent, A, has to move along directions until nothing of it overlaps another one, or a wall: for one pair after the other,
/// in memory of its own. FreeKernel searches.
class FreePair {
 public:
  FreeBody a, b;  ///< to begin with

  /// Clears the bound, and adds to it.
  void clear_bound() noexcept;
  void bound_by(const FreeElement& of_a, const FreeElement& of_b) noexcept;
  /// Begins with both bodies. The margin says how near elements may come, `max_extents` how far the elements of both are off, metres.
  void begin(const Implementation& implementation, FreeKind kind, double margin, double max_extents);
  /// Bounds by the deepest two elements of leaves that overlap, of some.
  void sample();

  /// As in FreeKernel.
  void bound(float x, float y, float* places) const noexcept;
  void turn(float x, float y) noexcept;
  float next(float place) noexcept;
  /// Returns the end of the interval that begins next from a place in none on; or the same, where no more begins.
  float after_gap(float place) const;
  /// Returns where the elements touch whose interval is the last one to end on the way to a place in none.
  FreeTouch touch(float place) const;

 private:
  struct Leaves {
    std::uint32_t of_a, of_b;
  };

  const Kernels* kernels_ = nullptr;
  FreeTask task_{};
  FreeBound bound_;
  std::vector<std::uint16_t> lists_;
  std::vector<Leaves> overlapping_;
};

}  // namespace bch::detail
