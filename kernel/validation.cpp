// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/validation.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace bch::kernel {
namespace {

std::size_t count_beyond(const double* values, std::size_t count, double limit) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < count; ++i) beyond += !(std::abs(values[i]) <= limit);
  return beyond;
}

template <class Index>
std::size_t count_from(const Index* values, std::size_t count, std::uint32_t limit) {
  std::size_t from = 0;
  for (std::size_t i = 0; i < count; ++i) from += values[i] >= limit;
  return from;
}

}  // namespace

bool are_valid(const ShapeSet& shapes, const Agents& agents, std::size_t begin, std::size_t end) noexcept {
  const std::size_t count = end - begin;
  std::size_t bad = count_from(agents.shape.data() + begin, count, shapes.shape_count()) +
                    count_beyond(agents.x.data() + begin, count, rounding::largest_position) +
                    count_beyond(agents.y.data() + begin, count, rounding::largest_position) +
                    count_beyond(agents.heading.data() + begin, count, rounding::largest_heading);
  if (!agents.level.empty()) bad += count_from(agents.level.data() + begin, count, shapes.level_count());
  return bad == 0;
}

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

void reject(const ShapeSet& shapes, const Agents& agents, std::size_t i) {
  std::ostringstream message;
  message << "agent " << i << ": ";
  if (agents.shape[i] >= shapes.shape_count()) {
    message << "shape " << agents.shape[i] << " of " << shapes.shape_count();
  } else if (!agents.level.empty() && agents.level[i] >= shapes.level_count()) {
    message << "level " << static_cast<unsigned>(agents.level[i]) << " of " << shapes.level_count();
  } else if (!(std::abs(agents.heading[i]) <= rounding::largest_heading)) {
    message << "heading " << agents.heading[i] << " rad is not within +-1e9";
  } else {
    message << "position (" << agents.x[i] << ", " << agents.y[i] << ") m is not within +-1e9";
  }
  throw std::invalid_argument(message.str());
}

}  // namespace bch::kernel
