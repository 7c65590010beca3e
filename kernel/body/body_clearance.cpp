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

/// Holds what was found of a pair of agents, and all outputs of it: in double, from the positions themselves. A is the lower index.
class FoundSpheres {
 public:
  FoundSpheres(const BodySetView& bodies, const Agents& agents, Pair pair, const NearestSpheres& nearest)
      : bodies_(bodies),
        agents_(agents),
        first_(std::min(pair.first, pair.second)),
        second_(std::max(pair.first, pair.second)),
        nearest_(nearest),
        a_(bodies, agents, first_, nearest.a),
        b_(bodies, agents, second_, nearest.b) {
    const double rise = agents.z.empty() ? 0 : agents.z[second_] - agents.z[first_];
    const SpacePoint way{agents.x[second_] - agents.x[first_] + (b_.centre.x - a_.centre.x),
                         agents.y[second_] - agents.y[first_] + (b_.centre.y - a_.centre.y),
                         rise + (b_.centre.z - a_.centre.z)};
    unit_ = unit_of(way);
  }

  /// Returns the unit vector from A's sphere to B's, or with a sign of -1 its opposite.
  Vec3 direction(double sign) const { return rounded({sign * unit_.x, sign * unit_.y, sign * unit_.z}); }
  BodyClearanceAnswers::Points points() const { return {a_.end(unit_, 1), b_.end(unit_, -1)}; }
  DiscPair numbers() const {
    return {bodies_.number(agents_.shape[first_], nearest_.a),
            bodies_.number(agents_.shape[second_], nearest_.b)};
  }

 private:
  const BodySetView& bodies_;
  const Agents& agents_;
  const std::uint32_t first_, second_;
  const NearestSpheres& nearest_;
  const AgentSphere a_, b_;
  SpacePoint unit_;
};

/// Holds what all pairs of a query have in common, and writes their answers.
struct Writer {
  const BodySetView& bodies;
  const Agents& agents;
  const BodyClearanceAnswers& answers;
  float enough;

  void put(std::size_t i, Pair pair, const NearestSpheres& nearest) const {
    if (nearest.a == no_slot) return put_alone(answers, i, std::numeric_limits<float>::infinity());
    if (nearest.distance <= enough) return put_alone(answers, i, 0);
    answers.distance[i] = nearest.distance;
    if (answers.direction.empty() && answers.spheres.empty() && answers.points.empty()) return;
    const FoundSpheres found(bodies, agents, pair, nearest);
    const bool is_turned = pair.second < pair.first;
    if (!answers.direction.empty()) answers.direction[i] = found.direction(is_turned ? -1 : 1);
    if (!answers.spheres.empty()) {
      const DiscPair of = found.numbers();
      answers.spheres[i] = is_turned ? DiscPair{of.second, of.first} : of;
    }
    if (!answers.points.empty()) {
      const BodyClearanceAnswers::Points at = found.points();
      answers.points[i] = is_turned ? BodyClearanceAnswers::Points{at.second, at.first} : at;
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
  const float enough = options.overlap == Overlap::zero ? 0 : -std::numeric_limits<float>::infinity();
  const BodyClearanceArguments arguments{
      {arguments_for(view.ground, agents, pairs), &view},
      rounding::round_down(std::min(options.max_distance, double{largest_limit})),
      enough,
      nullptr};
  const Writer writer{view, agents, answers, enough};
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    NearestSpheres nearest[pairs_at_once];
    BodyClearanceArguments part = arguments;
    part.in.pairs.pairs += begin;
    part.nearest = nearest;
    implementation.kernels->body_clearance(part, 0, size);
    for (std::size_t i = 0; i < size; ++i) writer.put(begin + i, pairs[begin + i], nearest[i]);
  });
}

}  // namespace bch
