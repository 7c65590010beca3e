// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bch/character.hpp>
#include <bch/pose_shape.hpp>

#include "layout/animation/winding_grid.hpp"
#include "layout/character/motion_bounds.hpp"
#include "layout/character/skinning.hpp"

namespace bch::detail {

/// Enlarges the discs of chunks until they hold triangles of a character at every real time.
///
/// It goes through a chunk in short windows [a, b], in each of which discs move evenly, and vertices, too, but for a bend: with an
/// acceleration of at most A they leave the chord between a and b by at most A (b - a)^2 / 8. MotionBounds bounds A. A piece of a
/// triangle is held throughout a window if
///
///  1. one disc holds its corners at a and at b, with room for the bend: the distance of an evenly moving corner from an evenly
///     moving centre, less an evenly changing radius, is convex in time, so that it is largest at a or at b; or
///  2. at a and at b, no ring of centres meets it, and the rings go round it a number of times that is not 0. Let there be a
///     point of it that they do not go round at a time t between. Their number of turns about it changes only when an edge
///     crosses it. So an edge does both from a to t and from t to b, once of these within half a window of t. A point of
///     an edge between two centres is as deep as half their discs' overlap in one of these. The windows are so short that
///     this is more than a vertex and a disc move relative to each other in half of one: at t the point is still in that disc.
///
/// Other pieces are divided, and the smallest ones enlarge a disc.
class CoverCheck {
 public:
  /// Takes a character, which must outlive this. `spacing` is that of the discs: what is small is small beside it.
  /// Errors:  throws std::invalid_argument as MotionBounds does.
  CoverCheck(const Character& character, std::uint32_t clip, double spacing);

  /// Enlarges the discs of a chunk, whose times have to be floats, for all triangles.
  /// Errors:  throws std::invalid_argument where vertices move too fast for any window.
  void hold(AnimatedChunk& chunk);

 private:
  /// Represents a point that moves evenly through a window.
  struct Moving {
    PlanePoint a, b;
  };
  using Piece = std::array<Moving, 3>;
  struct MovingDisc {
    Moving centre;
    double radius_a, radius_b;
  };

  void pose(float seconds, std::vector<PlanePoint>& points);
  void hold_between_keys(AnimatedChunk& chunk, std::size_t key);
  float take_window(const AnimatedChunk& chunk, std::size_t key, float from, float limit);
  double reach() const;
  void place_discs(const AnimatedChunk& chunk, std::size_t key, double from, double to);
  bool is_calm(const AnimatedChunk& chunk) const;
  void hold_window(AnimatedChunk& chunk, std::size_t key);
  bool holds(const MovingDisc& disc, const Piece& piece) const;
  bool inside_rings(const Piece& piece) const;
  void find_near(const Piece& piece);
  std::uint32_t hold_piece(const Piece& piece, AnimatedChunk& chunk, std::size_t key);
  double missing(const Piece& piece, const MovingDisc& disc) const;
  std::uint32_t enlarge(const Piece& piece, AnimatedChunk& chunk, std::size_t key);

  const Character& character_;
  std::uint32_t clip_;
  double spacing_;
  MotionBounds bounds_;
  Skinner skinner_;
  // These are of the window.
  std::vector<PlanePoint> pose_a_, pose_b_, corners_;
  std::vector<MovingDisc> discs_;
  WindingGrid grid_a_, grid_b_;
  double bend_ = 0;
  std::vector<std::uint32_t> near_;  ///< discs near the triangle
  std::vector<std::uint32_t>
      last_holder_;  ///< per triangle: a disc that held it, or a part of it, in the window before
};

}  // namespace bch::detail
