// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/base/median.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/build_stages.hpp"
#include "bench/workload/clipper_union.hpp"
#include "bench/workload/race.hpp"

namespace bch::bench {
namespace {

constexpr double most_microseconds = 45, most_with_sse2 = 90, times_welzl = 3, times_clipper = 1000;
constexpr std::size_t clipper_poses = 3;  ///< it takes tens of milliseconds for one

/// Microseconds a pose of every stage, in the order of build_stages.
using StageTimes = std::vector<double>;

void add_contenders(BuildStages& stages, std::vector<Contender>& contenders) {
  for (const BuildStage& stage : build_stages)
    contenders.push_back({stage.name, [&stages, build = stage.build] {
                            for (std::size_t pose = 0; pose < stages.poses(); ++pose) (stages.*build)(pose);
                          }});
}

/// All stages of all in turn.
std::vector<StageTimes> time_stages(std::vector<BuildStages>& all, std::uint32_t runs) {
  std::vector<Contender> contenders;
  for (BuildStages& stages : all) add_contenders(stages, contenders);
  race(contenders, runs, 1);
  std::vector<StageTimes> times;
  auto contender = contenders.begin();
  for (const BuildStages& stages : all) {
    StageTimes& of_one = times.emplace_back();
    for (std::size_t s = 0; s < std::size(build_stages); ++s, ++contender)
      of_one.push_back(contender->nanoseconds / 1000 / static_cast<double>(stages.poses()));
  }
  return times;
}

double time_of(const StageTimes& times, std::string_view stage) {
  for (std::size_t s = 0; s < times.size(); ++s)
    if (build_stages[s].name == stage) return times[s];
  throw std::logic_error("no such stage of construction");
}

void print_header(std::string_view first) {
  fmt::print("  {:10}", first);
  for (const BuildStage& stage : build_stages)
    fmt::print("{:>{}}", stage.name, std::string_view(stage.name).size() + 3);
}

void print_times(const StageTimes& times) {
  for (std::size_t s = 0; s < times.size(); ++s)
    fmt::print(" {:{}.1f}", times[s], std::string_view(build_stages[s].name).size() + 2);
}

double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0, before = points.size() - 1; i < points.size(); before = i++)
      twice += static_cast<double>(points[before].x) * static_cast<double>(points[i].y) -
               static_cast<double>(points[before].y) * static_cast<double>(points[i].x);
  }
  return 0.5 * twice;
}

/// The outline's time against the union of all triangles. Its holes are the outline's too, so that areas differ by them.
void print_clipper_ratio(const Character& character, const BuildStages& stages, double microseconds) {
  std::vector<double> times;
  for (std::size_t pose = 0; pose < std::min(clipper_poses, stages.poses()); ++pose) {
    const Outline& outline = stages.outline_of(pose);
    const Stopwatch watch(1);
    const double area = clipper_union_area(stages.positions_of(pose), character.triangles, outline.grid_step);
    times.push_back(watch.nanoseconds() / 1000);
    if (area < 0) return fmt::print("  libpolyclipping's union of all triangles: not in this build\n");
    const double ours = area_of(outline);
    if (!(area <= ours * (1 + 1e-4) && area >= 0.9 * ours))
      throw std::runtime_error("construction: the outline has another area than libpolyclipping's union");
  }
  const double ratio = cli::median(times) / microseconds;
  fmt::print("  libpolyclipping's union of all triangles: {:.0f} us over {:.1f}: {:.0f} x   {}\n",
             cli::median(times), microseconds, ratio, verdict(ratio, times_clipper));
}

void print_character(const Character& character, std::uint32_t poses, std::uint32_t runs) {
  const std::vector<BuildImplementation> implementations = build_implementations();
  std::vector<BuildStages> all;
  for (const BuildImplementation& implementation : implementations)
    all.emplace_back(character, poses, implementation);
  const std::vector<StageTimes> times = time_stages(all, runs);
  fmt::print("construction, {}: {} triangles, {} poses in turn, us a pose\n", character.name,
             cli::grouped(character.triangles.size()), all[0].poses());
  print_header("");
  fmt::print("\n");
  for (std::size_t i = 0; i < all.size(); ++i) {
    fmt::print("  {:10}", implementations[i].name);
    print_times(times[i]);
    const double most = implementations[i].name == "sse2" ? most_with_sse2 : most_microseconds;
    fmt::print("   pose: {}; all: {}\n", verdict_at_most(time_of(times[i], "pose"), most),
               verdict_at_most(time_of(times[i], "all"), most));
  }
  const double gain = time_of(times[0], "hierarchy_welzl") / time_of(times[0], "hierarchy");
  fmt::print("  hierarchy over the same builder with Welzl's algorithm: {:.2f} x   {}\n", gain,
             verdict(gain, times_welzl));
  print_clipper_ratio(character, all[0], time_of(times[0], "outline"));
  std::fflush(stdout);
}

}  // namespace

void print_build_ratios(Scene& scene, std::uint32_t runs) {
  for (const auto& loaded : scene.characters()) print_character(loaded.character, scene.poses(), runs);
}

void print_build_growth(std::uint32_t poses, std::uint32_t runs) {
  const MenInDetail men;
  fmt::print("construction by triangles: the built-in man, merged and cut, us a pose\n");
  print_header("triangles");
  fmt::print("   all over n log n, to the first row\n");
  double first = 0;
  for (std::size_t i = 0; i < men.count(); ++i) {
    const Character man = men.make(i);
    std::vector<BuildStages> one;
    one.emplace_back(man, std::min(poses, men.poses(i)), chosen_build_implementation());
    const StageTimes times = time_stages(one, runs)[0];
    const auto n = static_cast<double>(men.triangles(i));
    const double growth = time_of(times, "all") / (n * std::log(n));
    if (i == 0) first = growth;
    fmt::print("  {:10}", cli::grouped(men.triangles(i)));
    print_times(times);
    fmt::print("   {:.2f}   {}\n", growth / first, verdict_at_most(growth / first, 1));
    std::fflush(stdout);
  }
}

}  // namespace bch::bench
