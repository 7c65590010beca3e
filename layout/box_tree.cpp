// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/box_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace bch {
namespace {

constexpr std::int16_t lowest = std::numeric_limits<std::int16_t>::min();
constexpr std::int16_t highest = std::numeric_limits<std::int16_t>::max();

}  // namespace

CoarseBox BoxTree::Block::around() const {
  const auto smaller = [](Lanes a, Lanes b) -> Lanes { return a < b ? a : b; };
  const auto larger = [](Lanes a, Lanes b) -> Lanes { return a > b ? a : b; };
  const Lanes x0 = smaller(min_x[0], min_x[1]), y0 = smaller(min_y[0], min_y[1]);
  const Lanes x1 = larger(max_x[0], max_x[1]), y1 = larger(max_y[0], max_y[1]);
  CoarseBox box(x0[0], y0[0], x1[0], y1[0]);
  for (std::size_t i = 1; i < width / 2; ++i)
    box = {std::min(box.min_x, x0[i]), std::min(box.min_y, y0[i]), std::max(box.max_x, x1[i]),
           std::max(box.max_y, y1[i])};
  return box;
}

void BoxTree::reserve(std::size_t segments) {
  lay_out(segments);
  blocks_.reserve(level_begin_.back());
  open_.resize(2 * (segments / width + top_blocks + width));
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
    for (std::size_t i = 0; i < count; ++i)
      blocks_[level_begin_[level] + i / width].set(i % width, blocks_[below + i].around());
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
  const auto apart = [&](int half) -> Lanes {
    return (block.min_x[half] > box.max_x) | (block.min_y[half] > box.max_y) |
           (block.max_x[half] < box.min_x) | (block.max_y[half] < box.min_y);
  };
  // A byte for each box, 1 where it is apart: even numbers from one half, odd ones from the other.
  const Lanes bytes = (apart(0) & 0x0001) | (apart(1) & 0x0100);
  const auto [low, high] = std::bit_cast<std::array<std::uint64_t, 2>>(bytes);
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
  std::uint32_t *open = open_.data(), *next = open + open_.size() / 2;
  std::size_t count = level_begin_[level + 1] - level_begin_[level];
  for (std::uint32_t i = 0; i < count; ++i) open[i] = i;
  for (;; --level) {
    const Block* blocks = blocks_.data() + level_begin_[level];
    std::uint32_t *const begin = level == 0 ? found : next, *end = begin;
    for (std::size_t i = 0; i < count; ++i)
      end = append_meeting(blocks[open[i]], box, open[i] * static_cast<std::uint32_t>(width), end);
    count = static_cast<std::size_t>(end - begin);
    if (level == 0) return count;
    std::swap(open, next);
  }
}

}  // namespace bch
