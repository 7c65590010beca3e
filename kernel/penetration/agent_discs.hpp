// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>

#include <bch/agents.hpp>

#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// The discs of an agent, about its position and unturned.
class AgentDiscs {
 public:
  AgentDiscs(const ShapeSetView& shapes, const Agents& agents, std::uint32_t agent) noexcept
      : discs(cut_discs(shapes, static_cast<std::uint32_t>(agents.root(agent, shapes.level_count)))),
        // A set of single discs has no extents.
        max_extent(discs.count == 1 ? std::abs(discs.x[0]) + std::abs(discs.y[0]) + discs.radius[0]
                                    : shapes.max_extent[agents.shape[agent]]) {}

  const CutDiscs discs;
  const float max_extent;  ///< as in rounding.hpp
};

}  // namespace bch::detail
