// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/body/band_test.hpp"
#include "kernel/body/body_arguments.hpp"
#include "kernel/body/leaf_search.hpp"
#include "kernel/body/placed_bodies.hpp"
#include "kernel/body/sphere_pairs.hpp"
#include "kernel/simd/packet_pairs.hpp"
#include "kernel/simd/relative_transforms.hpp"

namespace bch::detail {

/// Implements the pair queries of bodies of spheres that are answered by yes or no: a pair is a hit if some sphere of one meets some sphere of
/// the other, that is, overlaps it or comes within a gap. That test alone decides a hit; what only saves work rejects nothing that it
/// accepts (layout/body/sphere_rounding.hpp).
///
/// Pairs are answered in packets, stage by stage, and each stage leaves fewer of them open: place B in A's frame; separate bands of
/// height by their supports; accept pairs whose core spheres meet; search the leaves of what is left.
template <class Simd>
class BodyKernel {
 public:
  static void run(const BodyArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(BodyKernel) <= 256 * 1024, "what Kernels promises");
    BodyKernel kernel(arguments);
    for (; begin < end; begin += packet_size) {
      kernel.transforms_.compute(arguments.pairs, begin, end);
      kernel.gaps_ = arguments.pairs.gaps == nullptr ? nullptr : arguments.pairs.gaps + begin;
      kernel.answer_packet(arguments.pairs.states + begin);
    }
  }

 private:
  explicit BodyKernel(const BodyArguments& arguments) noexcept : in_(arguments), bands_(transforms_) {}

  void answer_packet(std::uint8_t* states) noexcept {
    __builtin_memset(states, 0, transforms_.size);
    separate();
    accept<8>(states);
    accept<core_spheres>(states);
    for (std::uint32_t k = 0; k < open_.size; ++k) states[open_.pair[k]] = search(open_.pair[k]);
  }

  PlacedBodies bodies(std::uint32_t pair) const noexcept {
    PlacedBodies placed = placed_bodies(in_, transforms_, pair);
    if (gaps_ != nullptr) placed.gap = gaps_[pair];
    return placed;
  }

  /// Leaves the pairs open of which some bands may meet.
  void separate() noexcept {
    bands_.place();
    open_.size = 0;
    for (std::uint32_t k = 0; k < transforms_.size; ++k) {
      if (in_.pairs.prefetch_shapes && k + List::pairs_ahead < transforms_.size)
        prefetch(k + List::pairs_ahead);
      open_bands_[k] = static_cast<std::uint16_t>(bands_.open(k, bodies(k)));
      open_.add_if(open_bands_[k] != 0, k);
    }
  }

  /// Asks for the beginnings of two records, up to their nodes.
  [[gnu::always_inline]] void prefetch(std::uint32_t pair) const noexcept {
    for (std::uint32_t line = 0; line < record_nodes; line += record_line) {
      __builtin_prefetch(in_.bodies->record(transforms_.shape_a[pair]) + line);
      __builtin_prefetch(in_.bodies->record(transforms_.shape_b[pair]) + line);
    }
  }

  /// Accepts pairs of which some of the first `count` core spheres meet.
  template <unsigned count>
  void accept(std::uint8_t* states) noexcept {
    open_.drop_if(
        open_,
        [&](std::uint32_t pair) {
          const std::uint32_t hit = cores_meet<count>(bodies(pair));
          states[pair] = static_cast<std::uint8_t>(hit);
          return hit;
        },
        [](std::uint32_t) {});
  }

  template <unsigned count>
  static bool cores_meet(const PlacedBodies& bodies) noexcept {
    bool meet = false;
    for (unsigned i = 0; i < count; i += 8)
      for (unsigned j = 0; j < count; j += 8)
        if (count == 8 || i + j != 0)
          meet |= balls_meet<Simd, 8>(bodies.b_in_a, core_of(bodies.a, i), core_of(bodies.b, j), bodies.gap);
    return meet;
  }

  std::uint8_t search(std::uint32_t pair) noexcept {
    const PlacedBodies placed = bodies(pair);
    Reach of_a[BandTest<Simd>::max_pairs], of_b[BandTest<Simd>::max_pairs];
    std::uint32_t count = 0;
    for (std::uint32_t open = open_bands_[pair]; open != 0; open &= open - 1, ++count)
      bands_.find_reach(pair, placed, static_cast<std::uint32_t>(__builtin_ctz(open)), of_a[count],
                        of_b[count]);
    return leaves_.run(placed, of_a, of_b, count);
  }

  using List = PacketPairs<Simd, packet_size>;

  const BodyArguments& in_;
  const float* gaps_ = nullptr;  ///< of the packet
  RelativeTransforms<Simd> transforms_;
  BandTest<Simd> bands_;
  std::uint16_t open_bands_[packet_size];
  List open_;
  LeafSearch<Simd> leaves_;
};

}  // namespace bch::detail
