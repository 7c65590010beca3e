// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/contact_time_arguments.hpp"
#include "kernel/contact_time_measure.hpp"
#include "kernel/nearest_walk.hpp"
#include "kernel/placements.hpp"

namespace bch::kernel {

/// The first contact of every pair that does not overlap now. Chunk by chunk: places B in A's frame and walks the
/// trees.
template <class Simd>
class ContactTimeKernel {
 public:
  static void run(const ContactTimeArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(ContactTimeKernel) <= 256 * 1024, "what implementation.hpp promises");
    ContactTimeKernel kernel(arguments);
    for (; begin < end; begin += chunk)
      kernel.answer_chunk(begin, end - begin < chunk ? static_cast<std::uint32_t>(end - begin) : chunk);
  }

 private:
  using Measure = ContactTimeMeasure<Simd>;
  static constexpr std::uint32_t chunk = Placements<Simd>::chunk;

  explicit ContactTimeKernel(const ContactTimeArguments& arguments) noexcept
      : arguments_(arguments), shapes_(*arguments.in.shapes), walk_(shapes_.nodes) {}

  void answer_chunk(std::size_t begin, std::uint32_t size) noexcept {
    at_.place(arguments_.in, begin, size);
    for (std::uint32_t pair = 0; pair < size; ++pair) {
      const std::size_t i = begin + pair;
      if (arguments_.in.codes[i] == apart) arguments_.time[i] = time(pair, arguments_.x[i], arguments_.y[i]);
    }
  }

  float time(std::uint32_t pair, float x, float y) noexcept {
    const std::uint32_t root_a = at_.root_a[pair], root_b = at_.root_b[pair];
    if (shapes_.trees == nullptr) {
      Measure measure(x, y, 0);
      take(at_.transform(pair), shapes_.roots[root_a], shapes_.roots[root_b], measure);
      return measure.time();
    }
    Measure measure(x, y, shapes_.reach[at_.shape_a[pair]] + shapes_.reach[at_.shape_b[pair]]);
    if (x != 0 || y != 0)
      walk_.run(at_.transform(pair), shapes_.trees[root_a], shapes_.trees[root_b], measure);
    return measure.time();
  }

  /// Where every cut is a single disc.
  static void take(const Transform& at, const Root& a, const Root& b, Measure& measure) noexcept {
    measure.take(at.tx + (at.c * b.x - at.s * b.y) - a.x, at.ty + (at.s * b.x + at.c * b.y) - a.y,
                 a.radius + b.radius);
  }

  const ContactTimeArguments& arguments_;
  const ShapeSetView shapes_;
  Placements<Simd> at_;
  NearestWalk<Simd, Measure> walk_;
};

}  // namespace bch::kernel
