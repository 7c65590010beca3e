// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <deque>

#include "baselines/reference.hpp"
#include "bench/base/text.hpp"
#include "bench/report/areas.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/front.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"
#include "bench/workload/answer_checks.hpp"

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
constexpr std::string_view workloads[] = {"crowd", "near_miss", "colliding"};

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
        for (const std::string_view name : workloads) {
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

/// The area of those that are discs; boxes cut short are not measured.
Estimate excess_of(Run& run, const Contestant& contestant, std::uint32_t depth) {
  if (contestant.kind == "single") return estimate(excess_areas(run.scene().shapes(), 0), run.seed());
  if (contestant.kind == "fixed") {
    std::vector<Shape> shapes(run.scene().shapes());
    for (Shape& shape : shapes) shape.hierarchy = fixed_cylinder(contestant.fixed_radius);
    return estimate(excess_areas(shapes, 0), run.seed());
  }
  return depth == all_depths ? exact : unknown;
}

void add_others(Run& run, Points& points) {
  for (const Contestant& contestant : contestants()) {
    if (contestant.kind == "reference" || contestant.kind == "paper_descent") continue;
    const bool discs = contestant.kind == "single" || contestant.kind == "fixed";
    for (const std::uint32_t depth :
         contestant.has_depth ? depths_of(run, 0) : std::vector{discs ? 0 : all_depths}) {
      for (const std::string_view name : workloads)
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

void run_experiment(Run& run) {
  Points points;
  const bool full = run.sizes().poses >= full_sizes.poses;
  for (const double threshold : full ? std::vector{0.01, 0.005, 0.02, 0.04} : std::vector{0.01, 0.04})
    add_kernel(run, threshold, points);
  run.done(0.1);
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
std::string ends_of(const Table& front, std::string_view workload, std::string_view error,
                    std::string_view unit) {
  std::size_t first = front.rows().size(), last = 0;
  for (std::size_t i = 0; i < front.rows().size(); ++i)
    if (front.text(i, "pairs") == workload) first = std::min(first, i), last = i;
  return fmt::format("{} {} for {} ns ({}) to {} {} for {} ns ({})", brief(front.number(last, error)), unit,
                     brief(front.number(last, "ns/pair")), escaped(name_of(front, last)),
                     brief(front.number(first, error)), unit, brief(front.number(first, "ns/pair")),
                     escaped(name_of(front, first)));
}

std::string findings(const Results& results) {
  const Table &all = results("error_time"), &distance = results("error_time_distance");
  const auto cylinder = all.row({{"structure", "single cylinder"}});
  const auto kernel = all.row(
      {{"structure", kernel_name}, {"depth", "all"}, {"threshold (cm)", "1"}, {"semantics", "boundary"}});
  const auto exact_leaves = all.row({{"structure", exact_leaves_name},
                                     {"depth", "all"},
                                     {"threshold (cm)", "1"},
                                     {"semantics", "boundary"}});
  const auto mesh = all.row({{"structure", "OBB full mesh"}, {"depth", "all"}});
  return fmt::format(
      "<p>In a crowd the front of mean distances at detection goes from {}. A single cylinder stops people "
      "who "
      "are still {} cm apart and calls {} % of near misses collisions; the outline's hierarchy with all its "
      "depths in the batch kernel: {} cm and {} %, for {} ns a pair; with exact leaves {} cm and {} %, for "
      "{} ns. "
      "That is the price of looking from above, which every exact test of outlines pays: {} cm. Only trees "
      "over the full "
      "meshes go to "
      "{} cm: {} "
      "ns a pair, {} times as long.</p>"
      "<p>A fixed cylinder of 0.25 m misses {} % of collisions of the meshes, so it is in the chart and not "
      "on "
      "any front: all that is there never misses one. The paper found that radius, or nearly so, in three "
      "works "
      "(its keys KGO09, vTCG12, HFV00), 0.40 m in two (Ger10, AMTT12), and up to 2.00 m in one (GKLM11).</p>",
      ends_of(distance, "crowd", "distance at detection (cm)", "cm"),
      brief(all.number(cylinder, "distance at detection (cm)")),
      brief(all.number(cylinder, "false positives (%)")),
      brief(all.number(kernel, "distance at detection (cm)")),
      brief(all.number(kernel, "false positives (%)")), brief(all.number(kernel, "crowd (ns/pair)")),
      brief(all.number(exact_leaves, "distance at detection (cm)")),
      brief(all.number(exact_leaves, "false positives (%)")),
      brief(all.number(exact_leaves, "crowd (ns/pair)")),
      brief(all.number({{"structure", "OBB outline"}, {"depth", "all"}}, "distance at detection (cm)")),
      brief(all.number(mesh, "distance at detection (cm)")), brief(all.number(mesh, "crowd (ns/pair)")),
      brief(all.number(mesh, "crowd (ns/pair)") / all.number(kernel, "crowd (ns/pair)")),
      brief(all.number({{"structure", "fixed cylinder 0.25 m"}}, "missed collisions (%)")));
}

}  // namespace

const Experiment error_time_experiment{
    "error_time",
    "Error against run time",
    "Every structure, at every depth, with leaves of several sizes and in both semantics, is one point. Its "
    "time is "
    "that of a pair in a crowd of 3 agents per square metre, or of a near miss (root discs overlap, the "
    "meshes do "
    "not meet); one thread, medians. Its error is told in three ways: how far apart the meshes are when "
    "people who "
    "slide at each other are first seen to collide; which share of near misses it takes for collisions; and "
    "what it "
    "covers beyond the outline. Boxes that were cut short have no such area here. Every answer was compared: "
    "the "
    "kernel's with the plain traversal's, in solid semantics with that and exact containment, and with exact "
    "leaves pair of "
    "segments by pair of segments; those of exact "
    "structures with each other's, and where they were cut short with their own, of which they may miss "
    "none. "
    "Of a single cylinder nothing but that it never misses an outline was asked, of a fixed one nothing.",
    250,
    true,
    run_experiment,
    {"error_time_distance", "error_time_false", "error_time_excess"},
    {{"error_time_distance_crowd",
      "Mean distance at detection against the time of a pair in a crowd; the line is the "
      "front that nothing beats in both."},
     {"error_time_distance_near", "The same against the time of a near miss."},
     {"error_time_false_crowd",
      "Share of near misses taken for collisions, against the time of a pair in a crowd."},
     {"error_time_false_near", "The same against the time of a near miss."},
     {"error_time_excess_crowd", "Area covered beyond the outline, against the time of a pair in a crowd."},
     {"error_time_excess_near", "The same against the time of a near miss."}},
    findings};

}  // namespace bch::report
