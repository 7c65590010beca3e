// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "layout/default_character/body_joints.hpp"

namespace bch::detail {

/// Holds what a vertex follows before the weights are spread: `joint`, and for the part `mix` of it `next`.
struct SkinTag {
  std::uint32_t joint = 0;
  std::uint32_t next = 0;
  double mix = 0;
  double softness = 0;  ///< 0..1: how far smooth() may move it
};

/// Represents a mesh of quads under construction; a face whose last two corners agree is a triangle. Corners run
/// counter-clockwise seen from outside.
struct BodySurface {
  using Loop = std::vector<std::uint32_t>;
  using Face = std::array<std::uint32_t, 4>;

  std::vector<Eigen::Vector3d> positions;
  std::vector<SkinTag> tags;  ///< one a vertex
  std::vector<Face> faces;

  std::uint32_t add(const Eigen::Vector3d& position, const SkinTag& tag);

  /// Adds quads between two loops of one length, where a loop's direction crossed with the way from `from` to
  /// `to` points outwards. An open strip has no quad between the last and the first corner; the quads that
  /// start at the corners `skip_begin` to `skip_end` - 1 are left out.
  void strip(const Loop& from, const Loop& to, bool closed, std::size_t skip_begin = 0,
             std::size_t skip_end = 0);

  /// Fills a loop by quads from side to side; corner 0 and the last corner are neighbours on one side.
  void cap(const Loop& loop);

  /// Returns a copy of `base` moved by `offset`, flattened across it and scaled about its middle, joined to `base` by
  /// quads.
  Loop extrude(const Loop& base, const Eigen::Vector3d& offset, double scale, const SkinTag& tag);
};

/// Completes a left half (y >= 0) by its mirror image; vertices at y = 0 are shared.
BodySurface mirrored(const BodySurface& left);

/// Evens out the vertices with a softness by Taubin's two steps, which do not shrink the body.
/// Source:  G. Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995.
void smooth(BodySurface& surface, int rounds);

/// Returns the neighbours of each vertex along the edges of the faces, in ascending order.
std::vector<std::vector<std::uint32_t>> neighbours(const BodySurface& surface);

/// Cuts each quad along its shorter diagonal.
std::vector<std::array<std::uint32_t, 3>> triangulated(const BodySurface& surface);

}  // namespace bch::detail
