// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Measures how often a test of discs is wrong on hard cases, judged by exact arithmetic
/// (baselines/quad.hpp).
///
/// The truth is the definition of a collision (<bch/query.hpp>) for tight discs: whether two discs of the cuts, one of each agent,
/// have a point in common, and every disc above the one has one with every disc above the other. Three tests answer it: the
/// plain test in float as anybody would write it (positions, headings and tight discs in float, the world's coordinates; the
/// same pairs of discs), the same in double, and collide(). Beside that it is asked, of pairs whose outlines are about to
/// touch, whether collide() answers a hit wherever outlines meet.
namespace bch::bench {

/// Counts the errors of one test.
struct Errors {
  std::uint64_t misses = 0;           ///< discs collide, the answer is 0
  std::uint64_t false_positives = 0;  ///< they do not, the answer is 1
  // Metres, of Trial::gap():
  double deepest_miss = 0;  ///< below 0, the most that was missed
  double largest_gap = 0;   ///< the largest that was answered as a hit
  // The largest by the two shapes' extent:
  double miss_per_extent = 0, gap_per_extent = 0;
};

/// Holds the results for one value of what a family varies.
struct StabilityRow {
  std::string family, value;
  double conditioning = 0;  ///< the value as a number
  std::uint64_t pairs = 0;  ///< with discs near contact
  std::uint64_t meeting = 0;
  Errors plain_float, plain_double, ours;
  std::uint64_t outlines = 0;  ///< pairs with outlines near contact
  std::uint64_t outlines_meeting = 0, outline_misses = 0;
  bool outside = false;  ///< of the documented domain: has to be refused
  std::string refused;   ///< the exception's message; nothing is answered then
};

struct StabilitySetup;

struct StabilityFamily {
  const char* name;   ///< a word, for file names
  const char* title;  ///< a line
  const char* axis;   ///< what the value is; null: values are not numbers, there is no picture
  std::vector<StabilitySetup> (*setups)();
};
std::span<const StabilityFamily> stability_families();

/// Returns the rows of all families, in order, the same for a seed on every machine.
/// `pairs`: for every row, half of which go to outlines. Runs in the caller's TBB arena.
std::vector<StabilityRow> stability_rows(std::uint32_t pairs, std::uint64_t seed = 1);

/// Describes what is wrong with a row: a miss, a false positive beyond the documented gap, an answer outside
/// the domain, none inside. Empty: nothing.
std::string broken_promise(const StabilityRow& row);

/// The documented gap in metres per metre of extent, see layout/base/rounding.hpp.
constexpr double promised_gap = 4e-6;

/// Holds how the depths of one law and cut behave as the springs of penalty forces.
struct StiffRow {
  std::string law, cut;
  std::uint32_t bounces = 0;  ///< of two who fly into each other at 1 m/s, without drive and friction
  double onset = 0, largest_onset = 0;  ///< metres of depth in the first step of a bounce: mean, largest
  double energy = 0,
         max_energy = 0;  ///< that a bounce creates, parts of what was there: mean of the size, largest
  /// Seconds: of the steps that were tried, the largest up to which all were stable; 0: not even the first, 2 ms.
  /// Two press against each other; up to 20 in a corridor, one behind the other, against a wall; all through a door.
  double two_step = 0, row_step = 0, door_step = 0;
};

/// Returns the rows of all laws and cuts. Runs in the caller's TBB arena.
std::vector<StiffRow> stiff_rows(std::uint32_t people, std::uint32_t bounces);

}  // namespace bch::bench
