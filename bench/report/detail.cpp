// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <map>

#include <bch/crowd.hpp>
#include <bch/scene_plan.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/subjects.hpp"

// Level of detail by the density of a crowd, which the paper suggests and does not measure.

namespace bch::report {
namespace {

constexpr double densities[] = {0.5, 1, 2, 3, 4, 5, 6};  // people per square metre
constexpr std::uint32_t compared_depths[] = {0, 3, 6, all_depths};
constexpr double speed = 1.3, frames_per_second = 10;  // metres a second
constexpr int frames = 50;

using Levels = std::vector<std::uint8_t>;

/// How agents are tested: all at a depth, or each at that of the density around him.
struct Detail {
  const char* name;
  const ShapeSet& set;
  Levels (*levels)(const cli::Crowd& crowd);
};

template <std::uint8_t Level>
Levels same_level(const cli::Crowd& crowd) {
  return Levels(crowd.size(), Level);
}

Levels levels_by_density(const cli::Crowd& crowd) {
  Levels levels;
  for (const double density : local_densities(crowd.x, crowd.y)) {
    const auto* const depth = std::ranges::find(compared_depths, depth_at_density(density));
    levels.push_back(static_cast<std::uint8_t>(depth - std::begin(compared_depths)));
  }
  return levels;
}

/// What happens to a pair for as long as a test says that it collides.
struct Stop {
  int last_frame = -2;
  bool is_true = false;
};

struct StopCounts {
  std::size_t false_stops = 0, true_stops = 0, missed = 0, colliding = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Stop> stops;

  void add(Pair pair, int frame, bool is_hit, bool meshes_meet) {
    colliding += meshes_meet ? 1 : 0;
    missed += meshes_meet && !is_hit ? 1 : 0;
    if (!is_hit) return;
    Stop& stop = stops[{pair.first, pair.second}];
    if (stop.last_frame != frame - 1) finish(stop), stop = {};
    stop.last_frame = frame;
    stop.is_true = stop.is_true || meshes_meet;
  }
  void finish(const Stop& stop) {
    if (stop.last_frame >= 0) ++(stop.is_true ? true_stops : false_stops);
  }
};

/// People walk straight on, each in a pose, through whoever is in the way.
void walk(cli::Crowd& crowd) {
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    crowd.x[i] += speed / frames_per_second * std::cos(crowd.heading[i]);
    crowd.y[i] += speed / frames_per_second * std::sin(crowd.heading[i]);
    crowd.x[i] -= crowd.side * std::floor(crowd.x[i] / crowd.side);
    crowd.y[i] -= crowd.side * std::floor(crowd.y[i] / crowd.side);
  }
}

/// Counts stops, and adds the times of all frames.
std::vector<StopCounts> walk_and_test(Run& run, const baselines::Structure& meshes,
                                      std::span<const Detail> details, double density, Table& times) {
  bench::Workload workload{
      "walking", cli::place_crowd(run.sizes().people, density, meshes.shape_count(), run.seed()), {}};
  std::vector<StopCounts> counts(details.size());
  bench::Hits truth, hits;
  bch::Crowd finder;
  for (int frame = 0; frame < frames; ++frame, walk(workload.crowd)) {
    const Levels roots = same_level<0>(workload.crowd);
    const bch::Crowd::Pairs pairs = finder.candidates(details[0].set, workload.crowd.at_level(roots));
    workload.pairs.assign(pairs.begin(), pairs.end());
    truth.resize(workload.pairs.size()), hits.resize(workload.pairs.size());
    meshes.query(workload.agents(), workload.pairs, truth);
    for (std::size_t k = 0; k < details.size(); ++k) {
      const bench::Stopwatch counting(1);
      const Levels levels = details[k].levels(workload.crowd);
      const double counted = counting.nanoseconds();
      const bench::Stopwatch tests(1);
      collide(details[k].set, workload.crowd.at_level(levels), workload.pairs, hits, bench::disc_query);
      times.add({density, details[k].name, frame, tests.nanoseconds() / run.sizes().people,
                 counted / run.sizes().people});
      for (std::size_t i = 0; i < hits.size(); ++i)
        counts[k].add(workload.pairs[i], frame, hits[i] != 0, truth[i] != 0);
    }
  }
  for (StopCounts& count : counts)
    for (const auto& [pair, stop] : count.stops) count.finish(stop);
  return counts;
}

}  // namespace

void run_detail(Run& run) {
  const std::span<const Shape> shapes = run.scene.shapes();
  const ShapeSet cuts(shapes, {{std::begin(compared_depths), std::end(compared_depths)}});
  const ShapeSet fixed_set(with_fixed_cylinders(shapes, 0.25f), {{0}});
  const Detail details[] = {
      {"single cylinder", cuts, same_level<0>}, {"depth 3", cuts, same_level<1>},
      {"depth 6", cuts, same_level<2>},         {"all depths", cuts, same_level<3>},
      {"by density", cuts, levels_by_density},  {"fixed cylinder 0.25 m", fixed_set, same_level<0>}};
  Structures structures(run.scene);
  Table table({"people per m2", "detail", "people", "seconds", "false stops", "true stops",
               "colliding (pair-frames)", "missed (pair-frames)"});
  Table times({"people per m2", "detail", "frame", "tests (ns a person)", "levels (ns a person)"});
  for (const double density : densities) {
    const auto counts = walk_and_test(run, structures.of("OBB full mesh"), details, density, times);
    for (std::size_t k = 0; k < counts.size(); ++k)
      table.add({density, details[k].name, run.sizes().people, frames / frames_per_second,
                 counts[k].false_stops, counts[k].true_stops, counts[k].colliding, counts[k].missed});
  }
  run.write("detail", table);
  run.write("detail_times", times);
}

}  // namespace bch::report
