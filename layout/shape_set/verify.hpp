// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <bch/shapes.hpp>

namespace bch::detail {

/// Describes a stored value that contradicts the rest of its set.
struct Inconsistency {
  static constexpr std::uint32_t no_level = 0xffffffff;

  std::uint32_t shape;
  std::uint32_t level;  ///< no_level if the array has no levels
  const char* array;    ///< the name of the array, as in errors of loading
  std::string what;     ///< the value, its place, and the value that the rest requires
};

/// Returns an inconsistency as one line: "shape 3, level 1: nodes: ...".
std::string text_of(const Inconsistency& inconsistency);

/// Checks that a set gives right answers: recomputes, from discs and outlines, everything else that the set stores,
/// and compares. (Loading checks only that queries are safe.)
///
/// - The discs of a node and of its child could be the smallest ones around a set of points and around a part of it.
///   Every disc of the cut can be reached: it is inside the block nodes that lead to it, and their outer radii
///   enclose it and are no larger than needed.
/// - A level has at most as many discs as its depth allows and no fewer than the level before. Each disc belongs to a
///   disc of the level before, and could be the smallest disc around a part of that disc's points.
/// - Extents, supports and outer radii of profiles follow from the discs.
/// - If outlines are stored, every level's discs cover them. Leaves that name a segment cover it. Margins are not
///   below what rounding needs. Contours' discs are the smallest. Inscribed discs lie inside the largest contour.
///   Profiles follow from the outline. If outlines are not stored, there are no inscribed discs, and profiles have no
///   inner radii.
///
/// Not checked, because a set does not determine them: that discs and outlines are those of a character; that a disc
/// is the smallest; and, without outlines, that no discs are missing.
///
/// Returns: at most `most` inconsistencies, shape after shape; none for a set that this library made.
/// Precondition: the arrays of the set are safe to read, as in every set that was built or loaded.
/// Cost:    about as much as making the flat shapes from their hierarchies.
std::vector<Inconsistency> verify(const ShapeSet& set, std::size_t most = 100);

}  // namespace bch::detail
