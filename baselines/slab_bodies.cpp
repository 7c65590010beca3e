// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/slab_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace bch::baselines {
namespace {

/// Returns what lies in a slab of a body's heights. A plane is a little above its number.
std::optional<Heights> heights_in(const Heights& body, std::span<const float> planes, std::size_t slab) {
  Heights in = body;
  if (slab > 0 && planes[slab - 1] > in.bottom) in.bottom = planes[slab - 1];
  if (slab > 0 && !(body.top > planes[slab - 1])) return {};
  if (slab < planes.size()) {
    if (body.bottom > planes[slab]) return {};
    in.top = std::min(in.top, std::nextafter(planes[slab], 1e30f));
  }
  return in;
}

}  // namespace

SlabBodies::SlabBodies(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves)
    : slabs_(plan.slices.size() + 1), levels_(plan.depths.size()) {
  for (const Shape& shape : shapes) {
    const auto whole = static_cast<std::uint32_t>(parts_.size());
    if (shape.slabs.empty()) parts_.push_back(shape), heights_.push_back(shape.heights);
    for (std::size_t slab = 0; slab < slabs_; ++slab) {
      const std::optional<Heights> within = heights_in(shape.heights, plan.slices, slab);
      if (shape.slabs.empty()) {
        part_.push_back(within ? std::optional(whole) : std::nullopt);
      } else if (shape.slabs[slab].hierarchy.nodes.empty()) {
        part_.push_back({});
      } else {
        part_.push_back(static_cast<std::uint32_t>(parts_.size()));
        parts_.push_back(shape.slabs[slab]);
        heights_.push_back(within.value());
      }
    }
  }
  reference_.emplace(parts_, plan, leaves);
}

std::vector<SlabBodies::PartPair> SlabBodies::part_pairs(const Agents& agents, Pair pair) const {
  const auto [a, b] = pair;
  const long double rise = agents.z.empty() ? 0 : static_cast<long double>(agents.z[b]) - agents.z[a];
  const auto level = [&](std::uint32_t agent) {
    return static_cast<std::uint8_t>(agents.level.empty() ? levels_ - 1 : agents.level[agent]);
  };
  std::vector<PartPair> found;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::uint32_t i = 0; i < slabs_; ++i)
    for (std::uint32_t j = 0; j < slabs_; ++j) {
      const auto part_a = part_[agents.shape[a] * slabs_ + i], part_b = part_[agents.shape[b] * slabs_ + j];
      if ((rise == 0 && i != j) || !part_a || !part_b) continue;
      const long double slack = 1e-9L + 0x1p-50L * std::abs(rise);
      const Heights &of_a = heights_[*part_a], &of_b = heights_[*part_b];
      if (of_a.bottom > of_b.top + rise + slack || of_b.bottom + rise > of_a.top + slack) continue;
      if (!seen.insert({*part_a, *part_b}).second) continue;
      found.push_back({{*part_a, *part_b},
                       {i, j},
                       {agents.x[a], agents.x[b]},
                       {agents.y[a], agents.y[b]},
                       {agents.heading[a], agents.heading[b]},
                       {level(a), level(b)}});
    }
  return found;
}

bool SlabBodies::collide(const Agents& agents, Pair pair, Method method) const {
  // The agent of the lower index is A, as everywhere.
  const auto [a, b] = std::minmax(pair.first, pair.second);
  for (const PartPair& part : part_pairs(agents, {a, b}))
    if (reference_->solid(part.agents(), {0, 1}, method)) return true;
  return false;
}

}  // namespace bch::baselines
