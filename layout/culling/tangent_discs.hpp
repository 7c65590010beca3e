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

/// Points where a disc is to touch a contour, and the unit normals there that point inward.
constexpr std::uint32_t max_touches = 64;
struct Touches {
  alignas(64) std::array<float, max_touches> x{}, y{}, normal_x{}, normal_y{};
  std::uint32_t count = 0;
};

/// Holds discs as arrays, room for one a touch.
struct CandidateDiscs {
  alignas(64) std::array<float, max_touches> x{}, y{}, radius{};
  std::uint32_t count = 0;
};

/// Holds points equally spaced along a contour, however many corners it has: what stands for it where discs are
/// found, which takes no more than estimates.
class ContourSamples {
 public:
  /// Takes the corners of the contour as arrays, counter-clockwise, in any unit that makes the contour about
  /// 27 wide. At least one distance between them is positive.
  void take(std::span<const float> x, std::span<const float> y);

  /// Returns every other sample, with the normal of its edge.
  const Touches& touches() const { return touches_; }
  /// Finds for each touch the largest disc that touches there and holds neither a sample nor one of the
  /// corners given: a disc of the medial axis, up to the spacing. On the outer side of a whisker discs lie
  /// outside; the caller has to check that.
  /// Source:  the closed form of J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using nearest
  ///          neighbors and the normal field", The Visual Computer 28, 2012.
  void largest_discs(const InteriorLoops& loops, const Touches& touches, const ContourPoints& corners,
                     CandidateDiscs& discs) const;

 private:
  static constexpr std::uint32_t count = 2 * max_touches;
  alignas(64) std::array<float, count> x_, y_;
  Touches touches_;
  std::vector<float> length_;  ///< of the edge that ends at each corner
  std::vector<double> begin_;  ///< of the same edges, along the contour
};

}  // namespace bch::detail
