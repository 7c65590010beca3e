// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <array>

#include "bench/base/stopwatch.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/tree_size.hpp"
#include "layout/hierarchy/builder.hpp"

// How small the leaves should be.

namespace bch::report {
namespace {

constexpr double thresholds[] = {0.0025, 0.005, 0.01, 0.02, 0.04, 0.08};  // metres

/// The scene's outlines with other leaves, and what it took to build them.
struct Variant {
  std::vector<Shape> shapes;
  std::vector<double> microseconds;
  TreeSize size{};
};

Variant make_variant(Run& run, double threshold) {
  Variant made{run.scene().shapes(), {}};
  detail::HierarchyBuilder builder;
  for (const bool timed : {false, true})  // memory is there the second time
    for (Shape& shape : made.shapes) {
      const bench::Stopwatch watch(1);
      builder.contour(shape.outline, static_cast<float>(threshold), SplitRule::centroid, shape.hierarchy);
      if (timed) made.microseconds.push_back(watch.nanoseconds() / 1000);
    }
  made.size = tree_size(made.shapes);
  return made;
}

/// Returns the mean tests of the scalar reference.
std::array<MeanTests, 2> tests_of(Run& run, const Variant& variant) {
  std::vector<baselines::Body> bodies(variant.shapes.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].shape = variant.shapes[i];
  const auto plain = baselines::kind("reference").build(bodies, {});
  const Subject subject = subject_of(*plain);
  return {subject.tests(run.scene().workload("colliding")), subject.tests(run.scene().workload("near_miss"))};
}

void run_threshold(Run& run) {
  const SlideCases cases(run.scene().shapes(), run.sizes().cases, run.seed());
  Table table({"threshold (cm)", "nodes a shape", "height", "bytes a shape", "hierarchy (us)",
               "hierarchy (25 %)", "hierarchy (75 %)", "colliding (ns/pair)", "colliding (25 %)",
               "colliding (75 %)", "near miss (ns/pair)", "near miss (25 %)", "near miss (75 %)",
               "colliding, node tests of the plain traversal", "near miss, node tests of the plain traversal",
               "distance at detection (cm)", "distance (95 % low)", "distance (95 % high)"});
  std::vector<Variant> variants;
  std::vector<ShapeSet> sets;
  std::vector<Subject> subjects;
  for (const double threshold : thresholds)
    sets.emplace_back(variants.emplace_back(make_variant(run, threshold)).shapes);
  for (const ShapeSet& set : sets) subjects.push_back(subject_of(set));
  const auto colliding = times(subjects, run.scene().workload("colliding"), run.sizes().runs);
  const auto near = times(subjects, run.scene().workload("near_miss"), run.sizes().runs);
  run.done(0.5);
  for (std::size_t i = 0; i < std::size(thresholds); ++i) {
    const Quartiles built = quartiles(variants[i].microseconds);
    const Estimate distance =
        estimate(known(cases.distances(*run.distances(), subjects[i].contacts(cases))), run.seed());
    const auto [colliding_tests, near_tests] = tests_of(run, variants[i]);
    table.add({100 * thresholds[i], variants[i].size.nodes, variants[i].size.height,
               static_cast<double>(sets[i].bytes()) / sets[i].shape_count(), built.median, built.low,
               built.high, colliding[i].median, colliding[i].low, colliding[i].high, near[i].median,
               near[i].low, near[i].high, colliding_tests.nodes, near_tests.nodes, distance.mean,
               distance.low, distance.high});
  }
  run.write("threshold", table);
}

}  // namespace

const Experiment threshold_experiment{"threshold", "Threshold", 25, true, run_threshold};

}  // namespace bch::report
