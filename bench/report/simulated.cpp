// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "bench/report/experiment.hpp"
#include "bench/report/recorded_crowds.hpp"

// What a simulator's own radius hides: bodies that overlap while the discs that it moves are clear of each other, and the other way round.
// The same of recorded people, who do not overlap, says how much of that is an error of the bodies.

namespace bch::report {
namespace {

using detail::CheckedFrame;
using detail::CheckedPerson;

/// How often bodies overlap, the simulator's discs do, or both.
struct Verdicts {
  std::uint64_t all = 0;
  std::array<std::uint64_t, 4> count{};  ///< by bodies + 2 discs

  void add(bool bodies, bool discs) { ++all, ++count[bodies + 2 * discs]; }
  double bodies_alone() const { return percent(count[1], all); }
  double discs_alone() const { return percent(count[2], all); }
  double both() const { return percent(count[3], all); }
};

/// Compares the overlaps of bodies with those of discs of one radius.
class DiscComparison {
 public:
  explicit DiscComparison(double radius) : square_reach_(4 * radius * radius) {}

  void add(const CheckedFrame& frame) {
    const auto people = frame.people;
    std::vector<bool> in_discs(people.size());
    auto next = frame.pairs.begin();
    for (std::size_t i = 0; i < people.size(); ++i)
      for (std::size_t k = i + 1; k < people.size(); ++k) {
        const double distance = square_distance(people[i], people[k]);
        const bool discs = distance < square_reach_;
        const float depth = depth_of(frame, next, people[i], people[k]);
        if (discs) in_discs[i] = in_discs[k] = true;
        if (distance <= near * near) neighbours_.add(depth >= 0, discs);
        if (depth < 0 && !discs) continue;
        auto& seen = of_two_[{people[i].walker.id, people[k].walker.id}];
        seen.first |= depth >= 0, seen.second |= discs;
        if (!discs) deepest_ = std::max(deepest_, depth);
      }
    for (std::size_t i = 0; i < people.size(); ++i) people_.add(people[i].overlaps, in_discs[i]);
  }

  const Verdicts& neighbours() const { return neighbours_; }
  const Verdicts& people() const { return people_; }
  /// Returns what is said of two people in the whole recording.
  Verdicts of_two() const {
    Verdicts verdicts;
    for (const auto& [ids, seen] : of_two_) verdicts.add(seen.first, seen.second);
    return verdicts;
  }
  double deepest() const { return static_cast<double>(deepest_); }

 private:
  using NextPair = std::span<const detail::CheckedPair>::iterator;

  /// Returns how deep the bodies of two people overlap; below 0 where they do not. Asked for in the order of the frame's pairs.
  static float depth_of(const CheckedFrame& frame, NextPair& next, const CheckedPerson& a,
                        const CheckedPerson& b) {
    const auto wanted = std::pair(a.walker.id, b.walker.id);
    const auto is_over = [&](const detail::CheckedPair& pair) {
      return pair.is_wall || !pair.overlap || std::pair(pair.first, pair.second) < wanted;
    };
    while (next != frame.pairs.end() && is_over(*next)) ++next;
    return next != frame.pairs.end() && std::pair(next->first, next->second) == wanted ? next->depth : -1;
  }

  const double square_reach_;
  Verdicts neighbours_, people_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<bool, bool>> of_two_;
  float deepest_ = 0;
};

constexpr const char *hidden_column = "bodies alone (% of neighbours)",
                     *alone_column = "discs alone (% of neighbours)";

Table empty_table() {
  return Table({"recording", "made by", "structure", "radius of discs (m)", "neighbours",
                "both overlap (% of neighbours)", hidden_column, alone_column,
                "bodies alone (% of person-frames)", "discs alone (% of person-frames)",
                "people of whom two meet", "bodies alone (of these)", "discs alone (of these)",
                "deepest while discs are clear (cm)"});
}

void add_row(Table& table, const Source& source, const Bodies& bodies, double radius,
             const DiscComparison& comparison) {
  const Verdicts& neighbours = comparison.neighbours();
  const Verdicts of_two = comparison.of_two();
  table.add({source.file, std::string(source.made_by), bodies.name, radius, neighbours.all, neighbours.both(),
             neighbours.bodies_alone(), neighbours.discs_alone(), comparison.people().bodies_alone(),
             comparison.people().discs_alone(), of_two.all, of_two.count[1], of_two.count[2],
             100 * comparison.deepest()});
}

void run_simulated(Run& run) {
  const std::vector<Source> sources = wanted_sources(run);
  if (sources.empty()) return;
  Table table = empty_table();
  double done = 0;
  for (const Source& source : sources)
    for (const Bodies& bodies : {outlines, four_slabs}) {
      DiscComparison comparison(run.sizes().disc_radius);
      const auto reader = open(run, source);
      detail::check(*reader, bodies.options(),
                    [&](const CheckedFrame& frame, const ShapeSet&) { comparison.add(frame); });
      add_row(table, source, bodies, run.sizes().disc_radius, comparison);
      run.done(++done / static_cast<double>(2 * sources.size()));
    }
  run.write("simulated", table);
}

std::string hidden(const Results& results, std::string_view of) {
  return range_in(results("simulated"), of, hidden_column);
}

std::string alone(const Results& results, std::string_view of) {
  return range_in(results("simulated"), of, alone_column);
}

std::string radius(const Results& results, std::string_view) {
  return results("simulated").text(0, "radius of discs (m)");
}

}  // namespace

const Experiment simulated_experiment{"simulated",
                                      "Simulated people",
                                      10,
                                      false,
                                      run_simulated,
                                      {{"hidden neighbours", hidden},
                                       {"neighbours of discs alone", alone},
                                       {"radius of simulated people", radius}}};

}  // namespace bch::report
