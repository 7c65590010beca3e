// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/shape_set.hpp>

namespace bch::report {

/// Selects what people in a crush may change beside their places.
enum class Freedom : std::uint8_t {
  places,    ///< nothing else
  headings,  ///< they turn, a few degrees a step, where that leaves less overlap
  poses,     ///< they also take another pose of the same character, drawn at random, where that does
};

/// Measures how densely people can stand: so many of them, in poses and headings at random, on a square with
/// periodic boundaries (opposite sides are identified). They stand loosely at first and are pushed apart
/// until no two overlap (the solid semantics). Then the square shrinks by a hundredth of its area, and so on
/// until they do not come apart in 300 steps.
/// `poses`: how many shapes of the set, one after the other, belong to a character each; used by
/// Freedom::poses alone.
/// Returns: people per square metre in the last square without overlaps, the same for the same arguments.
double densest_packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed,
                       Freedom freedom = Freedom::places, std::uint32_t poses = 1);

}  // namespace bch::report
