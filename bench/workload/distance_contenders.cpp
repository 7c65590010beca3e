// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <memory>

#include "baselines/clearance_reference.hpp"
#include "baselines/pair_distances.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "bench/workload/contender.hpp"
#include "bench/workload/distance_answers.hpp"

namespace bch::bench {
namespace {

/// Makes a contender of a call whose answers are right. `wrong()` says what is wrong with them.
template <class Call, class Wrong>
Contender checked(std::string_view name, const Workload& workload, Call call, Wrong wrong) {
  call();
  require_right(name, workload, wrong());
  return {call, workload.pairs.size()};
}

Contender clearance_kernel(Scene& scene, const Workload& workload, const Implementation& implementation) {
  const auto answers = std::make_shared<Clearances>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, answers,
                     options =
                         QueryOptions{.implementation = &implementation, .max_distance = clearance_limit}] {
    clearance(set, workload.agents(), workload.pairs, answers->spans(), options);
  };
  return checked(implementation.name, workload, call,
                 [&] { return wrong_clearances(scene, workload, *answers); });
}

Contender exact_clearance_kernel(Scene& scene, const Workload& workload,
                                 const Implementation& implementation) {
  const auto answers = std::make_shared<Clearances>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, answers,
                     options = QueryOptions{.implementation = &implementation,
                                            .max_distance = clearance_limit,
                                            .distance_leaves = Leaves::segments}] {
    clearance(set, workload.agents(), workload.pairs, answers->spans(), options);
  };
  return checked(implementation.name, workload, call,
                 [&] { return wrong_exact_clearances(scene, workload, *answers); });
}

Contender clearance_reference(Scene& scene, const Workload& workload) {
  const auto answers = std::make_shared<Clearances>(workload.pairs.size());
  const auto reference = std::make_shared<baselines::ClearanceReference>(scene.shapes(), ShapeSetPlan{});
  const auto call = [reference, &workload, answers] {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
      const auto nearest = baselines::at_least_zero(reference->query(
          workload.agents(), workload.pairs[i], clearance_limit, baselines::Method::depth_first));
      answers->distance[i] = nearest.distance, answers->direction[i] = nearest.direction;
    }
  };
  return checked("scalar search", workload, call,
                 [&] { return wrong_clearances(scene, workload, *answers); });
}

Contender within_kernel(Scene& scene, const Workload& workload, const Implementation& implementation) {
  const auto answers = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, answers, &implementation] {
    within(set, workload.agents(), workload.pairs, {&personal_space, 1}, *answers,
           {.implementation = &implementation});
  };
  return checked(implementation.name, workload, call,
                 [&] { return wrong_within(scene, workload, *answers); });
}

Contender within_reference(Scene& scene, const Workload& workload) {
  const auto answers = std::make_shared<Hits>(workload.pairs.size());
  const auto reference = std::make_shared<baselines::ClearanceReference>(scene.shapes(), ShapeSetPlan{});
  const auto call = [reference, &workload, answers] {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i)
      (*answers)[i] = reference->within(workload.agents(), workload.pairs[i], personal_space,
                                        baselines::Method::depth_first);
  };
  return checked("scalar search", workload, call, [&] { return wrong_within(scene, workload, *answers); });
}

Contender time_of_impact_kernel(Scene& scene, const Workload& workload,
                                const Implementation& implementation) {
  const auto times = std::make_shared<std::vector<float>>(workload.pairs.size());
  const auto ways = std::make_shared<Ways>(workload);
  const auto call = [&set = scene.set(), &workload, ways, times, &implementation] {
    time_of_impact(set, workload.agents(), workload.pairs, ways->displacements(), *times,
                   {.implementation = &implementation});
  };
  return checked(implementation.name, workload, call,
                 [&] { return wrong_times_of_impact(scene, workload, *times); });
}

Contender time_of_impact_reference(Scene& scene, const Workload& workload) {
  const auto times = std::make_shared<std::vector<float>>(workload.pairs.size());
  const auto ways = std::make_shared<Ways>(workload);
  const auto reference = std::make_shared<baselines::TimeOfImpactReference>(scene.shapes(), ShapeSetPlan{});
  const auto call = [reference, &workload, ways, times] {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i)
      (*times)[i] = reference->query(workload.agents(), workload.pairs[i], ways->x[i], ways->y[i],
                                     baselines::Method::depth_first);
  };
  return checked("scalar search", workload, call,
                 [&] { return wrong_times_of_impact(scene, workload, *times); });
}

constexpr TimedQuery timed_distances[] = {
    {"clearance", clearance_kernel, clearance_reference},
    {"exact_clearance", exact_clearance_kernel, nullptr},
    {"within", within_kernel, within_reference},
    {"time_of_impact", time_of_impact_kernel, time_of_impact_reference}};

}  // namespace

std::span<const TimedQuery> distance_queries() {
  return timed_distances;
}

Contender fcl_distance_contender(Scene& scene, const Workload& workload, bool walls) {
  const std::shared_ptr<const baselines::PairDistances> fcl =
      walls ? baselines::fcl_outline_distances(scene.bodies())
            : baselines::fcl_segment_distances(scene.bodies());
  const auto distances = std::make_shared<std::vector<double>>(workload.pairs.size());
  const auto call = [fcl, &workload, distances] {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i)
      (*distances)[i] = fcl->query(workload.agents(), workload.pairs[i]);
  };
  return checked("FCL", workload, call, [&] { return wrong_distances(scene, workload, *distances); });
}

}  // namespace bch::bench
