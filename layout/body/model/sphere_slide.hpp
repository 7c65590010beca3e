// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <bch/body_set.hpp>

#include "layout/base/heading.hpp"

namespace bch::detail {

/// Represents the first contact of two bodies, one of which slides along x.
struct SlideContact {
  std::uint32_t first, second;  ///< spheres
  float normal[3];              ///< from the first to the second, in the frame of the slide
};

/// Holds a body that slides: its spheres turned by a heading, in the order of their front ends.
class SlidingBody {
 public:
  /// `toward`: 1 if the body looks along x, -1 if it looks against it; its spheres at that end come first.
  void place(const std::vector<Sphere>& spheres, const Rotation& heading, float lateral, float toward);

  std::vector<float> x, y, z, radius, front;  ///< front: of x, never falling in the order, times -toward
  std::vector<std::uint32_t> sphere;

 private:
  std::vector<Sphere> turned_;
};

/// Returns which spheres of two bodies meet first when `first` comes from far away and slides along x to `second`; none if they pass.
std::optional<SlideContact> first_contact(const SlidingBody& first, const SlidingBody& second);

}  // namespace bch::detail
