// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>

#include <bch/bodies.hpp>

#include "layout/body/model/skin_pieces.hpp"
#include "layout/body/model/sphere_choice.hpp"
#include "layout/body/model/training_poses.hpp"

namespace bch::detail {

/// Makes a model of spheres that own all pieces. Pieces are put together again where one sphere holds the whole without growing in any
/// pose. Spheres without pieces are left out, and the others are put in leaves.
BodyModel assemble_model(std::shared_ptr<const Character> character, const SkinPieces& skin,
                         const SphereChoice& choice, const TrainingPoses& poses);

}  // namespace bch::detail
