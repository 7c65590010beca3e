// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/arguments.hpp"
#include "kernel/block_test.hpp"
#include "kernel/chunk_pairs.hpp"
#include "kernel/lanes.hpp"
#include "kernel/placements.hpp"
#include "kernel/record_fields.hpp"
#include "kernel/separation_test.hpp"
#include "kernel/walk.hpp"
#include "layout/shape_set_view.hpp"

namespace bch::kernel {

/// The pair query, written once. `Simd` is a Lanes<Arch> with bits(). Every float operation that decides an
/// answer is one of those listed in layout/rounding.hpp, in that order, so that all instantiations and the
/// scalar reference agree bit for bit; what only saves work is conservative.
///
/// Pairs are answered in chunks, stage by stage, and each stage leaves fewer of them open: place B in A's frame;
/// part pairs by their supports; accept pairs whose inscribed discs overlap; walk the trees of the rest. Pairs that
/// stand near each other will probably collide and skip the parting until the inscribed discs have failed.
template <class Simd>
class PairKernel {
 public:
  static void run(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(PairKernel) <= 256 * 1024, "what implementation.hpp promises");
    PairKernel kernel(arguments);
    for (; begin < end; begin += chunk) {
      kernel.answer_chunk(begin, end - begin < chunk ? static_cast<std::uint32_t>(end - begin) : chunk);
      kernel.walk_.run(Walk<Simd>::capacity - chunk);
    }
    kernel.walk_.run(0);
  }

 private:
  using Float = typename Simd::Float;
  static constexpr std::uint32_t chunk = Placements<Simd>::chunk;
  using List = ChunkPairs<chunk>;
  /// Of the sum of squared enclosing radii: pairs nearer than that probably collide. By measurement.
  static constexpr float near_square = 0.845f;

  explicit PairKernel(const Arguments& arguments) noexcept
      : in_(arguments),
        shapes_(*arguments.shapes),
        miss_(arguments.mark_near_misses ? near_miss : apart),
        separation_(shapes_, at_),
        walk_(shapes_, arguments.codes) {}

  void answer_chunk(std::size_t begin, std::uint32_t size) noexcept {
    at_.place(in_, begin, size);
    codes_ = in_.codes + begin;
    open_.size = near_.size = 0;
    if (shapes_.support == nullptr || !shapes_.rows_in_order) {
      test_roots();
    } else {
      for (std::uint32_t k = 0; k < size; k += Simd::width) open_bits_[k / Simd::width] = ~std::uint32_t{0};
    }
    if (shapes_.support == nullptr)
      open_all();
    else if (any_open())
      take_shortcuts();
    for (std::uint32_t k = 0; k < open_.size; ++k) {
      const std::uint32_t pair = open_.pair[k];
      walk_.add(begin + pair, miss(pair), at_.transform(pair), at_.root_a[pair], at_.root_b[pair]);
    }
  }

  /// Root disc against root disc, lane = pair. Where both cuts are single discs, that is the answer.
  void test_roots() noexcept {
    of_a_.load(shapes_.roots, at_.root_a, at_.size);
    of_b_.load(shapes_.roots, at_.root_b, at_.size);
    __builtin_memcpy(row_a_, of_a_.fourth, sizeof row_a_);
    __builtin_memcpy(row_b_, of_b_.fourth, sizeof row_b_);
    separation_.use_rows(row_a_, row_b_);
    for (std::uint32_t k = 0; k < at_.size; k += Simd::width) {
      const auto [x, y] = b_in_a(k);
      const std::uint32_t hits =
          overlaps<Simd>(x, y, Simd::load(of_b_.third + k), Simd::load(of_a_.first + k),
                         Simd::load(of_a_.second + k), Simd::load(of_a_.third + k));
      std::uint32_t open = 0;
      for (std::uint32_t lane = 0; lane < lanes(k); ++lane) {
        const std::uint32_t hit = hits >> lane & 1, decided = both_are_single(k + lane);
        codes_[k + lane] = static_cast<std::uint8_t>(hit * (decided * overlap + (decided ^ 1) * miss_));
        open |= (hit & (decided ^ 1)) << lane;
      }
      open_bits_[k / Simd::width] = open;
    }
  }

  std::uint32_t both_are_single(std::uint32_t k) const noexcept {
    return (row_a_[k] | row_b_[k]) == single_disc;
  }

  struct Point {
    Float x, y;
  };
  /// The centres of B's discs.
  Point b_in_a(std::uint32_t k) const noexcept {
    const Float c = Simd::load(at_.c + k), s = Simd::load(at_.s + k);
    const Float x = Simd::load(of_b_.first + k), y = Simd::load(of_b_.second + k);
    return {Simd::load(at_.tx + k) + (c * x - s * y), Simd::load(at_.ty + k) + (s * x + c * y)};
  }

  /// A set of single discs is done by now.
  bool any_open() const noexcept {
    std::uint32_t any = 0;
    for (std::uint32_t k = 0; k < at_.size; k += Simd::width) any |= open_bits_[k / Simd::width];
    return any != 0;
  }

  void open_all() noexcept {
    for (std::uint32_t k = 0; k < at_.size; ++k)
      open_.add_if(open_bits_[k / Simd::width] >> k % Simd::width & 1, k);
  }

  void take_shortcuts() noexcept {
    separation_.place_directions();
    measure_distances();
    parted_.size = meeting_.size = 0;
    open_.move_if(parted_, [&](std::uint32_t pair) { return separation_.apart(pair, 0); });
    if (shapes_.inscribed != nullptr) accept_by_inscribed_discs();
    near_.move_if(parted_, [&](std::uint32_t pair) { return separation_.apart(pair, 0); });
    near_.move_all(open_);
    open_.move_if(parted_, [&](std::uint32_t pair) { return separation_.apart(pair, 1); });
    for (std::uint32_t k = 0; k < parted_.size; ++k) codes_[parted_.pair[k]] = apart;
    for (std::uint32_t k = 0; k < meeting_.size; ++k) codes_[meeting_.pair[k]] = overlap;
  }

  /// Which pairs stand so near each other that they probably collide, and where one may hold the other; lane =
  /// pair.
  void measure_distances() noexcept {
    of_a_.load(shapes_.enclosures, at_.shape_a, at_.size);
    of_b_.load(shapes_.enclosures, at_.shape_b, at_.size);
    for (std::uint32_t k = 0; k < at_.size; k += Simd::width) {
      const auto [bx, by] = b_in_a(k);
      const Float x = bx - Simd::load(of_a_.first + k), y = by - Simd::load(of_a_.second + k);
      const Float square = x * x + y * y;
      const Float a_outer = Simd::load(of_a_.third + k), a_inner = Simd::load(of_a_.fourth + k);
      const Float b_outer = Simd::load(of_b_.third + k), b_inner = Simd::load(of_b_.fourth + k);
      may_nest_[k / Simd::width] =
          Simd::bits(square <= a_outer - b_inner) | Simd::bits(square <= b_outer - a_inner);
      const std::uint32_t near = Simd::bits(square < Float(near_square) * (a_outer + b_outer));
      const std::uint32_t all = open_bits_[k / Simd::width];
      for (std::uint32_t lane = 0; lane < lanes(k); ++lane) {
        near_.add_if((all & near) >> lane & 1, k + lane);
        open_.add_if((all & ~near) >> lane & 1, k + lane);
      }
    }
  }

  /// Of the register that begins with pair k.
  std::uint32_t lanes(std::uint32_t k) const noexcept {
    return at_.size - k < Simd::width ? at_.size - k : Simd::width;
  }

  /// What a pair is whose cuts do not overlap.
  std::uint8_t miss(std::uint32_t pair) const noexcept {
    return static_cast<std::uint8_t>(shapes_.support == nullptr ? miss_ : miss_ * may_nest(pair));
  }

  std::uint32_t may_nest(std::uint32_t pair) const noexcept {
    return may_nest_[pair / Simd::width] >> pair % Simd::width & 1;
  }

  /// Where discs inside the outlines overlap, the outlines meet; in boundary semantics that counts only where
  /// neither can hold the other. See layout/interior.hpp.
  void accept_by_inscribed_discs() noexcept {
    nestable_.size = 0;
    near_.move_if(meeting_,
                  [&](std::uint32_t pair) { return inscribed_discs_overlap<block_width / 2>(pair); });
    near_.move_if(meeting_, [&](std::uint32_t pair) { return inscribed_discs_overlap<block_width>(pair); });
    open_.move_if(meeting_, [&](std::uint32_t pair) { return inscribed_discs_overlap<block_width>(pair); });
    if (in_.mark_near_misses) return;
    meeting_.move_if(nestable_, [&](std::uint32_t pair) { return may_nest(pair); });
    nestable_.move_if(meeting_, [&](std::uint32_t pair) { return separation_.contours_stick_out(pair); });
    nestable_.move_all(open_);
  }

  /// By the first `count` discs of either.
  template <unsigned count>
  std::uint32_t inscribed_discs_overlap(std::uint32_t pair) const noexcept {
    return overlapping_discs<Simd, count>(at_.transform(pair), inscribed(at_.shape_a[pair]),
                                          inscribed(at_.shape_b[pair])) != 0;
  }

  Discs inscribed(std::uint32_t shape) const noexcept { return {shapes_.inscribed[shape].x, block_width}; }

  const Arguments& in_;
  const ShapeSetView shapes_;
  const std::uint8_t miss_;
  std::uint8_t* codes_ = nullptr;  ///< of the chunk
  Placements<Simd> at_;
  SeparationTest<Simd> separation_;
  RecordFields<Simd, chunk> of_a_, of_b_;
  std::uint32_t row_a_[chunk], row_b_[chunk];  ///< of the roots' supports; set by test_roots()
  std::uint32_t open_bits_[chunk / Simd::width], may_nest_[chunk / Simd::width];  ///< a register's pairs each
  List open_, near_, parted_, meeting_, nestable_;
  Walk<Simd> walk_;
};

}  // namespace bch::kernel
