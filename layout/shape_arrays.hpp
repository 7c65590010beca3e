// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "layout/disc.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// The arrays of a shape set with their sizes, whoever owns them; ShapeSetView says what they hold. Each begins on a
/// cache line.
struct ShapeArrays {
  std::span<const std::uint32_t> depths;  ///< cut depths, ascending: one a level, 1 to 255 of them
  std::span<const Root> roots;
  std::span<const Tree> trees;
  std::span<const float> nodes, reach, support;
  std::span<const DiscBlock> inscribed;
  std::span<const Extremes> extremes;
  std::span<const Profile> profiles;
  std::span<const ContourRange> shape_contours;
  std::span<const Contour> contours;
  std::span<const Vec2> points;

  std::size_t shape_count() const noexcept { return depths.empty() ? 0 : roots.size() / depths.size(); }
};

}  // namespace bch
