// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/sphere_slide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bch::detail {
namespace {

constexpr float never_met = std::numeric_limits<float>::infinity();
constexpr std::size_t spheres_at_once = 16;

}  // namespace

void SlidingBody::place(const std::vector<Sphere>& spheres, const Rotation& heading, float lateral,
                        float toward) {
  const auto cosine = static_cast<float>(heading.cosine), sine = static_cast<float>(heading.sine);
  turned_.clear();
  for (const Sphere& s : spheres)
    turned_.push_back({s.x * cosine - s.y * sine, s.x * sine + s.y * cosine + lateral, s.z, s.radius});
  const auto end = [&](std::uint32_t i) { return -(toward * turned_[i].x + turned_[i].radius); };
  sphere.resize(spheres.size());
  std::iota(sphere.begin(), sphere.end(), 0u);
  std::sort(sphere.begin(), sphere.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float at_a = end(a), at_b = end(b);
    return at_a != at_b ? at_a < at_b : a < b;
  });
  for (auto* const of : {&x, &y, &z, &radius, &front}) of->clear();
  for (const std::uint32_t i : sphere) {
    x.push_back(turned_[i].x), y.push_back(turned_[i].y), z.push_back(turned_[i].z);
    radius.push_back(turned_[i].radius), front.push_back(end(i));
  }
}

std::optional<SlideContact> first_contact(const SlidingBody& first, const SlidingBody& second) {
  float least = never_met;
  std::size_t met_a = 0, met_b = 0;
  const std::size_t count = second.x.size();
  for (std::size_t a = 0; a < first.x.size(); ++a) {
    // What the spheres of both have to go at least: the gap of their ends.
    if (first.front[a] + second.front[0] >= least) break;
    for (std::size_t begin = 0; begin < count && first.front[a] + second.front[begin] < least;
         begin += spheres_at_once) {
      const std::size_t width = std::min(spheres_at_once, count - begin);
      float distance[spheres_at_once];
      const float x = first.x[a], y = first.y[a], z = first.z[a], radius = first.radius[a];
      for (std::size_t k = 0; k < width; ++k) {
        const std::size_t b = begin + k;
        const float across = second.y[b] - y, up = second.z[b] - z, sum = second.radius[b] + radius;
        const float left = sum * sum - across * across - up * up;
        distance[k] = left >= 0 ? second.x[b] - x - std::sqrt(std::max(left, 0.0f)) : never_met;
      }
      for (std::size_t k = 0; k < width; ++k)
        if (distance[k] < least) least = distance[k], met_a = a, met_b = begin + k;
    }
  }
  if (least == never_met) return {};
  SlideContact contact{first.sphere[met_a], second.sphere[met_b], {}};
  const float sum = first.radius[met_a] + second.radius[met_b];
  const float apart[3] = {second.x[met_b] - first.x[met_a] - least, second.y[met_b] - first.y[met_a],
                          second.z[met_b] - first.z[met_a]};
  for (int i = 0; i < 3; ++i) contact.normal[i] = sum > 0 ? apart[i] / sum : 0;
  return contact;
}

}  // namespace bch::detail
