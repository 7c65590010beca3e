// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/core_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "layout/base/heading.hpp"
#include "layout/base/random.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t sample_pairs = 4000, exchanges = 4000, first_core = core_spheres / 2;

/// Lists the pairs of spheres of two bodies that overlap.
using Overlaps = std::vector<std::pair<std::uint16_t, std::uint16_t>>;

double extent_on_ground(std::span<const std::vector<Sphere>> poses) {
  double max_extent = 0;
  for (const auto& spheres : poses)
    for (const Sphere& s : spheres) {
      const double x = double{s.x}, y = double{s.y};
      max_extent = std::max(max_extent, std::sqrt(x * x + y * y) + double{s.radius});
    }
  return max_extent;
}

std::vector<Sphere> placed(const std::vector<Sphere>& spheres, const Rotation& turn, double x, double y) {
  std::vector<Sphere> all;
  all.reserve(spheres.size());
  for (const Sphere& s : spheres)
    all.push_back({static_cast<float>(x + (turn.cosine * double{s.x} - turn.sine * double{s.y})),
                   static_cast<float>(y + (turn.sine * double{s.x} + turn.cosine * double{s.y})), s.z,
                   s.radius});
  return all;
}

Overlaps overlaps(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
  Overlaps found;
  for (std::size_t j = 0; j < b.size(); ++j)
    for (std::size_t i = 0; i < a.size(); ++i) {
      const float x = b[j].x - a[i].x, y = b[j].y - a[i].y, z = b[j].z - a[i].z;
      const float radii = a[i].radius + b[j].radius;
      if (x * x + y * y + z * z <= radii * radii)
        found.emplace_back(static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j));
    }
  return found;
}

/// Places the body beside itself, in random poses, anywhere in its extent, and keeps the collisions.
std::vector<Overlaps> sample_collisions(std::span<const std::vector<Sphere>> poses, Random& random) {
  const double max_extent = 2 * extent_on_ground(poses);
  std::vector<Overlaps> collisions;
  for (std::uint32_t k = 0; k < sample_pairs; ++k) {
    const auto& a = poses[random.below(static_cast<std::uint32_t>(poses.size()))];
    const auto& b = poses[random.below(static_cast<std::uint32_t>(poses.size()))];
    const Rotation turn = rotation(random.uniform(2 * std::numbers::pi));
    const double x = random.between(-max_extent, max_extent), y = random.between(-max_extent, max_extent);
    if (Overlaps found = overlaps(a, placed(b, turn, x, y)); !found.empty())
      collisions.push_back(std::move(found));
  }
  return collisions;
}

/// Counts the collisions that the first core spheres meet, and those that all of them meet, and adds both numbers.
std::uint32_t met(const std::vector<Overlaps>& collisions, const std::vector<std::uint8_t>& rank) {
  std::uint32_t sum = 0;
  for (const Overlaps& each : collisions) {
    std::uint8_t best = 0;
    for (const auto& [i, j] : each) {
      best = std::max(best, std::min(rank[i], rank[j]));
      if (best == 2) break;
    }
    sum += best;
  }
  return sum;
}

}  // namespace

std::array<std::uint32_t, core_spheres> choose_core(std::span<const std::vector<Sphere>> poses,
                                                    std::array<std::uint32_t, core_spheres> core) {
  const auto spheres = static_cast<std::uint32_t>(poses.front().size());
  if (spheres <= core_spheres) return core;
  Random random(1);
  const std::vector<Overlaps> collisions = sample_collisions(poses, random);
  const auto ranks = [&](const std::array<std::uint32_t, core_spheres>& of) {
    std::vector<std::uint8_t> rank(spheres, 0);
    for (std::uint32_t i = 0; i < core_spheres; ++i) rank[of[i]] = i < first_core ? 2 : 1;
    return rank;
  };
  std::uint32_t most = met(collisions, ranks(core));
  for (std::uint32_t k = 0; k < exchanges; ++k) {
    auto other = core;
    const std::uint32_t place = random.below(core_spheres), sphere = random.below(spheres);
    if (const auto at = std::find(other.begin(), other.end(), sphere); at != other.end())
      std::swap(*at, other[place]);
    else
      other[place] = sphere;
    const std::uint32_t now = met(collisions, ranks(other));
    if (now >= most) most = now, core = other;
  }
  return core;
}

}  // namespace bch::detail
