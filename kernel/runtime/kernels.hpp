// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

namespace bch {
struct DiscPair;
struct Pair;
struct Vec2;
}  // namespace bch

namespace bch::detail {

struct CutDiscs;
struct Arguments;
struct BodyArguments;
struct BodyClearanceArguments;
struct Box;
struct BoxBlock;
struct BoxHit;
struct ClearanceArguments;
struct FreeBound;
struct FreeColumns;
struct FreeTask;
struct ObstacleArguments;
struct ObstacleGap;
struct TimeOfImpactArguments;
template <class Float>
struct TransformOf;

/// Holds the lowest and the highest agent of some pairs; without pairs, low > high.
struct AgentRange {
  std::uint32_t low, high;
};

/// Holds the kernels of one instruction set.
struct Kernels {
  unsigned width;  ///< floats per register
  /// Returns whether agents begin .. end are valid, as collide() requires.
  bool (*check)(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Returns the range of the agents that pairs begin .. end name.
  AgentRange (*named)(const Pair* pairs, std::size_t begin, std::size_t end) noexcept;
  /// Writes the states of pairs begin .. end; see Arguments. Uses up to 256 KiB of stack and no other memory.
  void (*run)(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Does the same for within(), with Arguments::gaps.
  void (*run_within)(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Writes 1 or 0 for pairs begin .. end of bodies of spheres, with up to 256 KiB of stack; see BodyKernel.
  void (*run_bodies)(const BodyArguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Writes the nearest spheres of those pairs, with as much stack; see BodyClearanceArguments.
  void (*body_clearance)(const BodyClearanceArguments& arguments, std::size_t begin,
                         std::size_t end) noexcept;
  /// Writes how many contacts each of pairs begin .. end has, to counts[begin] .. counts[end].
  void (*count_contacts)(const Arguments& arguments, std::size_t begin, std::size_t end,
                         std::uint64_t* counts) noexcept;
  /// Writes the contacts of pairs from `begin` on, from contacts[offsets[begin]] on, and their ends to `offsets`, until `capacity`
  /// contacts are full. Returns one past the last pair that was answered.
  std::size_t (*append_contacts)(const Arguments& arguments, std::size_t begin, std::size_t end,
                                 std::uint64_t* offsets, DiscPair* contacts, std::uint64_t capacity) noexcept;
  /// Writes the contacts of pair i to contacts[offsets[i]] .. contacts[offsets[i + 1]].
  void (*fill_contacts)(const Arguments& arguments, std::size_t begin, std::size_t end,
                        const std::uint64_t* offsets, DiscPair* contacts) noexcept;
  /// Writes the interval that discs span along each axis: the least c . axis - r and the largest c . axis + r.
  void (*extents)(const CutDiscs& discs, const float* axis_x, const float* axis_y, std::uint32_t axes,
                  float* low, float* high) noexcept;
  /// Place segments, bound two opposite directions, turn a pair into a direction, and search it; see FreeKernel.
  void (*free_place)(const Vec2* points, std::uint32_t count, const TransformOf<float>& to_a,
                     const FreeColumns& to, std::uint32_t first) noexcept;
  void (*free_bound)(const FreeBound& by, float x, float y, float* places) noexcept;
  void (*free_turn)(const FreeTask& task, float x, float y) noexcept;
  float (*free_next)(const FreeTask& task, float place) noexcept;
  /// Writes the nearest discs of pairs begin .. end, with as much stack as run(); see ClearanceArguments.
  void (*clearance)(const ClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Writes the times of impact of pairs begin .. end, which do not collide now; see TimeOfImpactArguments.
  void (*time_of_impact)(const TimeOfImpactArguments& arguments, std::size_t begin, std::size_t end) noexcept;
  /// Writes which boxes of one level overlap those of many queries; see BoxQuery. Returns how many were written.
  std::uint32_t (*overlapping_boxes)(const BoxBlock* blocks, const Box* queries, const BoxHit* in,
                                     std::uint32_t count, BoxHit* out) noexcept;
  /// Returns whether an agent touches the segments of an obstacle; see ObstacleKernel.
  bool (*touches)(const ObstacleArguments& arguments) noexcept;
  /// Finds the least gap between a disc of an agent and one of the segments, until it is at most `stop_below`.
  void (*find_gap)(const ObstacleArguments& arguments, double stop_below, ObstacleGap& best) noexcept;
};

}  // namespace bch::detail
