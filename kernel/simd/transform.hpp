// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch::detail {

/// Represents a point, or a register of points.
template <class Float>
struct PointIn {
  Float x, y;
};

/// Maps from B's frame into A's: a rotation (c, s), then a translation; one, or a register of them. Every answer
/// depends on the order of these operations (layout/base/rounding.hpp), so they are written only here. (Always inlined:
/// of an ordinary inline function, the linker could keep a copy that was compiled for another instruction set.)
template <class Float>
struct TransformOf {
  Float c, s, tx, ty;

  [[gnu::always_inline]] PointIn<Float> apply(Float x, Float y) const noexcept {
    return {tx + (c * x - s * y), ty + (s * x + c * y)};
  }
  /// Returns the same one in every lane.
  template <class Wide>
  [[gnu::always_inline]] TransformOf<Wide> in_lanes() const noexcept {
    return {Wide(c), Wide(s), Wide(tx), Wide(ty)};
  }
};
using Transform = TransformOf<float>;

}  // namespace bch::detail
