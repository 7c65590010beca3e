// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/character.hpp>
#include <bch/pose_shape.hpp>

namespace bch {

/// Holds the share of one bone in the centre of a sphere. The centre in a pose is the sum of weight * (where the bone takes `centre`).
struct SphereInfluence {
  std::uint32_t bone;
  float weight;
  Vec3 centre;  ///< in the frame that the bone's inverse_bind expects
};

/// Describes a body as spheres that move with a skeleton. In a pose each centre is blended from its bones, and each radius is the least
/// that holds the sphere's corners. Corners are points of the skin: each triangle, or each of the pieces that cuts make of it, has all
/// of its corners in one sphere, so that the spheres hold all triangles in every pose.
struct BodyModel {
  std::shared_ptr<const Character> character;  ///< its mesh, skeleton and clips
  std::vector<std::uint32_t> influence_begin;  ///< one offset more than spheres
  std::vector<SphereInfluence> influences;     ///< weights of a sphere are positive and sum to 1
  /// Makes more points: number vertices + i is the middle of these two earlier points, in every pose.
  std::vector<std::array<std::uint32_t, 2>> cuts;
  std::vector<std::uint32_t> corner_begin;  ///< one offset more than spheres
  std::vector<std::uint32_t> corners;       ///< points, ascending within a sphere
  std::vector<float> least_radius;  ///< one a sphere, metres; of spheres that stand for themselves. None: 0
  /// Spheres follow each other in leaves of so many, 4 or 8, that are near each other in most poses.
  std::uint32_t leaf_size = 4;
  std::array<std::uint32_t, core_spheres> core = {};  ///< spheres that most collisions meet first

  std::size_t sphere_count() const noexcept {
    return influence_begin.empty() ? 0 : influence_begin.size() - 1;
  }
};

/// Checks all that the type above promises, and that spheres hold all triangles of the mesh.
/// Errors:  throws std::invalid_argument naming the place and the value.
void validate(const BodyModel& model);

/// Says how make_body() works.
struct BodyOptions {
  std::uint32_t spheres = 256;  ///< at most 4096
  /// Leaves out the search for better places of the spheres: a model in seconds, whose errors are about twice as large.
  bool draft = false;
  /// Hears on the caller's thread, twenty times a second at most, which share is done. Returning false cancels.
  std::function<bool(double share)> progress = {};
};

/// Makes the model of a character: spheres inside its skin, bound to its bones. The same bits on every processor.
/// Cost:    up to a minute, a few seconds as a draft.
/// Errors:  throws std::invalid_argument as validate(Character) does, on spheres out of range, and on a character without triangles;
///          std::system_error of std::errc::operation_canceled where it is cancelled.
BodyModel make_body(const Character& character, const BodyOptions& options = {});

}  // namespace bch
