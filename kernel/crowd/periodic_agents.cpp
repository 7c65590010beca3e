// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/periodic_agents.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kernel/broad_phase/crowd_grid.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

/// Returns a coordinate modulo a period, from 0 to below it; as it is where there is no period.
double wrapped(double at, double period) noexcept {
  if (period == 0) return at;
  const double rest = std::fmod(at, period);  // exact
  const double result = rest < 0 ? rest + period : rest;
  return result < period ? result : 0;
}

/// Returns how far from its position an agent is searched for at most, plus the rounding of the broad phase.
double farthest_extent(const ShapeSetView& shapes, const Agents& agents, double margin) noexcept {
  const CrowdBounds all = bounds(shapes, agents, margin, 0, agents.size());
  return (all.offset + all.max_radius) * (1 + 0x1p-18);
}

/// Holds the shifts from a coordinate to those of its images, 0 among them.
struct Shifts {
  std::array<double, 3> values = {};
  std::size_t count = 1;
  const double* begin() const noexcept { return values.data(); }
  const double* end() const noexcept { return values.data() + count; }
};

Shifts shifts(double at, double period, double max_extent) noexcept {
  Shifts all;
  if (period > 0 && at <= 2 * max_extent) all.values[all.count++] = period;
  if (period > 0 && at >= period - 2 * max_extent) all.values[all.count++] = -period;
  return all;
}

void require_longer(double period, double max_extent, const char* axis) {
  if (period == 0 || period > 4 * max_extent) return;
  throw std::invalid_argument("crowd: expected a period along " + std::string(axis) + " of more than " +
                              shortest(4 * max_extent) + " m, four times the farthest extent, found " +
                              shortest(period));
}

}  // namespace

void PeriodicAgents::add_image(std::uint32_t agent, double x, double y) {
  origin_.push_back(agent);
  shape_.push_back(shape_[agent]);
  x_.push_back(x), y_.push_back(y);
  heading_.push_back(heading_[agent]);
  if (!heading_y_.empty()) heading_y_.push_back(heading_y_[agent]);
  if (!z_.empty()) z_.push_back(z_[agent]);
  if (!level_.empty()) level_.push_back(level_[agent]);
}

void PeriodicAgents::set(const ShapeSetView& shapes, const Agents& agents, CrowdOptions::Period period,
                         double margin) {
  const double max_extent = agents.size() == 0 ? 0 : farthest_extent(shapes, agents, margin);
  require_longer(period.x, max_extent, "x");
  require_longer(period.y, max_extent, "y");
  agents_ = agents.size();
  origin_.clear();
  shape_.clear(), x_.clear(), y_.clear(), heading_.clear(), heading_y_.clear(), level_.clear(), z_.clear();
  for (std::size_t i = 0; i < agents_; ++i) {
    shape_.push_back(agents.shape[i]);
    x_.push_back(wrapped(agents.x[i], period.x)), y_.push_back(wrapped(agents.y[i], period.y));
    heading_.push_back(agents.heading.x()[i]);
    if (agents.heading.are_directions()) heading_y_.push_back(agents.heading.y()[i]);
    if (!agents.level.empty()) level_.push_back(agents.level[i]);
    if (!agents.z.empty()) z_.push_back(agents.z[i]);
  }
  for (std::uint32_t i = 0; i < agents_; ++i) {
    const double x = x_[i], y = y_[i];
    const Shifts along_x = shifts(x, period.x, max_extent), along_y = shifts(y, period.y, max_extent);
    for (const double shift_x : along_x)
      for (const double shift_y : along_y)
        if (shift_x != 0 || shift_y != 0) add_image(i, x + shift_x, y + shift_y);
  }
}

Agents PeriodicAgents::agents() const noexcept {
  const Headings heading = heading_y_.empty() ? Headings(heading_) : Headings(heading_, heading_y_);
  return {shape_, x_, y_, heading, level_, z_};
}

}  // namespace bch::detail
