// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"

// How near people come until a structure says that they collide: figure 6, left, of the paper.

namespace bch::report {
namespace {

/// The paper's means in centimetres.
struct Row {
  std::string_view contestant;
  double paper;
};
constexpr double not_told = std::numeric_limits<double>::quiet_NaN();
constexpr Row rows[] = {
    {"single cylinder", 20},     {"BCH outline", 5}, {"BCH outline by centre", not_told},
    {"BCH projected", not_told}, {"OBB outline", 4}, {"OBB projected", not_told},
    {"OBB full mesh", 0},
};

/// What is common to all rows of a table.
struct Tables {
  Table summary{{"structure", "paper (cm)", "mean (cm)", "mean (95 % low)", "mean (95 % high)", "median (cm)",
                 "standard deviation (cm)", "lower quartile (cm)", "upper quartile (cm)", "cases",
                 "never detected"}};
  Table cases{{"structure", "case", "place (m)", "distance (cm)"}};
};

void add(const Run& run, const Row& row, std::span<const double> places, std::span<const double> distances,
         Tables& out) {
  const std::vector<double> found = known(distances);
  const Estimate mean = estimate(found, run.seed());
  const Quartiles spread = quartiles(found);
  out.summary.add({row.contestant, row.paper, mean.mean, mean.low, mean.high, spread.median, mean.deviation,
                   spread.low, spread.high, distances.size(), distances.size() - found.size()});
  for (std::size_t i = 0; i < distances.size(); ++i)
    out.cases.add({row.contestant, i, places[i], distances[i]});
}

void run_experiment(Run& run) {
  const SlideCases cases(run.scene().shapes(), run.sizes().cases, run.seed());
  const ShapeSet leaves(run.scene().shapes()), roots(run.scene().shapes(), {{0}});
  Tables out;
  double done = 0;
  for (const Row& row : rows) {
    const baselines::Structure& structure = run.contestants().structure(row.contestant);
    // The hierarchies that the kernel takes are slid in one query, others step by step.
    const std::vector<double> places = row.contestant == "BCH outline" ? cases.contacts(leaves)
                                       : row.contestant == "single cylinder"
                                           ? cases.contacts(roots)
                                           : cases.contacts(structure, all_depths);
    add(run, row, places, cases.distances(*run.distances(), places), out);
    run.done(++done / static_cast<double>(std::size(rows)));
  }
  run.write("distance", out.summary);
  run.write("distance_cases", out.cases);
}

/// "X: 6.7 cm (95 % 6.1 to 7.3; the paper 5)".
std::string words_of(const Table& table, std::string_view structure) {
  const std::size_t row = table.row({{"structure", structure}});
  return fmt::format("{} {} cm ({} to {}; the paper {})", escaped(structure),
                     brief(table.number(row, "mean (cm)")), brief(table.number(row, "mean (95 % low)")),
                     brief(table.number(row, "mean (95 % high)")), brief(table.number(row, "paper (cm)")));
}

std::string findings(const Results& results) {
  const Table& table = results("distance");
  const double outline = table.number({{"structure", "OBB outline"}}, "mean (cm)");
  const double discs = table.number({{"structure", "BCH outline"}}, "mean (cm)");
  return fmt::format(
      "<p>Mean distances of the meshes when a collision is seen: {}; {}; {}; {}.</p>"
      "<p>Where we are above the paper it is the bodies, not the discs: OBB trees over the outline are exact "
      "seen from above, so their {} cm are the price of leaving out height, a leg that passes "
      "under an arm. Discs "
      "with leaves of 1 cm add {} cm to that; in the paper {} cm. Our people are other meshes in "
      "other motions.</p>",
      words_of(table, "single cylinder"), words_of(table, "BCH outline"), words_of(table, "OBB outline"),
      words_of(table, "OBB full mesh"), brief(outline), brief(discs - outline),
      brief(table.number({{"structure", "BCH outline"}}, "paper (cm)") -
            table.number({{"structure", "OBB outline"}}, "paper (cm)")));
}

}  // namespace

const Experiment distance_experiment{"distance",
                                     "Distance at detection",
                                     "Figure 6, left. Two people stand apart, each in a pose and turned at "
                                     "random; the first slides along a line that passes the second's origin "
                                     "up to half a metre to either side, as in the paper, "
                                     "until the structure says that they collide. Then the distance of the "
                                     "two meshes in space is measured, by FCL's "
                                     "distance of triangles: 0 would be perfect. All are asked "
                                     "every millimetre, and the place is then halved to a micrometre.",
                                     40,
                                     true,
                                     run_experiment,
                                     {"distance"},
                                     {{"distance",
                                       "Distance of the meshes at detection: median, quartiles (box), 5 % "
                                       "and 95 % (whiskers), mean (diamond) and "
                                       "the paper's mean (cross)."}},
                                     findings};

}  // namespace bch::report
