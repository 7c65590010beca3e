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
    return between(chunk.disc(place.key, i), chunk.disc(place.key + 1, i), place.share);
  }
};

/// Returns a disc that holds two, but for what floats round.
Disc disc_around(const Disc& a, const Disc& b) {
  const double x = double{b.x} - double{a.x}, y = double{b.y} - double{a.y}, apart = std::sqrt(x * x + y * y);
  const double radius = (apart + double{a.radius} + double{b.radius}) / 2;
  if (radius <= double{a.radius}) return a;
  if (radius <= double{b.radius}) return b;
  const double share = (radius - double{a.radius}) / apart;
  return {static_cast<float>(double{a.x} + x * share), static_cast<float>(double{a.y} + y * share),
          rounding::round_up(radius)};
}

/// Adds the tree of a chunk at a time as a binary one, in depth-first order: children are halved. Nodes hold the discs with room to spare, as
/// those of shape_from_discs() do, and for the rounding of both their centres, and of those that halve them.
class BinaryTree {
 public:
  BinaryTree(const ChunkAt& at, Hierarchy& hierarchy) : at_(at), hierarchy_(hierarchy) {}

  void add_root() { add_node(0); }

 private:
  /// Returns: the disc without room.
  Disc add_node(std::uint32_t node) {
    if (at_.chunk.is_leaf(node))
      return hierarchy_.nodes.push_back({with_room(at_.node(node), of_leaves)}), at_.node(node);
    return add_range(at_.chunk.children(node));
  }

  Disc add_range(const NodeRange& nodes) {
    if (nodes.end - nodes.begin == 1) return add_node(nodes.begin);
    const std::uint32_t middle = nodes.begin + (nodes.end - nodes.begin) / 2;
    const std::size_t index = hierarchy_.nodes.size();
    hierarchy_.nodes.emplace_back();
    const Disc first = add_range({nodes.begin, middle});
    hierarchy_.nodes[index].second_child = static_cast<std::uint32_t>(hierarchy_.nodes.size());
    const Disc both = disc_around(first, add_range({middle, nodes.end}));
    hierarchy_.nodes[index].disc = with_room(both, of_others);
    return both;
  }

  Disc with_room(Disc disc, double margin) const {
    disc.radius = rounding::round_up(double{disc.radius} + margin * hierarchy_.reach);
    return disc;
  }

  /// The discs between a leaf and the root, up to 12 of them, each round by three roundings of at most the reach.
  static constexpr double of_leaves = rounding::query_margin,
                          of_others = of_leaves + rounding::held_room + 48 * rounding::unit_roundoff;

  const ChunkAt& at_;
  Hierarchy& hierarchy_;
};

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

/// Finds the reach of a chunk's discs, and their speed.
void measure(const AnimatedTreeChunk& chunk, AnimatedTree& tree) {
  for (std::size_t key = 0; key < chunk.times.size(); ++key)
    for (const std::uint32_t leaf : chunk.leaf_of_disc) {
      const Disc disc = chunk.disc(key, leaf);
      const double x = disc.x, y = disc.y, radius = disc.radius;
      tree.reach = std::max(tree.reach, (std::sqrt(x * x + y * y) + radius) * (1 + 0x1p-48));
      if (key == 0) continue;
      const Disc before = chunk.disc(key - 1, leaf);
      const double way = std::abs(x - double{before.x}) + std::abs(y - double{before.y}) +
                         std::abs(radius - double{before.radius});
      tree.speed = std::max(tree.speed, way / (chunk.times[key] - chunk.times[key - 1]));
    }
}

}  // namespace

AnimatedShape::AnimatedShape(const AnimatedDiscs& discs) : tree_(std::make_unique<AnimatedTree>()) {
  if (discs.chunks.empty()) throw std::invalid_argument("animated shape: no chunks");
  for (std::size_t i = 0; i < discs.chunks.size(); ++i) ChunkCheck(discs, i).check();
  tree_->loops = discs.loops;
  tree_->chunks.reserve(discs.chunks.size());
  for (const AnimatedChunk& chunk : discs.chunks) {
    tree_->chunks.push_back(animated_tree_chunk(chunk));
    measure(tree_->chunks.back(), *tree_);
  }
  require_reach(tree_->reach);
  tree_->hulls = animated_hulls(tree_->chunks, tree_->reach);
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
    bytes +=
        sizeof(chunk) + chunk.times.size() * sizeof(double) + chunk.ring_ends.size() * sizeof(std::uint32_t);
    bytes +=
        (chunk.numbers.size() + chunk.child_begin.size() + chunk.leaf_of_disc.size()) * sizeof(std::uint16_t);
  }
  for (const std::vector<HullWindow>& level : tree_->hulls.levels) bytes += level.size() * sizeof(HullWindow);
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
  shape.hierarchy.nodes.reserve(2 * at.chunk.leaf_of_disc.size());
  BinaryTree(at, shape.hierarchy).add_root();
  shape.outline = outline_of(at);
  return shape;
}

}  // namespace bch
