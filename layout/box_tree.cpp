// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/box_tree.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>

namespace bch {
namespace {

constexpr std::int16_t lowest = std::numeric_limits<std::int16_t>::min();
constexpr std::int16_t highest = std::numeric_limits<std::int16_t>::max();

template <std::size_t width>
std::int16_t smallest(const std::int16_t (&values)[width]) {
  std::int16_t result = highest;
  for (const std::int16_t value : values) result = std::min(result, value);
  return result;
}

template <std::size_t width>
std::int16_t largest(const std::int16_t (&values)[width]) {
  std::int16_t result = lowest;
  for (const std::int16_t value : values) result = std::max(result, value);
  return result;
}

}  // namespace

void BoxTree::reserve(std::size_t segments) {
  lay_out(segments);
  blocks_.reserve(level_begin_.back());
  open_.resize(segments + top_blocks + width);
}

/// Sets the levels' places.
void BoxTree::lay_out(std::size_t segments) {
  level_begin_.assign(1, 0);
  std::size_t blocks = segments;
  do {
    blocks = (blocks + width - 1) / width;
    level_begin_.push_back(level_begin_.back() + blocks);
  } while (blocks > top_blocks);
}

void BoxTree::assign(std::span<const Segment> segments) {
  lay_out(segments.size());
  blocks_.resize(level_begin_.back());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto [a, b] = segments[i];
    const CoarseBox box({std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)});
    blocks_[i / width].set(i % width, box);
  }
  pad(segments.size(), 0);
  for (std::size_t level = 1; level + 1 < level_begin_.size(); ++level) {
    const std::size_t below = level_begin_[level - 1], count = level_begin_[level] - below;
    for (std::size_t i = 0; i < count; ++i) {
      const Block& block = blocks_[below + i];
      blocks_[level_begin_[level] + i / width].set(i % width, {smallest(block.min_x), smallest(block.min_y),
                                                               largest(block.max_x), largest(block.max_y)});
    }
    pad(count, level_begin_[level]);
  }
}

/// Fills the last block of a level of `count` boxes with boxes that meet nothing.
void BoxTree::pad(std::size_t count, std::size_t first_block) {
  for (std::size_t i = count; i % width != 0; ++i)
    blocks_[first_block + i / width].set(i % width, {highest, highest, lowest, lowest});
}

/// Appends the numbers of the block's boxes that meet the box, counted from `first`. How many there are is hard
/// to predict, so a few are written in any case; what is not a number is overwritten by the next.
std::uint32_t* BoxTree::append_meeting(const Block& block, const CoarseBox& box, std::uint32_t first,
                                       std::uint32_t* found) {
  static_assert(std::endian::native == std::endian::little);
  alignas(width) std::uint8_t apart[width];
  for (std::size_t i = 0; i < width; ++i)
    apart[i] = (block.min_x[i] > box.max_x) | (box.min_x > block.max_x[i]) | (block.min_y[i] > box.max_y) |
               (box.min_y > block.max_y[i]);
  std::uint64_t low, high;
  std::memcpy(&low, apart, 8);
  std::memcpy(&high, apart + 8, 8);
  // The highest byte of a product: the sum of eight bytes, or their lowest bits next to each other.
  constexpr std::uint64_t sum = 0x0101010101010101, gather = 0x0102040810204080;
  const std::uint64_t count = width - ((low + high) * sum >> 56);
  std::uint64_t open = ~(low * gather >> 56 | high * gather >> 56 << 8);

  constexpr std::uint64_t written_in_any_case = 4;
  for (std::uint64_t i = 0; i < written_in_any_case; ++i, open &= open - 1)
    found[i] = first + static_cast<std::uint32_t>(std::countr_zero(open));
  for (std::uint64_t i = written_in_any_case; i < count; ++i, open &= open - 1)
    found[i] = first + static_cast<std::uint32_t>(std::countr_zero(open));
  return found + count;
}

std::size_t BoxTree::find_meeting(const CoarseBox& box, std::uint32_t* found) {
  std::size_t level = level_begin_.size() - 2;
  std::uint32_t* open = open_.data();
  std::size_t count = level_begin_[level + 1] - level_begin_[level];
  std::iota(open, open + count, 0u);
  for (;; --level) {
    const Block* blocks = blocks_.data() + level_begin_[level];
    std::uint32_t* end = found;
    for (std::size_t i = 0; i < count; ++i)
      end = append_meeting(blocks[open[i]], box, open[i] * static_cast<std::uint32_t>(width), end);
    count = static_cast<std::size_t>(end - found);
    if (level == 0) return count;
    std::copy(found, end, open);
  }
}

}  // namespace bch
