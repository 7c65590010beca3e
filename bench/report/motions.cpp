// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/motions.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "bench/base/stopwatch.hpp"
#include "bench/report/report.hpp"

// Clips as moving spheres, whose first contact is found at every real time, against samples of the nearest pose.

namespace bch::report {
namespace {

constexpr double sample_rates[] = {30, 120, 1000};
constexpr std::uint32_t checked_pairs = 40;
/// How long the parts of clips are, for each pose of a character.
constexpr double seconds_a_pose = 0.12;

/// Returns how long one of so many takes, on one thread; NaN of none.
template <class Work>
double microseconds_of(std::size_t count, Work work) {
  if (count == 0) return unknown;
  return tbb::task_arena(1).execute([&] {
    const bench::Stopwatch watch(1);
    work();
    return watch.nanoseconds() / 1000 / static_cast<double>(count);
  });
}

}  // namespace

/// The times of pairs that touch, and of those that do not, aside.
void run_motions(Run& run) {
  const std::vector<bench::AnimatedClip> walks =
      bench::animated_clips(run.scene.characters(), "walk",
                            std::max(bench::least_clip_seconds, seconds_a_pose * run.sizes().poses));
  const bench::MotionScene scene(walks, run.sizes().cases, run.seed());
  scene.check(checked_pairs);
  Table table({"samples a second", "pair", "first contact (s)", "first sample that collides (s)"});
  Table costs({"how", "pairs", "a pair (us)"});
  std::vector<double> found(scene.pairs().size());
  const auto time = [&](const std::string& how, const auto& search) {
    for (const bool touching : {false, true}) {
      const std::vector<Pair> queried = scene.pairs(touching);
      costs.add(
          {how, touching ? "touching" : "free", microseconds_of(queried.size(), [&] { search(queried); })});
    }
    search(scene.pairs());
  };
  time("first contact", [&](std::span<const Pair> pairs) {
    first_contact(scene.motions(), pairs, bench::MotionScene::interval, std::span(found).first(pairs.size()));
  });
  const std::vector<double> times = found;
  for (const double rate : sample_rates) {
    const bench::SampledMotions sampled(scene, rate, rate);
    time(fmt::format("{:g} samples a second", rate), [&](std::span<const Pair> pairs) {
      std::ranges::transform(pairs, found.begin(),
                             [&](const Pair& pair) { return sampled.first_contact(pair); });
    });
    for (std::size_t i = 0; i < found.size(); ++i) table.add({rate, i, times[i], found[i]});
  }
  run.write("motions", table);
  run.write("motions_costs", costs);
}

}  // namespace bch::report
