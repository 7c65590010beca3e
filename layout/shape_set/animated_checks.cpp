// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/disc_box.hpp"
#include "layout/shape_set/animated_tree.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t max_discs = 4096;
constexpr double largest_time = 1e6;  ///< seconds
[[noreturn]] void reject(const std::string& what) {
  throw std::invalid_argument("animated shape: " + what);
}

/// Checks a chunk, and says of what it complains.
class ChunkCheck {
 public:
  ChunkCheck(const AnimatedDiscs& discs, std::size_t chunk)
      : all_(discs.chunks), chunk_(discs.chunks[chunk]), index_(chunk) {}

  void check() const {
    check_times();
    check_counts();
    for (std::size_t key = 0; key < chunk_.times.size(); ++key) check_key(key);
    check_heights();
  }

 private:
  [[noreturn]] void reject(const std::string& why) const {
    detail::reject("chunk " + std::to_string(index_) + ": " + why);
  }

  void check_times() const {
    const std::vector<double>& times = chunk_.times;
    if (times.size() < 2) reject("expected at least two keys, found " + std::to_string(times.size()));
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!(std::abs(times[k]) <= largest_time))
        reject("expected a key within +-1e6 s, found " + shortest(times[k]));
      if (k > 0 && !(times[k - 1] < times[k]))
        reject("expected a key after " + shortest(times[k - 1]) + " s, found " + shortest(times[k]));
    }
    if (index_ > 0 && all_[index_ - 1].times.back() != times.front())
      reject("expected a beginning at " + shortest(all_[index_ - 1].times.back()) +
             " s, where the one before ends, found " + shortest(times.front()));
  }

  void check_counts() const {
    if (chunk_.disc_count == 0 || chunk_.disc_count > max_discs)
      reject("expected 1 to " + std::to_string(max_discs) + " discs, found " +
             std::to_string(chunk_.disc_count));
    if (chunk_.keys.size() != chunk_.times.size() * chunk_.disc_count)
      reject("expected " + std::to_string(chunk_.disc_count) + " discs at each of " +
             std::to_string(chunk_.times.size()) + " keys, found " + std::to_string(chunk_.keys.size()));
  }

  void check_key(std::size_t key) const {
    const Disc* const discs = chunk_.keys.data() + key * chunk_.disc_count;
    const auto name = [&](std::uint32_t i) {
      return "disc " + std::to_string(i) + " at key " + std::to_string(key);
    };
    for (std::uint32_t i = 0; i < chunk_.disc_count; ++i)
      if (!is_finite(discs[i].x) || !is_finite(discs[i].y) || !is_finite(discs[i].radius) ||
          discs[i].radius < 0)
        reject(name(i) + ": expected a radius of at least 0 m about a finite centre, found " +
               shortest(discs[i].radius) + " about (" + shortest(discs[i].x) + ", " + shortest(discs[i].y) +
               ")");
  }

  void check_heights() const {
    const std::size_t heights = all_.front().z.empty() ? 0 : chunk_.keys.size();
    if (chunk_.z.size() != heights)
      reject("expected " + std::to_string(heights) + " heights, found " + std::to_string(chunk_.z.size()));
    for (std::size_t i = 0; i < heights; ++i)
      if (!(std::abs(chunk_.z[i]) + chunk_.keys[i].radius <= static_cast<float>(rounding::largest_extent)))
        reject("expected a sphere within +-1e6 m of the ground, found one at " + shortest(chunk_.z[i]));
  }

  const std::vector<AnimatedChunk>& all_;
  const AnimatedChunk& chunk_;
  std::size_t index_;
};

void require_chunks(const AnimatedDiscs& discs) {
  if (discs.chunks.empty()) reject("expected at least one chunk, found none");
  for (std::size_t i = 0; i < discs.chunks.size(); ++i) ChunkCheck(discs, i).check();
}

/// Rejects loops of next to no time.
void require_length_of_loop(const AnimatedDiscs& discs) {
  const std::vector<AnimatedChunk>& chunks = discs.chunks;
  const double length = chunks.back().times.back() - chunks.front().times.front();
  if (discs.loops && length < shortest_loop)
    reject("expected a loop of at least 0.001 s, found " + shortest(length));
}

/// Rejects discs that reach too little or too far.
void require_extent_of(const AnimatedDiscs& discs) {
  double max_extent = 0;
  for (const AnimatedChunk& chunk : discs.chunks)
    for (const auto& [x, y, radius] : chunk.keys)
      max_extent = std::max(max_extent, length(double{x}, double{y}) + double{radius});
  require_extent(max_extent);
}

}  // namespace
}  // namespace bch::detail

namespace bch {

using namespace detail;

void validate(const AnimatedDiscs& discs) {
  const FloatingPointStateGuard floats;
  if (!(discs.heights.bottom <= discs.heights.top))
    reject("heights from " + shortest(discs.heights.bottom) + " to " + shortest(discs.heights.top) + " m");
  require_chunks(discs);
  require_length_of_loop(discs);
  require_extent_of(discs);
}

}  // namespace bch
