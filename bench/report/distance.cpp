// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <map>

#include <bch/scene_plan.hpp>

#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/words.hpp"

// How near people come until a structure says that they collide: figure 6, left, of the paper.

namespace bch::report {
namespace {

/// The paper's means in centimetres.
struct DistanceRow {
  std::string_view contestant;
  double paper;
  bool in_groups = false;  ///< also for each kind of clips and couple of people
};
constexpr DistanceRow rows[] = {
    {"single cylinder", 20, true},         {"BCH outline", 5, true},      {exact_leaves_name, empty_cell},
    {"BCH outline by centre", empty_cell}, {"BCH projected", empty_cell}, {"OBB outline", 4, true},
    {"OBB projected", empty_cell},         {"OBB full mesh", 0},
};

/// Where people in slabs are detected.
std::vector<double> contacts_in_slabs(Run& run, const SlideCases& cases, std::uint32_t slabs, Leaves leaves) {
  const ShapeSet set(run.scene().shapes_in_slabs(slabs), {.slices = standing_slices(slabs)});
  return cases.contacts(set, leaves);
}

/// What is common to all rows of a table.
struct DistanceTables {
  Table summary{{"structure", "paper (cm)", "mean (cm)", "mean (95 % low)", "mean (95 % high)", "median (cm)",
                 "standard deviation (cm)", "lower quartile (cm)", "upper quartile (cm)", "cases",
                 "never detected"}};
  Table cases{{"structure", "case", "place (m)", "distance (cm)"}};
  Table groups{{"structure", "by", "group", "mean (cm)", "mean (95 % low)", "mean (95 % high)", "median (cm)",
                "cases"}};
};

/// Two names in one order, whoever slides.
std::string couple(const std::string& a, const std::string& b) {
  return a < b ? a + " + " + b : b + " + " + a;
}

/// What two people do and who they are, case by case.
struct Group {
  std::string_view by;
  std::vector<std::string> of_case;
};

/// "walk" of "walk fast" or "walk_07_01".
std::string kind_of(const cli::LoadedCharacter& character, PoseTime at) {
  const std::string name = cli::clip_name(character, at);
  return name.substr(0, name.find_first_of(" _"));
}

std::vector<Group> groups_of(Run& run, const SlideCases& cases) {
  Group kinds{"clips", {}}, people{"people", {}};
  const auto& sources = run.scene().sources();
  const auto& characters = run.scene().characters();
  for (const Pair pair : cases.pairs()) {
    const ShapeSource &a = sources[cases.agents().shape[pair.first]],
                      &b = sources[cases.agents().shape[pair.second]];
    const cli::LoadedCharacter &first = characters[a.character], &second = characters[b.character];
    kinds.of_case.push_back(couple(kind_of(first, a.at), kind_of(second, b.at)));
    people.of_case.push_back(couple(cli::file_name(first), cli::file_name(second)));
  }
  return {kinds, people};
}

void add_groups(const Run& run, const DistanceRow& row, std::span<const Group> groups,
                std::span<const double> distances, Table& table) {
  for (const Group& group : groups) {
    std::map<std::string, std::vector<double>> parts;
    for (std::size_t i = 0; i < distances.size(); ++i)
      if (!std::isnan(distances[i])) parts[group.of_case[i]].push_back(distances[i]);
    for (const auto& [name, found] : parts) {
      const Estimate mean = estimate(found, run.seed());
      table.add({row.contestant, group.by, name, mean.mean, mean.low, mean.high, quartiles(found).median,
                 found.size()});
    }
  }
}

void add(const Run& run, const DistanceRow& row, std::span<const double> places,
         std::span<const double> distances, DistanceTables& out) {
  const std::vector<double> found = known(distances);
  const Estimate mean = estimate(found, run.seed());
  const Quartiles spread = quartiles(found);
  out.summary.add({row.contestant, row.paper, mean.mean, mean.low, mean.high, spread.median, mean.deviation,
                   spread.low, spread.high, distances.size(), distances.size() - found.size()});
  for (std::size_t i = 0; i < distances.size(); ++i)
    out.cases.add({row.contestant, i, places[i], distances[i]});
}

void run_distance(Run& run) {
  const SlideCases cases(run.scene().shapes(), run.sizes().cases, run.seed());
  const std::vector<Group> groups = groups_of(run, cases);
  const ShapeSet leaves(run.scene().shapes()), roots(run.scene().shapes(), {{0}});
  DistanceTables out;
  double done = 0;
  for (const DistanceRow& row : rows) {
    // The hierarchies that the kernel takes are slid in one query, others step by step.
    const std::vector<double> places =
        row.contestant == "BCH outline"       ? cases.contacts(leaves)
        : row.contestant == exact_leaves_name ? cases.contacts(leaves, Leaves::segments)
        : row.contestant == "single cylinder"
            ? cases.contacts(roots)
            : cases.contacts(run.contestants().structure(row.contestant), all_depths);
    const std::vector<double> distances = cases.distances(*run.distances(), places);
    add(run, row, places, distances, out);
    if (row.in_groups) add_groups(run, row, groups, distances, out.groups);
    run.done(++done / static_cast<double>(std::size(rows) + std::size(compared_slabs)));
  }
  for (const std::uint32_t slabs : compared_slabs) {
    for (const Leaves how : {Leaves::discs, Leaves::segments}) {
      const std::vector<double> places = contacts_in_slabs(run, cases, slabs, how);
      const std::string name = slabs_name(slabs, how);
      add(run, {name, empty_cell}, places, cases.distances(*run.distances(), places), out);
    }
    run.done(++done / static_cast<double>(std::size(rows) + std::size(compared_slabs)));
  }
  run.write("distance", out.summary);
  run.write("distance_cases", out.cases);
  run.write("distance_groups", out.groups);
}

/// "X: 6.7 cm (95 % 6.1 to 7.3; the paper 5)".
std::string words_of(const Results& results, std::string_view structure) {
  const Table& table = results("distance");
  const std::size_t row = table.row({{"structure", structure}});
  return fmt::format("{} {} cm ({} to {}; the paper {})", escaped(structure),
                     brief(table.number(row, "mean (cm)")), brief(table.number(row, "mean (95 % low)")),
                     brief(table.number(row, "mean (95 % high)")), brief(table.number(row, "paper (cm)")));
}

/// The groups in which the outline's cylinders err most and least.
std::string extremes(const Results& results, std::string_view by) {
  const Table& groups = results("distance_groups");
  std::size_t least = groups.rows().size(), most = least;
  for (std::size_t i = 0; i < groups.rows().size(); ++i) {
    if (groups.text(i, "structure") != "BCH outline" || groups.text(i, "by") != by) continue;
    const double mean = groups.number(i, "mean (cm)");
    if (least == groups.rows().size() || mean < groups.number(least, "mean (cm)")) least = i;
    if (most == groups.rows().size() || mean > groups.number(most, "mean (cm)")) most = i;
  }
  const auto words = [&](std::size_t row) {
    return fmt::format("{} cm for {} ({} cases)", brief(groups.number(row, "mean (cm)")),
                       escaped(groups.text(row, "group")), groups.text(row, "cases"));
  };
  return words(least) + " to " + words(most);
}

/// What leaves of 1 cm cost beyond the exact outline.
std::string discs_over_boxes(const Results& results, std::string_view column) {
  const Table& table = results("distance");
  return brief(table.number({{"structure", "BCH outline"}}, column) -
               table.number({{"structure", "OBB outline"}}, column));
}

}  // namespace

const Experiment distance_experiment{
    "distance",
    "Distance at detection",
    40,
    true,
    run_distance,
    {{"distance of", words_of},
     {"distance of discs over boxes",
      [](const Results& results, std::string_view) { return discs_over_boxes(results, "mean (cm)"); }},
     {"the paper's distance of discs over boxes",
      [](const Results& results, std::string_view) { return discs_over_boxes(results, "paper (cm)"); }},
     {"extremes by", extremes}}};

}  // namespace bch::report
