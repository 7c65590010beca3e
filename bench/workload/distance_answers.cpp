// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/distance_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "baselines/clearance_reference.hpp"
#include "baselines/segment_clearance.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "layout/base/heading.hpp"

namespace bch::bench {

Ways::Ways(const Workload& workload) {
  const auto& headings = workload.crowd.heading;
  for (const auto& [first, second] : workload.pairs) {
    const detail::Rotation a = detail::rotation(headings[first]), b = detail::rotation(headings[second]);
    x.push_back(walking_speed * walking_time * (a.cosine - b.cosine));
    y.push_back(walking_speed * walking_time * (a.sine - b.sine));
  }
}

std::string wrong_clearances(Scene& scene, const Workload& workload, const Clearances& answers) {
  baselines::ClearanceReference reference(scene.shapes(), {});
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    const baselines::Clearance expected = baselines::at_least_zero(reference.query(
        workload.agents(), workload.pairs[i], clearance_limit, baselines::Method::brute_force));
    if (answers.distance[i] != expected.distance || answers.direction[i] != expected.direction)
      return fmt::format("pair {}: {} m where brute force says {} m", i, answers.distance[i],
                         expected.distance);
  }
  return {};
}

std::string wrong_exact_clearances(Scene& scene, const Workload& workload, const Clearances& answers) {
  constexpr std::size_t compared = 64;
  const baselines::SegmentClearance reference(scene.shapes(), {});
  Clearances of_discs(workload.pairs.size());
  clearance(scene.set(), workload.agents(), workload.pairs, of_discs.spans());
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    const float distance = answers.distance[i], least = of_discs.distance[i];
    const bool is_beyond = least + 0.04f > static_cast<float>(clearance_limit) && std::isinf(distance);
    if (!is_beyond && (distance < least - 1e-5f || distance > least + 0.04f))
      return fmt::format("pair {}: {} m where discs are {} m apart", i, distance, least);
    if (i % compared != 0) continue;
    const auto expected = reference.distance(workload.agents(), workload.pairs[i], clearance_limit);
    if (expected && distance != *expected)
      return fmt::format("pair {}: {} m where brute force says {} m", i, distance, *expected);
  }
  return {};
}

std::string wrong_within(Scene& scene, const Workload& workload, const Hits& answers) {
  baselines::ClearanceReference reference(scene.shapes(), {});
  for (std::size_t i = 0; i < workload.pairs.size(); ++i)
    if (answers[i] != reference.within(workload.agents(), workload.pairs[i], personal_space,
                                       baselines::Method::brute_force))
      return fmt::format("pair {}: {}, and brute force says otherwise", i, answers[i]);
  return {};
}

std::string wrong_distances(Scene& scene, const Workload& workload, const std::vector<double>& distances) {
  Clearances all(workload.pairs.size());
  clearance(scene.set(), workload.agents(), workload.pairs, all.spans());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto least = static_cast<double>(all.distance[i]);
    // Leaf discs of 1 cm.
    if (!(std::max(0.0, distances[i]) >= least - 1e-9) || !(distances[i] <= std::max(0.0, least) + 0.04))
      return fmt::format("pair {}: {} m where the clearance is {} m", i, distances[i], least);
  }
  return {};
}

std::string wrong_times_of_impact(Scene& scene, const Workload& workload, const std::vector<float>& times) {
  baselines::TimeOfImpactReference reference(scene.shapes(), {});
  const Ways ways(workload);
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    const float expected = reference.query(workload.agents(), workload.pairs[i], ways.x[i], ways.y[i],
                                           baselines::Method::brute_force);
    if (times[i] != expected)
      return fmt::format("pair {}: {} where brute force says {}", i, times[i], expected);
  }
  return {};
}

}  // namespace bch::bench
