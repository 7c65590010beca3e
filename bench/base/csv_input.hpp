// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <bch/pairs.hpp>

namespace bch::cli {

/// Holds agents as AGENTS.csv lists them.
struct AgentTable {
  std::vector<std::string> id;
  std::unordered_map<std::string, std::uint32_t> index_of;
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;
  std::vector<std::uint8_t> level;  ///< empty without that column
  std::vector<double> z;            ///< heights of the ground, metres; empty without that column
  std::vector<double> dx, dy;       ///< how far an agent moves, metres; empty without these columns
  std::vector<double> mobility;     ///< from 0 to 1; empty without that column

  Agents agents() const { return {shape, x, y, heading, level, z}; }
};

/// Both readers below take any order of columns, spaces around values, quotes as spreadsheets write them,
/// empty lines, and either kind of line ending.
/// Errors:  throw InputError naming file, line and value, and TrajectoryError on what is no text in UTF-8.

/// Reads the columns id,shape,x,y,heading[,z][,level][,dx,dy][,mobility]. An id is any text, unique; shapes are below
/// `shapes`, levels below `levels`, mobilities from 0 to 1, the rest within the limits of collide() and, for every two
/// agents, of time_of_impact(). `moving`: dx and dy have to be there.
AgentTable read_agents(const std::string& file, std::uint32_t shapes, std::uint32_t levels, bool moving);

/// Reads the columns first,second: ids of agents.
std::vector<Pair> read_pairs(const std::string& file, const AgentTable& agents);

/// Writes the same columns, as far as they were read.
std::string csv_of(const AgentTable& agents);

/// Puts ' before ids that spreadsheets take for formulas: those that begin with =, +, -, @ or a control character and are no numbers.
void guard_ids(AgentTable& table);

/// Writes an id as a CSV field: in quotes where it has a comma, a quote, a line ending, or a blank at either
/// end, which readers would otherwise take away.
std::string csv_field(const std::string& text);

}  // namespace bch::cli
