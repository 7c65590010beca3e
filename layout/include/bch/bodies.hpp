// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/characters.hpp>
#include <bch/poses.hpp>
#include <bch/shapes.hpp>

namespace bch {

/// Holds the skinning weight of one bone for the centre of a sphere.
/// The posed centre is the sum of weight * bone matrix * `centre` (linear blend skinning).
struct SphereInfluence {
  std::uint32_t bone;
  float weight;
  Vec3 centre;  ///< in the space that the bone's inverse_bind maps from
};

/// Describes a body as spheres that move with a skeleton and enclose all triangles of a skin in every pose.
/// In a pose each centre is blended from its bones, and each radius is the least that holds the sphere's
/// corners. Every triangle, or every piece of one that `midpoints` divides, has its three
/// corners among those of one sphere.
struct BodyModel {
  std::shared_ptr<const Character> character;  ///< its mesh, skeleton and clips
  std::vector<std::uint32_t> influence_begin;  ///< one offset more than spheres
  std::vector<SphereInfluence> influences;     ///< weights of a sphere are positive and sum to 1
  /// Makes more points: number vertices.size() + i is the midpoint of these two earlier points, in every
  /// pose.
  std::vector<std::array<std::uint32_t, 2>> midpoints;
  std::vector<std::uint32_t> corner_begin;  ///< one offset more than spheres
  std::vector<std::uint32_t> corners;       ///< indices of vertices or midpoints, ascending within a sphere
  std::vector<float> least_radius;          ///< lower bound of each sphere's radius, metres; empty: 0
  /// Every leaf_size spheres in sequence, 4 or 8, form a leaf; they are near each other in most poses.
  std::uint32_t leaf_size = 4;
  /// Indices of spheres that queries test first, which changes no answer. Repeats are allowed.
  std::array<std::uint32_t, detail::core_spheres> core = {};

  std::size_t sphere_count() const noexcept {
    return influence_begin.empty() ? 0 : influence_begin.size() - 1;
  }
};

/// Checks all that the type above promises, and that spheres hold all triangles of the mesh.
/// Errors:  throws std::invalid_argument naming the place and the value.
void validate(const BodyModel& model);

/// Writes a model, with its character, as bytes.
/// They are for files, other processes and other programs on machines of the same byte order.
/// Errors:  throws std::invalid_argument as validate() does.
std::vector<std::byte> to_bytes(const BodyModel& model);

/// Reads a model from bytes of to_bytes(), which need not be trusted.
/// Errors:  throws std::invalid_argument on other bytes, and as validate() does.
BodyModel body_model(std::span<const std::byte> bytes);

/// Says how make_body() works.
struct BodyOptions {
  std::uint32_t spheres = 256;  ///< at most 4096
  /// Leaves out the search for better places of the spheres.
  /// That makes a model in seconds, with errors about twice as large.
  bool draft = false;
  /// Called on the caller's thread, at most twenty times a second, with the part done, from 0 to 1.
  /// Returning false cancels.
  std::function<bool(double fraction)> progress = {};
};

/// Makes the model of a character: spheres inside its skin, bound to its bones. The same bits on every
/// processor.
/// Cost:    up to a minute, a few seconds as a draft.
/// Errors:  throws std::invalid_argument as validate(Character) does, on spheres out of range, and on a
///          character without triangles of some area; std::system_error of std::errc::operation_canceled
///          where it is cancelled.
BodyModel make_body(const Character& character, const BodyOptions& options = {});

/// Makes the model of a rigid body from spheres, for things that move among people and share their sets.
/// Its poses are Pose() (at rest) or a transform of its one joint, which may tilt it. Radii are the same in
/// every pose. The model numbers spheres by groups that are near each other, not as they are given: sphere i
/// has the centre influences[i].centre and the radius least_radius[i].
/// Errors:  throws std::invalid_argument on no spheres or more than 4096, and on one that is not finite or
///          has a negative radius.
BodyModel make_body(std::span<const Sphere> spheres);

/// Returns the model that comes with the library of a built-in character, with 64, 128, 256 or 512 spheres.
/// It is what make_body() makes of default_male() or default_female(). Pedestrians (default_pedestrian()),
/// who have the same skins, take the same models.
/// Cost:    milliseconds.
/// Errors:  throws std::invalid_argument on another skin or skeleton, or another number of spheres; use
///          make_body() for those.
BodyModel default_body(const Character& built_in, std::uint32_t spheres = 256);

/// Holds the options of animate().
struct AnimateOptions {
  /// Limits how far spheres protrude from those of BodyPoser, metres, between keys more than 9 ms apart.
  /// Closer keys have no such limit.
  float error = 0.005f;
  std::optional<bool> loops =
      {};  ///< AnimatedDiscs::loops; none: whether the clip's last pose is its first one, to 0.025 mm
};

/// Makes moving spheres of a clip that hold all triangles at every real time of it.
/// There is one for each sphere of the model; layout/animation/clip_samples.hpp has the proof. Each number of
/// a chunk is one of 16 bits times a power of two. The heights bound those of the triangles at every real
/// time.
/// Errors:  throws std::invalid_argument as validate() does, on a clip that does not exist or takes no time,
///          on channels that jump, step or are cubic, on a character without a root joint, and on an error
///          that is not above 0; std::domain_error as BodyPoser::spheres() does.
AnimatedDiscs animate(const BodyModel& model, std::uint32_t clip, const AnimateOptions& options = {});

/// Poses the spheres of a model, one pose after the other.
/// Threads: one at a time may use an object. One that was moved from can only be assigned to or destroyed.
class BodyPoser {
 public:
  /// Copies a model.
  /// Errors:  throws std::invalid_argument as validate() does.
  explicit BodyPoser(const BodyModel& model);
  BodyPoser(BodyPoser&&) noexcept;
  BodyPoser& operator=(BodyPoser&&) noexcept;
  ~BodyPoser();

  /// Returns the spheres of a pose: a time of a clip, joint transforms or bone matrices.
  /// They hold every triangle of pose_vertices(), in the same frame, whatever the pose. Valid until the next
  /// call.
  /// Errors:  as PoseShaper::shape(); throws std::invalid_argument on a pose of vertices, which does not say
  ///          where bones are, and std::domain_error on a reach outside 1e-6 to 1e6 m.
  std::span<const Sphere> spheres(const Pose& pose);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Names a pose of a body of one of several models.
struct PoseOfBody {
  std::uint32_t model = 0;
  Pose pose;
};

/// Says which bodies bake() makes.
struct BakeBodiesOptions {
  std::uint32_t poses =
      100;  ///< of each model, spread evenly over its character's clips, one model after the other
  std::vector<PoseOfBody> bodies = {};  ///< which poses of which models; none: `poses`
  /// Called on the caller's thread, at most twenty times a second, with the bodies made so far. Returning
  /// false cancels.
  std::function<bool(std::size_t done, std::size_t total)> progress = {};
};

/// Makes a set of models in many poses, on all threads of the caller's TBB arena, with the same bits.
/// Errors:  throws std::invalid_argument as validate() does and on a model that is not there; what
///          BodyPoser::spheres() throws, with the number of the body; and std::system_error of
///          std::errc::operation_canceled where it is cancelled.
BodySet bake(std::span<const BodyModel> models, const BakeBodiesOptions& options = {});
/// Makes a set of one model.
BodySet bake(const BodyModel& model, const BakeBodiesOptions& options = {});

/// Holds a body for each of many agents, who all have poses of their own in every frame.
///
///     bch::LiveBodies bodies(models, model_of_agent);
///     bodies.pose(poses);                                     // in every frame
///     for (const auto [a, b] : crowd.collisions(bodies.set(), {body, x, y, heading})) ...
class LiveBodies {
 public:
  /// Copies models. Body i is one of model model_of_body[i], in the rest pose.
  /// Errors:  throws std::invalid_argument as validate() does, and on an index of no model.
  LiveBodies(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body);
  LiveBodies(LiveBodies&&) noexcept;
  LiveBodies& operator=(LiveBodies&&) noexcept;
  ~LiveBodies();

  /// Poses all bodies, one pose a body, on all threads of the caller's TBB arena, with the same bits.
  /// No query may run meanwhile. Allocates nothing after the first calls.
  /// Errors:  throws std::invalid_argument on another number of poses and, naming the body, what
  ///          BodyPoser::spheres() throws. Some bodies then have their new poses.
  void pose(std::span<const Pose> poses);
  /// Returns the bodies in their present poses.
  const BodySet& set() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
