// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/animated_cover.hpp"

namespace bch::test {
namespace {

bool holds(std::span<const Disc> cover, const Vec2& p) {
  return std::any_of(cover.begin(), cover.end(), [&](const Disc& disc) {
    const double x = double{p.x} - double{disc.x}, y = double{p.y} - double{disc.y};
    return std::sqrt(x * x + y * y) <= double{disc.radius};
  });
}

}  // namespace

std::vector<Disc> cover_at(const AnimatedDiscs& animated, double seconds) {
  std::size_t c = 0, key = 0;
  while (animated.chunks[c].times.back() < seconds) ++c;
  const AnimatedChunk& chunk = animated.chunks[c];
  while (chunk.times[key + 1] < seconds) ++key;
  const double share = (seconds - chunk.times[key]) / (chunk.times[key + 1] - chunk.times[key]);
  const auto mix = [share](float a, float b) {
    return static_cast<float>(double{a} + (double{b} - double{a}) * share);
  };
  std::vector<Disc> cover;
  for (std::size_t i = 0; i < chunk.disc_count; ++i) {
    const Disc &a = chunk.keys[key * chunk.disc_count + i], &b = chunk.keys[(key + 1) * chunk.disc_count + i];
    cover.push_back({mix(a.x, b.x), mix(a.y, b.y), mix(a.radius, b.radius)});
  }
  return cover;
}

std::size_t left_out(std::span<const Disc> cover, std::span<const Vec2> vertices, const Outline& outline) {
  const auto out = [&](const Vec2& p) { return !holds(cover, p); };
  std::size_t count = static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), out));
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
      const float parts = std::ceil(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) / 0.004f);
      for (float part = 0; part < parts; ++part)
        count += out({a.x + (b.x - a.x) * (part / parts), a.y + (b.y - a.y) * (part / parts)});
    }
  }
  return count;
}

double excess_in(std::span<const Disc> cover, std::span<const Vec2> vertices, double x, double y) {
  double of_discs = -1e9, of_vertices = -1e9;
  for (const Disc& disc : cover)
    of_discs = std::max(of_discs, x * double{disc.x} + y * double{disc.y} + double{disc.radius});
  for (const Vec2& p : vertices) of_vertices = std::max(of_vertices, x * double{p.x} + y * double{p.y});
  return of_discs - of_vertices;
}

}  // namespace bch::test
