// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/collide/containment.hpp"
#include "kernel/collide/pair_kernel.hpp"
#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/slab_pairs.hpp"

namespace bch::detail {

/// Implements the pair query of bodies in slabs, and of bodies at different heights. A chunk of pairs is placed once; then each round
/// takes the next pair of parts of every pair that has not collided yet through the stages of PairKernel, as if
/// they were shapes. Those whose outlines may hold each other are looked at last.
template <class Simd>
class SlabKernel {
 public:
  static void run(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(SlabKernel) <= 300 * 1024, "what query.hpp promises, and room for the callers");
    SlabKernel kernel(arguments);
    for (; begin < end; begin += group_size) kernel.answer_group(begin, end);
  }

 private:
  using Parts = typename SlabPairs<Simd>::Parts;

  explicit SlabKernel(const Arguments& arguments) noexcept
      : in_(arguments),
        for_parts_(with_codes(arguments, part_codes_)),
        hull_view_(hulls_as_shapes(*arguments.shapes)),
        kernel_(for_parts_),
        hulls_(hull_view_, kernel_.placements()) {}

  static Arguments with_codes(Arguments arguments, std::uint8_t* codes) noexcept {
    arguments.codes = codes;
    return arguments;
  }

  void answer_group(std::size_t begin, std::size_t end) noexcept {
    codes_ = in_.codes + begin;
    begin_ = begin;
    open_count_ = nested_count_ = 0;
    for (std::uint32_t first = 0; first < group_size && begin + first < end; first += chunk_size)
      place(first, begin + first, end);
    while (begin_round()) {
      for (std::uint32_t first = 0; first < open_count_; first += chunk_size) answer_parts(first);
      kernel_.finish();
      end_round();
    }
    for (std::uint32_t i = 0; i < nested_count_; ++i)
      if (codes_[nested_[i].pair] == apart && contains(nested_[i])) codes_[nested_[i].pair] = overlap;
  }

  /// Places a chunk, and opens the pairs that no line separates.
  void place(std::uint32_t first, std::size_t begin, std::size_t end) noexcept {
    Placements<Simd>& at = kernel_.placements();
    at.place(in_, begin, end);
    // They have no room for gaps: the reach that these need is that of a part.
    const bool has_hulls = in_.shapes->hull_support != nullptr && !KnowsGaps<Simd>;
    const std::uint32_t levels = in_.shapes->level_count;
    if (has_hulls) {
      hulls_.use_rows(at.shape_a, at.shape_b);
      hulls_.place_directions();
    }
    for (std::uint32_t k = 0; k < at.size; ++k) {
      const std::uint32_t pair = first + k;
      codes_[pair] = apart;
      const std::uint32_t a = at.agent_a(k), b = at.agent_b(k);
      placed_[pair] = {at.transform(k),
                       a,
                       b,
                       at.shape_a[k],
                       at.shape_b[k],
                       at.root_a[k] - at.shape_a[k] * levels,
                       at.root_b[k] - at.shape_b[k] * levels,
                       0,
                       in_.agent_z.first == nullptr ? 0
                                                    : AgentColumns<Simd>::number(in_.agent_z, b) -
                                                          AgentColumns<Simd>::number(in_.agent_z, a)};
      // Supports are those of the last level.
      const bool is_last = placed_[pair].level_a + placed_[pair].level_b == 2 * (levels - 1);
      open_[open_count_] = static_cast<std::uint16_t>(pair);
      open_count_ += !(has_hulls && is_last && (hulls_.apart(k, 0) | hulls_.apart(k, 1)) != 0);
    }
  }

  static ShapeSetView hulls_as_shapes(ShapeSetView shapes) noexcept {
    shapes.support = shapes.hull_support;
    return shapes;
  }

  /// Finds the next parts of all open pairs. Returns whether there are any.
  bool begin_round() noexcept {
    std::uint32_t size = 0;
    for (std::uint32_t i = 0; i < open_count_; ++i) {
      const std::uint16_t pair = open_[i];
      Placed& at = placed_[pair];
      const Parts parts = SlabPairs<Simd>(*in_.shapes, at.shape_a, at.shape_b, at.rise).next(at.cursor);
      parts_[size] = {pair, parts.a, parts.b};
      open_[size] = pair;
      size += parts.a != no_part;
    }
    open_count_ = size;
    return size > 0;
  }

  /// Takes a chunk of parts through the stages for shapes.
  void answer_parts(std::uint32_t first) noexcept {
    Placements<Simd>& at = kernel_.placements();
    const std::uint32_t levels = in_.shapes->level_count;
    std::uint32_t k = 0;
    for (; k < chunk_size && first + k < open_count_; ++k) {
      const auto [pair, a, b] = parts_[first + k];
      const Placed& placed = placed_[pair];
      at.c[k] = placed.b_in_a.c, at.s[k] = placed.b_in_a.s, at.tx[k] = placed.b_in_a.tx,
      at.ty[k] = placed.b_in_a.ty;
      at.shape_a[k] = a, at.shape_b[k] = b;
      at.root_a[k] = a * levels + placed.level_a, at.root_b[k] = b * levels + placed.level_b;
      if constexpr (KnowsGaps<Simd>) at.set_gaps(k, in_, begin_ + pair);
    }
    at.fill_up(k);
    kernel_.answer_placed(first);
  }

  /// Drops the pairs that collide.
  void end_round() noexcept {
    std::uint32_t left = 0;
    for (std::uint32_t k = 0; k < open_count_; ++k) {
      const std::uint16_t pair = open_[k];
      if (part_codes_[k] == may_contain) add_nested(parts_[k]);
      const bool hit = (part_codes_[k] & overlap) != 0;
      codes_[pair] = static_cast<std::uint8_t>(codes_[pair] | hit);
      open_[left] = pair;
      left += !hit;
    }
    open_count_ = left;
  }

  /// Holds two agents, and how the second lies in the first one's frame.
  struct Placed {
    Transform b_in_a;
    std::uint32_t agent_a, agent_b, shape_a, shape_b, level_a, level_b;
    std::uint32_t cursor;  ///< of SlabPairs
    double rise;           ///< metres from A's ground to B's
  };
  /// Holds two parts of a pair.
  struct PartPair {
    std::uint16_t pair;
    std::uint32_t a, b;
  };

  void add_nested(const PartPair& parts) noexcept {
    if (nested_count_ < group_size)
      nested_[nested_count_++] = parts;
    else if (contains(parts))
      codes_[parts.pair] = overlap;
  }
  bool contains(const PartPair& parts) const noexcept {
    const Placed& at = placed_[parts.pair];
    return one_contains_other(in_, at.agent_a, parts.a, at.agent_b, parts.b);
  }

  /// Pairs that go through their rounds together: more than a chunk, because a round ends when the last traversal does.
  static constexpr std::uint32_t group_size = 2 * chunk_size;

  const Arguments& in_;
  Arguments for_parts_;
  ShapeSetView hull_view_;
  PairKernel<Simd> kernel_;
  SeparatingAxisTest<Simd> hulls_;
  std::size_t begin_ = 0;          ///< of the group
  std::uint8_t* codes_ = nullptr;  ///< of it
  std::uint32_t open_count_ = 0, nested_count_ = 0;
  std::uint16_t open_[group_size];
  std::uint8_t part_codes_[group_size];
  Placed placed_[group_size];
  PartPair parts_[group_size], nested_[group_size];
};

}  // namespace bch::detail
