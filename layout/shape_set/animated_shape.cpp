// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shape_set.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/base/ring_edges.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/shape_set/animated_tree.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::uint32_t most_discs = 4096;
constexpr double largest_time = 1e6;  ///< seconds
/// How far apart consecutive discs of a ring may be that overlap, times their coordinates: they may have been rounded to float.
constexpr double ring_rounding = 0x1p-21;

/// Checks a chunk, and says of what it complains.
class ChunkCheck {
 public:
  ChunkCheck(const AnimatedDiscs& discs, std::size_t chunk)
      : all_(discs.chunks), chunk_(discs.chunks[chunk]), index_(chunk) {}

  void check() const {
    check_times();
    check_counts();
    for (std::size_t key = 0; key < chunk_.times.size(); ++key) check_key(key);
  }

 private:
  [[noreturn]] void reject(const std::string& why) const {
    throw std::invalid_argument("animated shape: chunk " + std::to_string(index_) + ": " + why);
  }

  void check_times() const {
    const std::vector<double>& times = chunk_.times;
    if (times.size() < 2) reject("fewer than two keys");
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!(std::abs(times[k]) <= largest_time))
        reject("a key at " + shortest(times[k]) + " s, which is not within +-1e6");
      if (k > 0 && !(times[k - 1] < times[k]))
        reject("a key at " + shortest(times[k]) + " s after one at " + shortest(times[k - 1]) + " s");
    }
    if (index_ > 0 && all_[index_ - 1].times.back() != times.front())
      reject("it begins at " + shortest(times.front()) + " s, where the one before ends at " +
             shortest(all_[index_ - 1].times.back()) + " s");
  }

  void check_counts() const {
    if (chunk_.disc_count == 0 || chunk_.disc_count > most_discs)
      reject(std::to_string(chunk_.disc_count) + " discs, not 1 to " + std::to_string(most_discs));
    if (chunk_.keys.size() != chunk_.times.size() * chunk_.disc_count)
      reject(std::to_string(chunk_.keys.size()) + " discs at " + std::to_string(chunk_.times.size()) +
             " keys, not " + std::to_string(chunk_.disc_count) + " at each");
    std::uint32_t end = 0;
    for (const std::uint32_t next : chunk_.ring_ends) {
      if (next <= end) reject("a ring's end at " + std::to_string(next) + " after " + std::to_string(end));
      end = next;
    }
    if (!chunk_.ring_ends.empty() && end != chunk_.disc_count)
      reject("rings of " + std::to_string(end) + " discs of " + std::to_string(chunk_.disc_count));
  }

  void check_key(std::size_t key) const {
    const Disc* const discs = chunk_.keys.data() + key * chunk_.disc_count;
    const auto name = [&](std::uint32_t i) {
      return "disc " + std::to_string(i) + " at key " + std::to_string(key);
    };
    for (std::uint32_t i = 0; i < chunk_.disc_count; ++i)
      if (!std::isfinite(discs[i].x) || !std::isfinite(discs[i].y) || !std::isfinite(discs[i].radius) ||
          discs[i].radius < 0)
        reject(name(i) + ", of " + shortest(discs[i].radius) + " m at (" + shortest(discs[i].x) + ", " +
               shortest(discs[i].y) + ") m");
    for_each_ring_edge(chunk_.ring_ends, [&](std::uint32_t i, std::uint32_t next) {
      if (!overlap(discs[i], discs[next]))
        reject(name(i) + " does not overlap disc " + std::to_string(next) + ", the next one of its ring");
    });
  }

  static bool overlap(const Disc& a, const Disc& b) {
    const double x = double{a.x} - double{b.x}, y = double{a.y} - double{b.y},
                 radii = double{a.radius} + double{b.radius};
    const float farthest = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
    const double spare = ring_rounding * double{farthest};
    return x * x + y * y <= (radii + spare) * (radii + spare);
  }

  const std::vector<AnimatedChunk>& all_;
  const AnimatedChunk& chunk_;
  std::size_t index_;
};

/// Returns a disc of the line between two.
Disc between(const Disc& from, const Disc& to, double share) {
  const auto blend = [=](float a, float b) { return double{a} + (double{b} - double{a}) * share; };
  return {static_cast<float>(blend(from.x, to.x)), static_cast<float>(blend(from.y, to.y)),
          static_cast<float>(blend(from.radius, to.radius))};
}

/// A chunk at a time.
struct ChunkAt {
  const AnimatedTreeChunk& chunk;
  KeyPlace place;

  ChunkAt(const AnimatedTree& tree, double seconds)
      : ChunkAt(tree, key_place(tree, time_in_clip(tree, seconds))) {}
  ChunkAt(const AnimatedTree& tree, const KeyPlace& at) : chunk(tree.chunks[at.chunk]), place(at) {}
  Disc node(std::uint32_t i) const {
    return between(chunk.key(place.key)[i], chunk.key(place.key + 1)[i], place.share);
  }
};

/// Adds a node and all below it in depth-first order. Nodes hold the discs with room to spare, as those of shape_from_discs() do, and for the
/// rounding of both their centres.
void add_nodes(const ChunkAt& at, std::uint32_t node, Hierarchy& hierarchy) {
  constexpr double of_leaves = rounding::query_margin,
                   of_others = of_leaves + rounding::held_room + 8 * rounding::unit_roundoff;
  const std::uint32_t child = at.chunk.first_child[node];
  const std::size_t index = hierarchy.nodes.size();
  Disc disc = at.node(node);
  const double margin = (child == 0 ? of_leaves : of_others) * hierarchy.reach;
  disc.radius = rounding::round_up(double{disc.radius} + margin);
  hierarchy.nodes.push_back({disc});
  if (child == 0) return;
  add_nodes(at, child, hierarchy);
  hierarchy.nodes[index].second_child = static_cast<std::uint32_t>(hierarchy.nodes.size());
  add_nodes(at, child + 1, hierarchy);
}

/// Returns the polygons of the rings' centres, counter-clockwise.
Outline outline_of(const ChunkAt& at) {
  Outline outline;
  std::size_t begin = 0;
  for (const std::uint32_t end : at.chunk.ring_ends) {
    double twice_area = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Disc disc = at.node(at.chunk.leaf_of_disc[i]),
                 next = at.node(at.chunk.leaf_of_disc[i + 1 < end ? i + 1 : begin]);
      outline.points.push_back({disc.x, disc.y});
      twice_area += double{disc.x} * double{next.y} - double{next.x} * double{disc.y};
    }
    if (twice_area < 0)
      std::reverse(outline.points.begin() + static_cast<std::ptrdiff_t>(begin), outline.points.end());
    outline.contour_begin.push_back(end);
    begin = end;
  }
  return outline;
}

double reach_of(const AnimatedDiscs& discs) {
  double reach = 0;
  for (const AnimatedChunk& chunk : discs.chunks)
    for (const auto& [x, y, radius] : chunk.keys)
      reach = std::max(reach, std::sqrt(double{x} * double{x} + double{y} * double{y}) + double{radius});
  return reach * (1 + 0x1p-48);
}

/// Returns the most that a centre moves in a second, and a radius grows.
double speed_of(const AnimatedDiscs& discs) {
  double speed = 0;
  for (const AnimatedChunk& chunk : discs.chunks)
    for (std::size_t i = chunk.disc_count; i < chunk.keys.size(); ++i) {
      const std::size_t key = i / chunk.disc_count;
      const Disc &from = chunk.keys[i - chunk.disc_count], &to = chunk.keys[i];
      const double way = std::abs(double{to.x} - double{from.x}) + std::abs(double{to.y} - double{from.y}) +
                         std::abs(double{to.radius} - double{from.radius});
      speed = std::max(speed, way / (chunk.times[key] - chunk.times[key - 1]));
    }
  return speed;
}

}  // namespace

AnimatedShape::AnimatedShape(const AnimatedDiscs& discs) : tree_(std::make_unique<AnimatedTree>()) {
  if (discs.chunks.empty()) throw std::invalid_argument("animated shape: no chunks");
  for (std::size_t i = 0; i < discs.chunks.size(); ++i) ChunkCheck(discs, i).check();
  tree_->loops = discs.loops;
  tree_->reach = reach_of(discs);
  require_reach(tree_->reach);
  tree_->speed = speed_of(discs);
  for (const AnimatedChunk& chunk : discs.chunks) tree_->chunks.push_back(animated_tree_chunk(chunk));
}

AnimatedShape::AnimatedShape(AnimatedShape&&) noexcept = default;
AnimatedShape& AnimatedShape::operator=(AnimatedShape&&) noexcept = default;
AnimatedShape::~AnimatedShape() = default;

double AnimatedShape::begin() const noexcept {
  return tree_->begin();
}

double AnimatedShape::end() const noexcept {
  return tree_->end();
}

bool AnimatedShape::loops() const noexcept {
  return tree_->loops;
}

double AnimatedShape::reach() const noexcept {
  return tree_->reach;
}

std::size_t AnimatedShape::bytes() const noexcept {
  std::size_t bytes = sizeof(AnimatedTree);
  for (const AnimatedTreeChunk& chunk : tree_->chunks) {
    bytes += sizeof(chunk) + chunk.times.size() * sizeof(double) + chunk.keys.size() * sizeof(Disc) +
             (chunk.first_child.size() + chunk.leaf_of_disc.size() + chunk.ring_ends.size()) *
                 sizeof(std::uint32_t);
    for (const KeyWindows& windows : chunk.windows)
      bytes += (windows.steps.size() + windows.spares.size()) * sizeof(float);
  }
  return bytes;
}

std::vector<Disc> AnimatedShape::discs(double seconds) const {
  const ChunkAt at(*tree_, seconds);
  std::vector<Disc> discs;
  for (const std::uint32_t leaf : at.chunk.leaf_of_disc) discs.push_back(at.node(leaf));
  return discs;
}

Shape AnimatedShape::shape(double seconds) const {
  const ChunkAt at(*tree_, seconds);
  Shape shape;
  shape.hierarchy.reach = tree_->reach;
  shape.hierarchy.nodes.reserve(at.chunk.nodes());
  add_nodes(at, 0, shape.hierarchy);
  shape.outline = outline_of(at);
  return shape;
}

}  // namespace bch
