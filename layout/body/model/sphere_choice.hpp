// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "layout/body/model/body_candidates.hpp"
#include "layout/body/model/skin_pieces.hpp"
#include "layout/body/model/training_poses.hpp"

namespace bch::detail {

/// Holds spheres, and the one that each piece of a skin belongs to.
struct SphereChoice {
  std::vector<std::vector<SphereInfluence>> spheres;
  std::vector<std::uint32_t> owner;  ///< of each piece
};

/// Chooses at most so many candidates that hold all pieces in all poses when they are grown by as little as possible: always the one that
/// holds most of the pieces that are left. Pieces that no candidate can hold go to the chosen one that has to grow least.
/// `advance`: is called with the fraction that is done.
SphereChoice choose_spheres(const SkinPieces& skin, std::span<const BodyCandidate> candidates,
                            const TrainingPoses& poses, std::uint32_t most, double scale,
                            const std::function<void(double)>& advance);

}  // namespace bch::detail
