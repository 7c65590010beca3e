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
    gather(in, begin);
    turn();
  }

  Transform transform(std::uint32_t pair) const noexcept { return {c[pair], s[pair], tx[pair], ty[pair]}; }

  std::uint32_t size = 0;

  // Up to the next multiple of the padding, lanes beyond the last pair repeat it.
  alignas(64) float c[chunk], s[chunk], tx[chunk], ty[chunk];  ///< as in layout/rounding.hpp
  std::uint32_t shape_a[chunk], shape_b[chunk];
  std::uint32_t root_a[chunk], root_b[chunk];  ///< shape * level_count + level

 private:
  static constexpr std::uint32_t pairs_ahead = 32;  ///< that agents are prefetched

  using Float = typename Simd::Float;
  using Double = typename Simd::Double;

  /// Scalar: what the chunk's pairs need, side by side. The lower index is A, so that the order within a pair
  /// does not matter.
  void gather(const Arguments& in, std::size_t begin) noexcept {
    const std::uint32_t levels = in.shapes->level_count;
    for (std::uint32_t k = 0; k < size; ++k) {
      // Not a function of its own: GCC 12 drops the call of one that only prefetches.
      if (in.prefetch && k + pairs_ahead < size) {
        const Pair next = in.pairs[begin + k + pairs_ahead];
        const std::uint32_t both[] = {next.first, next.second};
        for (const std::uint32_t i : both) {
          __builtin_prefetch(in.agent_shape + i);
          __builtin_prefetch(in.agent_x + i);
          __builtin_prefetch(in.agent_y + i);
          __builtin_prefetch(in.agent_heading + i);
          if (in.agent_level) __builtin_prefetch(in.agent_level + i);
        }
      }
      const Pair pair = in.pairs[begin + k];
      const bool swap = pair.second < pair.first;
      const std::uint32_t a = swap ? pair.second : pair.first, b = swap ? pair.first : pair.second;
      const std::uint32_t level_a = in.agent_level ? in.agent_level[a] : levels - 1;
      const std::uint32_t level_b = in.agent_level ? in.agent_level[b] : levels - 1;
      shape_a[k] = in.agent_shape[a];
      shape_b[k] = in.agent_shape[b];
      root_a[k] = shape_a[k] * levels + level_a;
      root_b[k] = shape_b[k] * levels + level_b;
      dx_[k] = static_cast<float>(in.agent_x[b] - in.agent_x[a]);
      dy_[k] = static_cast<float>(in.agent_y[b] - in.agent_y[a]);
      heading_[k] = in.agent_heading[a];
      heading_[chunk + k] = in.agent_heading[b];
    }
    for (std::uint32_t k = size; k % padding != 0; ++k) {
      shape_a[k] = shape_a[size - 1], shape_b[k] = shape_b[size - 1];
      root_a[k] = root_a[size - 1], root_b[k] = root_b[size - 1];
      dx_[k] = dx_[size - 1], dy_[k] = dy_[size - 1];
      heading_[k] = heading_[size - 1], heading_[chunk + k] = heading_[chunk + size - 1];
    }
  }

  /// Unit vectors of the headings, then B's rotation and position in A's frame.
  void turn() noexcept {
    rotate(heading_, cosine_, sine_);
    rotate(heading_ + chunk, cosine_ + chunk, sine_ + chunk);
    for (std::uint32_t k = 0; k < size; k += Simd::width) {
      const Float ca = Simd::load(cosine_ + k), sa = Simd::load(sine_ + k);
      const Float cb = Simd::load(cosine_ + chunk + k), sb = Simd::load(sine_ + chunk + k);
      const Float dx = Simd::load(dx_ + k), dy = Simd::load(dy_ + k);
      Simd::store(c + k, ca * cb + sa * sb);
      Simd::store(s + k, ca * sb - sa * cb);
      Simd::store(tx + k, ca * dx + sa * dy);
      Simd::store(ty + k, ca * dy - sa * dx);
    }
  }

  /// layout/heading.cpp, in lanes.
  void rotate(const double* heading, float* cosine, float* sine) noexcept {
    namespace h = heading_constants;
    alignas(64) double c_out[chunk], s_out[chunk];
    const auto round_to_integer = [](Double x) {
      return (x + Double(h::round_to_integer)) - Double(h::round_to_integer);
    };
    constexpr std::uint32_t width = sizeof(Double) / sizeof(double);
    for (std::uint32_t k = 0; k < size; k += width) {
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
      sines = sines * square * r + r;
      cosines = cosines * square + Double(1.0);
      const Double left = quarters - Double(4.0) * round_to_integer(quarters * Double(0.25));
      const Double turn_c = Double(1.0) - xsimd::abs(left);
      const Double turn_s = left * (Double(2.0) - xsimd::abs(left));
      Simd::store(c_out + k, cosines * turn_c - sines * turn_s);
      Simd::store(s_out + k, sines * turn_c + cosines * turn_s);
    }
    for (std::uint32_t k = 0; k < size; ++k)
      cosine[k] = static_cast<float>(c_out[k]), sine[k] = static_cast<float>(s_out[k]);
    for (std::uint32_t k = size; k % padding != 0; ++k)
      cosine[k] = cosine[size - 1], sine[k] = sine[size - 1];
  }

  alignas(64) double heading_[2 * chunk];
  alignas(64) float cosine_[2 * chunk], sine_[2 * chunk];
  alignas(64) float dx_[chunk], dy_[chunk];
};

}  // namespace bch::kernel
