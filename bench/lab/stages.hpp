// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "bench/lab/figures.hpp"
#include "layout/format/shape_set_view.hpp"

// What each stage of "Stages" in kernel/README.md compares of one pair, as the set stores it.

namespace bch::lab {

constexpr double turn = std::numbers::pi / 16;  ///< between two directions of supports
constexpr Stand stands[2] = {{0, 0, 0}, {0.615, -0.082, 9}};

double distance(Vec2 a, Vec2 b);
/// Returns the point that is so far along a direction.
Vec2 along(Vec2 point, Vec2 direction, double metres);
Vec2 direction_of(double radians);

/// Holds a sector of a person's profile.
struct Side {
  Vec2 centre, begin, end;  ///< in the world
  double inner, outer;
};

/// Returns the sectors along the line of the centres.
std::array<Side, 2> compared_profiles(const detail::ShapeSetView& view);

/// Returns a person's support along a direction of the world, numbered as by stands.
double support(const detail::ShapeSetView& view, unsigned person, unsigned direction);
/// Returns how far apart the lines about both people perpendicular to a direction are, metres; negative if they overlap.
double support_gap(const detail::ShapeSetView& view, unsigned direction);
/// Returns the direction of the widest gap.
unsigned widest_direction(const detail::ShapeSetView& view);

std::vector<Disc> inscribed(const detail::ShapeSetView& view, unsigned person);
/// Returns the least gap of two inscribed discs.
double inscribed_gap(const detail::ShapeSetView& view);

/// Represents a segment of an outline, in the world.
using Segment = std::array<Vec2, 2>;

/// Traverses the trees of the pair, as the kernel does but past the first hit.
class Traversal {
 public:
  explicit Traversal(const detail::ShapeSetView& view) : view_(view) {
    compare(view.trees[0].top, view.trees[1].top, 0);
  }

  /// Discs of each person that overlap one of the other's, by how many blocks are above them.
  std::array<std::vector<std::set<std::uint32_t>>, 2> overlapping;
  std::set<std::pair<std::uint32_t, std::uint32_t>> compared;  ///< blocks
  std::set<std::pair<std::uint32_t, std::uint32_t>> leaves;    ///< that overlap

  /// Returns a disc, of a block or of the cut, in the world.
  Disc disc(unsigned person, std::uint32_t name, unsigned lane) const;
  Disc leaf(unsigned person, std::uint32_t at) const { return disc(person, at | detail::leaf_bit, 0); }

  /// Returns the discs of the topmost block that overlap none.
  std::vector<Disc> top(unsigned person) const;

  std::vector<Segment> segments(unsigned person, std::uint32_t at) const;

 private:
  void compare(std::uint32_t a, std::uint32_t b, std::size_t level);

  std::uint32_t child(std::uint32_t name, unsigned lane) const;

  const detail::ShapeSetView& view_;
};

/// Returns where segments of overlapping leaves cross.
std::vector<Vec2> crossings(const Traversal& traversal);

}  // namespace bch::lab
