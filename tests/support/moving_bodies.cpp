// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/moving_bodies.hpp"

namespace bch::test {
namespace {

/// Returns numbers that an AnimatedShape of such bodies keeps as they are.
float even(double value, double step = 0x1p-16) {
  return static_cast<float>(std::ceil(value / step) * step);
}

PathKey pose_at(const std::vector<PathKey>& path, double time) {
  if (time <= path.front().time) return path.front();
  for (std::size_t k = 1; k < path.size(); ++k)
    if (time <= path[k].time) {
      const double fraction = (time - path[k - 1].time) / (path[k].time - path[k - 1].time);
      return {time, std::lerp(path[k - 1].x, path[k].x, fraction),
              std::lerp(path[k - 1].y, path[k].y, fraction),
              std::lerp(path[k - 1].heading, path[k].heading, fraction),
              std::lerp(path[k - 1].z, path[k].z, fraction)};
    }
  return path.back();
}

}  // namespace

std::vector<WorldDisc> placed_at(const MotionCase& motion, double time) {
  const auto& chunks = motion.discs.chunks;
  const double begin = chunks.front().times.front(), end = chunks.back().times.back();
  double seconds = time - motion.clip_begin;
  if (motion.discs.loops) seconds -= std::floor(seconds / (end - begin)) * (end - begin);
  seconds = std::clamp(seconds + begin, begin, end);
  std::size_t k = 0;
  while (k + 1 < chunks.size() && seconds > chunks[k].times.back()) ++k;
  const PathKey pose = pose_at(motion.path, time);
  const double c = std::cos(pose.heading), s = std::sin(pose.heading);
  std::vector<WorldDisc> placed;
  const AnimatedChunk& chunk = chunks[k];
  std::size_t key = 0;
  while (key + 2 < chunk.times.size() && seconds > chunk.times[key + 1]) ++key;
  const double fraction = (seconds - chunk.times[key]) / (chunk.times[key + 1] - chunk.times[key]);
  for (std::uint32_t i = 0; i < chunk.disc_count; ++i) {
    const Disc &from = chunk.keys[key * chunk.disc_count + i],
               &to = chunk.keys[(key + 1) * chunk.disc_count + i];
    const double x = std::lerp(double{from.x}, double{to.x}, fraction),
                 y = std::lerp(double{from.y}, double{to.y}, fraction);
    placed.push_back({pose.x + c * x - s * y, pose.y + s * x + c * y,
                      std::lerp(double{from.radius}, double{to.radius}, fraction)});
    if (chunk.z.empty()) continue;
    const double z_from = chunk.z[key * chunk.disc_count + i],
                 z_to = chunk.z[(key + 1) * chunk.disc_count + i];
    placed.back().z = pose.z + std::lerp(z_from, z_to, fraction);
  }
  return placed;
}

AnimatedDiscs swinging_body(Random& random, std::uint32_t chunks, std::uint32_t discs) {
  AnimatedDiscs body;
  body.loops = random.below(2) == 0;
  double time = random.uniform(-1, 1);
  const double wide = random.uniform(0.15, 0.3), deep = random.uniform(0.1, 0.2), pace = random.uniform(4, 9);
  for (std::uint32_t c = 0; c < chunks; ++c) {
    AnimatedChunk chunk;
    chunk.disc_count = discs + 4 * c;
    const std::uint32_t keys = 4 + random.below(8);
    for (std::uint32_t k = 0; k < keys; ++k) {
      if (k > 0) time += random.uniform(0.02, 0.2);
      chunk.times.push_back(time);
      for (std::uint32_t i = 0; i < chunk.disc_count; ++i) {
        const double angle = 2 * std::numbers::pi * i / chunk.disc_count;
        const double swing = 0.15 * std::sin(pace * time) * std::pow(std::sin(angle), 3);
        chunk.keys.push_back({even(deep * std::cos(angle) + swing), even(wide * std::sin(angle)),
                              even(random.uniform(0.001, 0.02))});
      }
    }
    body.chunks.push_back(std::move(chunk));
  }
  return body;
}

AnimatedDiscs loose_discs(Random& random, std::uint32_t discs) {
  AnimatedDiscs body;
  body.loops = random.below(2) == 0;
  AnimatedChunk chunk;
  chunk.disc_count = discs;
  double time = 0;
  for (int k = 0; k < 6; ++k) {
    chunk.times.push_back(time);
    time += random.uniform(0.05, 0.3);
    for (std::uint32_t i = 0; i < discs; ++i)
      chunk.keys.push_back({even(random.uniform(-0.3, 0.3)), even(random.uniform(-0.3, 0.3)),
                            even(random.below(4) == 0 ? 0 : random.uniform(0, 0.1))});
  }
  body.chunks.push_back(std::move(chunk));
  return body;
}

AnimatedDiscs in_space(Random& random, AnimatedDiscs body, double top) {
  for (AnimatedChunk& chunk : body.chunks) {
    std::vector<double> height(chunk.disc_count);
    for (double& each : height) each = random.uniform(0, top);
    for (std::size_t i = 0; i < chunk.keys.size(); ++i) {
      constexpr double step = 0x1p-14;  // of numbers below 2 m
      Disc& disc = chunk.keys[i];
      disc = {even(double{disc.x}, step), even(double{disc.y}, step), even(double{disc.radius}, step)};
      chunk.z.push_back(even(height[i % chunk.disc_count] + random.uniform(-0.05, 0.05), step));
    }
  }
  return body;
}

AnimatedDiscs still_disc(float radius, float x, float y) {
  return {{{{0, 1}, 1, {{x, y, radius}, {x, y, radius}}}}, false};
}

MotionCase random_motion(Random& random) {
  return random_motion(random, random.below(4) == 0
                                   ? loose_discs(random, 1 + random.below(6))
                                   : swinging_body(random, 1 + random.below(3), 12 + random.below(20)));
}

MotionCase random_motion(Random& random, AnimatedDiscs body) {
  std::vector<PathKey> path;
  const std::uint32_t keys = 1 + random.below(8);
  const double angle = random.uniform(-4, 4), speed = random.uniform(0.3, 2),
               aside = random.uniform(-0.6, 0.6);
  double time = random.uniform(-2, -1), heading = random.uniform(-10, 10);
  for (std::uint32_t k = 0; k < keys; ++k) {
    const double along = speed * time + random.uniform(-0.2, 0.2), across = aside + random.uniform(-0.1, 0.1);
    path.push_back({time, along * std::cos(angle) - across * std::sin(angle),
                    along * std::sin(angle) + across * std::cos(angle), heading});
    time += random.uniform(0.1, 1.5);
    heading += random.uniform(-1, 1) * (random.below(6) == 0 ? 20 : 1);
  }
  return {std::move(body), std::move(path), random.uniform(-3, 3)};
}

double gap_at(const MotionCase& a, const MotionCase& b, double seconds) {
  const PathKey at_a = pose_at(a.path, seconds), at_b = pose_at(b.path, seconds);
  const double apart =
      std::hypot(at_a.x - at_b.x, at_a.y - at_b.y) - a.shape.bounding_radius() - b.shape.bounding_radius();
  if (apart > 0.1) return apart;
  const bool both_in_space = a.shape.in_space() && b.shape.in_space();
  double gap = std::numeric_limits<double>::infinity();
  const std::vector<WorldDisc> discs = placed_at(b, seconds);
  for (const WorldDisc& i : placed_at(a, seconds))
    for (const WorldDisc& j : discs) {
      const double x = i.x - j.x, y = i.y - j.y, z = both_in_space ? i.z - j.z : 0,
                   square = x * x + y * y + z * z, far = gap + i.radius + j.radius;
      if (square < far * std::abs(far)) gap = std::sqrt(square) - i.radius - j.radius;
    }
  return gap;
}

}  // namespace bch::test
