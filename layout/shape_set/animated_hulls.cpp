// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/animated_hulls.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
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

/// Says for each sphere of a chunk into which bands it comes: a bit each. Between two keys its lowest and highest points move evenly.
std::vector<std::uint32_t> bands_of(const AnimatedTreeChunk& chunk) {
  std::vector<std::uint32_t> bands;
  for (const std::uint32_t leaf : chunk.leaf_of_disc) {
    double bottom = HUGE_VAL, top = -HUGE_VAL;
    for (std::size_t key = 0; key < chunk.times.size(); ++key) {
      const double z = chunk.z(key, leaf), radius = chunk.disc(key, leaf).radius;
      bottom = std::min(bottom, z - radius), top = std::max(top, z + radius);
    }
    bands.push_back(0);
    for (std::uint32_t band = 0; band < hull_bands; ++band) {
      const bool is_above = band > 0 && top < band * hull_band - hull_overlap,
                 is_below = band + 1 < hull_bands && bottom > (band + 1) * hull_band + hull_overlap;
      if (!is_above && !is_below) bands.back() |= 1u << band;
    }
  }
  return bands;
}

/// Finds how far the discs at a key reach for which use(i); without any, less far than discs do.
template <class Use>
HullKey hull_key(const AnimatedTreeChunk& chunk, std::size_t key, double max_extent, const Use& use) {
  HullKey hull{chunk.times[key], {}};
  hull.extents.fill(-1.4143 * max_extent);
  for (std::size_t i = 0; i < chunk.leaf_of_disc.size(); ++i) {
    if (!use(i)) continue;
    const Disc disc = chunk.disc(key, chunk.leaf_of_disc[i]);
    for (std::uint32_t k = 0; k < hull_directions; ++k) {
      const PlanePoint d = hull_direction(k);
      hull.extents[k] = std::max(
          hull.extents[k], d.x * double{disc.x} + d.y * double{disc.y} + length(d) * double{disc.radius});
    }
  }
  return hull;
}

/// Returns the hull through an interval, whose ends are larger by what the keys between depart from the straight path. Between two keys the
/// extent of discs that move straight on is convex.
HullInterval interval_of(std::span<const HullKey> keys, double step) {
  const double begin = keys.front().time, seconds = keys.back().time - begin;
  HullInterval interval{begin, keys.back().time, {}};
  for (std::uint32_t k = 0; k < hull_directions; ++k) {
    const double from = keys.front().extents[k], to = keys.back().extents[k];
    double spare = 0;
    for (const HullKey& key : keys)
      spare = std::max(spare, key.extents[k] - (from + (to - from) * ((key.time - begin) / seconds)));
    const auto in_steps = [&](double extent) {
      return static_cast<std::int16_t>(std::ceil((extent + spare) / step + 0x1p-20));
    };
    interval.extents[k] = {in_steps(from), in_steps(to)};
  }
  return interval;
}

/// Returns the step in which all extents have 16 bits: one is at most sqrt(2) extents, and what it is larger by twice as much.
double step_of_hulls(double max_extent) {
  int exponent = 0;
  std::frexp(4.3 * max_extent / 32767, &exponent);
  return std::ldexp(1.0, exponent);
}

}  // namespace

AnimatedHulls animated_hulls(const std::vector<AnimatedTreeChunk>& chunks, double max_extent) {
  const bool in_space = chunks.front().in_space;
  std::vector<HullKey> keys;
  std::array<std::vector<HullKey>, hull_bands> of_bands;  ///< likewise
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> occupied;  ///< per chunk: the bands that have spheres
  for (const AnimatedTreeChunk& chunk : chunks) {
    begin.push_back(keys.size());
    const std::vector<std::uint32_t> bands =
        in_space ? bands_of(chunk) : std::vector<std::uint32_t>(chunk.leaf_of_disc.size());
    occupied.push_back(std::accumulate(bands.begin(), bands.end(), 0u, std::bit_or<>()));
    for (std::size_t key = 0; key < chunk.times.size(); ++key) {
      keys.push_back(hull_key(chunk, key, max_extent, [](std::size_t) { return true; }));
      for (std::uint32_t band = 0; in_space && band < hull_bands; ++band)
        of_bands[band].push_back(
            hull_key(chunk, key, max_extent, [&](std::size_t i) { return (bands[i] >> band & 1) != 0; }));
    }
  }
  begin.push_back(keys.size());
  AnimatedHulls hulls{step_of_hulls(max_extent), {}, {}};
  for (unsigned level = 0; level < AnimatedHulls::level_count; ++level)
    for (std::size_t first = 0; first < chunks.size(); first += std::size_t{1} << level) {
      const std::size_t last = std::min(first + (std::size_t{1} << level), chunks.size());
      const auto interval = [&](const std::vector<HullKey>& all) {
        return interval_of(std::span(all).subspan(begin[first], begin[last] - begin[first]), hulls.step);
      };
      hulls.levels[level].push_back(interval(keys));
      if (!in_space) continue;
      HullBands& bands = hulls.bands[level].emplace_back();
      for (std::size_t chunk = first; chunk < last; ++chunk) bands.occupied |= occupied[chunk];
      for (std::uint32_t band = 0; band < hull_bands; ++band)
        bands.extents[band] = interval(of_bands[band]).extents;
    }
  return hulls;
}

}  // namespace bch::detail
