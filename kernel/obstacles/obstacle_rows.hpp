// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/body_set.hpp>
#include <bch/obstacles.hpp>

#include "kernel/runtime/row_blocks.hpp"

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
  template <class MakeQuery>
  Rows<std::uint32_t> find_all(std::size_t agents, const MakeQuery& make);

  RowBlocks<std::uint32_t> rows_;
};

}  // namespace bch::detail
