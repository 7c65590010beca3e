// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/shape_storage.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

/// Blocks begin on cache lines; leaf blocks do not care.
std::size_t level_begin(const Bvh8& tree, std::size_t after) {
  return tree.blocks.empty() ? after : next_line(after);
}

/// Inner nodes begin where kernels load them whole.
std::size_t inner_begin(const Bvh8& tree, std::size_t first_disc) {
  return (first_disc + 3 * tree.x.size() + inner_floats - 1) / inner_floats * inner_floats;
}

std::size_t level_end(const Bvh8& tree, std::size_t begin) {
  const std::size_t first_disc = begin + tree.blocks.size() * block_floats;
  return inner_begin(tree, first_disc) + tree.inner_nodes.size() * inner_floats;
}

void require_numbers(std::size_t count, const char* what) {
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error(std::string("shape set: more than 2^32 ") + what);
}

}  // namespace

ShapeExtent extent_of(const FlatShape& flat) {
  ShapeExtent extent;
  for (const Bvh8& tree : flat.levels) {
    extent.nodes = level_end(tree, level_begin(tree, extent.nodes));
  }
  extent.rows = !flat.levels.back().is_single();
  extent.contours = flat.contour_disc.size();
  extent.points = flat.outline.points.size() + extent.contours;
  extent.segments = flat.leaf_segments.size();
  return extent;
}

ShapeArrays ShapeStorage::arrays() const {
  ShapeArrays arrays;
  for_each_array([](const char*, const auto& owned, auto& span) { span = owned; }, *this, arrays);
  return arrays;
}

void ShapeStorage::reserve(const ShapeSetPlan& plan, std::size_t shapes, const ShapeExtent& extent) {
  if (plan.heights) heights.reserve(shapes);
  roots.reserve(shapes * plan.depths.size());
  if (plan.depths.back() == 0) return;
  trees.reserve(shapes * plan.depths.size());
  nodes.reserve(std::min<std::size_t>(extent.nodes, leaf_bit));
  max_extent.reserve(shapes);
  if (plan.culling) {
    support.reserve(extent.rows * support_stride);
    inscribed.reserve(shapes), profiles.reserve(shapes);
  }
  if (plan.outlines) {
    shape_contours.reserve(shapes), segment_margin.reserve(shapes);
    contours.reserve(extent.contours), points.reserve(extent.points);
    leaf_segments.reserve(extent.segments);
  }
}

void ShapeStorage::resize(const ShapeSetPlan& plan, std::size_t shapes) {
  const std::size_t levels = plan.depths.size();
  require_numbers(shapes * levels, "roots");
  if (plan.heights) heights.resize(shapes);
  roots.resize(shapes * levels);
  if (plan.depths.back() == 0) return;
  trees.resize(shapes * levels);
  max_extent.resize(shapes);
  if (plan.culling) inscribed.resize(shapes), profiles.resize(shapes);
  if (plan.outlines) shape_contours.resize(shapes), segment_margin.resize(shapes);
}

void ShapeStorage::allocate(const ShapeExtent& at, const ShapeExtent& size) {
  // Kernels read a leaf block's "children", and forget them.
  const std::size_t last_node = at.nodes + size.nodes + block_floats;
  if (last_node >= leaf_bit) throw std::length_error("shape set: more than 2^31 numbers in nodes");
  require_numbers(at.rows + size.rows, "rows of supports");
  require_numbers(at.points + size.points, "points");
  require_numbers(at.segments + size.segments, "segments of leaves");
  if (!trees.empty()) nodes.resize(last_node);
  if (!profiles.empty()) {
    if (support.empty()) support.assign(first_row * support_stride, std::numeric_limits<float>::infinity());
    support.resize((at.rows + size.rows) * support_stride);
  }
  if (!shape_contours.empty()) {
    contours.resize(at.contours + size.contours);
    points.resize(at.points + size.points);
    leaf_segments.resize(at.segments + size.segments);
  }
}

void ShapeStorage::shorten(const ShapeExtent& end) noexcept {
  const auto cut = [](auto& array, std::size_t size) { array.resize(std::min(array.size(), size)); };
  cut(nodes, end.nodes);
  cut(support, end.rows * support_stride);
  cut(contours, end.contours);
  cut(points, end.points);
  cut(leaf_segments, end.segments);
}

void ShapeStorage::store(std::size_t shape, const FlatBody& body, const ShapeExtent& at) {
  const FlatShape& flat = body.shape;
  const std::size_t first_root = shape * depths.size();
  std::size_t node = at.nodes;
  for (std::size_t k = 0; k < flat.levels.size(); ++k) {
    const Bvh8& tree = flat.levels[k];
    const bool deepest = k + 1 == flat.levels.size();
    const std::size_t row = tree.is_single() ? single_disc : deepest ? at.rows : no_supports;
    roots[first_root + k] = {tree.root.x, tree.root.y, tree.root.radius, static_cast<std::uint32_t>(row)};
    if (trees.empty()) continue;
    node = level_begin(tree, node);
    store_level(first_root + k, tree, node);
    node = level_end(tree, node);
  }
  if (!heights.empty()) heights[shape] = body.heights;
  if (!max_extent.empty()) max_extent[shape] = rounding::round_up(flat.max_extent);
  if (!profiles.empty()) store_culling(shape, flat, at);
  if (!shape_contours.empty()) store_outline(shape, flat, at);
}

void ShapeStorage::store_level(std::size_t root, const Bvh8& tree, std::size_t node) {
  const std::size_t first_disc = node + tree.blocks.size() * block_floats;
  const auto name = [&](std::uint32_t local) {
    return static_cast<std::uint32_t>(local & leaf_bit ? local + first_disc : node + local * block_floats);
  };
  trees[root] = {name(tree.top), static_cast<std::uint32_t>(first_disc),
                 static_cast<std::uint32_t>(tree.x.size()), tree.count, tree.outer_radius};
  trees[root].conservative_nodes = tree.conservative_nodes;
  const std::uint32_t first_inner = trees[root].first_inner();
  float* out = nodes.data() + node;
  for (const Bvh8::Block& block : tree.blocks) {
    std::memcpy(out, &block.discs, sizeof block.discs);
    std::memcpy(out + block_outer, block.outer_radius, sizeof block.outer_radius);
    for (std::uint32_t k = 0; k < block_width; ++k) {
      const std::uint32_t of_block = block.node[k];
      out[block_names + k] = std::bit_cast<float>(name(block.child[k]));
      out[block_nodes + k] =
          std::bit_cast<float>(of_block < leaf_bit ? of_block + first_inner : name(of_block));
    }
    out += block_floats;
  }
  for (const std::vector<float>* field : {&tree.x, &tree.y, &tree.radius})
    out = std::copy(field->begin(), field->end(), out);
  out = std::fill_n(out, nodes.data() + inner_begin(tree, first_disc) - out, 0.0f);
  for (InnerNode inner : tree.inner_nodes) {
    inner.link += first_inner;
    std::memcpy(out, &inner, sizeof inner);
    out += inner_floats;
  }
}

void ShapeStorage::store_culling(std::size_t shape, const FlatShape& flat, const ShapeExtent& at) {
  if (!flat.levels.back().is_single())
    std::copy(flat.supports.begin(), flat.supports.end(), support.data() + at.rows * support_stride);
  profiles[shape] = flat.profile;
  inscribed[shape] = flat.inscribed;
}

void ShapeStorage::store_outline(std::size_t shape, const FlatShape& flat, const ShapeExtent& at) {
  const auto contour = static_cast<std::uint32_t>(at.contours), point = static_cast<std::uint32_t>(at.points);
  const std::size_t count = flat.contour_disc.size();
  shape_contours[shape] = {contour, contour + static_cast<std::uint32_t>(count)};
  const auto& begin = flat.outline.contour_begin;
  for (std::size_t c = 0; c < count; ++c) {
    const auto closed = static_cast<std::uint32_t>(point + c);
    contours[contour + c] = {flat.contour_disc[c], closed + begin[c], closed + begin[c + 1]};
    const auto of_contour = flat.outline.contour(c);
    Vec2* const out = std::copy(of_contour.begin(), of_contour.end(), points.data() + closed + begin[c]);
    *out = of_contour.front();
  }
  segment_margin[shape] = flat.segment_margin;
  if (flat.leaf_segments.empty()) return;
  Tree& last_level = trees[(shape + 1) * depths.size() - 1];
  last_level.segments = static_cast<std::uint32_t>(at.segments);
  last_level.points = point;
  std::copy(flat.leaf_segments.begin(), flat.leaf_segments.end(), leaf_segments.data() + at.segments);
}

}  // namespace bch::detail
