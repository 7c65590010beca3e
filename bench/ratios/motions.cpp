// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/ratios/ratios.hpp"

namespace bch::bench {
namespace {

constexpr std::uint64_t motion_seed = 31;
constexpr std::uint32_t asked_pairs = 400, checked_pairs = 40;
constexpr double seconds_of_pose = 0.12, least_seconds = 1;  // of clips: fewer poses, less to build
constexpr double samples_per_second = 1000, poses_per_second = 120;
constexpr double contact_tolerance = 0.005;

/// People who walk, and the same ones sampled.
struct Walkers {
  std::vector<AnimatedClip> clips;
  MotionScene scene;
  SampledMotions sampled;

  explicit Walkers(Scene& of)
      : clips(animated_clips(of.characters(), "walk", std::max(least_seconds, seconds_of_pose * of.poses()))),
        scene(clips, asked_pairs, motion_seed),
        sampled(scene, samples_per_second, poses_per_second) {
    scene.check(checked_pairs);
  }
};

Contender by_first_contact(const Walkers& walkers, bool touching) {
  const auto asked = std::make_shared<std::vector<Pair>>(walkers.scene.pairs(touching));
  const auto times = std::make_shared<std::vector<double>>(asked->size());
  return {[&walkers, asked, times] {
            first_contact(walkers.scene.motions(), *asked, MotionScene::interval, *times, contact_tolerance);
          },
          asked->size()};
}

/// Samples are of the nearest pose, so that a few pairs that hardly touch, or hardly pass, come out otherwise.
Contender by_sampling(const Walkers& walkers, bool touching) {
  const auto asked = std::make_shared<std::vector<Pair>>(walkers.scene.pairs(touching));
  const auto times = std::make_shared<std::vector<double>>(asked->size());
  const auto call = [&walkers, asked, times] {
    std::ranges::transform(*asked, times->begin(),
                           [&](const Pair& pair) { return walkers.sampled.first_contact(pair); });
  };
  call();
  const auto right =
      std::ranges::count_if(*times, [&](double time) { return (time <= MotionScene::seconds) == touching; });
  if (static_cast<double>(right) < 0.9 * static_cast<double>(asked->size()))
    throw std::runtime_error(fmt::format("sampling finds {} of {} pairs {}", right, asked->size(),
                                         touching ? "touching" : "free"));
  return {call, asked->size()};
}

/// Counts bytes, which takes no time: of animated bodies, and over those of poses at a rate.
Contender bytes_of(const Walkers& walkers) {
  Contender counted{[] {}};
  double& bytes = counted.counters["bytes"];
  for (const AnimatedClip& clip : walkers.clips) {
    counted.counters["seconds"] += clip.seconds;
    bytes += static_cast<double>(clip.shape.bytes());
  }
  for (const int rate : {10, 30, 120}) {
    double of_poses = 0;
    for (const AnimatedClip& clip : walkers.clips)
      of_poses += static_cast<double>(baked_poses(clip, rate).bytes());
    counted.counters[fmt::format("over_{}", rate)] = bytes / of_poses;
  }
  return counted;
}

}  // namespace

void add_motions(Scene& scene) {
  const auto walkers = once([&scene] { return std::make_shared<const Walkers>(scene); });
  add("motions/bytes", [walkers] { return bytes_of(walkers()); });
  for (const bool touching : {false, true}) {
    const char* const name = touching ? "touching" : "free";
    add(fmt::format("motions/first_contact/{}", name),
        [walkers, touching] { return by_first_contact(walkers(), touching); });
    add(fmt::format("motions/sampled/{}", name),
        [walkers, touching] { return by_sampling(walkers(), touching); });
  }
}

}  // namespace bch::bench
