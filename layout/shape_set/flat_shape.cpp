// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/flat_shape.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "layout/format/cut_discs.hpp"
#include "layout/format/leaf_segments.hpp"

namespace bch::detail {
namespace {

/// What ShapeStorage::put_level() was given.
Bvh8 bvh8_of(const Root& root, const Tree& level, const float* nodes) {
  Bvh8 tree;
  tree.root = {root.x, root.y, root.radius};
  tree.count = level.count;
  tree.outer_radius = level.outer_radius;
  tree.conservative_nodes = level.conservative_nodes != 0;
  const std::uint32_t begin = level.top < leaf_bit ? level.top : level.discs;
  const auto local = [&](std::uint32_t name) {
    return name < leaf_bit ? (name - begin) / block_floats : name - level.discs;
  };
  tree.top = local(level.top);
  tree.blocks.resize((level.discs - begin) / block_floats);
  const std::uint32_t first_inner = level.first_inner();
  const float* in = nodes + begin;
  const auto read = [&](float* to, std::size_t count) {
    std::copy_n(in, count, to);
    in += count;
  };
  const auto read_bits = [&](std::uint32_t* to, const auto& local_of) {
    std::transform(in, in + block_width, to,
                   [&](float bits) { return local_of(std::bit_cast<std::uint32_t>(bits)); });
    in += block_width;
  };
  for (Bvh8::Block& block : tree.blocks) {
    for (float* field : {block.discs.x, block.discs.y, block.discs.radius}) read(field, block_width);
    read_bits(block.child, local);
    read(block.outer_radius, block_width);
    read_bits(block.node,
              [&](std::uint32_t node) { return node < leaf_bit ? node - first_inner : node - level.discs; });
  }
  for (std::vector<float>* field : {&tree.x, &tree.y, &tree.radius}) {
    field->resize(level.stride);
    read(field->data(), level.stride);
  }
  in = nodes + std::size_t{first_inner} * inner_floats;
  tree.inner_nodes.resize(level.count);
  for (InnerNode& inner : tree.inner_nodes) {
    std::memcpy(&inner, in, sizeof inner);
    in += inner_floats;
    inner.link -= first_inner;
  }
  return tree;
}

/// What ShapeStorage::put_culling() was given.
void take_culling(const ShapeArrays& arrays, std::size_t shape, std::uint32_t row, FlatShape& flat) {
  if (row >= first_row)
    std::copy_n(arrays.support.data() + std::size_t{row} * support_stride, support_stride,
                flat.supports.begin());
  flat.profile = arrays.profiles[shape];
  flat.inscribed = arrays.inscribed[shape];
}

/// What ShapeStorage::put_outline() was given.
void take_outline(const ShapeArrays& arrays, std::size_t shape, FlatShape& flat) {
  flat.outline = outline_of(arrays, shape);
  const auto [begin, end] = arrays.shape_contours[shape];
  for (const Contour& contour : arrays.contours.subspan(begin, end - begin))
    flat.contour_disc.push_back(contour.disc);
  flat.segment_margin = arrays.segment_margin[shape];
  const Tree& last_level = arrays.trees[(shape + 1) * arrays.depths.size() - 1];
  if (last_level.segments == no_segments) return;
  const auto words = arrays.leaf_segments.subspan(last_level.segments);
  const auto own = words.first(leaf_segments_size(words, last_level.count));
  flat.leaf_segments.assign(own.begin(), own.end());
}

}  // namespace

Outline outline_of(const ShapeArrays& arrays, std::size_t shape) {
  Outline outline;
  if (arrays.shape_contours.empty()) return outline;
  const auto [begin, end] = arrays.shape_contours[shape];
  for (const Contour& contour : arrays.contours.subspan(begin, end - begin)) {
    const auto points = arrays.points.subspan(contour.begin, contour.end - contour.begin);
    outline.points.insert(outline.points.end(), points.begin(), points.end());
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
  return outline;
}

FlatShape flat_shape(const ShapeArrays& arrays, std::size_t shape) {
  const std::size_t levels = arrays.depths.size(), first_root = shape * levels;
  FlatShape flat;
  for (std::size_t k = first_root; k < first_root + levels; ++k) {
    if (!arrays.trees.empty()) {
      flat.levels.push_back(bvh8_of(arrays.roots[k], arrays.trees[k], arrays.nodes.data()));
      continue;
    }
    const Root& root = arrays.roots[k];
    flat.levels.emplace_back().root = {root.x, root.y, root.radius};
    flat.levels.back().count = 1;
  }
  if (!arrays.max_extent.empty()) flat.max_extent = static_cast<double>(arrays.max_extent[shape]);
  if (!arrays.profiles.empty()) take_culling(arrays, shape, arrays.roots[first_root + levels - 1].row, flat);
  if (!arrays.shape_contours.empty()) take_outline(arrays, shape, flat);
  return flat;
}

FlatBody flat_body(const ShapeArrays& arrays, std::size_t shape) {
  FlatBody body;  // where a member of a braced result throws, GCC 12 destroys those before it twice
  body.shape = flat_shape(arrays, shape);
  if (!arrays.heights.empty()) body.heights = arrays.heights[shape];
  return body;
}

}  // namespace bch::detail
