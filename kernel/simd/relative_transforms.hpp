// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/agents.hpp>

#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/arguments.hpp"
#include "kernel/simd/gaps.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Computes the transforms from B's frame into A's for a packet of pairs, lane = pair. This is the first stage of the pair
/// kernel.
template <class Simd>
class RelativeTransforms {
 public:
  /// Computes the transforms of pairs begin .. end, one packet at most.
  void compute(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
    size = end - begin < packet_size ? static_cast<std::uint32_t>(end - begin) : packet_size;
    load_agents(in, begin);
    in.prefetch_agents ? find_roots<true>(in) : find_roots<false>(in);
    turn(in);
  }

  Transform transform(std::uint32_t pair) const noexcept { return {c[pair], s[pair], tx[pair], ty[pair]}; }
  /// Returns the transforms of the register of pairs that begins with k.
  TransformOf<typename Simd::Float> transforms(std::uint32_t k) const noexcept {
    return {Simd::load(c + k), Simd::load(s + k), Simd::load(tx + k), Simd::load(ty + k)};
  }

  /// Returns A's heading.
  UnitVector heading(std::uint32_t pair) const noexcept { return {cosine_[pair], sine_[pair]}; }

  /// Returns the size, rounded up to whole registers of floats.
  std::uint32_t whole_registers() const noexcept {
    return (size + Simd::width - 1) / Simd::width * Simd::width;
  }

  /// Sets the gaps of all pairs; `begin` is the index of the first one in the batch.
  void set_gaps(const Arguments& in, std::size_t begin) noexcept {
    // A set of roots alone has no extents and nothing to bound.
    const float* const max_extent = in.shapes->max_extent;
    for (std::uint32_t k = 0; k < whole_registers(); ++k) {
      const float distance = in.gaps[begin + (k < size ? k : size - 1)];
      const auto [leaf, bound] =
          gaps<Simd>(distance, max_extent == nullptr ? 0 : max_extent[shape_a[k]] + max_extent[shape_b[k]]);
      gap[k] = leaf, bound_gap[k] = bound;
    }
  }

  std::uint32_t agent_a(std::uint32_t pair) const noexcept { return a_[pair]; }
  std::uint32_t agent_b(std::uint32_t pair) const noexcept { return b_[pair]; }

  std::uint32_t size = 0;

  // Up to whole_registers(), lanes beyond the last pair repeat it. The transform is as in layout/base/rounding.hpp.
  alignas(64) float c[packet_size], s[packet_size], tx[packet_size], ty[packet_size];
  std::uint32_t shape_a[packet_size], shape_b[packet_size];
  std::uint32_t root_a[packet_size], root_b[packet_size];  ///< shape * level_count + level
  alignas(64) float gap[packet_size],
      bound_gap[packet_size];  ///< see Gaps; where KnowsGaps

 private:
  static constexpr std::uint32_t pairs_ahead = 32;  ///< how many pairs ahead agents are prefetched

  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  using Columns = AgentColumns<Simd>;
  static constexpr std::uint32_t doubles = Simd::doubles;        ///< per register
  static constexpr std::uint32_t parts = Simd::width / doubles;  ///< such registers for one of floats

  /// Loads the agents of each pair. The lower index is A, so that the order within a pair does not matter.
  void load_agents(const Arguments& in, std::size_t begin) noexcept {
    const Pair* const __restrict pairs = in.pairs + begin;
    const std::uint32_t count = size, whole = count / Simd::width * Simd::width;
    const auto store_ordered = [&](std::uint32_t k) {
      const auto [first, second] = pairs[k];
      a_[k] = second < first ? second : first;
      b_[k] = second < first ? first : second;
    };
    for_whole_registers<Simd>(whole, store_ordered);
    for (std::uint32_t k = whole; k < count; ++k) store_ordered(k);
    for (std::uint32_t k = count; k < whole_registers(); ++k) a_[k] = a_[count - 1], b_[k] = b_[count - 1];
  }

  /// Finds the root of each agent's shape at its level. With `prefetch`, it also prefetches all that turn()
  /// needs of agents.
  template <bool prefetch>
  void find_roots(const Arguments& in) noexcept {
    // Copies: the compiler has to assume that the stores below may change `in`.
    const AgentColumn shape = in.agent_shape, level = in.agent_level;
    const std::uint32_t levels = in.shapes->level_count;
    const std::uint32_t count = whole_registers();
    for (std::uint32_t k = 0; k < count; k += Simd::width) {
      // This is not a function of its own: GCC 12 drops the call of one that only prefetches.
      if (prefetch && k + pairs_ahead < count)
        for (std::uint32_t lane = 0; lane < Simd::width; ++lane) {
          const std::uint32_t both[] = {a_[k + pairs_ahead + lane], b_[k + pairs_ahead + lane]};
          for (const std::uint32_t agent : both) {
            Columns::prefetch(shape, agent);
            Columns::prefetch(in.agent_x, agent);
            Columns::prefetch(in.agent_y, agent);
            Columns::prefetch(in.agent_heading, agent);
            if (in.agent_heading_y.first != nullptr) Columns::prefetch(in.agent_heading_y, agent);
            if (level.first != nullptr) Columns::prefetch(level, agent);
          }
        }
      Columns::copy(shape, a_ + k, shape_a + k);
      Columns::copy(shape, b_ + k, shape_b + k);
    }
    for_whole_registers<Simd>(count, [&](std::uint32_t k) {
      root_a[k] = shape_a[k] * levels + levels - 1;
      root_b[k] = shape_b[k] * levels + levels - 1;
    });
    if (level.first == nullptr) return;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t level_a = Columns::template at<std::uint8_t>(level, a_[k]),
                          level_b = Columns::template at<std::uint8_t>(level, b_[k]);
      root_a[k] -= levels - 1 - level_a;
      root_b[k] -= levels - 1 - level_b;
    }
  }

  struct UnitVectors {
    Float cosine, sine;
  };

  /// Does what layout/base/heading.cpp does, in lanes.
  [[gnu::always_inline]] static UnitVectors unit_vectors(const AgentColumn& heading,
                                                         const std::uint32_t* agent) noexcept {
    namespace h = heading_constants;
    const auto round_to_integer = [](Double x) {
      return (x + Double(h::round_to_integer)) - Double(h::round_to_integer);
    };
    Double all_sines[parts], all_cosines[parts], left_quarters[parts];
#pragma GCC unroll 2
    for (std::uint32_t part = 0; part < parts; ++part) {
      const Double angle = Columns::numbers(heading, agent + part * doubles);
      const Double quarters = round_to_integer(angle * Double(h::two_over_pi));
      Double r = angle - quarters * Double(h::half_pi[0]);
      r = r - quarters * Double(h::half_pi[1]);
      r = r - quarters * Double(h::half_pi[2]);
      r = r - quarters * Double(h::half_pi[3]);
      const Double square = r * r;
      Double sines(h::sine[0]), cosines(h::cosine[0]);
      for (int i = 1; i < 5; ++i)
        sines = sines * square + Double(h::sine[i]), cosines = cosines * square + Double(h::cosine[i]);
      all_sines[part] = sines * square * r + r;
      all_cosines[part] = cosines * square + Double(1.0);
      left_quarters[part] = quarters - Double(4.0) * round_to_integer(quarters * Double(0.25));
    }
    // The remaining quarter turns multiply by 0 and +-1, so rounding to float before or after them gives the same.
    const Float c = Simd::to_float(all_cosines), s = Simd::to_float(all_sines),
                left = Simd::to_float(left_quarters);
    const Float turn_c = Float(1.0f) - xsimd::abs(left), turn_s = left * (Float(2.0f) - xsimd::abs(left));
    return {c * turn_c - s * turn_s, s * turn_c + c * turn_s};
  }

  /// Does the same with directions.
  static UnitVectors unit_vectors(const AgentColumn& x, const AgentColumn& y,
                                  const std::uint32_t* agent) noexcept {
    namespace h = heading_constants;
    Double sines[parts], cosines[parts];
    for (std::uint32_t part = 0; part < parts; ++part) {
      Double c = Columns::numbers(x, agent + part * doubles), s = Columns::numbers(y, agent + part * doubles);
      for (int i = 0; i < 2; ++i) {
        const Double by = Double(h::newton[0]) - Double(h::newton[1]) * (c * c + s * s);
        c = c * by, s = s * by;
      }
      cosines[part] = c, sines[part] = s;
    }
    return {Simd::to_float(cosines), Simd::to_float(sines)};
  }

  [[gnu::always_inline]] static UnitVectors unit_vectors(const Arguments& in,
                                                         const std::uint32_t* agent) noexcept {
    if (in.agent_heading_y.first == nullptr) [[likely]]
      return unit_vectors(in.agent_heading, agent);
    return unit_vectors(in.agent_heading, in.agent_heading_y, agent);
  }

  /// Returns B's coordinate minus A's.
  static Float difference(const AgentColumn& x, const std::uint32_t* a, const std::uint32_t* b) noexcept {
    Double between[parts];
#pragma GCC unroll 2
    for (std::uint32_t part = 0; part < parts; ++part) {
      const Double to = Columns::numbers(x, b + part * doubles),
                   from = Columns::numbers(x, a + part * doubles);
      between[part] = to - from;
    }
    return Simd::to_float(between);
  }

  /// Computes B's rotation and position in A's frame.
  void turn(const Arguments& in) noexcept {
    for (std::uint32_t k = 0; k < whole_registers(); k += Simd::width) {
      const auto [ca, sa] = unit_vectors(in, a_ + k);
      const auto [cb, sb] = unit_vectors(in, b_ + k);
      const Float dx = difference(in.agent_x, a_ + k, b_ + k), dy = difference(in.agent_y, a_ + k, b_ + k);
      Simd::store(cosine_ + k, ca), Simd::store(sine_ + k, sa);
      Simd::store(c + k, ca * cb + sa * sb);
      Simd::store(s + k, ca * sb - sa * cb);
      Simd::store(tx + k, ca * dx + sa * dy);
      Simd::store(ty + k, ca * dy - sa * dx);
    }
  }

  alignas(64) std::uint32_t a_[packet_size], b_[packet_size];  ///< agents, padded as above
  alignas(64) float cosine_[packet_size], sine_[packet_size];
};

}  // namespace bch::detail
