// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/validation.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace bch::kernel {

void require_sizes(const Agents& agents) {
  const std::size_t size = agents.size();
  const auto require = [size](std::size_t other, const char* name, bool optional) {
    if (other == size || (optional && other == 0)) return;
    throw std::invalid_argument("agents: " + std::to_string(size) + " shapes but " + std::to_string(other) +
                                " values of " + name);
  };
  require(agents.x.size(), "x", false);
  require(agents.y.size(), "y", false);
  require(agents.heading.size(), "heading", false);
  require(agents.level.size(), "level", true);
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("agents: more than 2^32 - 1");
}

void reject(const ShapeSetView& shapes, const Agents& agents, std::size_t i) {
  std::ostringstream message;
  message << "agent " << i << ": ";
  if (agents.shape[i] >= shapes.shape_count) {
    message << "shape " << agents.shape[i] << " of " << shapes.shape_count;
  } else if (!agents.level.empty() && agents.level[i] >= shapes.level_count) {
    message << "level " << static_cast<unsigned>(agents.level[i]) << " of " << shapes.level_count;
  } else if (!(std::abs(agents.heading[i]) <= rounding::largest_heading)) {
    message << "heading " << agents.heading[i] << " rad is not within +-1e9";
  } else {
    message << "position (" << agents.x[i] << ", " << agents.y[i] << ") m is not within +-1e9";
  }
  throw std::invalid_argument(message.str());
}

}  // namespace bch::kernel
