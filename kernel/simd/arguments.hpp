// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch {
struct Pair;
}

namespace bch::detail {

struct ShapeSetView;

/// The number of pairs that a kernel takes through its stages together.
constexpr std::uint32_t packet_size = 256;

/// Locates one value of each agent in the caller's memory. The values may be any number of bytes apart. Numbers are
/// floats or doubles.
struct AgentColumn {
  const unsigned char* first;  ///< null: there are no values
  std::uint64_t stride;        ///< bytes
  bool is_float;
};

/// Holds what a pair kernel reads and writes. Members are plain pointers, because the inline functions of a class such
/// as std::span are compiled in every object file that uses it. The linker keeps one copy for all of them, perhaps one
/// that was compiled for AVX-512, and a processor without these instructions would crash in it.
struct Arguments {
  const ShapeSetView* shapes;
  std::uint32_t agent_count;
  AgentColumn agent_shape;
  AgentColumn agent_x;
  AgentColumn agent_y;
  AgentColumn agent_heading;    ///< angles, or the directions' x
  AgentColumn agent_heading_y;  ///< null: angles
  AgentColumn agent_level;      ///< null: the last level
  AgentColumn agent_z;          ///< null: heights are ignored
  const Pair* pairs;
  const float* gaps;  ///< per pair, the threshold of within() (Gaps::leaf, gaps.hpp); null: collide()
  std::uint8_t* states;
  bool exact_leaves;  ///< if both trees have segments, these decide; see Leaves
  // Prefetch agents or shapes: set if there are more than the near caches hold.
  bool prefetch_agents = false, prefetch_shapes = false;
};

/// Selects the result of a kernel for a pair.
enum PairState : std::uint8_t {
  apart = 0,        ///< no hit
  overlap = 1,      ///< a hit: they collide or are within the distance; may be set beside may_contain
  may_contain = 2,  ///< no hit so far; one outline might contain the other
};

}  // namespace bch::detail
