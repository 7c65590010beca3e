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
/// The result is exact on a grid of 2^-23 of the power of two above the reach (0.12 um for a person).
/// Triangles may be open, non-manifold, duplicated or degenerate; holes are left out. The result depends only
/// on the union, not on how it is made of triangles. "Outlines" in layout/README.md has the rules.
class OutlineBuilder {
 public:
  /// Prepares the mesh; a bind pose makes building fast.
  /// Edges near each other in it are processed together, and vertices at one place in it are merged in every
  /// pose that does not separate them.
  /// Sizes:   triangle indices are below `vertices`; the bind pose has as many positions, or none.
  /// Errors:  throws std::invalid_argument on no triangles, an index out of range, a bind pose of another
  ///          length or with a position that is not finite. Vertices that no triangle uses do not count.
  OutlineBuilder(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                 std::span<const Vec3> bind_pose = {});
  OutlineBuilder(OutlineBuilder&&) noexcept;
  OutlineBuilder& operator=(OutlineBuilder&&) noexcept;
  ~OutlineBuilder();

  /// Writes the outline of a pose into `outline`, whose memory is used again.
  /// Allocates nothing once the longest outline has been built.
  /// Units:   metres; the ground is x-y.
  /// Errors:  throws std::invalid_argument on another number of positions than of vertices, a coordinate that
  ///          is not finite, a reach outside 1e-6 to 1e6 m, or when every triangle is a point.
  void build(std::span<const Vec2> positions, Outline& outline);
  /// Writes the outline of positions with heights.
  /// Returns: the heights of all vertices that triangles use.
  /// Errors:  as the other overload; also on such a height that is not finite.
  Heights build(std::span<const Vec3> positions, Outline& outline);

  // For the library's own parts, which alone know this type.

  /// Uses a given implementation instead of the best one. This processor has to support it.
  OutlineBuilder(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                 std::span<const Vec3> bind_pose, const detail::BuildImplementation& implementation);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Says what of a mesh outline() finds.
struct OutlineOptions {
  /// Clips the mesh at two heights, metres; infinite ones clip nothing.
  /// A clipped mesh is prepared anew in every pose.
  Heights between = {};
  /// Also finds the holes of the union, as clockwise contours, and what lies in the holes.
  /// They follow the counter-clockwise contour that is around them. No contour then visits a point twice, and
  /// parts without area are left out. It takes some hundred times as long.
  bool holes = false;
  /// Called as BakeOptions::progress, with the poses of outlines() done so far. Returning false cancels.
  std::function<bool(std::size_t done, std::size_t total)> progress = {};
};

/// Finds the outline of a mesh as it stands: the exact union of its triangles seen from above.
/// See OutlineBuilder. Between heights where there is nothing, or nothing but points and what is within 1e-6
/// m of the origin, it has no contours.
/// Sizes:   triangle indices are below positions.size(); vertices that no triangle uses do not count.
/// Errors:  throws std::invalid_argument on no triangles, an index out of range, a coordinate that is not
///          finite (a height only where some cut), a reach outside 1e-6 to 1e6 m, and heights that are NaN or
///          do not ascend.
Outline outline(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
                const OutlineOptions& options = {});
/// Finds the outline of a character in a pose, relative to the root joint's (x, y); see PoseShaper::shape().
Outline outline(const Character& character, PoseTime at = {}, const OutlineOptions& options = {});

/// Finds the outlines of a mesh in many poses, on all threads of the caller's TBB arena.
/// The mesh is prepared once for all poses.
/// Sizes:   one pose of so many vertices after the other.
/// Errors:  as outline(), with the number of the pose, and std::system_error of std::errc::operation_canceled
///          where it is cancelled.
std::vector<Outline> outlines(std::span<const Vec3> positions, std::size_t vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              const OutlineOptions& options = {});
/// Finds the outlines of a character in many poses.
std::vector<Outline> outlines(const Character& character, std::span<const PoseTime> poses,
                              const OutlineOptions& options = {});

}  // namespace bch
