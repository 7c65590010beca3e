// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

#include "layout/culling/interior_loops.hpp"

namespace bch::detail {

/// Holds points where a disc is to touch a contour, and the unit normals there that point inward.
constexpr std::uint32_t max_touches = 64;
struct Touches {
  alignas(64) std::array<float, max_touches> x{}, y{}, normal_x{}, normal_y{};
  std::uint32_t count = 0;
};

/// Holds discs in parallel arrays, at most one per touch.
struct CandidateDiscs {
  alignas(64) std::array<float, max_touches> x{}, y{}, radius{};
  std::uint32_t count = 0;
};

/// Holds points that are equally spaced along a contour, whatever its number of corners. They stand for the contour
/// when discs are searched, where estimates suffice.
class ContourSamples {
 public:
  /// Takes the corners of the contour, counter-clockwise, in a unit in which the contour is about 27 wide. At least
  /// two corners differ.
  void take(std::span<const float> x, std::span<const float> y);

  /// Returns every other sample, with the normal of its edge.
  const Touches& touches() const { return touches_; }
  /// Finds, for each touch, the largest disc that touches there and contains neither a sample nor one of the given
  /// corners: a disc of the medial axis, up to the spacing of samples. On the outer side of a whisker, discs lie
  /// outside the contour; the caller must check that.
  /// Source:  the closed form of J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using nearest
  ///          neighbors and the normal field", The Visual Computer 28, 2012.
  void largest_discs(const InteriorLoops& loops, const Touches& touches, const ContourPoints& corners,
                     CandidateDiscs& discs) const;

 private:
  static constexpr std::uint32_t count = 2 * max_touches;
  alignas(64) std::array<float, count> x_, y_;
  Touches touches_;
  std::vector<float> length_;  ///< per corner: of the edge that ends there
  std::vector<double> begin_;  ///< of the same edges: distance along the contour
};

}  // namespace bch::detail
