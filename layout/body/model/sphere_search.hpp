// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

#include "layout/body/model/skin_pieces.hpp"
#include "layout/body/model/sphere_choice.hpp"
#include "layout/body/model/training_poses.hpp"

namespace bch::detail {

/// Returns the number of poses that improve_spheres() expects.
constexpr std::uint32_t searched_poses = 24;

/// Moves, deletes and splits spheres, and hands their pieces over, until random slides of the body against itself in other poses meet as
/// late as possible: what collides first is what has to be better. A fixed number of rounds with a fixed seed.
/// `advance`: is called with the fraction that is done.
SphereChoice improve_spheres(const SkinPieces& skin, const TrainingPoses& poses, const SphereChoice& choice,
                             const std::function<void(double)>& advance);

}  // namespace bch::detail
