// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/arguments.hpp"
#include "kernel/block_test.hpp"
#include "kernel/lanes.hpp"
#include "layout/heading.hpp"
#include "layout/pair.hpp"
#include "layout/shape_set_view.hpp"

namespace bch::kernel {

/// Where the agents of a chunk of pairs stand: B seen from A, side by side. The first stage of the pair kernel.
template <class Simd>
class Placements {
 public:
  static constexpr std::uint32_t chunk = 256;
  static constexpr std::uint32_t padding = 16;  ///< lanes of the widest register

  /// Places `size` pairs from `begin` on, at most a chunk.
  void place(const Arguments& in, std::size_t begin, std::uint32_t count) noexcept {
    size = count;
    in.prefetch_agents ? gather<true>(in, begin) : gather<false>(in, begin);
    find_roots(in, begin);
    repeat_last();
    rotate(heading_, cosine_, sine_);
    rotate(heading_ + chunk, cosine_ + chunk, sine_ + chunk);
    turn();
  }

  Transform transform(std::uint32_t pair) const noexcept { return {c[pair], s[pair], tx[pair], ty[pair]}; }

  /// Of A.
  UnitVector heading(std::uint32_t pair) const noexcept { return {cosine_[pair], sine_[pair]}; }

  /// The size, filled up to whole registers of floats.
  std::uint32_t whole_registers() const noexcept {
    return (size + Simd::width - 1) / Simd::width * Simd::width;
  }

  std::uint32_t size = 0;

  // Up to the next multiple of the padding, lanes beyond the last pair repeat it.
  alignas(64) float c[chunk], s[chunk], tx[chunk], ty[chunk];  ///< as in layout/rounding.hpp
  std::uint32_t shape_a[chunk], shape_b[chunk];
  std::uint32_t root_a[chunk], root_b[chunk];  ///< shape * level_count + level

 private:
  static constexpr std::uint32_t pairs_ahead = 32;  ///< that agents are prefetched

  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  static constexpr std::uint32_t doubles = sizeof(Double) / sizeof(double);  ///< a register

  /// Scalar: what the chunk's pairs need, side by side.
  template <bool prefetch>
  void gather(const Arguments& in, std::size_t begin) noexcept {
    // What this writes might be these pointers, for all the compiler knows of `in`.
    const Pair* const pairs = in.pairs + begin;
    const std::uint32_t* const shape = in.agent_shape;
    const double *const x = in.agent_x, *const y = in.agent_y, *const heading = in.agent_heading;
    const std::uint32_t count = size;
    for (std::uint32_t k = 0; k < count; ++k) {
      // Not a function of its own: GCC 12 drops the call of one that only prefetches.
      if (prefetch && k + pairs_ahead < count) {
        const Pair next = pairs[k + pairs_ahead];
        const std::uint32_t both[] = {next.first, next.second};
        for (const std::uint32_t i : both) {
          __builtin_prefetch(shape + i);
          __builtin_prefetch(x + i);
          __builtin_prefetch(y + i);
          __builtin_prefetch(heading + i);
          if (in.agent_level) __builtin_prefetch(in.agent_level + i);
        }
      }
      const auto [a, b] = ordered(pairs[k]);
      shape_a[k] = shape[a];
      shape_b[k] = shape[b];
      dx_[k] = x[b] - x[a];
      dy_[k] = y[b] - y[a];
      heading_[k] = heading[a];
      heading_[chunk + k] = heading[b];
    }
  }

  /// The lower index is A, so that the order within a pair does not matter.
  static Pair ordered(Pair pair) noexcept {
    const bool swap = pair.second < pair.first;
    return {swap ? pair.second : pair.first, swap ? pair.first : pair.second};
  }

  void find_roots(const Arguments& in, std::size_t begin) noexcept {
    const std::uint32_t levels = in.shapes->level_count, count = size;
    for (std::uint32_t k = 0; k < count; ++k) {
      root_a[k] = shape_a[k] * levels + levels - 1;
      root_b[k] = shape_b[k] * levels + levels - 1;
    }
    if (!in.agent_level) return;
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto [a, b] = ordered(in.pairs[begin + k]);
      root_a[k] -= levels - 1 - in.agent_level[a];
      root_b[k] -= levels - 1 - in.agent_level[b];
    }
  }

  void repeat_last() noexcept {
    for (std::uint32_t k = size; k % padding != 0; ++k) {
      shape_a[k] = shape_a[size - 1], shape_b[k] = shape_b[size - 1];
      root_a[k] = root_a[size - 1], root_b[k] = root_b[size - 1];
      dx_[k] = dx_[size - 1], dy_[k] = dy_[size - 1];
      heading_[k] = heading_[size - 1], heading_[chunk + k] = heading_[chunk + size - 1];
    }
  }

  /// layout/heading.cpp, in lanes.
  void rotate(const double* heading, float* cosine, float* sine) const noexcept {
    namespace h = heading_constants;
    alignas(64) float quarter[chunk];
    const auto round_to_integer = [](Double x) {
      return (x + Double(h::round_to_integer)) - Double(h::round_to_integer);
    };
    for (std::uint32_t k = 0; k < whole_registers(); k += doubles) {
      const Double angle = Simd::load(heading + k);
      const Double quarters = round_to_integer(angle * Double(h::two_over_pi));
      Double r = angle - quarters * Double(h::half_pi[0]);
      r = r - quarters * Double(h::half_pi[1]);
      r = r - quarters * Double(h::half_pi[2]);
      r = r - quarters * Double(h::half_pi[3]);
      const Double square = r * r;
      Double sines(h::sine[0]), cosines(h::cosine[0]);
      for (int i = 1; i < 5; ++i)
        sines = sines * square + Double(h::sine[i]), cosines = cosines * square + Double(h::cosine[i]);
      Simd::store_rounded(sine + k, sines * square * r + r);
      Simd::store_rounded(cosine + k, cosines * square + Double(1.0));
      Simd::store_rounded(quarter + k, quarters - Double(4.0) * round_to_integer(quarters * Double(0.25)));
    }
    // The quarters that remain turn by 0 and +-1: rounded before or after, that is the same.
    for (std::uint32_t k = 0; k < size; k += Simd::width) {
      const Float ck = Simd::load(cosine + k), sk = Simd::load(sine + k), left = Simd::load(quarter + k);
      const Float turn_c = Float(1.0f) - xsimd::abs(left), turn_s = left * (Float(2.0f) - xsimd::abs(left));
      Simd::store(cosine + k, ck * turn_c - sk * turn_s);
      Simd::store(sine + k, sk * turn_c + ck * turn_s);
    }
  }

  /// B's rotation and position in A's frame.
  void turn() noexcept {
    for (std::uint32_t k = 0; k < whole_registers(); k += doubles) {
      Simd::store_rounded(tx + k, Simd::load(dx_ + k));
      Simd::store_rounded(ty + k, Simd::load(dy_ + k));
    }
    for (std::uint32_t k = 0; k < size; k += Simd::width) {
      const Float ca = Simd::load(cosine_ + k), sa = Simd::load(sine_ + k);
      const Float cb = Simd::load(cosine_ + chunk + k), sb = Simd::load(sine_ + chunk + k);
      const Float dx = Simd::load(tx + k), dy = Simd::load(ty + k);
      Simd::store(c + k, ca * cb + sa * sb);
      Simd::store(s + k, ca * sb - sa * cb);
      Simd::store(tx + k, ca * dx + sa * dy);
      Simd::store(ty + k, ca * dy - sa * dx);
    }
  }

  alignas(64) double heading_[2 * chunk], dx_[chunk], dy_[chunk];
  alignas(64) float cosine_[2 * chunk], sine_[2 * chunk];
};

}  // namespace bch::kernel
