// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "kernel/body/space_frame.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {

/// Visits spheres of two bodies that may touch: of each body, the leaves that may touch the other one's whole, and then the spheres of those
/// leaves that may touch each other. Written for one pair at a time, without SIMD.
class NearSpheres {
 public:
  NearSpheres(const float* a, const float* b, const SpaceFrame& frame) : a_(a), b_(b), frame_(frame) {}

  /// Calls use(slot of A, slot of B, sphere of A, sphere of B) for all spheres whose wholes and leaves pass may_touch(cylinder of A, cylinder
  /// of B), in A's frame. may_touch() may refuse more after each use().
  template <class MayTouch, class Use>
  void visit(const MayTouch& may_touch, const Use& use) {
    const Cylinder whole_a = whole_of(a_), whole_b = frame_.placed(whole_of(b_));
    if (!may_touch(whole_a, whole_b)) return;
    std::uint32_t count = 0;
    for (std::uint32_t j = 0; j < header_of(b_).leaf_count; ++j) {
      const Cylinder node = frame_.placed(node_of(b_, j));
      if (may_touch(whole_a, node)) nodes_[count] = node, leaves_[count++] = j;
    }
    for (std::uint32_t i = 0; count != 0 && i < header_of(a_).leaf_count; ++i) {
      const Cylinder node = node_of(a_, i);
      if (!may_touch(node, whole_b)) continue;
      for (std::uint32_t k = 0; k < count; ++k)
        if (may_touch(node, nodes_[k])) visit_leaves(i, leaves_[k], use);
    }
  }

 private:
  /// Slots behind the last sphere repeat it, and are left out.
  struct Slots {
    std::uint32_t begin, end;
    Slots(const float* record, std::uint32_t leaf)
        : begin(leaf * header_of(record).leaf_size),
          end(std::min(begin + header_of(record).leaf_size, header_of(record).sphere_count)) {}
  };

  template <class Use>
  void visit_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, const Use& use) const {
    const Slots of_a(a_, leaf_a), of_b(b_, leaf_b);
    for (std::uint32_t j = of_b.begin; j < of_b.end; ++j) {
      const Sphere b = frame_.placed(sphere_of(b_, j));
      for (std::uint32_t i = of_a.begin; i < of_a.end; ++i) use(i, j, sphere_of(a_, i), b);
    }
  }

  const float *a_, *b_;
  const SpaceFrame& frame_;
  std::array<Cylinder, max_spheres / 4> nodes_;  ///< of B, placed
  std::array<std::uint32_t, max_spheres / 4> leaves_;
};

}  // namespace bch::detail
