// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/clip_heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "layout/base/rounding.hpp"
#include "layout/character/motion_bounds.hpp"
#include "layout/character/skinning.hpp"

namespace bch::detail {
namespace {

constexpr double wanted_bend = 0.001;                                           ///< metres
constexpr double shortest_height_window = 0.001, longest_height_window = 0.02;  ///< seconds
/// What positions in float are off by, as a share of their size; see cover_check.cpp.
constexpr double rounding_share = 4e-6;

/// Looks at poses of one clip.
class HeightSearch {
 public:
  HeightSearch(const Character& character, std::uint32_t clip)
      : character_(character), clip_(clip), bounds_(character, clip), skinner_(character) {}

  /// Goes from window to window: each ends at the next key of a channel at the latest.
  Heights find() {
    const std::vector<float>& keys = bounds_.key_times();
    const float to = character_.clips[clip_].seconds;
    for (float begin = 0; begin < to;) {
      const auto next = std::upper_bound(keys.begin(), keys.end(), begin);
      const float limit = next == keys.end() ? to : std::min(to, *next);
      const double acceleration = bounds_.height_acceleration(begin), left = double{limit} - double{begin};
      const double even = std::sqrt(8 * wanted_bend / std::max(acceleration, 1e-9));
      const double parts = std::ceil(left / std::clamp(even, shortest_height_window, longest_height_window));
      const float after = static_cast<float>(double{begin} + left / parts);
      const float end = parts <= 1 || !(begin < after) ? limit : after;
      const double seconds = double{end} - double{begin};
      add(begin, end, acceleration * seconds * seconds / 8);
      begin = end;
    }
    return found_;
  }

 private:
  /// Adds the heights at both ends of a window, with room for the bend between.
  void add(float begin, float end, double bend) {
    Heights window = nowhere;
    double reach = 0;
    for (const float seconds : {begin, end}) {
      const std::span<const Vec3> pose = skinner_.pose({clip_, seconds});
      for (const auto& [x, y, z] : pose)
        reach = std::max({reach, std::abs(double{x}), std::abs(double{y}), std::abs(double{z})});
      for (const auto& triangle : character_.triangles)
        for (const std::uint32_t v : triangle)
          window = {std::min(window.bottom, pose[v].z), std::max(window.top, pose[v].z)};
    }
    const double room = bend + rounding_share * reach;
    found_ = {std::min(found_.bottom, rounding::round_down(double{window.bottom} - room)),
              std::max(found_.top, -rounding::round_down(-double{window.top} - room))};
  }

  static constexpr Heights nowhere = {std::numeric_limits<float>::infinity(),
                                      -std::numeric_limits<float>::infinity()};

  const Character& character_;
  std::uint32_t clip_;
  MotionBounds bounds_;
  Skinner skinner_;
  Heights found_ = nowhere;
};

}  // namespace

Heights clip_heights(const Character& character, std::uint32_t clip) {
  return HeightSearch(character, clip).find();
}

}  // namespace bch::detail
