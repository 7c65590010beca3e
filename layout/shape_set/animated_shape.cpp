// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/shape_set/animated_tree.hpp"

namespace bch {

using namespace detail;

namespace {

/// A chunk at a time.
struct ChunkAt {
  const AnimatedTreeChunk& chunk;
  KeyPlace place;

  ChunkAt(const AnimatedTree& tree, double seconds)
      : ChunkAt(tree, key_place(tree, time_in_clip(tree, seconds))) {}
  ChunkAt(const AnimatedTree& tree, const KeyPlace& at) : chunk(tree.chunks[at.chunk]), place(at) {}
  Disc node(std::uint32_t i) const { return chunk.disc(place, i); }
};

/// Returns a disc that holds two, but for what floats round.
Disc disc_around(const Disc& a, const Disc& b) {
  const double x = double{b.x} - double{a.x}, y = double{b.y} - double{a.y}, apart = std::sqrt(x * x + y * y);
  const double radius = (apart + double{a.radius} + double{b.radius}) / 2;
  if (radius <= double{a.radius}) return a;
  if (radius <= double{b.radius}) return b;
  const double t = (radius - double{a.radius}) / apart;
  return {static_cast<float>(double{a.x} + x * t), static_cast<float>(double{a.y} + y * t),
          rounding::round_up(radius)};
}

/// Adds the tree of a chunk at a time as a binary one, in depth-first order: children are halved. Nodes hold the discs with room to spare,
/// as those of shape_from_discs() do, and for the rounding of both their centres, and of those that halve them.
class BinaryTree {
 public:
  BinaryTree(const ChunkAt& at, Hierarchy& hierarchy) : at_(at), hierarchy_(hierarchy) {}

  void add_root() { add_node(0); }

 private:
  /// Returns: the disc without room.
  Disc add_node(std::uint32_t node) {
    if (at_.chunk.is_leaf(node))
      return hierarchy_.nodes.push_back({enlarged(at_.node(node), margin_of_leaves)}), at_.node(node);
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
    hierarchy_.nodes[index].disc = enlarged(both, margin_of_nodes);
    return both;
  }

  Disc enlarged(Disc disc, double margin) const {
    disc.radius = rounding::round_up(double{disc.radius} + margin * hierarchy_.max_extent);
    return disc;
  }

  const ChunkAt& at_;
  Hierarchy& hierarchy_;
};

/// Finds the extent of a chunk's discs, and their speed.
void measure(const AnimatedTreeChunk& chunk, AnimatedTree& tree) {
  for (std::size_t key = 0; key < chunk.times.size(); ++key)
    for (const std::uint32_t leaf : chunk.leaf_of_disc) {
      const Disc disc = chunk.disc(key, leaf);
      const double x = disc.x, y = disc.y, radius = disc.radius;
      tree.max_extent = std::max(tree.max_extent, (std::sqrt(x * x + y * y) + radius) * (1 + 0x1p-48));
      const double z = chunk.z(key, leaf);
      if (chunk.in_space) tree.height = std::max(tree.height, (std::abs(z) + radius) * (1 + 0x1p-48));
      if (key == 0) continue;
      const Disc before = chunk.disc(key - 1, leaf);
      const double distance = std::abs(x - double{before.x}) + std::abs(y - double{before.y}) +
                              std::abs(z - double{chunk.z(key - 1, leaf)}) +
                              std::abs(radius - double{before.radius});
      tree.speed = std::max(tree.speed, distance / (chunk.times[key] - chunk.times[key - 1]));
    }
}

std::unique_ptr<AnimatedTree> tree_of(std::span<const AnimatedChunk> chunks, bool loops) {
  auto tree = std::make_unique<AnimatedTree>();
  tree->loops = loops;
  tree->chunks.reserve(chunks.size());
  for (const AnimatedChunk& chunk : chunks) {
    tree->chunks.push_back(animated_tree_chunk(chunk));
    measure(tree->chunks.back(), *tree);
  }
  tree->in_space = tree->chunks.front().in_space;
  require_extent(tree->max_extent);
  tree->hulls = animated_hulls(tree->chunks, tree->max_extent);
  return tree;
}

void make_shape(const ChunkAt& at, double max_extent, Shape& shape) {
  shape.outline.points.clear(), shape.outline.contour_begin.assign(1, 0);
  shape.hierarchy.nodes.clear();
  shape.hierarchy.max_extent = max_extent;
  shape.hierarchy.nodes.reserve(2 * at.chunk.leaf_of_disc.size());
  BinaryTree(at, shape.hierarchy).add_root();
}

}  // namespace

AnimatedShape::AnimatedShape(const AnimatedDiscs& discs) : heights_(discs.heights) {
  const FloatingPointStateGuard floats;
  validate(discs);
  tree_ = tree_of(discs.chunks, discs.loops);
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

bool AnimatedShape::in_space() const noexcept {
  return tree_->in_space;
}

double AnimatedShape::bounding_radius() const noexcept {
  return tree_->max_extent;
}

std::size_t AnimatedShape::bytes() const noexcept {
  std::size_t bytes = sizeof(AnimatedTree);
  for (const AnimatedTreeChunk& chunk : tree_->chunks) {
    bytes += sizeof(chunk) + chunk.times.size() * sizeof(double);
    bytes +=
        (chunk.numbers.size() + chunk.child_begin.size() + chunk.leaf_of_disc.size()) * sizeof(std::uint16_t);
  }
  for (const std::vector<HullInterval>& level : tree_->hulls.levels)
    bytes += level.size() * sizeof(HullInterval);
  for (const std::vector<HullBands>& level : tree_->hulls.bands) bytes += level.size() * sizeof(HullBands);
  return bytes;
}

std::vector<Disc> AnimatedShape::discs(double seconds) const {
  const FloatingPointStateGuard floats;
  std::vector<Disc> discs;
  const ChunkAt at(*tree_, seconds);
  for (const std::uint32_t leaf : at.chunk.leaf_of_disc) discs.push_back(at.node(leaf));
  return discs;
}

std::vector<Sphere> AnimatedShape::spheres(double seconds) const {
  const FloatingPointStateGuard floats;
  std::vector<Sphere> spheres;
  if (!in_space()) return spheres;
  const ChunkAt at(*tree_, seconds);
  for (const std::uint32_t leaf : at.chunk.leaf_of_disc) {
    const Disc disc = at.node(leaf);
    spheres.push_back({disc.x, disc.y, at.chunk.z(at.place, leaf), disc.radius});
  }
  return spheres;
}

Shape AnimatedShape::shape(double seconds) const {
  Shape made;
  shape(seconds, made);
  return made;
}

void AnimatedShape::shape(double seconds, Shape& shape) const {
  const FloatingPointStateGuard floats;
  shape.heights = heights_;
  make_shape(ChunkAt(*tree_, seconds), tree_->max_extent, shape);
}

}  // namespace bch
