// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tests/support/program_run.hpp"

namespace bch::test {

using Arguments = std::vector<std::string>;

/// Runs the program `bch`.
Ending bch(Arguments arguments, const Arguments& more = {}, const Streams& streams = {});

/// Expects one line on standard error that has all of the words, and nothing on standard output.
void expect_failure(const Ending& run, int code, const Arguments& words);

std::size_t lines(const std::string& text);

/// Counts a word in a text.
std::size_t count_of(const std::string& text, const std::string& word);

/// A table of agents on a lattice, dense enough for many to collide, in so many shapes and levels by turns.
std::string crooked_lattice(int side, int shapes = 1, int levels = 1);

/// Two people who walk through each other in 4 s, and a third who is never near them: a recording.
std::string two_who_meet();

nlohmann::json read_json(const std::filesystem::path& file);

/// A person-sized box, 0.5 m x 0.3 m on the ground, y up.
constexpr const char* box =
    "v -0.25 0 -0.15\nv 0.25 0 -0.15\nv 0.25 0 0.15\nv -0.25 0 0.15\n"
    "v -0.25 1.8 -0.15\nv 0.25 1.8 -0.15\nv 0.25 1.8 0.15\nv -0.25 1.8 0.15\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
/// The import options for that box.
inline const Arguments as_metres{"--up", "y", "--scale", "1"};

constexpr const char* four_agents =
    "id,shape,x,y,heading\na,0,0,0,0\nb,0,0.4,0,0\nc,0,0,0.35,0\n\"d,e\",0,9,9,1\n";

}  // namespace bch::test
