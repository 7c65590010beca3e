// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>

#include <bch/scene_plan.hpp>

#include "bench/base/text.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"
#include "layout/character/skinning.hpp"

// Measures distances at detection of characters from other sources.

namespace bch::report {
namespace {

constexpr double threshold = 0.01;  // metres

/// A character's poses as all structures take them.
struct Posed {
  std::vector<ShapeSource> sources;
  std::vector<Shape> shapes;
  std::vector<baselines::Body> bodies;
};

Posed pose(const cli::LoadedCharacter& loaded, std::uint32_t poses, std::uint64_t seed) {
  const std::span<const cli::LoadedCharacter> one(&loaded, 1);
  Posed posed{cli::list_random_shapes(one, poses, seed), {}, {}};
  posed.shapes = cli::build_shapes(one, posed.sources, threshold).shapes;
  detail::Skinner skinner(loaded.character);
  for (std::size_t i = 0; i < posed.sources.size(); ++i) {
    const auto positions = skinner.pose(posed.sources[i].at);
    posed.bodies.push_back(
        {{positions.begin(), positions.end()}, loaded.character.triangles, posed.shapes[i]});
  }
  return posed;
}

void add_real_rows(Run& run, const cli::LoadedCharacter& loaded, Table& table) {
  const Posed posed = pose(loaded, std::min(run.sizes().poses, most_costly_poses), run.seed());
  const SlideCases cases(posed.shapes, run.sizes().cases, run.seed());
  const auto distances = baselines::fcl_mesh_distances(posed.bodies);
  const auto add = [&](const std::string& structure, const std::vector<double>& places) {
    const std::vector<double> found = known(cases.distances(*distances, places));
    const Estimate mean = estimate(found, run.seed());
    table.add({cli::file_name(loaded), loaded.character.triangles.size(), posed.shapes.size(), structure,
               mean.mean, mean.low, mean.high, quartiles(found).median, mean.deviation, cases.size(),
               cases.size() - found.size()});
  };
  for (const std::uint32_t depth : {0u, 3u, 6u, all_depths})
    add(cut_name(depth), cases.contacts(ShapeSet(posed.shapes, {{depth}})));
  for (const std::uint32_t slabs : compared_slabs) {
    const ShapeSetPlan plan{.slices = standing_slices(slabs)};
    const ShapeSet set(cli::build_shapes({&loaded, 1}, posed.sources, threshold, plan).shapes, plan);
    for (const Leaves leaves : {Leaves::discs, Leaves::segments})
      add(slabs_name(slabs, leaves), cases.contacts(set, leaves));
  }
  add("OBB outline", cases.contacts(*baselines::kind("obb_contour").build(posed.bodies, {}), all_depths));
}

void run_real(Run& run) {
  if (run.real_characters().empty()) return;
  Table table({"character", "triangles", "poses", "structure", "mean (cm)", "mean (95 % low)",
               "mean (95 % high)", "median (cm)", "standard deviation (cm)", "cases", "never detected"});
  double done = 0;
  for (const cli::LoadedCharacter& character : run.real_characters()) {
    add_real_rows(run, character, table);
    run.done(++done / static_cast<double>(run.real_characters().size()));
  }
  run.write("real", table);
}

/// The least and the greatest mean of all characters.
std::string range_of(const Results& results, std::string_view structure) {
  const Table& table = results("real");
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    if (table.text(i, "structure") != structure) continue;
    least = std::min(least, table.number(i, "mean (cm)"));
    most = std::max(most, table.number(i, "mean (cm)"));
  }
  return fmt::format("{} to {} cm", brief(least), brief(most));
}

}  // namespace

const Experiment real_experiment{"real", "Real characters", 140, true, run_real, {{"range of", range_of}}};

}  // namespace bch::report
