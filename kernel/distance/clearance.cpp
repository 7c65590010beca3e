// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/clearance.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/part_items.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

/// Pairs a task.
constexpr std::size_t grain = 1024;

constexpr float largest_limit = 1e10f;  ///< beyond the distance of any two agents

/// The largest float that is not above max_distance.
float limit_of(double max_distance) {
  const float nearest = static_cast<float>(std::min(max_distance, static_cast<double>(largest_limit)));
  return static_cast<double>(nearest) > max_distance ? std::nextafter(nearest, -1.0f) : nearest;
}

DiscPair nearest_discs(const ShapeSetView& shapes, const Agents& agents, Pair pair,
                       const NearestDiscs& nearest) {
  if (nearest.a == no_node) return no_discs;
  const auto index = [&](std::uint32_t agent, std::uint32_t node) {
    if (shapes.trees == nullptr) return node;
    return node - shapes.trees[agents.root(agent, shapes.level_count)].discs;
  };
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const DiscPair nodes{index(a, nearest.a), index(b, nearest.b)};
  return pair.second < pair.first ? DiscPair{nodes.second, nodes.first} : nodes;
}

/// Returns the direction of a clearance. It is computed in double, where squares do not underflow.
Vec2 direction(Pair pair, const NearestDiscs& nearest) {
  if (nearest.a == no_node) return {0, 0};
  const double x = nearest.x, y = nearest.y;
  const double sign = pair.second < pair.first ? -1 : 1;
  if (x == 0 && y == 0) return {static_cast<float>(sign), 0};
  const double c = nearest.cosine, s = nearest.sine, world_x = c * x - s * y, world_y = s * x + c * y;
  const double scale = sign / std::sqrt(world_x * world_x + world_y * world_y);
  return {static_cast<float>(scale * world_x), static_cast<float>(scale * world_y)};
}

/// The same for bodies in slabs or at different heights: the nearest parts, in a tie those in the lowest slabs.
void answer_parts(const Implementation& implementation, ClearanceArguments arguments,
                  const ShapeSetView& parts, std::span<const Pair> pairs, const PartItems& items,
                  const ClearanceAnswers& answers) {
  std::vector<NearestDiscs> nearest(items.size());
  const Agents agents = items.agents();
  arguments.in = arguments_for(parts, agents, items.pairs());
  arguments.nearest = nearest.data();
  implementation.kernels->clearance(arguments, 0, items.size());
  const auto is_before = [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      const float distance =
          nearest[i].a != no_node ? nearest[i].distance : std::numeric_limits<float>::infinity();
      return std::tuple(distance, items.origin(i).slab_a, items.origin(i).slab_b);
    };
    return key(a) < key(b);
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::size_t best = items.begin(i);
    for (std::size_t k = best + 1; k < items.begin(i + 1); ++k)
      if (is_before(k, best)) best = k;
    const bool found = items.begin(i) < items.begin(i + 1) && nearest[best].a != no_node;
    const bool is_turned = pairs[i].second < pairs[i].first;
    answers.distance[i] = found ? nearest[best].distance : std::numeric_limits<float>::infinity();
    if (!answers.direction.empty())
      answers.direction[i] = found ? direction(pairs[i], nearest[best]) : Vec2{0, 0};
    if (answers.discs.empty()) continue;
    answers.discs[i] = no_discs;
    if (!found) continue;
    const DiscPair local = nearest_discs(parts, agents, items.pairs()[best], nearest[best]);
    const DiscPair discs{local.first + items.origin(best).first_disc_a,
                         local.second + items.origin(best).first_disc_b};
    answers.discs[i] = is_turned ? DiscPair{discs.second, discs.first} : discs;
  }
}

/// The work of one task.
void answer(const Implementation& implementation, ClearanceArguments arguments, const Agents& agents,
            std::span<const Pair> pairs, const ClearanceAnswers& answers) noexcept {
  NearestDiscs nearest[grain];
  arguments.in.pairs = pairs.data();
  arguments.nearest = nearest;
  implementation.kernels->clearance(arguments, 0, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool found = nearest[i].a != no_node;
    answers.distance[i] = found ? nearest[i].distance : std::numeric_limits<float>::infinity();
    if (!answers.direction.empty()) answers.direction[i] = direction(pairs[i], nearest[i]);
    if (!answers.discs.empty())
      answers.discs[i] = nearest_discs(*arguments.in.shapes, agents, pairs[i], nearest[i]);
  }
}

void require_answers(const ClearanceAnswers& answers, std::size_t pairs) {
  const auto require = [pairs](std::size_t size, const char* name, bool optional) {
    if (size == pairs || (optional && size == 0)) return;
    throw std::invalid_argument("clearance: " + std::to_string(pairs) + " pairs but " + std::to_string(size) +
                                " " + name);
  };
  require(answers.distance.size(), "distances", false);
  require(answers.direction.size(), "directions", true);
  require(answers.discs.size(), "discs", true);
}

}  // namespace

void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_answers(answers, pairs.size());
  if (!(options.max_distance >= 0))
    throw std::invalid_argument("clearance: a max_distance of " + shortest(options.max_distance) + " m");
  const Implementation& implementation = chosen(options, "clearance");
  const ShapeSetView& view = shapes.view();
  require_valid(implementation, view, agents, pairs);

  const ShapeSetView parts = parts_as_shapes(view);
  ClearanceArguments arguments{arguments_for(view, agents, {}), limit_of(options.max_distance), nullptr};
  const auto part = [](auto span, std::size_t begin, std::size_t size) {
    return span.empty() ? span : span.subspan(begin, size);
  };
  for_pair_ranges(pairs.size(), grain, [&](std::size_t begin, std::size_t size) {
    const ClearanceAnswers its_answers{part(answers.distance, begin, size),
                                       part(answers.direction, begin, size),
                                       part(answers.discs, begin, size)};
    const std::span<const Pair> its_pairs = pairs.subspan(begin, size);
    if (!asks_parts(view, agents)) return answer(implementation, arguments, agents, its_pairs, its_answers);
    PartItems items;
    items.expand(view, agents, its_pairs);
    answer_parts(implementation, arguments, parts, its_pairs, items, its_answers);
  });
}

}  // namespace bch
