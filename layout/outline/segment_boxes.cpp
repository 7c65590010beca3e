// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/segment_boxes.hpp"

#include <algorithm>
#include <limits>

namespace bch::detail {
namespace {

constexpr std::int16_t lowest = std::numeric_limits<std::int16_t>::min();
constexpr std::int16_t highest = std::numeric_limits<std::int16_t>::max();

struct CellBox {
  std::int16_t min_x, min_y, max_x, max_y;
};

void set(BoxBlock& block, std::size_t number, const CellBox& box) {
  block.min_x[number] = box.min_x, block.min_y[number] = box.min_y;
  block.max_x[number] = box.max_x, block.max_y[number] = box.max_y;
}

void set(BoxBlock& block, const Segment* segments) {
  const auto cell = [](std::int32_t coordinate) {
    return static_cast<std::int16_t>(coordinate >> cell_bits);
  };
  for (std::size_t i = 0; i < boxes_per_block; ++i) {
    const auto& [a, b] = segments[i];
    block.min_x[i] = cell(std::min(a.x, b.x)), block.min_y[i] = cell(std::min(a.y, b.y));
    block.max_x[i] = cell(std::max(a.x, b.x)), block.max_y[i] = cell(std::max(a.y, b.y));
  }
}

CellBox around(const BoxBlock& block) {
  CellBox box{highest, highest, lowest, lowest};
  for (std::size_t i = 0; i < boxes_per_block; ++i) {
    box.min_x = std::min(box.min_x, block.min_x[i]), box.min_y = std::min(box.min_y, block.min_y[i]);
    box.max_x = std::max(box.max_x, block.max_x[i]), box.max_y = std::max(box.max_y, block.max_y[i]);
  }
  return box;
}

/// Sets boxes that meet nothing from that number on.
void clear_from(std::size_t begin, AlignedVector<BoxBlock>& blocks) {
  for (std::size_t i = begin; i < boxes_per_block * blocks.size(); ++i)
    set(blocks[i / boxes_per_block], i % boxes_per_block, {highest, highest, lowest, lowest});
}

std::size_t divided(std::size_t count, std::size_t by) {
  return (count + by - 1) / by;
}

}  // namespace

void SegmentBoxes::reserve(std::size_t segments) {
  const std::size_t blocks = divided(segments, boxes_per_block);
  blocks_.reserve(blocks);
  groups_.reserve(divided(blocks, boxes_per_block) + groups_in_a_word);
}

void SegmentBoxes::assign(const Segment* segments, std::size_t count) {
  const std::size_t blocks = divided(count, boxes_per_block);
  blocks_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b) set(blocks_[b], segments + boxes_per_block * b);
  clear_from(count, blocks_);
  groups_.resize(groups_in_a_word * divided(blocks, groups_in_a_word * boxes_per_block));
  for (std::size_t b = 0; b < blocks; ++b)
    set(groups_[b / boxes_per_block], b % boxes_per_block, around(blocks_[b]));
  clear_from(blocks, groups_);
}

GridPoint SegmentBoxes::first_end(const Segment* segments) const {
  std::int16_t column = highest;
  for (const BoxBlock& group : groups_) column = std::min(column, around(group).min_x);
  GridPoint first{std::numeric_limits<std::int32_t>::max(), 0};
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (groups_[b / boxes_per_block].min_x[b % boxes_per_block] != column) continue;
    for (std::size_t i = 0; i < boxes_per_block; ++i)
      for (const GridPoint end : {segments[boxes_per_block * b + i].a, segments[boxes_per_block * b + i].b})
        first = lexicographically_less(end, first) ? end : first;
  }
  return first;
}

void SegmentBoxes::describe(SegmentSearch& search) const {
  search.blocks = blocks_.data();
  search.groups = groups_.data();
  search.group_count = divided(blocks_.size(), boxes_per_block);
}

}  // namespace bch::detail
