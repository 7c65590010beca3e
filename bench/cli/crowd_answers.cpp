// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/crowd.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <tuple>

#include <bch/crowd.hpp>

#include "bench/base/median.hpp"
#include "bench/base/progress.hpp"
#include "bench/cli/baked_report.hpp"

namespace bch::cli {
namespace {

constexpr std::uint32_t most_runs = 15;
constexpr std::uint32_t least_runs = 3;
constexpr double enough_seconds = 0.5;  ///< for one level, once there were least_runs

/// Runs the batch until the time is known, the first time unmeasured.
void answer_level(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                  const QueryOptions& options, LevelAnswers& level) {
  using Clock = std::chrono::steady_clock;
  collide(set, agents, pairs, level.hits, options);
  std::vector<double> seconds;
  double total = 0;
  while (seconds.size() < least_runs || (seconds.size() < most_runs && total < enough_seconds)) {
    const auto begin = Clock::now();
    collide(set, agents, pairs, level.hits, options);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    total += seconds.back();
  }
  level.runs = static_cast<std::uint32_t>(seconds.size());
  if (!pairs.empty()) level.nanoseconds_per_pair = 1e9 * median(seconds) / static_cast<double>(pairs.size());
}

double mean_discs(const ShapeSet& set, std::uint32_t level) {
  std::size_t discs = 0;
  for (std::uint32_t s = 0; s < set.shape_count(); ++s) discs += set.discs(s, level).size();
  return static_cast<double>(discs) / static_cast<double>(set.shape_count());
}

/// Pairs that can collide at some level. The single cylinder's are not enough: the discs of a deeper cut
/// stick out of it, so an agent's root disc depends on its level.
std::vector<Pair> candidates_of_all_levels(const ShapeSet& shapes, const Crowd& crowd) {
  bch::Crowd finder;
  std::vector<Pair> all;
  for (std::uint32_t level = 0; level < shapes.level_count(); ++level) {
    const std::vector<std::uint8_t> levels(crowd.size(), static_cast<std::uint8_t>(level));
    const std::vector<Pair> some = sorted(finder.candidates(shapes, crowd.at_level(levels)));
    std::vector<Pair> both;
    std::set_union(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(both), before);
    all = std::move(both);
  }
  return all;
}

}  // namespace

bool before(Pair a, Pair b) {
  return std::tie(a.first, a.second) < std::tie(b.first, b.second);
}

std::vector<Pair> sorted(const CrowdPairs& found) {
  std::vector<Pair> pairs(found.begin(), found.end());
  std::sort(pairs.begin(), pairs.end(), before);
  return pairs;
}

std::vector<Pair> hits_of(const CrowdAnswers& answers) {
  std::vector<Pair> hits;
  for (std::size_t i = 0; i < answers.pairs.size(); ++i)
    if (answers.finest().hits[i] != 0) hits.push_back(answers.pairs[i]);
  return hits;
}

CrowdAnswers answer_crowd(const ShapeSet& set, const Crowd& crowd, const QueryOptions& options) {
  CrowdAnswers answers;
  answers.pairs = candidates_of_all_levels(set, crowd);
  answers.levels.resize(set.level_count());
  Progress progress("answering levels", set.level_count());
  for (std::uint32_t k = 0; k < set.level_count(); ++k) {
    LevelAnswers& level = answers.levels[k];
    level.depth = set.depths()[k];
    level.discs = mean_discs(set, k);
    level.hits.resize(answers.pairs.size());
    const std::vector<std::uint8_t> levels(crowd.size(), static_cast<std::uint8_t>(k));
    answer_level(set, crowd.at_level(levels), answers.pairs, options, level);
    const auto& single = answers.levels.front().hits;
    for (std::size_t i = 0; i < level.hits.size(); ++i) {
      level.hit_count += level.hits[i];
      level.cleared += static_cast<std::uint64_t>(single[i] != 0 && level.hits[i] == 0);
    }
    progress.advance();
  }
  return answers;
}

}  // namespace bch::cli
