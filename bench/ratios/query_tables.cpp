// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/distance_answers.hpp"

namespace bch::bench {
namespace {

constexpr double needed_over_fcl = 150;

std::string query_name(std::string_view query, std::string_view workload, std::string_view implementation) {
  return fmt::format("{}/{}/{}", query, workload, implementation);
}

std::string_view best() {
  return best_implementation().name;
}

const Timing& collide_in(std::string_view workload, const Results& results) {
  return results.at(collide_name(workload, disc_query, best()));
}

/// `most`: what is asked for, or 0.
void print_over_collide(const Results& results, std::string_view query, std::string_view workload,
                        const std::string& title, double most) {
  const Timing &collide = collide_in(workload, results),
               &own = results.at(query_name(query, workload, best()));
  const double times = own.nanoseconds / collide.nanoseconds;
  fmt::print("{}, {}, {}: {} pairs, {:.1f} ns over collide's {:.1f}: {:.2f} x   {}\n", title, workload,
             best(), cli::grouped(own.items), own.nanoseconds, collide.nanoseconds, times,
             most > 0 ? verdict_at_most(times, most) : "");
}

/// What is asked of a query: how many times the time of collide() in the crowd at most, and over a scalar search.
struct Bars {
  double most_times_collide, needed_over_scalar;
};

void print_distance(const Results& results, std::string_view query, const std::string& title,
                    const Bars& bars) {
  print_over_collide(results, query, "crowd", title, bars.most_times_collide);
  const Timing& scalar = results.at(query_name(query, "near_miss", "reference"));
  fmt::print("{}, near_miss: {} pairs; scalar search {:.1f} ns\n", title, cli::grouped(scalar.items),
             scalar.nanoseconds);
  for (const Implementation& one : implementations()) {
    if (!one.supported()) continue;
    const double taken = results.at(query_name(query, "near_miss", one.name)).nanoseconds;
    const double ratio = scalar.nanoseconds / taken;
    fmt::print(
        "  {:8}{:6.1f} ns{:7.1f} x   {}\n", one.name, taken, ratio,
        one.name == best() && bars.needed_over_scalar > 0 ? verdict(ratio, bars.needed_over_scalar) : "");
  }
}

void print_over_fcl(const Results& results) {
  if (!has_kind("fcl_obb_contour"))
    return fmt::print("clearance over FCL's distance of outlines: not in this build\n");
  const double of_discs = results.at(query_name("clearance", "near_miss", best())).nanoseconds;
  const double exact = results.at(query_name("exact_clearance", "near_miss", best())).nanoseconds;
  fmt::print(
      "clearance over FCL's distance of outlines, near_miss, {}: discs {:.1f} ns, exact leaves {:.1f} ns\n",
      best(), of_discs, exact);
  const auto print = [&](std::string_view title, std::string_view implementation, double needed) {
    const double taken = results.at(query_name("clearance", "near_miss", implementation)).nanoseconds;
    fmt::print("  {:28}{:8.1f} ns{:7.1f} x{:7.1f} x   {}\n", title, taken, taken / of_discs, taken / exact,
               needed > 0 ? verdict(taken / of_discs, needed) : "");
  };
  print("FCL, walls", "fcl_walls", needed_over_fcl);
  print("FCL, one triangle a segment", "fcl_segments", 0);
}

void print_distances(const Results& results) {
  print_distance(results, "clearance", fmt::format("clearance within {:g} m", clearance_limit), {6, 12});
  print_over_collide(results, "clearance", "candidates",
                     fmt::format("clearance within {:g} m", clearance_limit), 8);
  print_over_collide(results, "exact_clearance", "crowd", "the same with exact leaves", 0);
  print_distance(results, "within", fmt::format("whether within {:g} m", personal_space), {1.3, 0});
  print_distance(results, "time_of_impact", fmt::format("time of impact within {:g} s", walking_time),
                 {4, 10});
  print_over_fcl(results);
}

void print_responses(const Results& results) {
  const Timing& collide = collide_in("crowd", results);
  fmt::print("response, crowd, {}: {} pairs\n", best(), cli::grouped(collide.items));
  for (const TimedQuery& query : response_queries()) {
    const double own = results.at(query_name(query.name, "crowd", best())).nanoseconds;
    fmt::print("  {:12}{:7.1f} ns over collide's {:.1f}: {:.2f} x", query.name, own, collide.nanoseconds,
               own / collide.nanoseconds);
    if (query.reference != nullptr) {
      const double brute_force = results.at(query_name(query.name, "crowd", "reference")).nanoseconds;
      fmt::print("; brute force {:.0f} ns: {:.1f} x as long", brute_force, brute_force / own);
    }
    fmt::print("\n");
  }
}

void add_query(Suite& suite, Scene& scene, const TimedQuery& query, std::string_view workload) {
  for (const Implementation& implementation : implementations())
    for (const int threads : thread_counts())
      if (implementation.supported())
        suite.add(
            with_threads(query_name(query.name, workload, implementation.name), threads),
            [&scene, &query, workload, &implementation] {
              return query.kernel(scene, scene.workload(workload), implementation);
            },
            threads);
  if (query.reference != nullptr)
    suite.add(query_name(query.name, workload, "reference"),
              [&scene, &query, workload] { return query.reference(scene, scene.workload(workload)); });
}

}  // namespace

std::vector<Table> query_tables(Suite& suite, Scene& scene) {
  for (const TimedQuery& query : distance_queries())
    for (const std::string_view workload : workload_names()) add_query(suite, scene, query, workload);
  for (const TimedQuery& query : response_queries())
    for (const std::string_view workload : {"colliding", "crowd"})
      // Agents of pairs of their own stand anywhere, also in each other.
      if (workload == "crowd" || query.reference != nullptr) add_query(suite, scene, query, workload);
  if (has_kind("fcl_obb_contour"))
    for (const bool walls : {true, false})
      suite.add(query_name("clearance", "near_miss", walls ? "fcl_walls" : "fcl_segments"), [&scene, walls] {
        return fcl_distance_contender(scene, scene.workload("near_miss"), walls);
      });
  const std::string collide = fmt::format("^{}$", collide_name("crowd", disc_query, best()));
  const std::string one_thread = "/[a-z0-9_]+$";
  return {{"distances",
           fmt::format("{}|^{}$|^(clearance|exact_clearance|within|time_of_impact)/(crowd/"
                       "{}$|near_miss{})|^clearance/candidates/{}$",
                       collide, collide_name("candidates", disc_query, best()), best(), one_thread, best()),
           print_distances},
          {"responses",
           fmt::format("{}|^(contacts|penetration|collide_all)/crowd/({}|reference)$", collide, best()),
           print_responses}};
}

}  // namespace bch::bench
