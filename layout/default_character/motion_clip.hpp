// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <string>

#include <bch/characters.hpp>

#include "layout/default_character/human_pose.hpp"

namespace bch::detail {

/// Gives a pose for each time in seconds.
using Motion = std::function<HumanPose(double seconds)>;

/// Selects how the pelvis moves over the ground: as the motion says, or such that the foot that carries does not
/// slide.
enum class Travel { authored, by_feet };

/// Writes a motion down as keys, evenly spread, at least 16 a second. The height of the pelvis is corrected so that the
/// lowest vertex of the soles is on the ground at each key. `character` has a skin and a skeleton at
/// `joints`.
Clip bake(const Character& character, const JointPositions& joints, std::string name, double seconds,
          Travel travel, const Motion& motion);

}  // namespace bch::detail
