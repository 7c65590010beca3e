// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>

#include <bch/agents.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Throws std::invalid_argument if the spans differ in length, or there are more than 2^32 - 1 agents.
void require_sizes(const Agents& agents);

/// Throws std::invalid_argument if agents have a z but the set has no heights.
void require_heights(const ShapeSetView& shapes, const Agents& agents);

/// Returns what is wrong with a position and heading, in metres and radians; empty if AgentCheck passes them.
std::string misplacement(double x, double y, const Headings::Value& heading, double z = 0);

/// Throws std::invalid_argument saying what is wrong with an agent that AgentCheck does not pass.
[[noreturn]] void reject(const ShapeSetView& shapes, const Agents& agents, std::size_t i);

}  // namespace bch::detail
