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
    throw std::invalid_argument("agents: expected " + std::to_string(size) + " values of " + name +
                                ", one per shape, found " + std::to_string(other));
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
    throw std::invalid_argument("agents: expected fewer than 2^32, found more");
}

void require_heights(const ShapeSetView& shapes, const Agents& agents) {
  if (!agents.z.empty() && shapes.heights == nullptr && shapes.shape_count > 0)
    throw std::invalid_argument("agents: expected no z for a set without heights, found some");
}

std::string misplacement(double x, double y, const Headings::Value& heading, double z) {
  const auto is_near = [](double metres) { return std::abs(metres) <= rounding::largest_position; };
  if (heading.is_direction && !is_unit(heading.x, heading.y))
    return "expected a direction of length 0.999 to 1.001, found (" + shortest(heading.x) + ", " +
           shortest(heading.y) + ")";
  if (!(std::abs(heading.x) <= rounding::largest_heading))
    return "expected a heading within +-1e9 rad, found " + shortest(heading.x);
  if (!is_near(z)) return "expected a z within +-1e9 m, found " + shortest(z);
  if (is_near(x) && is_near(y)) return {};
  return "expected a position within +-1e9 m, found (" + shortest(x) + ", " + shortest(y) + ")";
}

void reject(const ShapeSetView& shapes, const Agents& agents, std::size_t i) {
  const auto why = [&]() -> std::string {
    if (agents.shape[i] >= shapes.shape_count)
      return "expected one of " + std::to_string(shapes.shape_count) + " shapes, found " +
             std::to_string(agents.shape[i]);
    if (!agents.level.empty() && agents.level[i] >= shapes.level_count)
      return "expected one of " + std::to_string(shapes.level_count) + " levels, found " +
             std::to_string(agents.level[i]);
    return misplacement(agents.x[i], agents.y[i], agents.heading[i], agents.z.empty() ? 0 : agents.z[i]);
  };
  throw std::invalid_argument("agent " + std::to_string(i) + ": " + why());
}

}  // namespace bch::detail
