// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>

#include "layout/body/model/skin_pieces.hpp"
#include "layout/character/skinning.hpp"

namespace bch::detail {

/// Holds a ball inside a skin that touches it at two points, bound to the bones that move these.
struct BodyCandidate {
  std::vector<SphereInfluence> influences;
  double radius;  ///< metres, in the pose in which it was found
};

/// Finds the largest balls inside a skin in the last pose of a skinner: one that touches each point, and the middle of each piece, of
/// `skin`, by shrinking; of a skin without such balls, small ones about its points. `points`: the positions of all points in that pose. `scale`: by how much
/// lengths are larger than those for people.
std::vector<BodyCandidate> find_candidates(const Character& character, const SkinPieces& skin,
                                           std::span<const Vec3> points, const Skinner& posed, double scale);

}  // namespace bch::detail
