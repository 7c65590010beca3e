// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bch {

/// What a shape shows: names by their index in ShapeOrigins.
struct ShapeOrigin {
  static constexpr std::uint32_t rest_pose = 0xffffffff;

  std::uint32_t character = 0;
  std::uint32_t clip = rest_pose;
  float seconds = 0;  ///< from the start of the clip
  friend bool operator==(const ShapeOrigin&, const ShapeOrigin&) = default;
};

/// The characters, clips and times that the shapes of a set come from. Queries do not use them.
struct ShapeOrigins {
  double threshold = 0;              ///< of all hierarchies, metres; see contour_hierarchy()
  std::vector<std::string> names;    ///< of characters and clips, as their files have them
  std::vector<ShapeOrigin> origins;  ///< one a shape, or none at all
  friend bool operator==(const ShapeOrigins&, const ShapeOrigins&) = default;
};

}  // namespace bch
