// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/motions.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <bch/pairs.hpp>
#include <bch/poses.hpp>

#include "bench/characters/baking.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/placing/placing.hpp"
#include "bench/workload/scene.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/base/random.hpp"
#include "layout/shape_set/animated_tree.hpp"

namespace bch::bench {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double near = 1;        // metres
constexpr double area_side = 12;  // metres: the side of the square
constexpr double speed = 1.3;     // metres a second
constexpr double tolerance = 0.005, rounding = 1e-5;

double distance(const PathKey& a, const PathKey& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Returns whether two people come near each other, and begin farther apart.
bool come_near(std::span<const PathKey> a, std::span<const PathKey> b) {
  if (distance(a[0], b[0]) <= near) return false;
  for (double time = 0; time <= MotionScene::seconds; time += 0.02)
    if (distance(at(a, time), at(b, time)) <= near) return true;
  return false;
}

/// Returns how far two bodies are from each other at a time, by clearance() of their spheres at that time.
double gap_at(const Motion& a, const Motion& b, double time) {
  std::vector<std::vector<Sphere>> bodies;
  cli::Crowd crowd;
  for (const Motion* const each : {&a, &b}) {
    const PathKey key = at(each->path, time);
    add_agent(crowd, static_cast<std::uint32_t>(bodies.size()), key.x, key.y, key.heading);
    bodies.push_back(each->shape->spheres(time - each->clip_begin));
  }
  constexpr Pair both{0, 1};
  float gap = 0;
  clearance(BodySet(bodies), crowd.agents(), {&both, 1}, {.distance = {&gap, 1}});
  return double{gap};
}

AnimatedClip animated_clip(const Character& character, BodyModel model, std::uint32_t clip,
                           double max_seconds) {
  Character shorter = character;
  float& seconds = shorter.clips[clip].seconds;
  constexpr auto least = static_cast<float>(least_clip_seconds);
  seconds = least * std::floor(std::min(seconds, static_cast<float>(max_seconds)) / least);
  const double lasts = seconds;
  model.character = std::make_shared<const Character>(std::move(shorter));
  return {&character, clip, lasts, AnimatedShape(animate(model, clip, {.loops = true}))};
}

}  // namespace

std::vector<AnimatedClip> animated_clips(std::span<const cli::LoadedCharacter> characters,
                                         std::string_view name, double max_seconds) {
  const auto is_named = [&](const Clip& clip) { return clip.name == name; };
  const bool all =
      std::none_of(characters.begin(), characters.end(), [&](const cli::LoadedCharacter& loaded) {
        return std::any_of(loaded.character.clips.begin(), loaded.character.clips.end(), is_named);
      });
  const std::vector<BodyModel> models = cli::make_models(characters, cli::animated_spheres);
  std::vector<cli::ClipOf> wanted;
  for (std::uint32_t i = 0; i < characters.size(); ++i)
    for (std::uint32_t clip = 0; clip < characters[i].character.clips.size(); ++clip)
      if (all || is_named(characters[i].character.clips[clip])) wanted.push_back({i, clip});
  std::vector<std::optional<AnimatedClip>> made(wanted.size());
  tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
    try {
      const auto [of, clip] = wanted[i];
      made[i].emplace(animated_clip(characters[of].character, models[of], clip, max_seconds));
    } catch (const std::invalid_argument&) {
      // Left out.
    }
  });
  std::vector<AnimatedClip> clips;
  for (std::optional<AnimatedClip>& clip : made)
    if (clip) clips.push_back(std::move(*clip));
  if (clips.empty()) throw std::runtime_error("no clip of which animate() makes a body");
  return clips;
}

MotionScene::MotionScene(std::span<const AnimatedClip> clips, std::uint32_t pairs, std::uint64_t seed)
    : clips_(clips) {
  detail::Random random(seed);
  while (pairs_.size() < pairs) {
    const PathKey begin{0, random.uniform(area_side), random.uniform(area_side),
                        random.uniform(2 * std::numbers::pi)};
    std::vector<PathKey> path = arc(begin, speed, random.uniform(1) - 0.5, seconds);
    const auto index = static_cast<std::uint32_t>(paths_.size());
    for (std::uint32_t other = 0; other < index && pairs_.size() < pairs; ++other)
      if (come_near(path, paths_[other])) pairs_.push_back({other, index});
    paths_.push_back(std::move(path));
    clip_.push_back(random.below(static_cast<std::uint32_t>(clips.size())));
    // Times of the clip are those of samples, too, of which there are a thousand a second.
    const double phase = std::floor(1000 * random.uniform(clips[clip_.back()].seconds)) / 1000;
    motions_.push_back({&clips[clip_.back()].shape, {}, -phase});
  }
  for (std::size_t i = 0; i < paths_.size(); ++i) motions_[i].path = paths_[i];
  contacts_.resize(pairs_.size());
  first_contact(motions_, pairs_, interval, contacts_, tolerance);
}

std::vector<Pair> MotionScene::pairs(bool touching) const {
  std::vector<Pair> some;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if ((contacts_[i] < never) == touching) some.push_back(pairs_[i]);
  return some;
}

void MotionScene::check(std::uint32_t pairs) const {
  tbb::parallel_for(std::size_t{0}, std::min<std::size_t>(pairs, pairs_.size()), [&](std::size_t i) {
    const Motion &a = motions_[pairs_[i].first], &b = motions_[pairs_[i].second];
    const auto require = [&](bool right, const char* what, double time) {
      if (!right) throw std::runtime_error(fmt::format("first contact of pair {} {} {} s", i, what, time));
    };
    const double max_extents = a.shape->bounding_radius() + b.shape->bounding_radius(),
                 until = std::min(contacts_[i], seconds);
    for (int k = 0; k * 0.001 < until; ++k)
      if (distance(at(a.path, k * 0.001), at(b.path, k * 0.001)) <= max_extents)
        require(gap_at(a, b, k * 0.001) > 0, "is behind", k * 0.001);
    if (contacts_[i] < never)
      require(gap_at(a, b, contacts_[i]) <= tolerance + rounding, "is too early at", contacts_[i]);
  });
}

SampledMotions::SampledMotions(const MotionScene& scene, double samples_per_second, double poses_per_second)
    : samples_per_second_(samples_per_second),
      samples_(static_cast<std::uint32_t>(MotionScene::seconds * samples_per_second) + 1) {
  std::vector<std::vector<Sphere>> poses;  // all of all clips
  std::vector<std::uint32_t> first_pose{0};
  for (const AnimatedClip& clip : scene.clips()) {
    for (double k = 0; k <= std::floor(clip.seconds * poses_per_second); ++k)
      poses.push_back(clip.shape.spheres(k / poses_per_second));
    first_pose.push_back(static_cast<std::uint32_t>(poses.size()));
  }
  poses_.emplace(poses);
  for (std::uint32_t motion = 0; motion < scene.motions().size(); ++motion) {
    const Motion& of = scene.motions()[motion];
    const std::uint32_t clip = scene.clip(motion), first = first_pose[clip];
    const detail::AnimatedTree& tree = scene.clips()[clip].shape.tree();
    for (std::uint32_t k = 0; k < samples_; ++k) {
      const double time = k / samples_per_second;
      const PathKey key = at(of.path, time);
      const double pose = std::round(detail::time_in_clip(tree, time - of.clip_begin) * poses_per_second);
      add_agent(all_, std::min(first + static_cast<std::uint32_t>(pose), first_pose[clip + 1] - 1), key.x,
                key.y, key.heading);
    }
  }
}

double SampledMotions::first_contact(const Pair& pair) const {
  const auto batch = std::max(1u, static_cast<std::uint32_t>(samples_per_second_ / 10));
  std::vector<Pair> pairs;
  for (std::uint32_t k = 0; k < batch; ++k) pairs.push_back({k, batch + k});
  Hits hits(batch);
  for (std::uint32_t from = 0; from < samples_; from += batch) {
    const std::uint32_t count = std::min(batch, samples_ - from);
    // Agents that are together, because those between the ones of pairs are examined, too.
    const auto together = [&](const auto& all) {
      std::remove_cvref_t<decltype(all)> some(2 * batch);
      std::copy_n(all.begin() + pair.first * samples_ + from, count, some.begin());
      std::copy_n(all.begin() + pair.second * samples_ + from, count, some.begin() + batch);
      return some;
    };
    const cli::Crowd crowd{0, together(all_.shape), together(all_.x), together(all_.y),
                           together(all_.heading)};
    collide(*poses_, crowd.agents(), std::span(pairs).first(count), std::span(hits).first(count));
    const auto hit = std::find(hits.begin(), hits.begin() + count, 1);
    if (hit != hits.begin() + count)
      return (from + static_cast<double>(hit - hits.begin())) / samples_per_second_;
  }
  return never;
}

}  // namespace bch::bench
