// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/obstacles.hpp>

namespace bch::detail {

/// Finds the obstacles that each agent collides with, and keeps its memory from call to call.
class ObstacleRows {
 public:
  /// Returns a row an agent, ascending, valid until the next call. Errors: as collide() with obstacles.
  Rows<std::uint32_t> find(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                           const CollideOptions& options);
  Rows<std::uint32_t> find(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
                           const Implementation* wanted);

 private:
  template <class MakeQuery, class Visit>
  Rows<std::uint32_t> find_all(std::size_t agents, const MakeQuery& make_query, const Visit& visit);

  std::vector<std::vector<std::uint32_t>> blocks_;  ///< what a task found, one agent after the other
  std::vector<std::uint64_t> offsets_;
  std::vector<std::uint32_t> values_;
};

}  // namespace bch::detail
