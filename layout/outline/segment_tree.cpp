// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/segment_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace bch::detail {
namespace {

constexpr std::size_t segments_per_leaf = 8;
constexpr std::size_t root = 1;
/// A tree has fewer levels than that, and a search waits for one node of each.
constexpr std::size_t max_open = 64;
/// Steps by which places and slabs are rounded at most, and more: products of coordinates below 2^24 and unit vectors
/// are off by less than 2^-27.
constexpr double margin = 2;

double along(double normal_x, double normal_y, GridPoint p) {
  return normal_x * p.x + normal_y * p.y;
}

/// The segments below a node that has `leaves` of them, the first of which is leaf `first`.
std::span<const Segment> below(std::span<const Segment> segments, std::size_t first, std::size_t leaves) {
  const std::size_t begin = std::min(segments_per_leaf * first, segments.size());
  return segments.subspan(begin, std::min(segments_per_leaf * leaves, segments.size() - begin));
}

}  // namespace

void SegmentTree::assign(std::span<const Segment> segments) {
  segments_ = segments;
  leaves_ = std::bit_ceil((segments.size() + segments_per_leaf - 1) / segments_per_leaf);
  nodes_.resize(2 * leaves_);
  for (std::size_t i = 0; i < leaves_; ++i) set_leaf(nodes_[leaves_ + i], below(segments, i, 1));
  for (std::size_t level = leaves_ / 2, leaves = 2; level > 0; level /= 2, leaves *= 2)
    for (std::size_t i = 0; i < level; ++i) {
      const Node &first = nodes_[2 * (level + i)], &second = nodes_[2 * (level + i) + 1];
      Node& node = nodes_[level + i];
      node = first.length < second.length ? second : first;
      node.box = first.box;
      enlarge(node.box, second.box);
      set_slab(node, below(segments, leaves * i, leaves));
    }
}

void SegmentTree::set_leaf(Node& node, std::span<const Segment> segments) const {
  node = {empty_box, 0, 0, 0, 0, 0};
  for (const auto& [a, b] : segments) {
    for (const GridPoint p : {a, b}) enlarge(node.box, {p, p});
    const GridVector edge = b - a;
    const double length = std::sqrt(static_cast<double>(dot(edge, edge)));
    if (length <= node.length) continue;
    node.length = length;
    node.normal_x = -static_cast<double>(edge.y) / length,
    node.normal_y = static_cast<double>(edge.x) / length;
  }
  set_slab(node, segments);
}

void SegmentTree::set_slab(Node& node, std::span<const Segment> segments) const {
  node.low = HUGE_VAL, node.high = -HUGE_VAL;
  for (const auto& [a, b] : segments)
    for (const double distance :
         {along(node.normal_x, node.normal_y, a), along(node.normal_x, node.normal_y, b)}) {
      node.low = std::min(node.low, distance);
      node.high = std::max(node.high, distance);
    }
}

std::size_t SegmentTree::find(GridPlace from, GridPlace to, std::uint32_t* near) const {
  const double left = std::min(from.x, to.x) - margin, right = std::max(from.x, to.x) + margin;
  const double bottom = std::min(from.y, to.y) - margin, top = std::max(from.y, to.y) + margin;
  const auto meets = [&](const Node& node) {
    if (node.box.low.x > right || node.box.high.x < left || node.box.low.y > top || node.box.high.y < bottom)
      return false;
    const double a = node.normal_x * from.x + node.normal_y * from.y;
    const double b = node.normal_x * to.x + node.normal_y * to.y;
    return std::min(a, b) - margin <= node.high && std::max(a, b) + margin >= node.low;
  };
  std::size_t open[max_open], count = 0, found = 0;
  open[count++] = root;
  while (count > 0) {
    const std::size_t node = open[--count];
    if (!meets(nodes_[node])) continue;
    if (node < leaves_) {
      open[count++] = 2 * node + 1, open[count++] = 2 * node;
      continue;
    }
    const std::size_t first = segments_per_leaf * (node - leaves_);
    const std::size_t end = std::min(first + segments_per_leaf, segments_.size());
    for (std::size_t i = first; i < end; ++i) near[found++] = static_cast<std::uint32_t>(i);
  }
  return found;
}

}  // namespace bch::detail
