// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/animated_hulls.hpp"

#include <algorithm>
#include <span>

#include "layout/shape_set/animated_tree.hpp"

namespace bch::detail {
namespace {

using Extents = std::array<double, hull_directions>;

/// A key of any chunk.
struct HullKey {
  double time;
  Extents extents;
};

HullKey hull_key(const AnimatedTreeChunk& chunk, std::size_t key) {
  HullKey hull{chunk.times[key], {}};
  hull.extents.fill(chunk.nodes() > 0 ? -HUGE_VAL : 0);  // any number bounds how far nothing reaches
  for (std::uint32_t k = 0; k < hull_directions; ++k) {
    const PlanePoint d = hull_direction(k);
    const double size = length(d);
    for (const std::uint32_t leaf : chunk.leaf_of_disc) {
      const Disc disc = chunk.disc(key, leaf);
      hull.extents[k] =
          std::max(hull.extents[k], d.x * double{disc.x} + d.y * double{disc.y} + size * double{disc.radius});
    }
  }
  return hull;
}

/// Returns the hull through a window, whose ends are larger by what the keys between depart from the straight way. Between two keys the
/// extent of discs that move straight on is convex.
HullWindow window_of(std::span<const HullKey> keys, double step) {
  const double begin = keys.front().time, seconds = keys.back().time - begin;
  HullWindow window{begin, keys.back().time, {}};
  for (std::uint32_t k = 0; k < hull_directions; ++k) {
    const double from = keys.front().extents[k], to = keys.back().extents[k];
    double spare = 0;
    for (const HullKey& key : keys)
      spare = std::max(spare, key.extents[k] - (from + (to - from) * ((key.time - begin) / seconds)));
    const auto in_steps = [&](double extent) {
      return static_cast<std::int16_t>(std::ceil((extent + spare) / step + 0x1p-20));
    };
    window.extents[k] = {in_steps(from), in_steps(to)};
  }
  return window;
}

/// Returns the step in which all extents have 16 bits: one is at most sqrt(2) reaches, and what it is larger by twice as much.
double step_of_hulls(double reach) {
  int exponent = 0;
  std::frexp(4.3 * reach / 32767, &exponent);
  return std::ldexp(1.0, exponent);
}

}  // namespace

AnimatedHulls animated_hulls(const std::vector<AnimatedTreeChunk>& chunks, double reach) {
  std::vector<HullKey> keys;
  std::vector<std::size_t> begin;
  for (const AnimatedTreeChunk& chunk : chunks) {
    begin.push_back(keys.size());
    for (std::size_t key = 0; key < chunk.times.size(); ++key) keys.push_back(hull_key(chunk, key));
  }
  begin.push_back(keys.size());
  AnimatedHulls hulls{step_of_hulls(reach), {}};
  for (unsigned level = 0; level < AnimatedHulls::level_count; ++level)
    for (std::size_t first = 0; first < chunks.size(); first += std::size_t{1} << level) {
      const std::size_t last = std::min(first + (std::size_t{1} << level), chunks.size());
      hulls.levels[level].push_back(
          window_of(std::span(keys).subspan(begin[first], begin[last] - begin[first]), hulls.step));
    }
  return hulls;
}

}  // namespace bch::detail
