// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/collide/overlap_traversal.hpp"
#include "kernel/simd/arguments.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/packet_pairs.hpp"
#include "kernel/simd/profile_test.hpp"
#include "kernel/simd/relative_transforms.hpp"
#include "kernel/simd/separating_axis_test.hpp"
#include "kernel/simd/stage.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Implements collide() and within() of shapes for all instruction sets. `Simd` is a Lanes<Arch> with bits(). Every float
/// operation that decides an answer is listed in layout/base/rounding.hpp or in Gaps, and runs in the order listed there,
/// so that all instantiations and the scalar reference agree bit for bit; what only saves work is conservative.
///
/// Pairs are answered in packets, stage by stage; "Stages" in kernel/README.md describes these.
template <class Simd>
class PairKernel {
 public:
  static void run(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(PairKernel) <= 256 * 1024,
                  "with room for calls within the stack that query.hpp requires");
    PairKernel kernel(arguments);
    for (; begin < end; begin += packet_size) {
      kernel.transforms_.compute(arguments, begin, end);
      if constexpr (KnowsGaps<Simd>) kernel.transforms_.set_gaps(arguments, begin);
      end_stage<Simd>(Stage::place, kernel.transforms_.size);
      kernel.answer_packet(begin);
      kernel.traversal_.run(max_traversals - packet_size);
    }
    kernel.traversal_.run(0);
  }

 private:
  using Float = typename Simd::Float;
  /// The most traversals at one time: one for each pair of a packet, and as many for undecided pairs of earlier packets
  /// as fit on the stack.
  static constexpr std::uint32_t max_traversals = packet_size + packet_size * 7 / 8;
  using List = PacketPairs<Simd, packet_size>;

  explicit PairKernel(const Arguments& arguments) noexcept
      : in_(arguments),
        shapes_(*arguments.shapes),
        state_without_hit_(shapes_.shape_contours != nullptr ? may_contain : apart),
        axis_test_(shapes_, transforms_),
        profiles_(shapes_, transforms_, arguments),
        traversal_(shapes_, arguments) {}

  /// Answers the packet's pairs, except those that it adds to traversal_.
  [[gnu::always_inline]] void answer_packet(std::size_t begin) noexcept {
    states_ = in_.states + begin;
    undecided_.size = likely_.size = 0;
    // Profiles reject more pairs than root discs do. Roots are tested only if there are no profiles, if a cut may be a single
    // disc, or if there are several levels.
    if (shapes_.support == nullptr || !shapes_.rows_follow_roots) {
      test_roots();
    } else {
      for (std::uint32_t k = 0; k < transforms_.whole_registers(); k += Simd::width)
        undecided_bits_[k / Simd::width] = ~std::uint32_t{0};
      __builtin_memset(states_, overlap, transforms_.size);
    }
    if (shapes_.support == nullptr)
      list_undecided();
    else if (any_undecided())
      cull();
    for (std::uint32_t k = 0; k < undecided_.size; ++k) {
      const std::uint32_t pair = undecided_.pair[k];
      if (coincide(pair)) continue;  // the state is `overlap` already
      traversal_.add(
          begin + pair, state_without_hit(pair), transforms_.transform(pair), transforms_.root_a[pair],
          transforms_.root_b[pair],
          shapes_.max_extent[transforms_.shape_a[pair]] + shapes_.max_extent[transforms_.shape_b[pair]],
          segment_margin(pair), gaps_of(pair));
    }
    end_stage<Simd>(Stage::add, undecided_.size);
  }

  /// Returns whether both agents have the same cut, position and heading, so that they collide. Traversing them would be
  /// slowest: all leaves are near each other, and no crossing is sure.
  bool coincide(std::uint32_t pair) const noexcept {
    const auto [c, s, tx, ty] = transforms_.transform(pair);
    return transforms_.root_a[pair] == transforms_.root_b[pair] && s == 0 && tx == 0 && ty == 0 && c > 0;
  }

  double segment_margin(std::uint32_t pair) const noexcept {
    if (!in_.exact_leaves) return 0;
    return detail::segment_margin<Simd>(shapes_, transforms_.shape_a[pair], transforms_.shape_b[pair]);
  }

  Gaps gaps_of(std::uint32_t pair) const noexcept {
    if constexpr (KnowsGaps<Simd>) return {transforms_.gap[pair], transforms_.bound_gap[pair]};
    return {0, 0};
  }

  /// Tests root disc against root disc, lane = pair. Where both cuts are single discs, that is the answer.
  void test_roots() noexcept {
    axis_test_.use_rows(row_a_, row_b_);
    for (std::uint32_t k = 0; k < transforms_.whole_registers(); k += Simd::width) {
      Float a[4], b[4];
      Simd::template load_records<4>(&shapes_.roots->x, transforms_.root_a + k, a);
      Simd::template load_records<4>(&shapes_.roots->x, transforms_.root_b + k, b);
      Simd::store(reinterpret_cast<float*>(row_a_ + k), a[3]);
      Simd::store(reinterpret_cast<float*>(row_b_ + k), b[3]);
      const auto [x, y] = transforms_.transforms(k).apply(b[0], b[1]);
      const std::uint32_t overlaps = roots_overlap(k, x - a[0], y - a[1], a[2] + b[2]);
      std::uint32_t undecided = 0;
      for (std::uint32_t lane = 0; lane < lanes(k); ++lane) {
        const std::uint32_t decided = both_are_single(k + lane);
        // within() rejects only pairs of single discs here, because leaf discs within its distance may
        // stick out of the roots. collide() rejects every pair whose roots are apart.
        const std::uint32_t hit = (overlaps >> lane & 1) | (KnowsGaps<Simd> & (decided ^ 1));
        states_[k + lane] = static_cast<std::uint8_t>(hit * overlap);
        undecided |= (hit & (decided ^ 1)) << lane;
      }
      undecided_bits_[k / Simd::width] = undecided;
    }
  }

  [[gnu::always_inline]] std::uint32_t roots_overlap(std::uint32_t k, Float x, Float y,
                                                     Float r) const noexcept {
    if constexpr (KnowsGaps<Simd>) r = r * Float(radius_factor) + Simd::load(transforms_.gap + k);
    return Simd::bits(x * x + y * y <= r * r);
  }

  std::uint32_t both_are_single(std::uint32_t k) const noexcept {
    return (row_a_[k] | row_b_[k]) == single_disc;
  }

  /// Returns whether a pair of the packet is undecided. In a set of single discs, test_roots() has decided all.
  bool any_undecided() const noexcept {
    std::uint32_t any = 0;
    for (std::uint32_t k = 0; k < transforms_.whole_registers(); k += Simd::width)
      any |= undecided_bits_[k / Simd::width];
    return any != 0;
  }

  void list_undecided() noexcept {
    for (std::uint32_t k = 0; k < transforms_.size; ++k)
      undecided_.add_if(undecided_bits_[k / Simd::width] >> k % Simd::width & 1, k);
  }

  /// Decides the pairs that need no traversal, and lists the others in undecided_. Here states begin as `overlap`, and
  /// only separation changes them: areas that meet are a hit, whether outlines cross or one contains the other.
  [[gnu::noinline]] void cull() noexcept {
    compare_profiles();
    end_stage<Simd>(Stage::profiles, transforms_.size);
    axis_test_.place_directions();
    separate(0, Stage::even_supports);
    accept<block_width / 2>(likely_, Stage::inscribed_four);
    accept<block_width>(undecided_, Stage::inscribed_eight);
    separate(1, Stage::odd_supports);
  }

  /// Rejects the undecided pairs that supports along even directions, or odd ones, show to be apart.
  void separate(unsigned odd, Stage stage) noexcept {
    const std::uint32_t tests = undecided_.size;
    undecided_.drop_if(
        undecided_,
        [&](std::uint32_t pair) {
          const std::uint32_t is_apart = axis_test_.apart(pair, odd, profiles_.excess(pair));
          states_[pair] = static_cast<std::uint8_t>(overlap * (is_apart ^ 1));
          return is_apart;
        },
        [&](std::uint32_t pair) __attribute__((always_inline)) {
          if (in_.prefetch_shapes) axis_test_.prefetch(pair, odd);
        });
    end_stage<Simd>(stage, tests);
  }

  /// Accepts each listed pair if one of A's first `count` inscribed discs overlaps one of B's first `count`. Moves the
  /// other pairs to undecided_.
  template <unsigned count>
  void accept(List& list, Stage stage) noexcept {
    const std::uint32_t tests = list.size;
    list.drop_if(
        undecided_, [&](std::uint32_t pair) { return inscribed_discs_overlap<count>(pair); },
        [&](std::uint32_t pair) __attribute__((always_inline)) {
          if (in_.prefetch_shapes) prefetch_inscribed(pair);
        });
    end_stage<Simd>(stage, tests);
  }

  /// Answers the pairs that profiles decide, and lists the others in likely_ or undecided_.
  void compare_profiles() noexcept {
    shapes_.rows_follow_roots ? profiles_.load_sectors(nullptr, nullptr)
                              : profiles_.load_sectors(row_a_, row_b_);
    separated_.size = 0;
    for (std::uint32_t k = 0; k < transforms_.whole_registers(); k += Simd::width) {
      const auto answers = profiles_.answers(k);
      const std::uint32_t all = undecided_bits_[k / Simd::width] & ((std::uint32_t{1} << lanes(k)) - 1);
      const std::uint32_t undecided = all & ~(answers.apart | answers.meet);
      may_nest_[k / Simd::width] = answers.may_nest;
      separated_.add(all & answers.apart, k);
      likely_.add(undecided & answers.likely, k);
      undecided_.add(undecided & ~answers.likely, k);
    }
    for (std::uint32_t k = 0; k < separated_.size; ++k) states_[separated_.pair[k]] = apart;
  }

  /// Returns the number of pairs in the register that begins with pair k.
  std::uint32_t lanes(std::uint32_t k) const noexcept {
    return transforms_.size - k < Simd::width ? transforms_.size - k : Simd::width;
  }

  /// Returns the state of a pair whose cuts do not overlap.
  std::uint8_t state_without_hit(std::uint32_t pair) const noexcept {
    return static_cast<std::uint8_t>(shapes_.support == nullptr ? state_without_hit_
                                                                : state_without_hit_ * may_nest(pair));
  }

  std::uint32_t may_nest(std::uint32_t pair) const noexcept {
    return may_nest_[pair / Simd::width] >> pair % Simd::width & 1;
  }

  /// Returns whether two inscribed discs overlap, so that the areas meet. See layout/culling/interior.hpp.
  template <unsigned count>
  std::uint32_t inscribed_discs_overlap(std::uint32_t pair) const noexcept {
    const Discs a = inscribed(transforms_.shape_a[pair]), b = inscribed(transforms_.shape_b[pair]);
    if constexpr (KnowsGaps<Simd>)
      return near_discs<Simd, count>(transforms_.transform(pair), a, b, 1,
                                     sure_gap * transforms_.gap[pair]) != 0;
    return overlapping_discs<Simd, count>(transforms_.transform(pair), a, b) != 0;
  }

  [[gnu::always_inline]] void prefetch_inscribed(std::uint32_t pair) const noexcept {
    const std::uint32_t both[] = {transforms_.shape_a[pair], transforms_.shape_b[pair]};
    for (const std::uint32_t shape : both) {
      __builtin_prefetch(shapes_.inscribed[shape].x);
      __builtin_prefetch(shapes_.inscribed[shape].radius);
    }
  }

  Discs inscribed(std::uint32_t shape) const noexcept {
    return {shapes_.inscribed[shape].x, block_width, 2 * block_width};
  }

  const Arguments& in_;
  const ShapeSetView shapes_;
  const std::uint8_t state_without_hit_;
  std::uint8_t* states_ = nullptr;  ///< of the packet
  RelativeTransforms<Simd> transforms_;
  SeparatingAxisTest<Simd> axis_test_;
  ProfileTest<Simd> profiles_;
  alignas(64) std::uint32_t row_a_[packet_size], row_b_[packet_size];  ///< of supports; set by test_roots()
  /// One word for each register of pairs: a bit for each of its pairs.
  std::uint32_t undecided_bits_[packet_size / Simd::width], may_nest_[packet_size / Simd::width];
  List undecided_, likely_, separated_;
  OverlapTraversal<Simd, max_traversals> traversal_;
};

}  // namespace bch::detail
