// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>

#include <bch/scene_plan.hpp>

#include "bench/report/experiment.hpp"
#include "bench/report/packing.hpp"
#include "bench/report/subject.hpp"

// The premise of the paper: with a single cylinder a crowd cannot be dense.

namespace bch::report {
namespace {

struct PackingRow {
  std::string name;
  ShapeSet set;
  Freedom freedom = Freedom::places;
};

constexpr std::uint32_t most_free_people = 300;  // each of whom tries several stances a step

std::string_view name_of(Freedom freedom) {
  return freedom == Freedom::places     ? "places"
         : freedom == Freedom::headings ? "headings"
                                        : "headings and poses";
}

std::uint32_t people_of(const PackingRow& row, const Sizes& sizes) {
  return row.freedom == Freedom::places ? sizes.people : std::min(sizes.people, most_free_people);
}

std::vector<PackingRow> rows_of(Run& run) {
  const std::span<const Shape> shapes = run.scene().shapes();
  std::vector<PackingRow> rows;
  rows.push_back({"single cylinder", ShapeSet(shapes, {{0}, true})});
  for (const float radius : {0.25f, 0.4f}) {
    rows.push_back({fmt::format("fixed cylinder {:.2f} m", radius),
                    ShapeSet(with_fixed_cylinders(shapes, radius), {{0}, true})});
  }
  for (const std::uint32_t depth : {3u, 6u, 9u, all_depths})
    rows.push_back({cut_name(depth), ShapeSet(shapes, {{depth}, true})});
  for (const std::uint32_t slabs : compared_slabs)
    rows.push_back({slabs_name(slabs, Leaves::segments),
                    ShapeSet(run.scene().shapes_in_slabs(slabs), {.slices = standing_slices(slabs)})});
  for (const Freedom freedom : {Freedom::headings, Freedom::poses})
    for (const std::uint32_t depth : {0u, 3u, all_depths})
      rows.push_back({cut_name(depth), ShapeSet(shapes, {{depth}, true}), freedom});
  return rows;
}

void run_density(Run& run) {
  const std::vector<PackingRow> rows = rows_of(run);
  const std::size_t packings = run.sizes().packings;
  // Characters without clips have one pose, which then never changes.
  const std::uint32_t characters = static_cast<std::uint32_t>(run.scene().characters().size()),
                      poses = run.sizes().poses;
  const std::uint32_t free_poses = run.scene().shapes().size() == characters * poses ? poses : 1;
  std::vector<double> densities(rows.size() * packings);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(
      std::size_t{0}, densities.size(),
      [&](std::size_t i) {
        const PackingRow& row = rows[i / packings];
        densities[i] = densest_packing(row.set, people_of(row, run.sizes()), run.seed() + i % packings,
                                       row.freedom, free_poses);
        run.done(static_cast<double>(++done) / static_cast<double>(densities.size()));
      },
      tbb::simple_partitioner());
  Table table({"structure", "free", "densest (people/m2)", "95 % low", "95 % high",
               "times the single cylinder's", "people", "packings"});
  double single = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Estimate density = estimate(std::span(densities).subspan(i * packings, packings), run.seed());
    if (i == 0) single = density.mean;
    table.add({rows[i].name, name_of(rows[i].freedom), density.mean, density.low, density.high,
               density.mean / single, people_of(rows[i], run.sizes()), packings});
  }
  run.write("density", table);
}

}  // namespace

const Experiment density_experiment{"density", "Crowd density", 240, false, run_density};

}  // namespace bch::report
