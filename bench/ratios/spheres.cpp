// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/pairs.hpp>

#include "baselines/body_reference.hpp"
#include "bench/ratios/ratios.hpp"

namespace bch::bench {
namespace {

Contender spheres_contender(const BodySet& bodies, const Workload& workload,
                            const Implementation& implementation) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&bodies, &workload, &implementation, hits] {
    collide(bodies, workload.agents(), workload.pairs, *hits, &implementation);
  };
  call();
  const baselines::BodyReference reference(bodies);
  for (std::size_t i = 0; i < hits->size(); ++i)
    if (((*hits)[i] != 0) != reference.collide(workload.agents(), workload.pairs[i]))
      throw std::runtime_error(
          fmt::format("{}: pair {} of bodies of spheres is answered wrongly", workload.name, i));
  const double bodies_bytes = static_cast<double>(bodies.bytes()) / bodies.body_count();
  const auto count = static_cast<double>(std::count(hits->begin(), hits->end(), 1));
  return {call, hits->size(), {{"hits", count}, {"bytes", bodies_bytes}}};
}

/// Measures distances and directions; one answer in 16 is compared with brute force.
Contender clearance_contender(const BodySet& bodies, const Workload& workload,
                              const Implementation& implementation) {
  constexpr std::size_t checked = 16;
  const std::size_t pairs = workload.pairs.size();
  const auto distance = std::make_shared<std::vector<float>>(pairs);
  const auto direction = std::make_shared<std::vector<Vec3>>(pairs);
  const auto call = [&bodies, &workload, &implementation, distance, direction] {
    clearance(bodies, workload.agents(), workload.pairs, {*distance, *direction},
              {.implementation = &implementation, .max_distance = clearance_limit});
  };
  call();
  const baselines::BodyReference reference(bodies);
  for (std::size_t i = 0; i < pairs; i += checked) {
    const float nearest = reference.clearance(workload.agents(), workload.pairs[i]).distance;
    const float expected = nearest <= 0 ? 0
                           : static_cast<double>(nearest) <= clearance_limit
                               ? nearest
                               : std::numeric_limits<float>::infinity();
    if ((*distance)[i] != expected)
      throw std::runtime_error(
          fmt::format("{}: the distance of pair {} of bodies of spheres is wrong", workload.name, i));
  }
  const auto near =
      static_cast<double>(std::count_if(distance->begin(), distance->end(), [](float d) { return d < 1; }));
  return {call, pairs, {{"near", near}}};
}

/// Measures the ways of pairs apart, by penetration() or nearest_free().
template <class Query>
Contender ways_contender(const BodySet& bodies, const Workload& workload, const Query& run_query) {
  static constexpr std::uint32_t directions = 16;
  const auto ways = std::make_shared<std::vector<Penetration>>(workload.pairs.size());
  const auto call = [&bodies, &workload, run_query, ways] {
    run_query(bodies, workload.agents(), workload.pairs, directions, *ways);
  };
  call();
  const baselines::BodyReference reference(bodies);
  for (std::size_t i = 0; i < ways->size(); ++i)
    if ((*ways)[i].depth == 0 && reference.collide(workload.agents(), workload.pairs[i]))
      throw std::runtime_error(fmt::format("{}: the way of pair {} is wrong", workload.name, i));
  return {call, ways->size()};
}

}  // namespace

void add_spheres(Scene& scene) {
  for (const std::uint32_t spheres : {128u, 256u, 512u}) {
    const auto bodies = once([&scene, spheres] { return std::make_shared<BodySet>(scene.bodies(spheres)); });
    for (const std::string_view name : {"crowd", "near_miss", "colliding"})
      for (const Implementation* implementation : supported_implementations())
        add(fmt::format("spheres/{}/{}/{}", spheres, name, implementation->name),
            [&scene, bodies, name, implementation] {
              return spheres_contender(bodies(), scene.workload(name), *implementation);
            });
    for (const Implementation* implementation : supported_implementations()) {
      add(fmt::format("spheres_penetration/{}/colliding/{}", spheres, implementation->name),
          [&scene, bodies, implementation] {
            return ways_contender(bodies(), scene.workload("colliding"), [implementation](auto&&... asked) {
              penetration(asked..., implementation);
            });
          });
      add(fmt::format("spheres_nearest_free/{}/colliding/{}", spheres, implementation->name),
          [&scene, bodies, implementation] {
            return ways_contender(bodies(), scene.workload("colliding"), [implementation](auto&&... asked) {
              nearest_free(asked..., implementation);
            });
          });
    }
    for (const std::string_view name : {"crowd", "candidates"})
      for (const Implementation* implementation : supported_implementations())
        add(fmt::format("spheres_clearance/{}/{}/{}", spheres, name, implementation->name),
            [&scene, bodies, name, implementation] {
              return clearance_contender(bodies(), scene.workload(name), *implementation);
            });
  }
}

}  // namespace bch::bench
