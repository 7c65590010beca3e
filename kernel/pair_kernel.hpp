// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/arguments.hpp"
#include "kernel/lanes.hpp"
#include "kernel/placements.hpp"
#include "layout/shape_set_view.hpp"

namespace bch::kernel {

/// The pair query, written once. `Simd` is a Lanes<Arch> with bits(). Every float operation that decides an
/// answer is one of those listed in layout/rounding.hpp, in that order, so that all instantiations and the
/// scalar reference agree bit for bit.
///
/// Pairs are answered in chunks. Stage 1 places B in A's frame and tests the root discs, lane = pair. Stage 2
/// parts pairs by their supports in fixed directions, lane = direction. Stage 3 accepts pairs whose inscribed
/// discs overlap. Stage 4 walks the trees of the pairs left, in rounds: each round tests one pair of blocks,
/// 8 x 8 discs, for every open pair, so that the cache misses and the latencies of many pairs overlap and no
/// branch depends on an answer.
template <class Simd>
class PairKernel {
 public:
  static void run(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    PairKernel kernel(arguments);
    for (; begin < end; begin += kernel.size_) {
      kernel.size_ = end - begin < chunk ? static_cast<std::uint32_t>(end - begin) : chunk;
      kernel.at_.place(arguments, begin, kernel.size_);
      kernel.test_roots(begin);
      if (kernel.shapes_.support && kernel.open_count_ > 0) kernel.reject_by_supports(begin);
      if (kernel.shapes_.inscribed_x && kernel.open_count_ > 0) kernel.accept_by_inscribed_discs(begin);
      kernel.walk(begin);
    }
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;
  static constexpr std::uint32_t chunk = Placements<Simd>::chunk;
  /// Every test descends on one side at least, and neither side has more levels than this.
  static constexpr std::uint32_t most_frames = 2 * most_wide_levels;

  /// Two blocks whose discs overlap at the set bits (8 i + j: disc i of A, disc j of B), none of which was
  /// followed yet.
  struct Frame {
    std::uint32_t a, b;
    std::uint64_t open;
  };

  explicit PairKernel(const Arguments& arguments) noexcept : in_(arguments), shapes_(*arguments.shapes) {}

  /// Stage 1, after placing: root disc against root disc. Pairs that this does not decide become open.
  void test_roots(std::size_t begin) noexcept {
    alignas(64) float a_x[chunk], a_y[chunk], a_r[chunk], b_x[chunk], b_y[chunk], b_r[chunk];
    const std::uint32_t padded = (size_ + Simd::width - 1) / Simd::width * Simd::width;
    for (std::uint32_t k = 0; k < padded; ++k) {
      const std::uint32_t a = at_.root_a[k], b = at_.root_b[k];
      a_x[k] = shapes_.root_x[a], a_y[k] = shapes_.root_y[a], a_r[k] = shapes_.root_radius[a];
      b_x[k] = shapes_.root_x[b], b_y[k] = shapes_.root_y[b], b_r[k] = shapes_.root_radius[b];
    }
    open_count_ = 0;
    std::uint8_t* __restrict codes = in_.codes + begin;
    for (std::uint32_t k = 0; k < size_; k += Simd::width) {
      const Float c = Simd::load(at_.c + k), s = Simd::load(at_.s + k), tx = Simd::load(at_.tx + k),
                  ty = Simd::load(at_.ty + k);
      const Float bx = Simd::load(b_x + k), by = Simd::load(b_y + k);
      const std::uint32_t hits = overlaps(tx + (c * bx - s * by), ty + (s * bx + c * by), Simd::load(b_r + k),
                                          Simd::load(a_x + k), Simd::load(a_y + k), Simd::load(a_r + k));
      const std::uint32_t lanes = size_ - k < Simd::width ? size_ - k : Simd::width;
      for (std::uint32_t lane = 0; lane < lanes; ++lane) open_root(k + lane, hits >> lane & 1, codes);
    }
  }

  void open_root(std::uint32_t k, std::uint32_t hit, std::uint8_t* __restrict codes) noexcept {
    const std::uint32_t a = at_.root_a[k], b = at_.root_b[k];
    const std::uint32_t decided = shapes_.root_is_single[a] & shapes_.root_is_single[b];
    codes[k] = static_cast<std::uint8_t>(hit * (decided ? overlap : near_miss));
    open_[open_count_] = static_cast<std::uint16_t>(k);
    open_count_ += hit & (decided ^ 1);
  }

  /// Stage 2: apart where a line parts the two cuts. See layout/supports.hpp.
  void reject_by_supports(std::size_t begin) noexcept {
    place_directions();
    std::uint8_t* __restrict codes = in_.codes + begin;
    std::uint32_t still_open = 0;
    for (std::uint32_t k = 0; k < open_count_; ++k) {
      const std::uint32_t pair = open_[k];
      const std::uint32_t parted = parted_by_supports(pair);
      codes[pair] = static_cast<std::uint8_t>(near_miss * (parted ^ 1));
      open_[still_open] = static_cast<std::uint16_t>(pair);
      still_open += parted ^ 1;
    }
    open_count_ = still_open;
  }

  /// Against A's direction k stands B's direction k * D + psi, with D the angle between directions and psi =
  /// pi - (B's turn in A's frame). psi = (offset + share) * D with 0 <= share <= 1, and a support between two
  /// directions is at most lower * (that of the one below) + upper * (that of the one above), the height of
  /// the corner of two supporting lines.
  void place_directions() noexcept {
    static_assert(support_directions == 16);
    constexpr float tan_1 = 0.41421356f, tan_3 = 2.41421356f, cot_1 = 2.41421356f,
                    one_over_sin_1 = 2.61312593f;
    constexpr float cos_1 = 0.92387953f, cos_2 = 0.70710678f, cos_3 = 0.38268343f;
    alignas(64) float offset[chunk];
    const Float zero(0.0f);
    for (std::uint32_t k = 0; k < size_; k += Simd::width) {
      const Float x = zero - Simd::load(at_.c + k), y = Simd::load(at_.s + k);
      const Float ax = xsimd::abs(x), ay = xsimd::abs(y);
      const auto past_1 = Float(tan_1) * ax < ay, past_2 = ax < ay, past_3 = Float(tan_3) * ax < ay;
      const auto among = [&](float at_0, float at_1, float at_2, float at_3) {
        return Simd::select(
            past_3, Float(at_3),
            Simd::select(past_2, Float(at_2), Simd::select(past_1, Float(at_1), Float(at_0))));
      };
      const Float cosine = among(1, cos_1, cos_2, cos_3), sine = among(0, cos_3, cos_2, cos_1);
      const Float rest_cosine = ax * cosine + ay * sine, rest_sine = ay * cosine - ax * sine;
      const Float near = rest_cosine - Float(cot_1) * rest_sine, far = Float(one_over_sin_1) * rest_sine;
      // No operator on masks: in xsimd 8.1, != is wrong with SSE2 (it compares as floats, and a full mask is
      // a NaN) and ^ with AVX-512.
      const Mask left = x < zero, below = y < zero;
      const auto by_quadrant = [&](Float first, Float second, Float third, Float fourth) {
        return Simd::select(left, Simd::select(below, third, second), Simd::select(below, fourth, first));
      };
      const Float up = among(0, 1, 2, 3);
      Simd::store(offset + k, by_quadrant(up, Float(7.0f) - up, Float(8.0f) + up, Float(15.0f) - up));
      Simd::store(lower_ + k, by_quadrant(near, far, near, far));
      Simd::store(upper_ + k, by_quadrant(far, near, far, near));
    }
    for (std::uint32_t k = 0; k < size_; ++k) offset_[k] = static_cast<std::uint8_t>(offset[k]);
  }

  std::uint32_t parted_by_supports(std::uint32_t pair) const noexcept {
    const float* a = shapes_.support + std::size_t{at_.root_a[pair]} * support_stride;
    const float* b = shapes_.support + std::size_t{at_.root_b[pair]} * support_stride + offset_[pair];
    const Float tx(at_.tx[pair]), ty(at_.ty[pair]), lower(lower_[pair]), upper(upper_[pair]);
    std::uint32_t parted = 0;
    for (unsigned k = 0; k < support_directions; k += Simd::width) {
      const Float distance = tx * Simd::load(direction_x + k) + ty * Simd::load(direction_y + k);
      const Float reach = Simd::load(a + k) + (lower * Simd::load(b + k) + upper * Simd::load(b + k + 1));
      parted |= Simd::bits(reach < distance);
    }
    return parted != 0;
  }

  static std::uint32_t overlaps(Float bx, Float by, Float br, Float ax, Float ay, Float ar) noexcept {
    const Float x = bx - ax, y = by - ay, r = ar + br;
    return Simd::bits(x * x + y * y <= r * r);
  }

  /// Stage 3: a hit where discs inside the outlines overlap, and in boundary semantics neither can hold the
  /// other. See layout/interior.hpp.
  void accept_by_inscribed_discs(std::size_t begin) noexcept {
    std::uint8_t* __restrict codes = in_.codes + begin;
    std::uint32_t still_open = 0;
    for (std::uint32_t k = 0; k < open_count_; ++k) {
      const std::uint32_t pair = open_[k];
      const std::uint32_t a = at_.shape_a[pair], b = at_.shape_b[pair];
      const bool meet = outer_product(pair, inscribed(a), inscribed(b)) != 0;
      const std::uint32_t accepted = meet & (in_.mark_near_misses || cannot_nest(pair, a, b));
      codes[pair] = static_cast<std::uint8_t>(near_miss - accepted);
      open_[still_open] = static_cast<std::uint16_t>(pair);
      still_open += accepted ^ 1;
    }
    open_count_ = still_open;
  }

  /// Both contours have a point beyond the other's supports.
  bool cannot_nest(std::uint32_t pair, std::uint32_t a, std::uint32_t b) const noexcept {
    const float c = at_.c[pair], s = at_.s[pair], tx = at_.tx[pair], ty = at_.ty[pair];
    const unsigned nearer = upper_[pair] > lower_[pair];
    const unsigned turn = (offset_[pair] + support_directions / 2 + nearer) % support_directions;
    const unsigned back = (support_directions - turn) % support_directions;
    // The float arithmetic is off by less than 40 u S.
    const float slack = 4e-6f * (shapes_.reach[a] + shapes_.reach[b]);
    return sticks_out(b, turn, c, s, tx, ty, at_.root_a[pair], slack) &
           sticks_out(a, back, c, -s, -(c * tx + s * ty), -(c * ty - s * tx), at_.root_b[pair], slack);
  }

  /// Whether a farthest point of a shape, placed in another's frame by a rotation (c, s) and a translation t,
  /// is beyond one of the other's supports. Its direction k + turn is the one that points most nearly along
  /// the other's direction k.
  bool sticks_out(std::uint32_t shape, unsigned turn, float c, float s, float tx, float ty,
                  std::uint32_t other_root, float slack) const noexcept {
    const float* x = shapes_.extreme_x + std::size_t{shape} * extreme_stride + turn;
    const float* y = shapes_.extreme_y + std::size_t{shape} * extreme_stride + turn;
    const float* support = shapes_.support + std::size_t{other_root} * support_stride;
    std::uint32_t out = 0;
    for (unsigned k = 0; k < support_directions; k += Simd::width) {
      const Float ux = Simd::load(direction_x + k), uy = Simd::load(direction_y + k);
      const Float turned_x = Float(c) * ux + Float(s) * uy, turned_y = Float(c) * uy - Float(s) * ux;
      const Float along =
          (Float(tx) * ux + Float(ty) * uy) + (Simd::load(x + k) * turned_x + Simd::load(y + k) * turned_y);
      out |= Simd::bits(Simd::load(support + k) + Float(slack) < along);
    }
    return out != 0;
  }

  /// Stage 4.
  void walk(std::size_t begin) noexcept {
    std::uint8_t* __restrict codes = in_.codes + begin;
    for (std::uint32_t k = 0; k < open_count_; ++k) {
      const std::uint32_t pair = open_[k];
      a_[pair] = shapes_.root_block[at_.root_a[pair]];
      b_[pair] = shapes_.root_block[at_.root_b[pair]];
      allowed_[pair] = ~std::uint64_t{0};
      depth_[pair] = 0;
    }
    while (open_count_ > 0) {
      std::uint32_t still_open = 0;
      for (std::uint32_t k = 0; k < open_count_; ++k) {
        const std::uint32_t pair = open_[k];
        const std::uint64_t hits = outer_product(pair, block(a_[pair]), block(b_[pair])) & allowed_[pair];
        const std::uint32_t hit = (hits & leaf_bits(a_[pair], b_[pair])) != 0;
        codes[pair] = static_cast<std::uint8_t>(near_miss - hit);
        const bool more = descend(pair, hits);
        open_[still_open] = static_cast<std::uint16_t>(pair);
        still_open += more & (hit ^ 1);
      }
      open_count_ = still_open;
    }
    if (!in_.mark_near_misses)
      for (std::uint32_t k = 0; k < size_; ++k) codes[k] = codes[k] & overlap;
  }

  /// Eight discs.
  struct Discs {
    const float *x, *y, *radius;
  };
  Discs block(std::uint32_t index) const noexcept {
    const std::size_t at = std::size_t{index} * block_width;
    return {shapes_.x + at, shapes_.y + at, shapes_.radius + at};
  }
  Discs inscribed(std::uint32_t shape) const noexcept {
    const std::size_t at = std::size_t{shape} * block_width;
    return {shapes_.inscribed_x + at, shapes_.inscribed_y + at, shapes_.inscribed_radius + at};
  }

  /// All discs of one agent's eight against all of the other's: bit 8 i + j for disc i of A and j of B.
  std::uint64_t outer_product(std::uint32_t pair, Discs a, Discs b) const noexcept {
    constexpr unsigned parts = Simd::width < block_width ? block_width / Simd::width : 1;
    constexpr unsigned rows = Simd::width > block_width ? Simd::width / block_width : 1;
    const Float c(at_.c[pair]), s(at_.s[pair]), tx(at_.tx[pair]), ty(at_.ty[pair]);
    std::uint64_t bits = 0;
    for (unsigned part = 0; part < parts; ++part) {
      const Float x = Simd::columns(b.x, part), y = Simd::columns(b.y, part),
                  r = Simd::columns(b.radius, part);
      const Float px = tx + (c * x - s * y), py = ty + (s * x + c * y);
      for (unsigned row = 0; row < block_width; row += rows)
        bits |= static_cast<std::uint64_t>(
                    overlaps(px, py, r, Simd::row(a.x, row), Simd::row(a.y, row), Simd::row(a.radius, row)))
                << (row * block_width + part * Simd::width);
    }
    return bits;
  }

  static constexpr std::uint64_t every_row = 0x0101010101010101;

  /// Where both discs belong to the cut. (Padding never hits.)
  std::uint64_t leaf_bits(std::uint32_t a, std::uint32_t b) const noexcept {
    const unsigned inner_a = shapes_.inner_count[a], inner_b = shapes_.inner_count[b];
    const std::uint64_t rows = ~std::uint64_t{0} << 4 * inner_a
                                                 << 4 * inner_a;  // in two steps: 64 is too far for one
    const std::uint64_t columns = (0xff << inner_b & 0xff) * every_row;
    return rows & columns;
  }

  /// Keeps the hits for later, takes the next open one, and names the pair of blocks to test: the children of
  /// the two discs, or where one is a disc of the cut, its own block again with only that disc allowed.
  /// False: nothing is left.
  bool descend(std::uint32_t pair, std::uint64_t hits) noexcept {
    std::uint32_t depth = depth_[pair];
    frames_[depth][pair] = {a_[pair], b_[pair], hits};
    depth += hits != 0;
    const bool any = depth != 0;

    // Where nothing is left, what follows computes something that is never used, which beats a branch.
    Frame& top = frames_[depth - any][pair];
    const auto bit = static_cast<unsigned>(__builtin_ctzll(top.open | std::uint64_t{1} << 63));
    top.open &= top.open - 1;
    const unsigned i = bit / block_width, j = bit % block_width;
    const bool inner_a = i < shapes_.inner_count[top.a], inner_b = j < shapes_.inner_count[top.b];
    a_[pair] = inner_a ? shapes_.first_child[top.a] + i : top.a;
    b_[pair] = inner_b ? shapes_.first_child[top.b] + j : top.b;
    allowed_[pair] = (inner_a ? ~std::uint64_t{0} : std::uint64_t{0xff} << (i * block_width)) &
                     (inner_b ? ~std::uint64_t{0} : every_row << j);
    depth_[pair] = static_cast<std::uint8_t>(depth - (top.open == 0));
    return any;
  }

  static constexpr float c1 = 0.92387953f, c2 = 0.70710678f, c3 = 0.38268343f;
  alignas(64) static constexpr float direction_x[] = {1,  c1,  c2,  c3,  0, -c3, -c2, -c1,
                                                      -1, -c1, -c2, -c3, 0, c3,  c2,  c1};
  alignas(64) static constexpr float direction_y[] = {0, c3,  c2,  c1,  1,  c1,  c2,  c3,
                                                      0, -c3, -c2, -c1, -1, -c1, -c2, -c3};

  const Arguments& in_;
  const ShapeSetView shapes_;
  std::uint32_t size_ = 0;
  std::uint32_t open_count_ = 0;
  Placements<Simd> at_;
  std::uint8_t offset_[chunk];
  alignas(64) float lower_[chunk], upper_[chunk];
  std::uint32_t a_[chunk], b_[chunk];
  std::uint64_t allowed_[chunk];
  std::uint8_t depth_[chunk];
  std::uint16_t open_[chunk];
  Frame frames_[most_frames][chunk];
};

}  // namespace bch::kernel
