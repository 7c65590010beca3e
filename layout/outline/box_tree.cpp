// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/box_tree.hpp"

#include <emmintrin.h>

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

/// Eight pairs (x, y) of cells, from four times two of them in every other lane of 32 bits.
struct Eight {
  __m128i x, y;

  Eight(__m128i p, __m128i q, __m128i r, __m128i s) {
    const auto even_lanes = [](__m128i v, __m128i w) {
      return _mm_castps_si128(
          _mm_shuffle_ps(_mm_castsi128_ps(v), _mm_castsi128_ps(w), _MM_SHUFFLE(2, 0, 2, 0)));
    };
    const __m128i low = even_lanes(p, q), high = even_lanes(r, s);
    x = _mm_packs_epi32(_mm_srai_epi32(_mm_slli_epi32(low, 16), 16),
                        _mm_srai_epi32(_mm_slli_epi32(high, 16), 16));
    y = _mm_packs_epi32(_mm_srai_epi32(low, 16), _mm_srai_epi32(high, 16));
  }
};

/// The boxes of eight segments, from number `first` of the block.
void set_eight(BoxBlock& block, std::size_t first, const Segment* segments) {
  __m128i smaller[4], larger[4];  // of two segments' ends, each twice
  for (int i = 0; i < 4; ++i) {
    const auto cells = [segments](int s) {
      return _mm_srai_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(segments + s)), cell_bits);
    };
    const __m128i ends = _mm_packs_epi32(cells(2 * i), cells(2 * i + 1));
    const __m128i others = _mm_shuffle_epi32(ends, _MM_SHUFFLE(2, 3, 0, 1));
    smaller[i] = _mm_min_epi16(ends, others);
    larger[i] = _mm_max_epi16(ends, others);
  }
  const Eight low(smaller[0], smaller[1], smaller[2], smaller[3]);
  const Eight high(larger[0], larger[1], larger[2], larger[3]);
  const auto store = [first](std::int16_t* cells, __m128i eight) {
    _mm_store_si128(reinterpret_cast<__m128i*>(cells + first), eight);
  };
  store(block.min_x, low.x), store(block.min_y, low.y);
  store(block.max_x, high.x), store(block.max_y, high.y);
}

template <class Choose>
std::int16_t fold(const std::int16_t* cells, Choose choose) {
  const auto* halves = reinterpret_cast<const __m128i*>(cells);
  __m128i all = choose(_mm_load_si128(halves), _mm_load_si128(halves + 1));
  all = choose(all, _mm_shuffle_epi32(all, _MM_SHUFFLE(1, 0, 3, 2)));
  all = choose(all, _mm_shuffle_epi32(all, _MM_SHUFFLE(2, 3, 0, 1)));
  all = choose(all, _mm_srli_epi32(all, 16));
  return static_cast<std::int16_t>(_mm_cvtsi128_si32(all));
}

CellBox around(const BoxBlock& block) {
  const auto smallest = [](__m128i a, __m128i b) { return _mm_min_epi16(a, b); };
  const auto largest = [](__m128i a, __m128i b) { return _mm_max_epi16(a, b); };
  return {fold(block.min_x, smallest), fold(block.min_y, smallest), fold(block.max_x, largest),
          fold(block.max_y, largest)};
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

void BoxTree::reserve(std::size_t segments) {
  const std::size_t blocks = divided(segments, boxes_per_block);
  blocks_.reserve(blocks);
  groups_.reserve(divided(blocks, boxes_per_block) + groups_in_a_word);
}

void BoxTree::assign(const Segment* segments, std::size_t count) {
  const std::size_t blocks = divided(count, boxes_per_block);
  blocks_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b)
    for (const std::size_t half : {0, 8}) set_eight(blocks_[b], half, segments + boxes_per_block * b + half);
  clear_from(count, blocks_);
  groups_.resize(groups_in_a_word * divided(blocks, groups_in_a_word * boxes_per_block));
  for (std::size_t b = 0; b < blocks; ++b)
    set(groups_[b / boxes_per_block], b % boxes_per_block, around(blocks_[b]));
  clear_from(blocks, groups_);
}

GridPoint BoxTree::first_end(const Segment* segments) const {
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

void BoxTree::describe(SegmentSearch& search) const {
  search.blocks = blocks_.data();
  search.groups = groups_.data();
  search.group_count = divided(blocks_.size(), boxes_per_block);
}

}  // namespace bch::detail
