// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/validation.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

template <class Column>
void require_alignment(const Column& column, std::size_t alignment, const char* name) {
  const auto address = reinterpret_cast<std::uintptr_t>(column.data());
  if (column.empty() || (address % alignment == 0 && column.stride() % alignment == 0)) return;
  throw std::invalid_argument("agents: expected values of " + std::string(name) +
                              " at addresses that are multiples of " + std::to_string(alignment) +
                              ", found a stride of " + std::to_string(column.stride()));
}

}  // namespace

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
  if (agents.heading.are_directions()) require(agents.heading.y().size(), "heading's y", false);
  require(agents.level.size(), "level", true);
  require(agents.z.size(), "z", true);
  require_alignment(agents.shape, alignof(std::uint32_t), "shape");
  for (const auto& [numbers, name] : {std::pair{agents.x, "x"},
                                      {agents.y, "y"},
                                      {agents.heading.x(), "heading"},
                                      {agents.heading.y(), "heading"},
                                      {agents.z, "z"}})
    require_alignment(numbers, numbers.is_float() ? alignof(float) : alignof(double), name);
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("agents: more than 2^32 - 1");
}

void require_heights(const ShapeSetView& shapes, const Agents& agents) {
  if (!agents.z.empty() && shapes.heights == nullptr && shapes.shape_count > 0)
    throw std::invalid_argument("agents: they have a z, and the set was planned without heights");
}

std::string misplacement(double x, double y, const Headings::Value& heading, double z) {
  const auto is_near = [](double metres) { return std::abs(metres) <= rounding::largest_position; };
  if (heading.is_direction && !is_unit(heading.x, heading.y))
    return "heading (" + shortest(heading.x) + ", " + shortest(heading.y) +
           ") is no direction, expected a length from 0.999 to 1.001";
  if (!(std::abs(heading.x) <= rounding::largest_heading))
    return "heading " + shortest(heading.x) + " rad is not within +-1e9";
  if (!is_near(z)) return "z " + shortest(z) + " m is not within +-1e9";
  if (is_near(x) && is_near(y)) return {};
  return "position (" + shortest(x) + ", " + shortest(y) + ") m is not within +-1e9";
}

void reject(const ShapeSetView& shapes, const Agents& agents, std::size_t i) {
  const auto why = [&]() -> std::string {
    if (agents.shape[i] >= shapes.shape_count)
      return "shape " + std::to_string(agents.shape[i]) + " of " + std::to_string(shapes.shape_count);
    if (!agents.level.empty() && agents.level[i] >= shapes.level_count)
      return "level " + std::to_string(agents.level[i]) + " of " + std::to_string(shapes.level_count);
    return misplacement(agents.x[i], agents.y[i], agents.heading[i], agents.z.empty() ? 0 : agents.z[i]);
  };
  throw std::invalid_argument("agent " + std::to_string(i) + ": " + why());
}

}  // namespace bch::detail
