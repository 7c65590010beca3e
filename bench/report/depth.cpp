// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/text.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"

// What the maximum recursion depth costs and gives: figure 6, right, of the paper.

namespace bch::report {
namespace {

constexpr std::uint32_t deepest = 12;
constexpr double paper_critical_depth = 9, critical = 1.01;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

std::vector<std::uint32_t> every_depth() {
  std::vector<std::uint32_t> list;
  for (std::uint32_t depth = 0; depth <= deepest; ++depth) list.push_back(depth);
  list.push_back(all_depths);
  return list;
}

/// A structure that can be asked at every depth.
struct Series {
  std::string name;
  std::vector<Subject> at;         ///< in the order of every_depth()
  std::vector<double> nodes = {};  ///< of a shape, down to that depth, where they are known
  std::vector<std::vector<double>> distances = {};
};

/// Nodes of a shape down to each depth, on average.
std::vector<double> nodes_to_depths(std::span<const Shape> shapes) {
  std::vector<double> nodes;
  for (const std::uint32_t depth : every_depth()) {
    double sum = 0;  // a binary tree of so many leaves
    for (const Shape& shape : shapes) sum += 2 * static_cast<double>(cut(shape.hierarchy, depth).size()) - 1;
    nodes.push_back(sum / static_cast<double>(shapes.size()));
  }
  return nodes;
}

/// The first depth from which on the mean is within a hundredth of that without limit.
std::string critical_depth(const std::vector<Estimate>& means) {
  std::size_t first = means.size() - 1;
  while (first > 0 && means[first - 1].mean <= critical * means.back().mean) --first;
  return cli::depth_name(every_depth()[first]);
}

/// What a series costs on the pairs of a workload, at every depth.
struct Cost {
  std::vector<Quartiles> times;
  std::vector<MeanTests> tests;
};

Cost cost_of(Run& run, const Series& series, std::string_view workload) {
  const bench::Workload& pairs = run.scene().workload(workload);
  Cost cost{times(series.at, pairs, run.sizes().runs), {}};
  for (const Subject& subject : series.at) cost.tests.push_back(subject.tests(pairs));
  return cost;
}

void add_series(const Run& run, const Series& series, const Cost& colliding, const Cost& near, Table& table,
                Table& critical_depths) {
  std::vector<Estimate> means;
  for (std::size_t i = 0; i < series.at.size(); ++i) {
    const std::vector<double> found = known(series.distances[i]);
    const Estimate& mean = means.emplace_back(estimate(found, run.seed()));
    const Quartiles spread = quartiles(found);
    table.add({series.name, cli::depth_name(every_depth()[i]), mean.mean, mean.low, mean.high, spread.low,
               spread.median, spread.high, colliding.times[i].median, colliding.times[i].low,
               colliding.times[i].high, colliding.tests[i].nodes, near.times[i].median, near.times[i].low,
               near.times[i].high, near.tests[i].nodes, series.nodes.empty() ? not_known : series.nodes[i]});
  }
  critical_depths.add({series.name, series.name == kernel_name ? Cell(paper_critical_depth) : Cell(""),
                       critical_depth(means), means.back().mean});
}

void run_depth(Run& run) {
  std::vector<ShapeSet> sets;
  for (const std::uint32_t depth : every_depth())
    sets.emplace_back(run.scene().shapes(), ShapeSetPlan{{depth}});
  const std::vector<double> nodes = nodes_to_depths(run.scene().shapes());
  std::vector<Series> all = {{std::string(kernel_name), {}, nodes},
                             {"OBB outline", {}},
                             {"OBB full mesh", {}},
                             {"BCH outline", {}, nodes}};
  for (const ShapeSet& set : sets) all[0].at.push_back(subject_of(set));
  for (std::size_t k = 1; k < all.size(); ++k)
    for (const std::uint32_t depth : every_depth())
      all[k].at.push_back(subject_of(run.contestants().structure(all[k].name), depth));

  const SlideCases cases(run.scene().shapes(), run.sizes().cases, run.seed());
  Table summary({"structure", "depth", "mean (cm)", "mean (95 % low)", "mean (95 % high)",
                 "lower quartile (cm)", "median (cm)", "upper quartile (cm)", "colliding (ns/pair)",
                 "colliding (25 %)", "colliding (75 %)", "colliding, node tests", "near miss (ns/pair)",
                 "near miss (25 %)", "near miss (75 %)", "near miss, node tests", "nodes a shape"});
  Table critical_depths({"structure", "paper", "critical depth", "mean without limit (cm)"});
  Table each({"case", "depth", "distance (cm)"});
  double done = 0;
  for (Series& series : all) {
    for (const Subject& subject : series.at)
      series.distances.push_back(cases.distances(*run.distances(), subject.contacts(cases)));
    add_series(run, series, cost_of(run, series, "colliding"), cost_of(run, series, "near_miss"), summary,
               critical_depths);
    run.done(++done / static_cast<double>(all.size()));
  }
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::uint32_t depth = 0; depth <= deepest; ++depth) each.add({i, depth, all[0].distances[depth][i]});
  run.write("depth", summary);
  run.write("depth_critical", critical_depths);
  run.write("depth_cases", each);
}

}  // namespace

const Experiment depth_experiment{"depth", "Depth", 45, true, run_depth};

}  // namespace bch::report
