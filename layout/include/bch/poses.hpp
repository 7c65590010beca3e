// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include <bch/characters.hpp>
#include <bch/geometry.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

namespace bch {

/// Represents an affine map like Affine3, in double.
/// Joint transforms are multiplied along the skeleton in double.
struct Affine3d {
  double rows[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  friend bool operator==(const Affine3d&, const Affine3d&) = default;
};

/// Views affine maps of float or double in the caller's memory, row-major or column-major.
/// That memory must stay valid and unchanged while the view is in use.
class Transforms {
 public:
  /// Views a contiguous range of Affine3 or Affine3d.
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const Affine3>> Transforms(const Range& maps)
      : Transforms(of(std::span<const Affine3>(maps))) {}
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const Affine3d>> Transforms(const Range& maps)
      : Transforms(of(std::span<const Affine3d>(maps))) {}

  /// Views row-major maps: three rows of four numbers each.
  /// Maps begin `stride` numbers apart: 12, or 16 if each has a fourth row.
  template <std::floating_point Number>
  static Transforms row_major(const Number* first, std::size_t count, std::size_t stride = 12) {
    return {first, count, stride, 4, 1, std::same_as<Number, double>};
  }
  /// Views column-major 4x4 matrices, as OpenGL, glTF, glm and Eigen store them.
  /// Row-major matrices for row vectors (Direct3D, Unreal) have the same layout in memory.
  template <std::floating_point Number>
  static Transforms column_major(const Number* first, std::size_t count, std::size_t stride = 16) {
    return {first, count, stride, 1, 4, std::same_as<Number, double>};
  }

  std::size_t size() const noexcept { return count_; }
  Affine3d operator[](std::size_t i) const noexcept;

 private:
  Transforms(const void* first, std::size_t count, std::size_t stride, std::size_t row, std::size_t column,
             bool is_double) noexcept
      : first_(first), count_(count), stride_(stride), row_(row), column_(column), is_double_(is_double) {}
  template <class Map>
  static Transforms of(std::span<const Map> maps) {
    return row_major(maps.empty() ? nullptr : maps[0].rows[0], maps.size());
  }

  const void* first_;
  std::size_t count_;
  std::size_t stride_, row_, column_;  ///< numbers from one map, row, column to the next
  bool is_double_;
};

/// Poses a character by the transforms of all joints, each in the frame of its parent.
/// The transform of a joint without parent is in the character's own frame, which Character::to_ground maps
/// to the world.
struct LocalPose {
  Transforms joints;
};

/// Poses a character by the world transforms of all joints: metres, z up.
/// As in a clip, the root joint's (x, y) becomes the shape's origin.
struct WorldPose {
  Transforms joints;
};

/// Poses a character by the bone matrices of a renderer, in the order of Character::bones.
/// A bone matrix is the world transform of the bone's joint times the bone's inverse_bind.
struct SkinningPalette {
  Transforms bones;
  /// The world point that becomes the shape's origin, metres.
  /// Ignored without a root joint: the origin is then the centre of the bounding rectangle.
  double x = 0, y = 0;
};

/// Poses a character by the positions of all vertices: metres, z up, relative to the origin of the shape.
struct PosedVertices {
  std::span<const Vec3> positions;
};

/// Holds a pose in one of the ways above, or as a time in a clip.
/// It views the arrays of the caller, which must stay unchanged until the call that uses the pose returns.
class Pose {
 public:
  using Kinds = std::variant<PoseTime, LocalPose, WorldPose, SkinningPalette, PosedVertices>;

  Pose() = default;  ///< the rest pose
  Pose(std::uint32_t clip, float seconds) : kind_(PoseTime{clip, seconds}) {}
  template <class Kind>
  requires(std::same_as<Kind, PoseTime> || std::same_as<Kind, LocalPose> || std::same_as<Kind, WorldPose> ||
           std::same_as<Kind, SkinningPalette> || std::same_as<Kind, PosedVertices>) Pose(const Kind& kind)
      : kind_(kind) {}

  const Kinds& kind() const noexcept { return kind_; }

 private:
  Kinds kind_;
};

/// Names a pose of a clip and its weight in a blend.
struct WeightedPose {
  PoseTime at;
  float weight = 1;
};

/// Selects the frame of joint transforms: the parent's (LocalPose) or the world (WorldPose).
enum class JointFrame : std::uint8_t { parent, world };

/// Returns the index of the joint that has a name.
/// Errors:  throws std::invalid_argument if no joint or more than one has the name.
std::uint32_t find_joint(const Character& character, std::string_view name);

// ShapeBuilder has functions of the same names that reuse memory.

/// Returns the transforms of all joints at a time of a clip.
/// As a LocalPose or a WorldPose they give the same shape as the clip, bit for bit.
/// Errors:  throws std::invalid_argument if the clip does not exist or the time is outside 0 to
///          Clip::seconds.
std::vector<Affine3d> joint_transforms(const Character& character, PoseTime at,
                                       JointFrame frame = JointFrame::parent);

/// Returns the joint transforms of a weighted mean of poses, in the frames of the parents.
/// Positions and scales are weighted means. Rotations are normalised weighted sums of quaternions; each is
/// first negated if that brings it nearer to the sum so far. Weights need not sum to 1.
/// Errors:  throws std::invalid_argument if a weight is negative or not finite, if no weight is above 0, if a
///          clip does not exist or a time is outside 0 to Clip::seconds.
std::vector<Affine3d> blend(const Character& character, std::span<const WeightedPose> poses);

/// Returns the positions of all vertices in a pose: metres, z up, relative to the origin of the shape.
/// Errors:  as ShapeBuilder::shape().
std::vector<Vec3> pose_vertices(const Character& character, const Pose& pose);

/// Converts the axes and units of another program to ours.
/// Ours are x forwards, y left, z up, metres, and headings in radians, counter-clockwise.
///
///     agents.x[i] = AxisSystem::unity.position(at.x, at.y, at.z)[0];
///     const Transforms posed = Transforms::column_major(matrices, joints);
///     builder.shape(WorldPose{AxisSystem::unity.transforms(posed)});
struct AxisSystem {
  double rows[3][3];   ///< rotation or reflection from the program's axes to ours
  double metres = 1;   ///< metres per unit of the program's lengths
  double radians = 1;  ///< radians counter-clockwise per unit of the program's headings

  /// Returns Character::to_ground of a character whose vertices and joints are in these axes.
  /// Its LocalPose then needs no conversion.
  Affine3 to_ground() const;
  Vec3 point(const Vec3& theirs) const;
  std::array<double, 3> position(double x, double y, double z) const;
  double heading(double theirs) const { return radians * theirs; }
  /// Converts a transform to our axes and units (a change of basis).
  Affine3d transform(const Affine3d& theirs) const;
  std::vector<Affine3d> transforms(const Transforms& theirs) const;

  /// Y up, z forwards, left-handed, metres; degrees about y, clockwise seen from above.
  static const AxisSystem unity;
  /// Z up, x forwards, left-handed, centimetres; degrees about z, clockwise seen from above.
  static const AxisSystem unreal;
  static const AxisSystem gltf;  ///< y up, z forwards, right-handed, metres; radians
  /// Y up, nodes face -z, right-handed, metres; radians.
  /// In Godot, too, a model from a glTF file faces +z, as in `gltf`.
  static const AxisSystem godot;
  static const AxisSystem ros;  ///< REP 103: our own axes and units
};

inline constexpr AxisSystem AxisSystem::unity{{{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}, 1, -std::numbers::pi / 180};
inline constexpr AxisSystem AxisSystem::unreal{
    {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, 0.01, -std::numbers::pi / 180};
inline constexpr AxisSystem AxisSystem::gltf{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
inline constexpr AxisSystem AxisSystem::godot{{{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
inline constexpr AxisSystem AxisSystem::ros{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Returns Character::to_ground * map for each map.
/// This converts joint or bone matrices from the character's model space to the world, for a WorldPose or a
/// SkinningPalette.
std::vector<Affine3d> grounded(const Character& character, const Transforms& maps);

/// Makes shapes of one character in pose after pose.
/// It poses the mesh, finds the outline of the union of its triangles, and builds the contour hierarchy. It
/// reuses its memory: a pose allocates nothing once the largest shape has been made.
/// Threads: one at a time may use an object. A moved-from object can only be assigned to or destroyed.
class ShapeBuilder {
 public:
  /// Prepares the mesh of a valid character (see validate()), which must outlive this object.
  /// The shapes are for sets with this `plan`: their hierarchies end at its deepest cut. A plan of depth 0
  /// alone, without heights, needs no outlines: the outermost vertices give its discs in a third of the time.
  /// Discs with a radius below `threshold`, in metres, are not divided.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeBuilder(const Character& character, const ShapeSetPlan& plan = {}, float threshold = 0.01f);
  /// Deleted, because a temporary character would not outlive this object.
  ShapeBuilder(const Character&&, const ShapeSetPlan& = {}, float = 0.01f) = delete;
  ShapeBuilder(ShapeBuilder&&) noexcept;
  ShapeBuilder& operator=(ShapeBuilder&&) noexcept;
  ~ShapeBuilder();

  /// Sets the largest number of nodes of a hierarchy, 2^22 by default.
  /// A shape that needs more nodes throws std::length_error.
  void limit_nodes(std::size_t max);

  /// Makes the shape of a pose, valid until the next call. Its hierarchy has primitives if the deepest depth
  /// is all_depths.
  /// The root joint's translation along the ground is removed; its rotation is kept. Between keys, poses
  /// follow the clip's curves.
  /// Errors:  throws std::invalid_argument if a clip or time is out of range, if transforms or vertices are
  ///          not finite or not as many as the character's; what OutlineBuilder and contour_hierarchy()
  ///          throw; std::domain_error if a posed position is not finite. After an error, the previous shape
  ///          is lost.
  const Shape& shape(const Pose& pose);

  /// Makes the outline of a pose, the first step of shape(), for callers that need only outlines.
  /// For a plan of depth 0 alone, without heights, the outline is empty.
  const Shape& make_outline(const Pose& pose);
  /// Makes the hierarchy over the last outline, the second step of shape().
  const Shape& make_hierarchy();

  // Like the functions of the same names above. Results lie in memory of this object and are valid until the
  // next call of any of its functions that takes a pose or a time.
  std::span<const Affine3d> joint_transforms(PoseTime at, JointFrame frame = JointFrame::parent);
  std::span<const Affine3d> blend(std::span<const WeightedPose> poses);
  std::span<const Vec3> pose_vertices(const Pose& pose);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Selects the shapes that bake() makes of characters.
struct BakeOptions {
  /// The number of poses per character, spread evenly over its clips, character by character.
  std::uint32_t poses = 100;
  /// The shapes one by one, for instance ScenePlan::shapes; empty: `poses` of every character.
  std::vector<PoseId> shapes = {};
  ShapeSetPlan plan = {};
  float threshold = 0.01f;  ///< metres; the radius below which discs are not divided
  /// Called on the caller's thread, at most twenty times per second, with the number of shapes made so far.
  /// Returning false cancels.
  std::function<bool(std::size_t done, std::size_t total)> progress = {};
};

/// Makes a set of characters in many poses, on all threads of the caller's TBB arena.
/// The bytes do not depend on the number of threads.
/// Errors:  throws std::invalid_argument as validate(Character) does, if the plan is bad, or if a character
///          does not exist; what ShapeBuilder::shape() throws, naming character, clip and time;
///          std::length_error if the set is too large; std::system_error of std::errc::operation_canceled if
///          cancelled.
ShapeSet bake(std::span<const Character> characters, const BakeOptions& options = {});
/// Makes a set of one character.
ShapeSet bake(const Character& character, const BakeOptions& options = {});

}  // namespace bch
