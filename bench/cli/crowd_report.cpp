// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/crowd.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <tuple>

#include <bch/crowd.hpp>

#include "bench/base/progress.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/inspection.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::cli {
namespace {

constexpr std::uint32_t max_runs = 15;
constexpr std::uint32_t least_runs = 3;
constexpr double min_total_seconds = 0.5;  ///< for one level, once there were least_runs

/// Runs the batch until the time is known, the first time unmeasured.
void answer_level(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                  const detail::AllOptions& options, LevelAnswers& level) {
  collide(set, agents, pairs, level.hits, options);
  std::vector<double> seconds;
  double total = 0;
  while (seconds.size() < least_runs || (seconds.size() < max_runs && total < min_total_seconds)) {
    const bench::Stopwatch watch(0);
    collide(set, agents, pairs, level.hits, options);
    seconds.push_back(watch.nanoseconds() / 1e9);
    total += seconds.back();
  }
  level.runs = static_cast<std::uint32_t>(seconds.size());
  if (!pairs.empty())
    level.nanoseconds_per_pair = 1e9 * bench::median(seconds) / static_cast<double>(pairs.size());
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

std::vector<Pair> sorted(const bch::Crowd::Pairs& found) {
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

CrowdAnswers answer_crowd(const ShapeSet& set, const Crowd& crowd, const detail::AllOptions& options) {
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

namespace {

std::string leaves_text(const CrowdRun& run) {
  return run.set.exact_leaves() && run.options.answer.leaves != "discs" ? "segments" : "discs";
}

std::string time_text(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.0f} us", seconds * 1e6) : fmt::format("{:.1f} ms", seconds * 1e3);
}

double bytes_per_shape(const CrowdRun& run) {
  return static_cast<double>(run.set.bytes()) / static_cast<double>(run.set.shape_count());
}

/// Part of the collisions at depth 0 that a level clears: of single cylinders.
double fraction_cleared(const CrowdRun& run, const LevelAnswers& level) {
  const std::uint64_t single = run.answers.levels.front().hit_count;
  return single == 0 ? 0 : static_cast<double>(level.cleared) / static_cast<double>(single);
}

std::string facts(const CrowdRun& run) {
  const bool baked = run.characters.empty();
  const double outline = run.built.outline_seconds, hierarchy = run.built.hierarchy_seconds;
  return fact(baked ? "baked" : "characters",
              baked ? run.options.characters.front() : names_of(run.characters)) +
         fact("shapes", fmt::format("{} in contour hierarchies down to {:g} mm, {:.1f} kB each",
                                    counted(run.set.shape_count(), "pose"), run.threshold * 1e3,
                                    bytes_per_shape(run) / 1e3)) +
         (baked ? std::string()
                : fact("build", fmt::format("{} a shape and thread: outline {}, hierarchy {}",
                                            time_text(outline + hierarchy), time_text(outline),
                                            time_text(hierarchy)))) +
         fact("agents", agents_text(run.options, run.crowd)) +
         fact("candidates", fmt::format("{} that can collide", counted(run.answers.pairs.size(), "pair"))) +
         fact("kernel", fmt::format("{}, {}, leaves {}", run.implementation, counted(run.threads, "thread"),
                                    leaves_text(run)));
}

std::string level_table(const CrowdRun& run) {
  std::string out =
      fmt::format("{:>5} {:>9} {:>13} {:>10} {:>9}\n", "depth", "discs", "collisions", "cleared", "ns/pair");
  for (const LevelAnswers& level : run.answers.levels)
    out += fmt::format("{:>5} {:>9.1f} {:>13} {:>10} {:>9.1f}\n", depth_name(level.depth), level.discs,
                       grouped(level.hit_count),
                       level.depth == 0 ? "-" : fmt::format("{:.1f} %", 100 * fraction_cleared(run, level)),
                       level.nanoseconds_per_pair);
  return out;
}

std::string conclusion(const CrowdRun& run) {
  const LevelAnswers& finest = run.answers.finest();
  if (finest.depth == 0 || run.answers.levels.front().hit_count == 0) return {};
  const std::string which =
      finest.depth == all_depths ? "The full hierarchy" : fmt::format("Depth {}", finest.depth);
  return fmt::format("{} clears {:.1f} % of the single cylinder's collisions.\n", which,
                     100 * fraction_cleared(run, finest));
}

/// A baked file has settled what concerns shapes.
nlohmann::ordered_json options_json(const CrowdRun& run) {
  const CrowdOptions& o = run.options;
  nlohmann::ordered_json json{{"characters", o.characters}};
  if (!run.characters.empty()) json["clips"] = o.shapes.clips;
  if (!o.shapes.up.empty()) json["up"] = o.shapes.up;
  if (o.shapes.scale > 0) json["scale"] = o.shapes.scale;
  if (!run.characters.empty()) json["poses"] = o.shapes.poses;
  json["threshold_m"] = shortest(static_cast<float>(run.threshold));
  json["agents"] = o.agents;
  json["density_per_m2"] = o.density;
  json["seed"] = o.seed;
  if (!run.characters.empty()) json["depths"] = o.answer.depths;
  json["leaves"] = leaves_text(run);
  return json;
}

nlohmann::ordered_json depth_json(std::uint32_t depth) {
  return depth == all_depths ? nlohmann::ordered_json("all") : nlohmann::ordered_json(depth);
}

}  // namespace

std::string names_of(std::span<const LoadedCharacter> characters) {
  std::string names;
  for (const LoadedCharacter& character : characters)
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", file_name(character),
                         counted(character.report.triangles, "triangle"));
  return names;
}

std::string agents_text(const CrowdOptions& options, const Crowd& crowd) {
  return fmt::format("{} on {:.1f} m x {:.1f} m, {:g} per m2, seed {}", grouped(crowd.size()), crowd.side,
                     crowd.side, options.density, options.seed);
}

std::string text_report(const CrowdRun& run) {
  std::uint32_t runs = 0;
  for (const LevelAnswers& level : run.answers.levels) runs = std::max(runs, level.runs);
  return facts(run) + "\n" + level_table(run) + "\n" + conclusion(run) +
         fmt::format("Times per pair are medians of up to {} batch calls after a warm-up.\n", runs);
}

nlohmann::ordered_json json_report(const CrowdRun& run) {
  nlohmann::ordered_json json{{"program", "bch " BCH_VERSION}, {"options", options_json(run)}};
  for (const LoadedCharacter& character : run.characters)
    json["characters"].push_back({{"source", character.source},
                                  {"triangles", character.report.triangles},
                                  {"height_m", shortest(character.report.height)}});
  json["shapes"] = {{"count", run.set.shape_count()}, {"bytes_per_shape", bytes_per_shape(run)}};
  if (!run.characters.empty()) {
    json["shapes"]["outline_seconds"] = run.built.outline_seconds;
    json["shapes"]["hierarchy_seconds"] = run.built.hierarchy_seconds;
  }
  json["crowd"] = {{"agents", run.crowd.size()},
                   {"side_m", run.crowd.side},
                   {"area_m2", run.crowd.side * run.crowd.side},
                   {"candidate_pairs", run.answers.pairs.size()}};
  json["kernel"] = {{"implementation", run.implementation}, {"threads", run.threads}};
  for (const LevelAnswers& level : run.answers.levels)
    json["levels"].push_back({{"depth", depth_json(level.depth)},
                              {"discs_per_shape", level.discs},
                              {"hits", level.hit_count},
                              {"cleared", level.cleared},
                              {"cleared_share", fraction_cleared(run, level)},
                              {"nanoseconds_per_pair", level.nanoseconds_per_pair},
                              {"runs", level.runs}});
  return json;
}

std::string csv_of(std::span<const Pair> pairs) {
  std::string out = "first,second\n";
  for (const auto [first, second] : pairs) out += fmt::format("{},{}\n", first, second);
  return out;
}

}  // namespace bch::cli
