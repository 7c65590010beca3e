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

#include <bch/characters.hpp>
#include <bch/outline.hpp>

namespace bch::detail {
struct BuildImplementation;
}

namespace bch {

/// Finds the outline of one mesh in pose after pose: the outer boundary of its triangles, seen from above.
/// The result is exact on a grid whose step is 2^-23 times the least power of two above the extent (0.12 um
/// for a person). The mesh may be open or non-manifold, with duplicated or degenerate triangles; holes are
/// left out. The result depends on the union of the triangles alone. "Outlines" in layout/README.md has the
/// rules.
class OutlineBuilder {
 public:
  /// Prepares the mesh. A bind pose makes building faster and changes no outline.
  /// Edges near each other in the bind pose are processed together. Vertices that coincide in the bind pose
  /// are merged in each pose in which they still coincide. Vertices that no triangle uses are ignored.
  /// Sizes:   triangle indices are below `vertices`; the bind pose has `vertices` positions or none.
  /// Errors:  throws std::invalid_argument if there are no triangles, an index is out of range, or the bind
  ///          pose has another length or a position that is not finite.
  OutlineBuilder(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                 std::span<const Vec3> bind_pose = {});
  OutlineBuilder(OutlineBuilder&&) noexcept;
  OutlineBuilder& operator=(OutlineBuilder&&) noexcept;
  ~OutlineBuilder();

  /// Writes the outline of a pose into `outline`, whose memory is reused.
  /// Allocates nothing once the longest outline has been built.
  /// Units:   metres; the ground is x-y.
  /// Errors:  throws std::invalid_argument if the number of positions is not that of the vertices, a
  ///          coordinate is not finite, the extent is outside 1e-6 to 1e6 m, or every triangle is a point.
  void build(std::span<const Vec2> positions, Outline& outline);
  /// Writes the outline of positions with heights.
  /// Returns: the interval of heights of all vertices that triangles use.
  /// Errors:  as the other overload; also if the height of such a vertex is not finite.
  Heights build(std::span<const Vec3> positions, Outline& outline);

  // Internal, for the library's own code; the type BuildImplementation is not public.

  /// Uses a given implementation, which this processor must support, in place of the best one.
  OutlineBuilder(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                 std::span<const Vec3> bind_pose, const detail::BuildImplementation& implementation);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Selects the part of a mesh whose outline outline() finds, and whether to find its holes.
struct OutlineOptions {
  /// Clips the mesh to an interval of heights, metres; infinite ends clip nothing.
  /// A clipped mesh is prepared again in every pose.
  Heights between = {};
  /// Also finds the holes of the union, as clockwise contours, and the parts inside the holes.
  /// A hole follows the counter-clockwise contour around it. With holes, no contour visits a point twice, and
  /// parts without area are left out. Takes about a hundred times as long.
  bool holes = false;
  /// Called like BakeOptions::progress, with the number of poses that outlines() has done so far.
  /// Returning false cancels.
  std::function<bool(std::size_t done, std::size_t total)> progress = {};
};

/// Finds the outline of a mesh in one pose: the exact union of its triangles seen from above.
/// See OutlineBuilder. The outline is empty if nothing of the mesh lies between the heights. Single points,
/// and parts within 1e-6 m of the origin, count as nothing.
/// Sizes:   triangle indices are below positions.size(); vertices without triangles are ignored.
/// Errors:  throws std::invalid_argument if there are no triangles, an index is out of range, a coordinate is
///          not finite (z is checked only if `between` clips), the extent is outside 1e-6 to 1e6 m, or the
///          heights of `between` are NaN or do not ascend.
Outline outline(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
                const OutlineOptions& options = {});
/// Finds the outline of a character in a pose, relative to its root joint; see ShapeBuilder::shape().
Outline outline(const Character& character, PoseTime at = {}, const OutlineOptions& options = {});

/// Finds the outlines of a mesh in many poses, on all threads of the caller's TBB arena.
/// The mesh is prepared once for all poses.
/// Sizes:   `positions` has `vertices` positions per pose, pose after pose.
/// Errors:  as outline(), with the number of the pose, and std::system_error of std::errc::operation_canceled
///          if cancelled.
std::vector<Outline> outlines(std::span<const Vec3> positions, std::size_t vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              const OutlineOptions& options = {});
/// Finds the outlines of a character in many poses.
std::vector<Outline> outlines(const Character& character, std::span<const PoseTime> poses,
                              const OutlineOptions& options = {});

}  // namespace bch
