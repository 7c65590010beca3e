// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include <bch/pairs.hpp>

#include "kernel/body/agent_sphere.hpp"
#include "kernel/body/body_clearance_arguments.hpp"
#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/body/body_record.hpp"

namespace bch {

using namespace detail;

namespace {

/// Holds what all pairs of a query have in common, and writes their answers.
struct Writer {
  const BodySetView& bodies;
  const Agents& agents;
  const BodyClearanceAnswers& answers;
  float stop_below;

  void store(std::size_t i, Pair pair, const NearestSpheres& nearest) const {
    if (nearest.a == no_slot) return store_distance(answers, i, std::numeric_limits<float>::infinity());
    if (nearest.distance <= stop_below) return store_distance(answers, i, 0);
    answers.distance[i] = nearest.distance;
    if (answers.direction.empty() && answers.spheres.empty() && answers.points.empty()) return;
    const auto [a, b] = std::minmax(pair.first, pair.second);
    const bool is_turned = pair.second < pair.first;
    const AgentPair::Spheres found = AgentPair(bodies, agents, a, b).spheres(nearest.a, nearest.b);
    if (!answers.direction.empty()) answers.direction[i] = found.direction(is_turned ? -1 : 1);
    if (!answers.spheres.empty()) {
      const DiscPair of{bodies.number(agents.shape[a], nearest.a), bodies.number(agents.shape[b], nearest.b)};
      answers.spheres[i] = is_turned ? DiscPair{of.second, of.first} : of;
    }
    if (!answers.points.empty()) {
      const Vec3 at_a = found.end_of_a(), at_b = found.end_of_b();
      answers.points[i] =
          is_turned ? BodyClearanceAnswers::Points{at_b, at_a} : BodyClearanceAnswers::Points{at_a, at_b};
    }
  }
};

constexpr std::size_t pairs_at_once = 1024;

}  // namespace

void clearance(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "pair", pairs.size()}, answers, options);
  const Implementation& implementation = chosen(options.implementation, "clearance");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  const float stop_below = options.overlap == Overlap::zero ? 0 : -std::numeric_limits<float>::infinity();
  const BodyClearanceArguments arguments{
      {arguments_for(view.ground, agents, pairs), &view},
      rounding::round_down(std::min(options.max_distance, double{largest_limit})),
      stop_below,
      nullptr};
  const Writer writer{view, agents, answers, stop_below};
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    NearestSpheres nearest[pairs_at_once];
    BodyClearanceArguments part = arguments;
    part.in.pairs.pairs += begin;
    part.nearest = nearest;
    implementation.kernels->body_clearance(part, 0, size);
    for (std::size_t i = 0; i < size; ++i) writer.store(begin + i, pairs[begin + i], nearest[i]);
  });
}

}  // namespace bch
