// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "tests/fuzz/c_api_program.hpp"

// The steps of programs that call the C interface.

namespace bch::fuzz {

constexpr std::uint32_t most = 16;      // agents, points, parts
constexpr std::uint8_t untouched = 77;  // in the outputs

/// An array of answers, before and after a call.
template <class Value>
class Answers {
 public:
  Answers() { std::memset(values, untouched, sizeof values); }
  Value values[most];

  /// Ends the program where a call that failed has written.
  void check(bch_status status) const {
    if (Program::succeeded(status)) return;
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(values);
    require(std::all_of(bytes, bytes + sizeof values, [](std::uint8_t byte) { return byte == untouched; }),
            "nothing is written on an error");
  }
};

// Characters and building.

void ask_character(Program& by);
void make_builder(Program& by);
void finish(Program& by);
void add_polygons(Program& by);
void add_round_bodies(Program& by);
void add_mesh(Program& by);
void pose(Program& by);
void make_character(Program& by);
void add_sources(Program& by);
void plan_scene(Program& by);
void read_plan(Program& by);
void make_dynamic(Program& by);
void lend(Program& by);

// Queries, obstacles and scenes.

void ask_pairs(Program& by);
void find_pairs(Program& by);
void ask_crowd(Program& by);
void make_crowd_objects(Program& by);
void make_obstacles(Program& by);
void read_obstacles(Program& by);
void ask_obstacles(Program& by);
void ask_scene(Program& by);

}  // namespace bch::fuzz
