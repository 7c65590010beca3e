// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include <bch/pairs.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"

namespace bch::c_api {

/// Holds the arguments of every query: a set, of shapes or of bodies, agents, options.
template <class Handle>
struct CallOn {
  CallOn(const Handle* set, const bch_agents* of, const bch_query_options* given)
      : shapes(object_of(set, "set").set), agents(agents_of(of)) {
    const CallOptions all = options_of(given);
    options = all.query;
    threads = all.threads;
  }

  decltype(Handle::set) shapes;
  const Agents agents;
  detail::AllOptions options;
  std::uint32_t threads;

  /// Asks on the threads that the options want.
  template <class RunQuery>
  void run(RunQuery run_query) const {
    threads == 0 ? run_query() : on_threads(threads, std::ref(run_query));  // which needs no memory
  }
};

using Call = CallOn<bch_shape_set>;

/// Holds the arguments of a query of pairs.
template <class Handle>
struct PairCallOn : CallOn<Handle> {
  PairCallOn(const Handle* set, const bch_agents* of, const bch_pair* queried, std::size_t count,
             const bch_query_options* given)
      : CallOn<Handle>(set, of, given), pairs(same_array<Pair>(queried, count, "pairs")) {}

  const std::span<const Pair> pairs;
};
using PairCall = PairCallOn<bch_shape_set>;

/// Views the output arrays of a clearance of `count` pairs or agents.
inline ClearanceAnswers clearance_answers(const bch_clearance_out* given, std::size_t count) {
  const bch_clearance_out out =
      sized(&required(given, "out"), bch_clearance_out BCH_CLEARANCE_OUT_INIT, "out");
  ClearanceAnswers answers{array_of(out.distance, count, "out->distance")};
  if (out.direction != nullptr) answers.direction = same_array<Vec2>(out.direction, count, "out->direction");
  if (out.discs != nullptr) answers.discs = same_array<DiscPair>(out.discs, count, "out->discs");
  if (out.points != nullptr) answers.points = same_array<NearestPoints>(out.points, count, "out->points");
  return answers;
}

/// Does the same of bodies.
inline BodyClearanceAnswers clearance_answers(const bch_body_clearance_out* given, std::size_t count) {
  const bch_body_clearance_out out =
      sized(&required(given, "out"), bch_body_clearance_out BCH_BODY_CLEARANCE_OUT_INIT, "out");
  using Points = BodyClearanceAnswers::Points;
  BodyClearanceAnswers answers{array_of(out.distance, count, "out->distance")};
  if (out.direction != nullptr) answers.direction = same_array<Vec3>(out.direction, count, "out->direction");
  if (out.spheres != nullptr) answers.spheres = same_array<DiscPair>(out.spheres, count, "out->spheres");
  if (out.points != nullptr) answers.points = same_array<Points>(out.points, count, "out->points");
  return answers;
}

/// Holds the answers of a query that needs memory on its way until all are there, so that nothing has been written for the
/// caller where memory runs out.
template <class Value>
class Kept {
 public:
  explicit Kept(std::span<Value> to) : to_(to), answers_(to.size()) {}

  std::span<Value> answers() { return answers_; }
  void deliver() const { std::copy(answers_.begin(), answers_.end(), to_.begin()); }

 private:
  const std::span<Value> to_;
  std::vector<Value> answers_;
};

/// Asks `run_query(answers)` for answers, and delivers all of them or none.
template <class Value, class RunQuery>
void all_or_none(std::span<Value> to, RunQuery run_query) {
  Kept kept(to);
  run_query(kept.answers());
  kept.deliver();
}

/// Does the same for a distance and what goes with it: ClearanceAnswers, or BodyClearanceAnswers.
template <class Answers, class RunQuery>
requires std::is_aggregate_v<Answers>
void all_or_none(const Answers& to, RunQuery run_query) {
  const auto& [to_distance, to_direction, to_discs, to_points] = to;
  Kept distance(to_distance);
  Kept direction(to_direction);
  Kept discs(to_discs);
  Kept points(to_points);
  run_query(Answers{distance.answers(), direction.answers(), discs.answers(), points.answers()});
  distance.deliver(), direction.deliver(), discs.deliver(), points.deliver();
}

inline std::span<Penetration> penetrations(bch_penetration_depth* depths, std::size_t count) {
  return same_array<Penetration>(depths, count, "depths");
}

/// Views an array that may be missing.
inline std::span<Penetration::Touch> touches_of(bch_touch* touches, std::size_t count) {
  if (touches == nullptr) return {};
  return same_array<Penetration::Touch>(touches, count, "touches");
}

}  // namespace bch::c_api
