// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <bch/outline.hpp>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/build_stages.hpp"
#include "bench/workload/clipper_union.hpp"

namespace bch::bench {
namespace {

constexpr double most_build_us = 45, most_with_base = 90, times_welzl = 3, times_clipper = 1000;
constexpr std::size_t clipper_poses = 3;  ///< it takes tens of milliseconds for one

/// A character, and the stages of its construction.
struct Built {
  Built(const Character& made, std::uint32_t poses, const detail::BuildImplementation& implementation)
      : character(made), stages(character, poses, implementation) {}

  const Character character;
  BuildStages stages;
};

/// Adds NAME/<stage> for all stages.
void add_stages(Suite& suite, const std::string& name, const Shared<Built>& built) {
  for (const BuildStage& stage : build_stages)
    suite.add(fmt::format("{}/{}", name, stage.name), [built, build = stage.build]() -> Contender {
      const auto kept = built.get();
      const auto call = [kept, build] {
        for (std::size_t pose = 0; pose < kept->stages.poses(); ++pose) (kept->stages.*build)(pose);
      };
      return {call, kept->stages.poses()};
    });
}

double microseconds(const Results& results, const std::string& name, std::string_view stage) {
  return results.at(fmt::format("{}/{}", name, stage)).nanoseconds / 1000;
}

void print_header(std::string_view first) {
  fmt::print("  {:10}", first);
  for (const BuildStage& stage : build_stages)
    fmt::print("{:>{}}", stage.name, std::string_view(stage.name).size() + 3);
}

void print_times(const Results& results, const std::string& name) {
  for (const BuildStage& stage : build_stages)
    fmt::print(" {:{}.1f}", microseconds(results, name, stage.name), std::string_view(stage.name).size() + 2);
}

/// The union of all triangles. Its holes are the outline's too, so that areas differ by them.
Contender clipper_contender(const Shared<Built>& built) {
  const auto kept = built.get();
  const std::size_t poses = std::min(clipper_poses, kept->stages.poses());
  const auto area_of = [kept](std::size_t pose) {
    return clipper_union_area(kept->stages.positions_of(pose), kept->character.triangles,
                              kept->stages.outline_of(pose).grid_step);
  };
  for (std::size_t pose = 0; pose < poses; ++pose) {
    const double theirs = area_of(pose), ours = area(kept->stages.outline_of(pose));
    if (!(theirs <= ours * (1 + 1e-4) && theirs >= 0.9 * ours))
      throw std::runtime_error("construction: the outline has another area than libpolyclipping's union");
  }
  const auto call = [area_of, poses] {
    for (std::size_t pose = 0; pose < poses; ++pose) area_of(pose);
  };
  return {call, poses};
}

void print_construction(const Character& character, const std::string& name, const Results& results) {
  const auto with = [&](const detail::BuildImplementation& set) {
    return fmt::format("{}/{}", name, set.name);
  };
  const std::string best = with(detail::best_build_implementation());
  fmt::print("construction, {}: {} triangles, {} poses in turn, us a pose\n", character.name,
             cli::grouped(character.triangles.size()), results.at(best + "/all").items);
  print_header("");
  fmt::print("\n");
  for (const detail::BuildImplementation& set : detail::build_implementations()) {
    if (!set.supported()) continue;
    fmt::print("  {:10}", set.name);
    print_times(results, with(set));
    const double most = set.name == base_implementation() ? most_with_base : most_build_us;
    fmt::print("   pose: {}; all: {}\n", verdict_at_most(microseconds(results, with(set), "pose"), most),
               verdict_at_most(microseconds(results, with(set), "all"), most));
  }
  const double gain =
      microseconds(results, best, "hierarchy_welzl") / microseconds(results, best, "hierarchy");
  fmt::print("  hierarchy over the same builder with Welzl's algorithm: {:.2f} x   {}\n", gain,
             verdict(gain, times_welzl));
  if (!results.contains(name + "/clipper"))
    return fmt::print("  libpolyclipping's union of all triangles: not in this build\n");
  const double clipper = microseconds(results, name, "clipper"),
               ours = microseconds(results, best, "outline");
  fmt::print("  libpolyclipping's union of all triangles: {:.0f} us over {:.1f}: {:.0f} x   {}\n", clipper,
             ours, clipper / ours, verdict(clipper / ours, times_clipper));
}

void print_growth(const MenInDetail& men, const Results& results) {
  fmt::print("construction by triangles: the built-in man, merged and cut, us a pose\n");
  print_header("triangles");
  fmt::print("   all over n log n, to the first row\n");
  double first = 0;
  for (std::size_t i = 0; i < men.count(); ++i) {
    const auto n = static_cast<double>(men.triangles(i));
    const std::string name = fmt::format("growth/{}", men.triangles(i));
    const double growth = microseconds(results, name, "all") / (n * std::log(n));
    if (i == 0) first = growth;
    fmt::print("  {:10}", cli::grouped(men.triangles(i)));
    print_times(results, name);
    fmt::print("   {:.2f}   {}\n", growth / first, verdict_at_most(growth / first, 1));
  }
}

/// Adds the stages of a character by every instruction set. Returns: how to print them.
std::function<void(const Results&)> add_character(Suite& suite, const Character& character,
                                                  const std::string& name, std::uint32_t poses) {
  for (const detail::BuildImplementation& set : detail::build_implementations()) {
    if (!set.supported()) continue;
    const Shared<Built> built(
        [&character, poses, &set] { return std::make_shared<Built>(character, poses, set); });
    add_stages(suite, fmt::format("{}/{}", name, set.name), built);
    if (has_clipper && &set == &detail::best_build_implementation())
      suite.add(name + "/clipper", [built] { return clipper_contender(built); });
  }
  return [&character, name](const Results& results) { print_construction(character, name, results); };
}

}  // namespace

std::vector<Table> build_tables(Suite& suite, Scene& scene) {
  std::vector<std::function<void(const Results&)>> print;
  for (std::size_t i = 0; i < scene.characters().size(); ++i)
    print.push_back(add_character(suite, scene.characters()[i].character, fmt::format("construction/{}", i),
                                  scene.poses()));
  const auto men = std::make_shared<const MenInDetail>();
  for (std::size_t i = 0; i < men->count(); ++i)
    add_stages(suite, fmt::format("growth/{}", men->triangles(i)),
               Shared<Built>([men, i, most = scene.poses()] {
                 return std::make_shared<Built>(men->make(i), std::min(most, men->poses(i)),
                                                detail::best_build_implementation());
               }));
  return {{"construction", "^construction/",
           [print](const Results& results) {
             for (const auto& each : print) each(results);
           }},
          {"growth", "^growth/", [men](const Results& results) { print_growth(*men, results); }}};
}

}  // namespace bch::bench
