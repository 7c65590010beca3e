// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <deque>

#include <bch/scene_plan.hpp>

#include "baselines/reference.hpp"
#include "baselines/slab_bodies.hpp"
#include "bench/base/text.hpp"
#include "bench/report/coverage.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/front.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/contender.hpp"

// What does each microsecond buy? Every structure, depth, threshold and semantics as a point.

namespace bch::report {
namespace {

struct Point {
  std::string structure;
  std::uint32_t depth;
  double threshold;  ///< metres; NaN: none
  std::string semantics, arithmetic;
  Subject subject;
  Estimate excess;
};

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate exact{0, 0, 0, 0}, unknown{none, none, none, none};

/// What points refer to lives as long as they do.
struct Points {
  std::deque<std::vector<baselines::Body>> bodies;
  std::deque<std::vector<Shape>> shapes;
  std::deque<ShapeSet> sets;
  std::deque<std::unique_ptr<baselines::Structure>> structures;
  std::vector<Point> all;
};

std::vector<std::uint32_t> depths_of(const Run& run, std::uint32_t first) {
  std::vector<std::uint32_t> depths = {0, 3, 6, 9, all_depths};
  if (run.sizes().poses >= full_sizes.poses) depths = {0, 2, 3, 4, 5, 6, 7, 8, 9, all_depths};
  if (first > 0) depths.erase(depths.begin());
  return depths;
}

/// What points are asked.
constexpr std::string_view timed_workloads[] = {"crowd", "near_miss", "colliding"};

/// Checks what the scalar reference does not know: solid semantics and exact leaves.
void require_right(const Subject& kernel, const QueryOptions& query, std::span<const Shape> shapes,
                   std::uint32_t depth, const bench::Workload& workload) {
  const baselines::Reference reference(shapes, {{depth}}, query.leaves);
  bench::require_right(std::string(kernel_name), workload,
                       bench::wrong_answers(reference, workload.agents(), workload.pairs,
                                            answers(kernel, workload), query.semantics));
}

/// Adds the kernel at every depth, in both semantics and at all depths with exact leaves, and the scalar
/// reference, which must agree.
void add_kernel(Run& run, double threshold, Points& points) {
  const auto& bodies = points.bodies.emplace_back(
      with_hierarchies(run.scene().bodies(), static_cast<float>(threshold), SplitRule::centroid));
  auto& shapes = points.shapes.emplace_back();
  for (const baselines::Body& body : bodies) shapes.push_back(body.shape);
  const auto& plain = points.structures.emplace_back(baselines::kind("reference").build(bodies, {}));
  const bool first = points.sets.empty();
  for (const std::uint32_t depth : depths_of(run, first ? 0 : 1)) {
    const Estimate excess = estimate(excess_areas(shapes, depth), run.seed());
    const Subject slow = subject_of(*plain, depth);
    const ShapeSet& set = points.sets.emplace_back(shapes, ShapeSetPlan{{depth}});
    for (const Leaves leaves : {Leaves::discs, Leaves::segments})
      for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
        const bool solid = semantics == Semantics::solid, segments = leaves == Leaves::segments;
        if (solid && depth == 0) continue;  // single discs know no difference
        if (segments && depth != all_depths) continue;
        const QueryOptions query{semantics, nullptr, leaves};
        const Subject fast = subject_of(set, query);
        for (const std::string_view name : timed_workloads) {
          const bench::Workload& workload = run.scene().workload(name);
          solid || segments ? require_right(fast, query, shapes, depth, workload)
                            : require_same(fast, slow, workload);
        }
        points.all.push_back({std::string(segments ? exact_leaves_name : kernel_name), depth, threshold,
                              solid ? "solid" : "boundary", segments ? "double" : "single", fast,
                              segments ? exact : excess});
      }
    if (first) points.all.push_back({"BCH outline", depth, threshold, "boundary", "single", slow, excess});
  }
}

/// Adds the kernel over bodies in slabs, whose answers are compared with those of every pair of slabs by itself.
void add_slabs(Run& run, Points& points) {
  for (const std::uint32_t slabs : compared_slabs) {
    const std::vector<Shape>& shapes = run.scene().shapes_in_slabs(slabs);
    const ShapeSetPlan plan{.slices = standing_slices(slabs)};
    const ShapeSet& set = points.sets.emplace_back(shapes, plan);
    for (const Leaves leaves : {Leaves::discs, Leaves::segments}) {
      const Subject subject = subject_of(set, {.semantics = Semantics::solid, .leaves = leaves});
      const baselines::SlabBodies reference(shapes, plan, leaves);
      for (const std::string_view name : timed_workloads) {
        const bench::Workload& workload = run.scene().workload(name);
        const bench::Hits hits = answers(subject, workload);
        for (std::size_t i = 0; i < hits.size(); ++i)
          if ((hits[i] != 0) !=
              reference.collide(workload.agents(), workload.pairs[i], baselines::Method::depth_first))
            bench::require_right(slabs_name(slabs, leaves), workload, fmt::format("pair {} differs", i));
      }
      points.all.push_back({slabs_name(slabs, leaves), all_depths, 0.01, "solid",
                            leaves == Leaves::segments ? "double" : "single", subject, unknown});
    }
  }
}

/// The area of those that are discs; boxes cut short are not measured.
Estimate excess_of(Run& run, const Contestant& contestant, std::uint32_t depth) {
  if (contestant.kind == "single") return estimate(excess_areas(run.scene().shapes(), 0), run.seed());
  if (contestant.kind == "fixed")
    return estimate(excess_areas(with_fixed_cylinders(run.scene().shapes(), contestant.fixed_radius), 0),
                    run.seed());
  return depth == all_depths ? exact : unknown;
}

void add_others(Run& run, Points& points) {
  for (const Contestant& contestant : contestants()) {
    if (contestant.kind == "reference" || contestant.kind == "paper_descent") continue;
    const bool discs = contestant.kind == "single" || contestant.kind == "fixed";
    for (const std::uint32_t depth :
         contestant.has_depth ? depths_of(run, 0) : std::vector{discs ? 0 : all_depths}) {
      for (const std::string_view name : timed_workloads)
        run.contestants().require_right(contestant, run.scene().workload(name), depth);
      points.all.push_back({std::string(contestant.name), depth, none, "boundary",
                            contestant.kind.starts_with("fcl") ? "double"
                            : discs                            ? "single"
                                                               : "exact",
                            subject_of(run.contestants().structure(contestant), depth),
                            excess_of(run, contestant, depth)});
    }
  }
}

std::vector<Quartiles> times(const Run& run, const Points& points, const bench::Workload& workload) {
  std::vector<Subject> subjects;
  for (const Point& point : points.all) subjects.push_back(point.subject);
  return times(subjects, workload, run.sizes().runs);
}

Table table_of(Run& run, const Points& points) {
  const bench::Workload &crowd = run.scene().workload("crowd"), &near = run.scene().workload("near_miss"),
                        &colliding = run.scene().workload("colliding");
  const SlideCases cases(run.scene().shapes(), run.sizes().cases, run.seed());
  const auto in_crowd = times(run, points, crowd);
  run.done(0.4);
  const auto on_near = times(run, points, near);
  run.done(0.7);
  Table table({"structure",
               "depth",
               "threshold (cm)",
               "semantics",
               "arithmetic",
               "crowd (ns/pair)",
               "crowd (25 %)",
               "crowd (75 %)",
               "near miss (ns/pair)",
               "near miss (25 %)",
               "near miss (75 %)",
               "crowd, node tests",
               "near miss, node tests",
               "distance at detection (cm)",
               "distance (95 % low)",
               "distance (95 % high)",
               "false positives (%)",
               "false positives (95 % low)",
               "false positives (95 % high)",
               "excess area (%)",
               "excess area (95 % low)",
               "excess area (95 % high)",
               "missed collisions (%)"});
  for (std::size_t i = 0; i < points.all.size(); ++i) {
    const Point& point = points.all[i];
    const auto distances = known(cases.distances(*run.distances(), point.subject.contacts(cases)));
    const Estimate distance = estimate(distances, run.seed());
    const Estimate wrong = share(count_hits(point.subject, near), near.pairs.size());
    const std::size_t found = count_hits(point.subject, colliding);
    const Estimate missed = share(colliding.pairs.size() - found, colliding.pairs.size());
    const MeanTests crowd_tests = point.subject.tests(crowd), near_tests = point.subject.tests(near);
    table.add({point.structure,       cli::depth_name(point.depth),
               100 * point.threshold, point.semantics,
               point.arithmetic,      in_crowd[i].median,
               in_crowd[i].low,       in_crowd[i].high,
               on_near[i].median,     on_near[i].low,
               on_near[i].high,       crowd_tests.nodes,
               near_tests.nodes,      distance.mean,
               distance.low,          distance.high,
               100 * wrong.mean,      100 * wrong.low,
               100 * wrong.high,      point.excess.mean,
               point.excess.low,      point.excess.high,
               100 * missed.mean});
    run.done(0.7 + 0.3 * static_cast<double>(i + 1) / static_cast<double>(points.all.size()));
  }
  return table;
}

void run_error_time(Run& run) {
  Points points;
  const bool full = run.sizes().poses >= full_sizes.poses;
  for (const double threshold : full ? std::vector{0.01, 0.005, 0.02, 0.04} : std::vector{0.01, 0.04})
    add_kernel(run, threshold, points);
  run.done(0.1);
  add_slabs(run, points);
  add_others(run, points);
  run.done(0.15);
  const Table table = table_of(run, points);
  run.write("error_time", table);
  run.write("error_time_distance", front(table, "distance at detection (cm)"));
  run.write("error_time_false", front(table, "false positives (%)"));
  run.write("error_time_excess", front(table, "excess area (%)"));
}

/// "X at depth D", with its threshold.
std::string name_of(const Table& table, std::size_t row) {
  const std::string& depth = table.text(row, "depth");
  std::string name = table.text(row, "structure");
  name += depth == "all" ? std::string(" to all depths") : " to depth " + depth;
  const std::string& threshold = table.text(row, "threshold (cm)");
  return threshold.empty() ? name : name + fmt::format(" with leaves of {} cm", threshold);
}

/// The first of the front, which has the least error, and the one that is fastest.
std::string ends_of_front(const Results& results, std::string_view) {
  const Table& front = results("error_time_distance");
  std::size_t first = front.rows().size(), last = 0;
  for (std::size_t i = 0; i < front.rows().size(); ++i)
    if (front.text(i, "pairs") == "crowd") first = std::min(first, i), last = i;
  const auto end = [&](std::size_t row) {
    return fmt::format("{} cm for {} ns ({})", brief(front.number(row, "distance at detection (cm)")),
                       brief(front.number(row, "ns/pair")), escaped(name_of(front, row)));
  };
  return end(last) + " to " + end(first);
}

}  // namespace

const Experiment error_time_experiment{
    "error_time", "Error against run time", 250,
    true,         run_error_time,           {{"ends of the front", ends_of_front}}};

}  // namespace bch::report
