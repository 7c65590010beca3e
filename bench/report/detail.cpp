// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/base/stopwatch.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/statistics.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"
#include "kernel/broad_phase/broad_phase.hpp"
#include "layout/scene/local_density.hpp"

// Level of detail by the density of a crowd, which the paper suggests and does not measure.

namespace bch::report {
namespace {

constexpr double densities[] = {0.5, 1, 2, 3, 4, 5, 6};  // people per square metre
constexpr std::uint32_t depths[] = {0, 3, 6, all_depths};
constexpr double speed = 1.3, frames_per_second = 10;  // metres a second
constexpr int frames = 50;

/// How agents are tested: all at a depth, or each at that of the density around him.
struct Detail {
  std::string name;
  const ShapeSet* set;
  std::vector<std::uint8_t> (*levels)(const cli::Crowd& crowd);
};

template <std::uint8_t Level>
std::vector<std::uint8_t> same_level(const cli::Crowd& crowd) {
  return std::vector<std::uint8_t>(crowd.size(), Level);
}

std::vector<std::uint8_t> levels_by_density(const cli::Crowd& crowd) {
  std::vector<std::uint8_t> levels;
  for (const double density : local_densities(crowd.x, crowd.y)) {
    const auto* const depth = std::find(std::begin(depths), std::end(depths), depth_at_density(density));
    levels.push_back(static_cast<std::uint8_t>(depth - std::begin(depths)));
  }
  return levels;
}

/// What happens to a pair for as long as a test says that it collides.
struct Stop {
  int last_frame = -2;
  bool is_true = false;
};

struct Outcome {
  std::size_t false_stops = 0, true_stops = 0, missed = 0, colliding = 0;
  std::vector<double> tests, counting;  ///< nanoseconds of a frame
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

std::vector<Outcome> walk_and_test(Run& run, std::span<const Detail> details, double density) {
  const baselines::Structure& meshes = run.contestants().structure("OBB full mesh");
  bench::Workload workload{
      "walking", cli::place_crowd(run.sizes().people, density, meshes.shape_count(), run.seed()), {}};
  std::vector<Outcome> outcomes(details.size());
  bench::Hits truth, hits;
  for (int frame = 0; frame < frames; ++frame, walk(workload.crowd)) {
    const std::vector<std::uint8_t> roots = same_level<0>(workload.crowd);
    workload.pairs = candidate_pairs(*details[0].set, workload.crowd.at_level(roots));
    truth.resize(workload.pairs.size()), hits.resize(workload.pairs.size());
    meshes.query(workload.agents(), workload.pairs, truth);
    for (std::size_t k = 0; k < details.size(); ++k) {
      const bench::Stopwatch counting(1);
      const std::vector<std::uint8_t> levels = details[k].levels(workload.crowd);
      outcomes[k].counting.push_back(counting.nanoseconds());
      const bench::Stopwatch tests(1);
      collide(*details[k].set, workload.crowd.at_level(levels), workload.pairs, hits, bench::disc_query);
      outcomes[k].tests.push_back(tests.nanoseconds());
      for (std::size_t i = 0; i < hits.size(); ++i)
        outcomes[k].add(workload.pairs[i], frame, hits[i] != 0, truth[i] != 0);
    }
  }
  for (Outcome& outcome : outcomes)
    for (const auto& [pair, stop] : outcome.stops) outcome.finish(stop);
  return outcomes;
}

void run_experiment(Run& run) {
  const std::span<const Shape> shapes = run.scene().shapes();
  const ShapeSet cuts(shapes, {std::vector<std::uint32_t>(std::begin(depths), std::end(depths))});
  std::vector<Shape> fixed(shapes.begin(), shapes.end());
  for (Shape& shape : fixed) shape.hierarchy = fixed_cylinder(0.25f);
  const ShapeSet fixed_set(fixed, {{0}});
  const Detail details[] = {
      {"single cylinder", &cuts, same_level<0>}, {"depth 3", &cuts, same_level<1>},
      {"depth 6", &cuts, same_level<2>},         {"all depths", &cuts, same_level<3>},
      {"by density", &cuts, levels_by_density},  {"fixed cylinder 0.25 m", &fixed_set, same_level<0>}};
  Table table({"people per m2", "detail", "false stops per person and second",
               "true stops per person and second", "missed (%)", "tests of a frame (ns a person)",
               "lower quartile (ns)", "upper quartile (ns)", "levels of a frame (ns a person)"});
  double done = 0;
  for (const double density : densities) {
    const std::vector<Outcome> outcomes = walk_and_test(run, details, density);
    const double people = run.sizes().people, seconds = frames / frames_per_second;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const Outcome& outcome = outcomes[k];
      const Quartiles frame = quartiles(outcome.tests);
      // Both of a pair stop.
      table.add({density, details[k].name, 2 * static_cast<double>(outcome.false_stops) / people / seconds,
                 2 * static_cast<double>(outcome.true_stops) / people / seconds,
                 100 * share(outcome.missed, outcome.colliding).mean, frame.median / people,
                 frame.low / people, frame.high / people, quartiles(outcome.counting).median / people});
    }
    run.done(++done / static_cast<double>(std::size(densities)));
  }
  run.write("detail", table);
}

std::string findings(const Results& results) {
  const Table& table = results("detail");
  const auto of = [&](std::string_view density, std::string_view detail, std::string_view column) {
    return brief(table.number({{"people per m2", density}, {"detail", detail}}, column));
  };
  std::string html = "<p>";
  for (const std::string_view density : {"0.5", "2", "6"}) {
    const auto stops = [&](std::string_view detail) {
      return of(density, detail, "false stops per person and second");
    };
    const auto time = [&](std::string_view detail) {
      return of(density, detail, "tests of a frame (ns a person)");
    };
    html += fmt::format(
        "At {} people per square metre a single cylinder stops a person {} times a second without need, all "
        "depths {} "
        "times, depths by density {} times, for {}, {} and {} ns a person and frame. ",
        density, stops("single cylinder"), stops("all depths"), stops("by density"), time("single cylinder"),
        time("all depths"), time("by density"));
  }
  return html + fmt::format(
                    "Nothing but the fixed cylinder of 0.25 m misses a collision, of which it misses {} % at "
                    "2 people per "
                    "square metre. Finding each person's density takes {} ns there, as a call of its own in "
                    "every frame: more than "
                    "a coarser depth saves, so that it should come from what a simulator knows anyway, or be "
                    "asked for once "
                    "in a while.</p>",
                    of("2", "fixed cylinder 0.25 m", "missed (%)"),
                    of("2", "by density", "levels of a frame (ns a person)"));
}

}  // namespace

const Experiment detail_experiment{
    "detail",
    "Detail by density",
    "The paper suggests to choose the depth by the density of a crowd. People in random poses walk straight "
    "on at 1.3 m/s, "
    "each along a heading of his own and through whoever is in the way, for 5 s at 10 frames a second. A "
    "stop is a stretch of "
    "frames in which two of them are said to collide, and false where their meshes do not meet in any of "
    "these. By density, "
    "each agent has the depth that depth_at_density() gives for those within 2 m. Time is that of the kernel "
    "for all pairs "
    "whose root discs overlap, on all threads; finding the levels is timed beside it.",
    30,
    false,
    run_experiment,
    {"detail"},
    {{"detail", "False stops of a person in a second against the density of the crowd."},
     {"detail_time", "Time of a frame's tests, for a person, against the density."}},
    findings};

}  // namespace bch::report
