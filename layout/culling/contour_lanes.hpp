// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/geometry.hpp>

#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds up to `most` segments of a contour relative to a centre, with all values that can be computed without
/// branches.
template <class Simd>
class ContourLanes {
 public:
  static constexpr std::size_t most = 64;

  /// Takes one to `most` segments: the first begins at `begin`, and segment i ends at ends[i].
  ContourLanes(Vec2 begin, std::span<const Vec2> ends, double centre_x, double centre_y) noexcept
      : count_(ends.size()) {
    const auto put = [&](std::size_t i, Vec2 point) {
      x_[i] = static_cast<double>(point.x) - centre_x, y_[i] = static_cast<double>(point.y) - centre_y;
    };
    put(0, begin);
    for (std::size_t i = 0; i < count_; ++i) put(i + 1, ends[i]);
    for (std::size_t i = 0; i < padding; ++i) put(count_ + 1 + i, ends[count_ - 1]);
    for (std::size_t i = 0; i <= count_; i += Batch::size) find_sectors(i);
    for (std::size_t i = 0; i < count_; i += Batch::size) find_feet(i);
  }

  std::size_t size() const noexcept { return count_; }

  // These functions describe the point where segment i begins and segment i - 1 ends.

  double x(std::size_t i) const noexcept { return x_[i]; }
  double y(std::size_t i) const noexcept { return y_[i]; }
  std::uint32_t sector(std::size_t i) const noexcept {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(sector_[i])) % profile_sectors;
  }
  /// Returns a lower bound of the distance from the nearest line that separates two sectors.
  double aside(std::size_t i) const noexcept { return aside_[i]; }

  // These functions describe segment i.

  /// Returns the parameter t, 0 at the begin of the segment and 1 at its end, of the point of its line nearest to the
  /// centre.
  double foot(std::size_t i) const noexcept { return foot_[i]; }
  double square_distance(std::size_t i) const noexcept { return square_distance_[i]; }
  bool turns_left(std::size_t i) const noexcept { return turn_[i] >= 0; }
  /// Returns whether the segment crosses the positive x axis. It has no branch, because a branch could not be
  /// predicted.
  bool crosses(std::size_t i) const noexcept {
    return ((y_[i] > 0) != (y_[i + 1] > 0)) & (turns_left(i) == (y_[i + 1] > y_[i]));
  }

 private:
  using Batch = typename Simd::Double;
  /// Elements that pad arrays to whole registers, also for the ends of segments.
  static constexpr std::size_t padding = Batch::size;
  using Array = std::array<double, most + 1 + padding>;
  /// Added to divisors that may be 0; the dividend is then 0, too.
  static constexpr double not_zero = 1e-200;

  static Batch load(const Array& of, std::size_t i) noexcept { return Simd::load(&of[i]); }
  static void store(Array& to, std::size_t i, const Batch& value) noexcept { Simd::store(&to[i], value); }

  /// Finds the sectors of points, and lower bounds of their distances from the lines between sectors. A sector takes
  /// an equal part of |y| / (|x| + |y|). The line at an end of a sector is at most `quadrant` long in these terms. So
  /// the distance of a point from that line is at least the point's fraction of a sector times (|x| + |y|), divided
  /// by that length.
  void find_sectors(std::size_t i) noexcept {
    constexpr double quadrant = 0.25 * profile_sectors;
    const Batch x = load(x_, i), y = load(y_, i), zero(0.0);
    const Batch sum = xsimd::abs(x) + xsimd::abs(y);
    const Batch t = Batch(quadrant) * xsimd::abs(y) / (sum + Batch(not_zero));
    const Batch half = xsimd::select(x < zero, Batch(2 * quadrant) - t, t);
    const Batch sector = xsimd::select(y < zero, Batch(4 * quadrant) - half, half);
    const Batch to_integer(0x1.8p52), nearest = (sector + to_integer) - to_integer;
    store(sector_, i, sector);
    store(aside_, i, xsimd::abs(sector - nearest) * sum * Batch(1 / (quadrant + 0.001)));
  }

  void find_feet(std::size_t i) noexcept {
    const Batch x = load(x_, i), y = load(y_, i), to_x = load(x_, i + 1), to_y = load(y_, i + 1);
    const Batch along_x = to_x - x, along_y = to_y - y;
    const Batch square = along_x * along_x + along_y * along_y;
    const Batch foot = (Batch(0.0) - (x * along_x + y * along_y)) / (square + Batch(not_zero));
    const Batch t = xsimd::max(Batch(0.0), xsimd::min(Batch(1.0), foot));
    const Batch there_x = x + t * along_x, there_y = y + t * along_y;
    store(foot_, i, foot);
    store(square_distance_, i, there_x * there_x + there_y * there_y);
    store(turn_, i, x * to_y - y * to_x);
  }

  std::size_t count_;
  Array x_, y_, sector_, aside_, foot_, square_distance_, turn_;
};

}  // namespace bch::detail
