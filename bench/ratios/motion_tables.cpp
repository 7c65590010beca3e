// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/motions.hpp"

namespace bch::bench {
namespace {

constexpr std::uint64_t motion_seed = 31;
constexpr std::uint32_t pairs = 400, checked_pairs = 40;
constexpr double seconds_of_pose = 0.12, least_seconds = 1;  // of clips: fewer poses, less to build
constexpr double samples_per_second = 1000, poses_per_second = 120;
constexpr double most_bytes = 0.6, most_free = 20, most_touching = 30, needed_over_sampling = 20;
constexpr double tolerance = 0.005;

/// People who walk, and the same ones sampled.
struct Walkers {
  std::vector<AnimatedClip> clips;
  MotionScene scene;
  SampledMotions sampled;

  explicit Walkers(Scene& of)
      : clips(animated_clips(of.characters(), "walk", std::max(least_seconds, seconds_of_pose * of.poses()))),
        scene(clips, pairs, motion_seed),
        sampled(scene, samples_per_second, poses_per_second) {
    scene.check(checked_pairs);
  }

  /// Returns the animated bodies' bytes over those of poses at a rate.
  double bytes_over_poses(double per_second) const {
    double own = 0, of_poses = 0;
    for (const AnimatedClip& clip : clips) {
      own += static_cast<double>(clip.shape.bytes());
      of_poses += static_cast<double>(baked_poses(clip, per_second).bytes());
    }
    return own / of_poses;
  }
};

std::string contact_name(bool touching) {
  return touching ? "touching" : "free";
}

Contender contact_contender(const std::shared_ptr<Walkers>& walkers, bool touching) {
  const auto asked = std::make_shared<std::vector<Pair>>(walkers->scene.pairs(touching));
  const auto times = std::make_shared<std::vector<double>>(asked->size());
  return {[walkers, asked, times] {
            first_contact(walkers->scene.motions(), *asked, MotionScene::interval, *times, tolerance);
          },
          asked->size()};
}

/// Samples are of the nearest pose, so that a few pairs that hardly touch, or hardly pass, come out otherwise.
Contender sampled_contender(const std::shared_ptr<Walkers>& walkers, bool touching) {
  const auto asked = std::make_shared<std::vector<Pair>>(walkers->scene.pairs(touching));
  const auto times = std::make_shared<std::vector<double>>(asked->size());
  const auto call = [walkers, asked, times] {
    for (std::size_t i = 0; i < asked->size(); ++i) (*times)[i] = walkers->sampled.first_contact((*asked)[i]);
  };
  call();
  const auto right = std::count_if(times->begin(), times->end(),
                                   [&](double time) { return (time <= MotionScene::seconds) == touching; });
  if (static_cast<double>(right) < 0.9 * static_cast<double>(asked->size()))
    throw std::runtime_error(
        fmt::format("sampling finds {} of {} pairs {}", right, asked->size(), contact_name(touching)));
  return {call, asked->size()};
}

/// Counts bytes, which takes no time.
Contender bytes_contender(const std::shared_ptr<Walkers>& walkers) {
  Contender counted{[] {}, 1};
  for (const AnimatedClip& clip : walkers->clips) counted.counters["seconds"] += clip.seconds;
  for (const AnimatedClip& clip : walkers->clips)
    counted.counters["bytes"] += static_cast<double>(clip.shape.bytes());
  for (const int rate : {10, 30, 120})
    counted.counters[fmt::format("over_{}", rate)] = walkers->bytes_over_poses(rate);
  return counted;
}

void print_motions(const Results& results) {
  const auto& bytes = results.at("motions/bytes").counters;
  fmt::print("walks as animated shapes: {:.0f} s, {:.1f} kB a second\n", bytes.at("seconds"),
             bytes.at("bytes") / bytes.at("seconds") / 1000);
  for (const int rate : {10, 30, 120}) {
    const double ratio = bytes.at(fmt::format("over_{}", rate));
    fmt::print("  over poses at {:3} a second {:6.2f} x   {}\n", rate, ratio,
               rate == 30 ? verdict_at_most(ratio, most_bytes) : "");
  }
  fmt::print("first contact of 10 s motions that come within a metre, one thread\n");
  for (const bool touching : {false, true}) {
    const Timing& own = results.at("motions/first_contact/" + contact_name(touching));
    const double taken = own.nanoseconds / 1000,
                 sampled = results.at("motions/sampled/" + contact_name(touching)).nanoseconds / 1000;
    fmt::print("  {:8}, {:3} pairs {:6.1f} us   {}\n", contact_name(touching), own.items, taken,
               verdict_at_most(taken, touching ? most_touching : most_free));
    fmt::print("    sampled at {:g} a second {:6.1f} us, {:.1f} x   {}\n", samples_per_second, sampled,
               sampled / taken, verdict(sampled / taken, needed_over_sampling));
  }
}

}  // namespace

std::vector<Table> motion_tables(Suite& suite, Scene& scene) {
  const Shared<Walkers> walkers([&scene] { return std::make_shared<Walkers>(scene); });
  suite.add("motions/bytes", [walkers] { return bytes_contender(walkers.get()); });
  for (const bool touching : {false, true}) {
    suite.add("motions/first_contact/" + contact_name(touching),
              [walkers, touching] { return contact_contender(walkers.get(), touching); });
    suite.add("motions/sampled/" + contact_name(touching),
              [walkers, touching] { return sampled_contender(walkers.get(), touching); });
  }
  return {{"motions", "^motions/", print_motions}};
}

}  // namespace bch::bench
