// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/poses.hpp>

#include "baselines/structure.hpp"

// Ragdolls: capsules on the bones of a character, as physics engines have them. A contender: fast, small, and without a promise, since
// capsules on bones hold a skin in no pose but those that somebody examined.

namespace bch::baselines {

/// Represents all points within a radius of a segment; it moves with one joint.
struct Capsule {
  std::uint32_t joint;
  std::array<Vec3, 2> ends;  ///< in the joint's frame
  float thin;                ///< metres: the radius of the best fit to the vertices
  float holding;             ///< metres: with it, all capsules hold all vertices in all poses of the fit
};

/// Fits capsules to a character. The visible vertices of joints are merged and halved until there are so many groups, with the least error; names of
/// joints do not matter. Each group has the capsule whose axis is as deep below the skin as the capsule is thick, in the sense of least
/// squares, weighted by area, with penalties on vertices far outside and on ends that stick out. `poses`: the transforms of all joints,
/// as of WorldPose, in each pose that counts.
/// Errors:  throws std::invalid_argument on a character without triangles, and on no poses.
std::vector<Capsule> fit_ragdoll(const Character& character, std::span<const std::vector<Affine3d>> poses,
                                 std::uint32_t capsules);

/// Holds a ragdoll in a pose: whole lanes of capsules in the agent's frame, side by side. Lanes behind the last one are far away.
struct PosedRagdoll {
  std::vector<float> lanes;  ///< fields of capsules, in the order of capsule_lanes.hpp
  std::uint32_t capsules = 0;

  std::size_t bytes() const { return lanes.size() * sizeof(float); }
};

/// Poses a ragdoll by the transforms of all joints, as of WorldPose: the root joint's point on the ground becomes the origin. Allocates
/// nothing after the first time. `grown`: 0 for thin capsules, 1 for those that hold their vertices.
void pose_ragdoll(const Character& character, std::span<const Capsule> capsules,
                  std::span<const Affine3d> joints, float grown, PosedRagdoll& posed);

/// Makes a structure that answers whether capsules overlap, at any Agents::z; in float, without a margin.
std::unique_ptr<Structure> ragdoll_structure(std::vector<PosedRagdoll> ragdolls);

}  // namespace bch::baselines
