// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/culling/interior_loops.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Implements the loops that take most of the time of interior.hpp: over the points of a contour, with discs or
/// points side by side in lanes, and over the rows of a raster. No float is summed across lanes, so every instruction
/// set gives the same bits. Values that depend only on an edge are computed once per edge.
template <class Simd>
class InteriorLanes {
 public:
  /// Raises the half curvature of each touch's disc until no point is inside: a disc that touches at q with the
  /// centre q + r n contains a point q + w unless 2 r (n w) <= w^2.
  static void keep_out(const ContourPoints& points, const TouchLanes& touches,
                       float* half_curvature) noexcept {
    constexpr std::size_t together = 4;
    std::uint32_t k = 0;
    for (; k + together * width <= touches.count; k += together * width)
      keep_out_of<together>(points, touches, k, half_curvature);
    for (; k < touches.count; k += width) keep_out_of<1>(points, touches, k, half_curvature);
  }

  /// Measures, per point, the squared distance of the nearest edge, and four times the winding number of the contour.
  static void measure(const Vec2* contour, std::size_t count, const PointLanes& from, double* square,
                      double* turns) noexcept {
    measure_from<double>(
        count,
        [=](std::size_t i) {
          return Point<double>{static_cast<double>(contour[i].x), static_cast<double>(contour[i].y)};
        },
        from, square, turns);
  }
  static void estimate(const ContourPoints& contour, const PointLanes& from, float* square,
                       float* turns) noexcept {
    measure_from<float>(
        contour.count,
        [&](std::size_t i) {
          return Point<float>{contour.x[i], contour.y[i]};
        },
        from, square, turns);
  }

  /// Finds, per point, the squared distance of the nearest edge and the index of the point where that edge ends; the
  /// first of several.
  static void find_nearest(const ContourPoints& contour, const PointLanes& from, float* square,
                           std::int32_t* edge) noexcept {
    for (std::uint32_t k = 0; k < from.count; k += width) {
      const Floats at_x = Simd::load(from.x + k), at_y = Simd::load(from.y + k);
      Floats least(HUGE_VALF), nearest(0.0f);
      for (std::size_t i = 0, before = contour.count - 1; i < contour.count; before = i++) {
        const Edge<float> line({contour.x[before], contour.y[before]}, {contour.x[i], contour.y[i]});
        const Floats here = line.square_distance(at_x - Floats(line.x), at_y - Floats(line.y));
        const auto nearer = here < least;
        // The index as bits, which a selection keeps whatever float they are.
        nearest =
            xsimd::select(nearer, Floats(__builtin_bit_cast(float, static_cast<std::int32_t>(i))), nearest);
        least = xsimd::select(nearer, here, least);
      }
      Simd::store(square + k, least);
      alignas(64) float bits[width];
      nearest.store_aligned(bits);
      __builtin_memcpy(edge + k, bits, sizeof bits);
    }
  }

  static void find_extremes(const Vec2* contour, std::size_t count, const LineLanes& lines) noexcept {
    using Doubles = typename Simd::Double;
    for (std::size_t k = 0; k < contour_lines; k += Simd::doubles) {
      const Doubles cosine = Simd::load(lines.cosine + k), sine = Simd::load(lines.sine + k);
      Doubles least(HUGE_VAL), most(-HUGE_VAL), lowest(0.0), highest(0.0);
      for (std::size_t i = 0; i < count; ++i) {
        const Doubles index(static_cast<double>(i));
        const Doubles along = cosine * Doubles(static_cast<double>(contour[i].x)) +
                              sine * Doubles(static_cast<double>(contour[i].y));
        const auto less = along < least, more = most < along;
        lowest = xsimd::select(less, index, lowest);
        least = xsimd::select(less, along, least);
        highest = xsimd::select(more, index, highest);
        most = xsimd::select(more, along, most);
      }
      Simd::store(lines.lowest + k, lowest);
      Simd::store(lines.highest + k, highest);
    }
  }

  /// Sets the bits of the cells whose centres are in a disc and clears the others; cell centres are at 0.5, 1.5 ...
  /// Returns: the number of set bits.
  static std::int32_t draw(float x, float y, float radius, std::uint32_t* rows) noexcept {
    alignas(64) float row[width];
    for (std::size_t lane = 0; lane < width; ++lane) row[lane] = static_cast<float>(lane) + 0.5f;
    const Floats square(radius * radius), middle(x + 0.5f);
    Floats at = Floats::load_aligned(row) - Floats(y);
    Ints drawn(0);
    for (std::size_t j = 0; j < raster_rows; j += width, at = at + Floats(static_cast<float>(width))) {
      const Floats half = xsimd::sqrt(xsimd::max(square - at * at, Floats(0.0f)));
      const Cell begin(middle - half), end(middle + half);
      (begin.minus_bit - end.minus_bit).store_unaligned(reinterpret_cast<std::int32_t*>(rows + j));
      drawn = drawn + (end.index - begin.index);
    }
    alignas(64) std::int32_t cells[width];
    drawn.store_aligned(cells);
    for (std::size_t lane = 1; lane < width; ++lane) cells[0] += cells[lane];
    return cells[0];
  }

  /// Returns the number of bits that are set in `rows` but not in `covered`. Written so that it vectorises, because
  /// baseline x86-64 has no instruction that counts bits.
  static std::int32_t count_new(const std::uint32_t* rows, const std::uint32_t* covered) noexcept {
    std::uint32_t sum = 0;
    for (std::size_t j = 0; j < raster_rows; ++j) {
      std::uint32_t v = rows[j] & ~covered[j];
      v = v - (v >> 1 & 0x55555555);
      v = (v & 0x33333333) + (v >> 2 & 0x33333333);
      v = (v + (v >> 4)) & 0x0f0f0f0f;
      sum += (v & 0x00ff00ff) + (v >> 8 & 0x00ff00ff);
    }
    return static_cast<std::int32_t>((sum & 0xffff) + (sum >> 16));
  }

  static constexpr InteriorLoops loops{keep_out,      measure, estimate, find_nearest,
                                       find_extremes, draw,    count_new};

 private:
  using Floats = typename Simd::Float;
  using Ints = typename Simd::Ints;
  static constexpr std::size_t width = Simd::width;
  /// The uncertainty of a squared distance: points nearer than the rounding of coordinates say nothing about a
  /// tangent disc.
  static constexpr float blur = 0x1p-16f;

  /// Holds, per row, the first cell whose centre is not before a coordinate, and that cell's bit. Half a cell has
  /// been added to the coordinate. Beyond the last cell there is no bit. The bit is computed as a power of two in
  /// float, because not every instruction set can shift each lane by another number; it is negative, so that the
  /// largest, 2^31, can be converted.
  struct Cell {
    Ints index, minus_bit;

    explicit Cell(const Floats& coordinate) {
      const Floats past(static_cast<float>(raster_rows));
      const Floats cell = xsimd::min(xsimd::max(coordinate, Floats(0.0f)), past);
      index = xsimd::to_int(cell);
      constexpr std::int32_t exponent_of_1 = 127, sign = 256;
      const Floats power = xsimd::bitwise_cast<Floats>((index + Ints(exponent_of_1 + sign)) << 23);
      minus_bit = xsimd::to_int(xsimd::select(cell < past, power, Floats(0.0f)));
    }
  };

  template <class Real>
  struct Point {
    Real x, y;
  };

  template <class Real>
  struct Edge {
    using Batch = typename Simd::template Batch<Real>;
    Real x, y, dx, dy, over;

    Edge(Point<Real> a, Point<Real> b) : x(a.x), y(a.y), dx(b.x - a.x), dy(b.y - a.y) {
      constexpr Real smallest_normal = sizeof(Real) == 4 ? Real(0x1p-126) : Real(0x1p-1022);
      const Real length = dx * dx + dy * dy;
      over = length > smallest_normal ? 1 / length : 0;
    }
    /// Returns the squared distances of points that are relative to the begin of the edge. The place of the nearest
    /// point along the edge may be off by its rounding. For an edge of length l, where t = distance / l, that changes
    /// the distance by no more than a rounding.
    Batch square_distance(const Batch& px, const Batch& py) const {
      const Batch t = (px * Batch(dx) + py * Batch(dy)) * Batch(over);
      const Batch held = xsimd::min(xsimd::max(t, Batch(Real(0))), Batch(Real(1)));
      const Batch ex = px - held * Batch(dx), ey = py - held * Batch(dy);
      return ex * ex + ey * ey;
    }
  };

  template <std::size_t parts>
  static void keep_out_of(const ContourPoints& points, const TouchLanes& touches, std::uint32_t first,
                          float* half_curvature) {
    Floats x[parts], y[parts], normal_x[parts], normal_y[parts], curvature[parts];
    for (std::size_t p = 0; p < parts; ++p) {
      const std::size_t k = first + p * width;
      x[p] = Simd::load(touches.x + k), y[p] = Simd::load(touches.y + k);
      normal_x[p] = Simd::load(touches.normal_x + k), normal_y[p] = Simd::load(touches.normal_y + k);
      curvature[p] = Simd::load(half_curvature + k);
    }
    for (std::size_t i = 0; i < points.count; ++i)
      for (std::size_t p = 0; p < parts; ++p) {
        const Floats wx = Floats(points.x[i]) - x[p], wy = Floats(points.y[i]) - y[p];
        const Floats needed = (normal_x[p] * wx + normal_y[p] * wy) / (wx * wx + wy * wy + Floats(blur));
        curvature[p] = xsimd::max(curvature[p], needed);
      }
    for (std::size_t p = 0; p < parts; ++p) Simd::store(half_curvature + first + p * width, curvature[p]);
  }

  /// Measures a contour of n points from other points, one per lane. corner(i) returns the coordinates of point i of
  /// the contour.
  template <class Real, class Corner>
  static void measure_from(std::size_t n, Corner corner, const PointLanes& from, Real* square, Real* turns) {
    using Batch = typename Simd::template Batch<Real>;
    const Batch one(Real(1)), minus_one(Real(-1));
    for (std::uint32_t k = 0; k < from.count; k += Batch::size) {
      alignas(64) Real x[Batch::size], y[Batch::size];
      for (std::size_t lane = 0; lane < Batch::size; ++lane) {
        x[lane] = static_cast<Real>(from.x[k + lane]);
        y[lane] = static_cast<Real>(from.y[k + lane]);
      }
      const Batch at_x = Batch::load_aligned(x), at_y = Batch::load_aligned(y);
      Batch least(static_cast<Real>(HUGE_VAL)), turned(Real(0));
      for (std::size_t i = 0, before = n - 1; i < n; before = i++) {
        const Edge<Real> edge(corner(before), corner(i));
        const Batch px = at_x - Batch(edge.x), py = at_y - Batch(edge.y);
        least = xsimd::min(least, edge.square_distance(px, py));
        // An edge that crosses the point's height has it on its left or on its right; the others count 0.
        const Batch end = xsimd::select(at_y <= Batch(corner(i).y), one, minus_one);
        const Batch begin = xsimd::select(at_y <= Batch(edge.y), one, minus_one);
        const Batch side = xsimd::select(Batch(edge.dx) * py >= Batch(edge.dy) * px, one, minus_one);
        turned = turned + (one - begin * end) * side;
      }
      Simd::store(square + k, least);
      Simd::store(turns + k, turned);
    }
  }
};

}  // namespace bch::detail
