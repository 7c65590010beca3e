// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <bch/character.hpp>
#include <bch/pose.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shape_set.hpp>

namespace bch {

/// Makes shapes of one character in pose after pose: it poses the mesh, finds the outline of the union of its triangles, and builds
/// the contour hierarchy that splits at the centroid. It keeps its memory: a pose allocates nothing once the largest shape has been
/// made. Only one thread may use an object at a time, and one that was moved from can only be assigned to or destroyed.
class PoseShaper {
 public:
  /// Prepares the mesh of a character, which must outlive this object and must be valid (see validate()). Shapes are made for sets of
  /// a plan: hierarchies end at its deepest cut, and its slices cut the body. A plan of depth 0 alone needs no outlines: the
  /// outermost vertices give its discs in a third of the time. `threshold`, in metres, is the radius below which a disc is
  /// not divided.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit PoseShaper(const Character& character, const ShapeSetPlan& plan = {}, float threshold = 0.01f);
  /// Refuses a character that nothing would keep.
  PoseShaper(const Character&&, const ShapeSetPlan& = {}, float = 0.01f) = delete;
  PoseShaper(PoseShaper&&) noexcept;
  PoseShaper& operator=(PoseShaper&&) noexcept;
  ~PoseShaper();

  /// Sets the largest number of nodes of a hierarchy, 2^22 by default. Shapes of more nodes throw std::length_error.
  void limit_nodes(std::size_t most);

  /// Makes the shape of a pose: a time of a clip, joint transforms, bone matrices or posed vertices. Keys of a clip are interpolated as
  /// the channels' curves say, and times are clamped to the first and last key. The way of the root joint over the ground is removed
  /// from the shape, but for bone matrices and vertices; its turn stays in it.
  /// Returns: the shape down to the deepest depth, valid until the next call. It has primitives where that depth is all_depths, because
  ///          exact leaves need them. With slices it has only its slabs, each with outline and hierarchy. With slices, or with the
  ///          plan's heights, it also has the heights of the body.
  /// Errors:  throws std::invalid_argument on a clip or a time that does not exist, transforms or vertices of another number than the
  ///          character has or that are not finite, and as OutlineBuilder and contour_hierarchy() do, std::domain_error on a position
  ///          that is not finite. The shape made before is lost.
  /// `whole`: does not cut the body, whatever the plan's slices; the body is then one part at all of its heights.
  const Shape& shape(const Pose& pose, bool whole = false);

  /// Makes the outlines of a pose, the first step of shape(), for callers that need only outlines or time each step. It makes
  /// none for a plan of depth 0 alone without slices and heights.
  const Shape& make_outlines(const Pose& pose, bool whole = false);
  /// Makes the hierarchies over the last outlines, the second step of shape().
  const Shape& make_hierarchies();

  // Like the functions of these names in pose.hpp, in memory of this object: valid until the next call of the same function or of another
  // one for the same character.
  std::span<const Affine3d> joint_transforms(PoseTime at, JointFrame frame = JointFrame::parent);
  std::span<const Affine3d> blend(std::span<const WeightedPose> poses);
  std::span<const Vec3> pose_vertices(const Pose& pose);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Says what bake() makes of characters.
struct BakeOptions {
  std::uint32_t poses = 100;             ///< of each character, spread evenly over its clips, one character after the other
  std::vector<ShapeSource> shapes = {};  ///< which poses of which characters, for instance ScenePlan::shapes; none: `poses`
  ShapeSetPlan plan = {};
  float threshold = 0.01f;  ///< metres; the radius below which discs are not divided
  /// Hears on the caller's thread, twenty times a second at most, how many shapes are made. Returning false cancels.
  std::function<bool(std::size_t done, std::size_t total)> progress = {};
};

/// Makes a set of characters in many poses, on all threads of the caller's TBB arena: the same bytes for any number of them.
/// Errors:  throws std::invalid_argument as validate(Character) does, on a bad plan and on a character that is not there; what
///          PoseShaper::shape() throws, with the names of the character, clip and time; std::length_error on a set
///          that is too large; and std::system_error of std::errc::operation_canceled where it is cancelled.
ShapeSet bake(std::span<const Character> characters, const BakeOptions& options = {});
/// Makes a set of one character.
ShapeSet bake(const Character& character, const BakeOptions& options = {});

/// Holds the options of animate(), which say how close its discs are to a body, in metres. The defaults are for people.
struct AnimateOptions {
  float spacing = 0.025f;  ///< the largest distance of discs along the outline, at keys
  float inset =
      0.04f;  ///< the largest distance of centres behind the outline: the more, the less discs protrude between neighbours
  float error =
      0.005f;  ///< by how much more discs may protrude between two keys than at these, unless keys are 9 ms apart
  std::vector<float> slices =
      {};  ///< planes that cut the body into slabs, as in ShapeSetPlan; none: discs are of the whole body
  std::optional<bool> loops =
      {};  ///< AnimatedDiscs::loops; none: whether the clip's last pose is its first one, to a 1000th of the spacing
};

/// Makes moving discs of a character's clip that hold all of its triangles at every real time of the clip. The proof is in
/// layout/animation/cover_check.hpp. Parts of the body that are apart have rings of their own. Each number of a chunk is one of 16 bits
/// times a power of two. With slices the discs of each slab hold all triangles that reach into the slab at some time of the chunk, as
/// wholes, whereas PoseShaper cuts them. The heights bound those that triangles take at every real time of the clip.
/// Cost:    about as long as the clip for people of 2 850 triangles with 30 keys a second, and more for more keys and slabs.
/// Errors:  throws std::invalid_argument on a clip that does not exist or takes no time, on one with channels that jump, step or are
///          cubic, on a character without a root joint, on options that are not above 0 and on slices that validate(ShapeSetPlan)
///          rejects; std::length_error beyond 4096 discs a chunk; std::domain_error as PoseShaper::shape() does.
AnimatedDiscs animate(const Character& character, std::uint32_t clip, const AnimateOptions& options = {});

}  // namespace bch
