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
  Vec3 centre;  ///< in the mesh's frame, from which the bone's inverse_bind maps
};

/// Describes a body as spheres that move with a skeleton and enclose all triangles of a skin in every pose.
/// In a pose, the centre of a sphere is blended from its bones. The radius is the least that encloses the
/// sphere's `corners`, which are points of the skin. `midpoints` divide some triangles into pieces. All three
/// corners of each triangle, or of each piece of a divided one, are corners of the same sphere.
struct BodyModel {
  std::shared_ptr<const Character> character;  ///< its mesh, skeleton and clips
  std::vector<std::uint32_t> influence_begin;  ///< sphere_count() + 1 offsets into influences
  std::vector<SphereInfluence> influences;     ///< weights of a sphere are positive and sum to 1
  /// Adds points to the vertices: point vertices.size() + i is, in every pose, halfway between the two points
  /// of entry i, whose indices are lower.
  std::vector<std::array<std::uint32_t, 2>> midpoints;
  std::vector<std::uint32_t> corner_begin;  ///< sphere_count() + 1 offsets into corners
  std::vector<std::uint32_t> corners;       ///< indices of vertices or midpoints, ascending within a sphere
  std::vector<float> least_radius;          ///< lower bound of each sphere's radius, metres; empty: 0
  /// The number of consecutive spheres per leaf, 4 or 8. They should be near each other in most poses.
  std::uint32_t leaf_size = 4;
  /// The indices of the spheres that queries test first. They change no answer and may repeat.
  std::array<std::uint32_t, detail::core_spheres> core = {};

  std::size_t sphere_count() const noexcept {
    return influence_begin.empty() ? 0 : influence_begin.size() - 1;
  }
};

/// Checks what BodyModel promises, and that the spheres enclose all triangles of the mesh.
/// Errors:  throws std::invalid_argument naming the place and the value.
void validate(const BodyModel& model);

/// Writes a model, with its character, as bytes.
/// Machines of the same byte order can read them with body_model().
/// Errors:  throws std::invalid_argument as validate() does.
std::vector<std::byte> to_bytes(const BodyModel& model);

/// Reads a model from bytes of to_bytes(). Untrusted bytes are safe.
/// Errors:  throws std::invalid_argument if the bytes are malformed, and as validate() does.
BodyModel body_model(std::span<const std::byte> bytes);

/// Holds the options of make_body().
struct BodyOptions {
  std::uint32_t spheres = 256;  ///< at most 4096
  /// Skips the search for better positions of the spheres.
  /// Such a draft takes seconds, and its spheres fit the skin about half as closely.
  bool draft = false;
  /// Called on the caller's thread, at most twenty times per second, with the fraction done, from 0 to 1.
  /// Returning false cancels.
  std::function<bool(double fraction)> progress = {};
};

/// Makes the model of a character: spheres that enclose its skin, bound to its bones.
/// The result has the same bits on every processor.
/// Cost:    up to a minute; a few seconds for a draft.
/// Errors:  throws std::invalid_argument as validate(Character) does, if the number of spheres is out of
///          range, and if no triangle has an area; std::system_error of std::errc::operation_canceled if
///          cancelled.
BodyModel make_body(const Character& character, const BodyOptions& options = {});

/// Makes the model of a rigid body from spheres, for objects that move among people in the same set.
/// Pose the model by Pose() (at rest) or by a transform of its one joint, which may tilt it. Radii are the
/// same in every pose. The model reorders the spheres so that near ones follow each other: sphere i has the
/// centre influences[i].centre and the radius least_radius[i].
/// Errors:  throws std::invalid_argument if there are no spheres or more than 4096, or if a sphere is not
///          finite or has a negative radius.
BodyModel make_body(std::span<const Sphere> spheres);

/// Returns the library's ready-made model of a built-in character, with 64, 128, 256 or 512 spheres.
/// It equals make_body() of default_male() or default_female(). Pedestrians (default_pedestrian()) have the
/// same skins and take the same models.
/// Cost:    milliseconds.
/// Errors:  throws std::invalid_argument for any other skin, skeleton or number of spheres; use make_body()
///          there.
BodyModel default_body(const Character& built_in, std::uint32_t spheres = 256);

/// Holds the options of animate().
struct AnimateOptions {
  /// The largest distance by which moving spheres protrude from the spheres of BodyPoser, metres.
  /// It may be exceeded between keys at most 9 ms apart.
  float error = 0.005f;
  /// AnimatedDiscs::loops. Unset: true if the clip's last pose equals its first to 0.025 mm.
  std::optional<bool> loops = {};
};

/// Makes moving spheres that enclose all triangles of a body at every time of a clip, also between keys.
/// Each sphere of the model becomes one moving sphere; layout/animation/clip_samples.hpp has the proof. The
/// numbers of a chunk are 16-bit integers times a power of two. AnimatedDiscs::heights bound the triangles at
/// all times.
/// Errors:  throws std::invalid_argument as validate() does, if the clip does not exist or has no duration,
///          if its curves have jumps, steps or cubic parts, if the character has no root joint, and if the
///          error is not above 0; std::domain_error as BodyPoser::spheres() does.
AnimatedDiscs animate(const BodyModel& model, std::uint32_t clip, const AnimateOptions& options = {});

/// Poses the spheres of a model, one pose after the other.
/// Threads: one at a time may use an object. A moved-from object can only be assigned to or destroyed.
class BodyPoser {
 public:
  /// Copies a model.
  /// Errors:  throws std::invalid_argument as validate() does.
  explicit BodyPoser(const BodyModel& model);
  BodyPoser(BodyPoser&&) noexcept;
  BodyPoser& operator=(BodyPoser&&) noexcept;
  ~BodyPoser();

  /// Returns the spheres of a pose: a time of a clip, joint transforms or bone matrices.
  /// They enclose every triangle of pose_vertices(), in the same frame. The result is valid until the next
  /// call.
  /// Errors:  as ShapeBuilder::shape(); throws std::invalid_argument for PosedVertices, which do not say
  ///          where bones are, and std::domain_error if the extent is outside 1e-6 to 1e6 m.
  std::span<const Sphere> spheres(const Pose& pose);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Names a model, by its index, and a pose of its body.
struct PoseOfBody {
  std::uint32_t model = 0;
  Pose pose;
};

/// Selects the bodies that bake() makes.
struct BakeBodiesOptions {
  /// The number of poses per model, spread evenly over its character's clips, model by model.
  std::uint32_t poses = 100;
  std::vector<PoseOfBody> bodies = {};  ///< the bodies one by one; empty: `poses` of every model
  /// Called on the caller's thread, at most twenty times per second, with the number of bodies made so far.
  /// Returning false cancels.
  std::function<bool(std::size_t done, std::size_t total)> progress = {};
};

/// Makes a set of models in many poses, on all threads of the caller's TBB arena.
/// The bits do not depend on the number of threads.
/// Errors:  throws std::invalid_argument as validate() does and if a body's model does not exist; what
///          BodyPoser::spheres() throws, with the number of the body; std::system_error of
///          std::errc::operation_canceled if cancelled.
BodySet bake(std::span<const BodyModel> models, const BakeBodiesOptions& options = {});
/// Makes a set of one model.
BodySet bake(const BodyModel& model, const BakeBodiesOptions& options = {});

/// Holds one body per agent, for agents that each have a pose of their own in every frame.
///
///     bch::LiveBodies bodies(models, model_of_agent);
///     bodies.pose(poses);                                     // in every frame
///     for (const auto [a, b] : crowd.collisions(bodies.set(), {body, x, y, heading})) ...
class LiveBodies {
 public:
  /// Copies the models. Body i takes models[model_of_body[i]] and begins in the rest pose.
  /// Errors:  throws std::invalid_argument as validate() does, and if an index is out of range.
  LiveBodies(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body);
  LiveBodies(LiveBodies&&) noexcept;
  LiveBodies& operator=(LiveBodies&&) noexcept;
  ~LiveBodies();

  /// Poses all bodies, poses[i] for body i, on all threads of the caller's TBB arena.
  /// The bits do not depend on the number of threads. No query may run at the same time. Allocates nothing
  /// after the first calls.
  /// Errors:  throws std::invalid_argument if the number of poses is not that of the bodies, and what
  ///          BodyPoser::spheres() throws, with the number of the body. Some bodies may then have their new
  ///          poses.
  void pose(std::span<const Pose> poses);
  /// Returns the set of the bodies in their present poses.
  const BodySet& set() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
