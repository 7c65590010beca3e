// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>

#include <bch/motion.hpp>

namespace bch::detail {

/// Returns the pose between two successive keys of a path.
inline PathKey between_keys(const PathKey& from, const PathKey& to, double time) noexcept {
  const double fraction = std::min((time - from.time) / (to.time - from.time), 1.0);
  const auto blend = [=](double a, double b) { return a + (b - a) * fraction; };
  return {time, blend(from.x, to.x), blend(from.y, to.y), blend(from.heading, to.heading),
          blend(from.z, to.z)};
}

/// Returns whether two keys have the same position and heading.
inline bool is_same_pose(const PathKey& a, const PathKey& b) noexcept {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.heading == b.heading;
}

}  // namespace bch::detail
