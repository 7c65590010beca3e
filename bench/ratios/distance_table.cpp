// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/distance_answers.hpp"
#include "bench/workload/distance_contenders.hpp"

namespace bch::bench {
namespace {

constexpr double most_times_collide = 4, needed_over_scalar = 10, needed_over_fcl = 50;

double per_pair(const Contender& contender, const Workload& workload) {
  return contender.nanoseconds / static_cast<double>(workload.pairs.size());
}

void print_over_collide(Scene& scene, const std::string& name, const TimedQuery& query, std::uint32_t runs) {
  const kernel::Implementation& best = kernel::best_implementation();
  const Workload& crowd = scene.workload("crowd");
  std::vector<Contender> both = {kernel_contender(scene, crowd, disc_query, best),
                                 query.kernel(scene, crowd, best)};
  race(both, runs, 1);
  const double times = both[1].nanoseconds / both[0].nanoseconds;
  fmt::print("{}, crowd, {}: {} pairs, {:.1f} ns over collide's {:.1f}: {:.2f} x   {}\n", name, best.name,
             cli::grouped(crowd.pairs.size()), per_pair(both[1], crowd), per_pair(both[0], crowd), times,
             verdict_at_most(times, most_times_collide));
}

void print_over_scalar(Scene& scene, const std::string& name, const TimedQuery& query, std::uint32_t runs) {
  const Workload& near_miss = scene.workload("near_miss");
  std::vector<Contender> contenders = {query.reference(scene, near_miss)};
  for (const kernel::Implementation& implementation : kernel::implementations())
    if (implementation.supported()) contenders.push_back(query.kernel(scene, near_miss, implementation));
  race(contenders, runs, 1);
  fmt::print("{}, near_miss: {} pairs; scalar search {:.1f} ns\n", name, cli::grouped(near_miss.pairs.size()),
             per_pair(contenders[0], near_miss));
  for (const Contender& contender : std::span(contenders).subspan(1)) {
    const double ratio = contenders[0].nanoseconds / contender.nanoseconds;
    fmt::print("  {:8}{:6.1f} ns{:7.1f} x   {}\n", contender.name, per_pair(contender, near_miss), ratio,
               &contender == &contenders[1] ? verdict(ratio, needed_over_scalar) : "");
  }
  std::fflush(stdout);
}

void print_over_fcl(Scene& scene, std::uint32_t runs) {
  const Workload& near_miss = scene.workload("near_miss");
  const kernel::Implementation& best = kernel::best_implementation();
  std::vector<Contender> contenders = fcl_distance_contenders(scene, near_miss);
  if (contenders.empty()) {
    fmt::print("clearance over FCL's distance of outlines: not in this build\n");
    return;
  }
  contenders.push_back(clearance_query().kernel(scene, near_miss, best));
  race(contenders, runs, 1);
  const Contender& own = contenders.back();
  fmt::print("clearance over FCL's distance of outlines, near_miss, {}: {:.1f} ns\n", best.name,
             per_pair(own, near_miss));
  for (const Contender& fcl : std::span(contenders).first(contenders.size() - 1)) {
    const double ratio = fcl.nanoseconds / own.nanoseconds;
    fmt::print("  {:28}{:8.1f} ns{:7.1f} x   {}\n", fcl.name, per_pair(fcl, near_miss), ratio,
               &fcl == &contenders.front() ? verdict(ratio, needed_over_fcl) : "");
  }
}

}  // namespace

void print_distance_ratios(Scene& scene, std::uint32_t runs) {
  const std::pair<std::string, const TimedQuery&> queries[] = {
      {fmt::format("clearance within {:g} m", clearance_limit), clearance_query()},
      {fmt::format("time of impact within {:g} s", walking_time), time_of_impact_query()}};
  for (const auto& [name, query] : queries) {
    print_over_collide(scene, name, query, runs);
    print_over_scalar(scene, name, query, runs);
  }
  print_over_fcl(scene, runs);
}

}  // namespace bch::bench
