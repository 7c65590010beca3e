// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>

#include <bch/outline.hpp>

#include "layout/base/shortest.hpp"
#include "layout/character/skinning.hpp"
#include "layout/format/contours.hpp"
#include "layout/import/clips.hpp"

namespace bch::detail::importing {
namespace {

constexpr double max_ratio = 1.5;  // of the rest pose's extent
constexpr int steps = 16;          // poses of a clip, less one

/// Returns the text of a length, rounded to the millimetre.
std::string text_of(double metres) {
  return shortest(std::round(metres * 1e3) / 1e3) + " m";
}

}  // namespace

void note_far_poses(const Character& character, std::size_t first_clip, ImportReport& report) {
  if (first_clip == character.clips.size()) return;
  Skinner skinner(character);
  const double rest = max_extent(skinner.ground_pose({}));
  for (std::size_t c = first_clip; c < character.clips.size(); ++c) {
    double farthest = 0;
    for (int step = 0; step <= steps; ++step) {
      const float seconds = character.clips[c].seconds * static_cast<float>(step) / static_cast<float>(steps);
      farthest =
          std::max(farthest, max_extent(skinner.ground_pose({static_cast<std::uint32_t>(c), seconds})));
    }
    if (farthest > max_ratio * rest)
      report.notes.push_back("clip '" + character.clips[c].name + "': a pose reaches " + text_of(farthest) +
                             ", more than " + shortest(max_ratio) + " times the rest pose's " +
                             text_of(rest));
  }
}

}  // namespace bch::detail::importing
