// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/lab/stages.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "kernel/simd/leaf_segments.hpp"

namespace bch::lab {
namespace {

using detail::ShapeSetView;

double number(float value) {
  return static_cast<double>(value);
}

double disc_gap(const Disc& a, const Disc& b) {
  return distance({a.x, a.y}, {b.x, b.y}) - number(a.radius) - number(b.radius);
}

/// Returns where a sector of profiles begins, as a direction; see SectorField of kernel/simd/profile_test.hpp.
Vec2 sector_begin(unsigned sector) {
  const double fraction = (sector % 16 <= 8 ? sector % 16 : 16 - sector % 16) / 8.0;
  const double x = sector % 32 > 8 && sector % 32 < 24 ? fraction - 1 : 1 - fraction,
               y = sector % 32 > 16 ? -fraction : fraction;
  const double length = std::hypot(x, y);
  return {static_cast<float>(x / length), static_cast<float>(y / length)};
}

Vec2 turned(const Stand& stand, Vec2 direction) {
  return Stand{0, 0, stand.heading}.in_world(direction);
}

/// Returns the sector of a person's profile that holds a direction.
Side side_of(const detail::Profile& profile, const Stand& stand, Vec2 direction) {
  const Vec2 own = turned({0, 0, 32 - stand.heading}, direction);
  unsigned sector = 0;
  for (unsigned k = 0; k < detail::profile_sectors; ++k) {
    const Vec2 a = sector_begin(k), b = sector_begin(k + 1);
    if (a.x * own.y - a.y * own.x >= 0 && own.x * b.y - own.y * b.x > 0) sector = k;
  }
  return {stand.in_world({profile.x, profile.y}), turned(stand, sector_begin(sector)),
          turned(stand, sector_begin(sector + 1)), number(profile.sectors[sector].inner),
          number(profile.sectors[sector].outer)};
}

/// Returns where two segments cross.
std::optional<Vec2> crossing(const Segment& a, const Segment& b) {
  const double ax = number(a[1].x) - number(a[0].x), ay = number(a[1].y) - number(a[0].y),
               bx = number(b[1].x) - number(b[0].x), by = number(b[1].y) - number(b[0].y),
               x = number(b[0].x) - number(a[0].x), y = number(b[0].y) - number(a[0].y);
  const double area = ax * by - ay * bx, of_a = (x * by - y * bx) / area, of_b = (x * ay - y * ax) / area;
  if (!(of_a >= 0 && of_a <= 1 && of_b >= 0 && of_b <= 1)) return {};
  return Vec2{static_cast<float>(number(a[0].x) + of_a * ax), static_cast<float>(number(a[0].y) + of_a * ay)};
}

}  // namespace

double distance(Vec2 a, Vec2 b) {
  return std::hypot(number(b.x) - number(a.x), number(b.y) - number(a.y));
}

Vec2 along(Vec2 point, Vec2 direction, double metres) {
  const auto m = static_cast<float>(metres);
  return {point.x + m * direction.x, point.y + m * direction.y};
}

Vec2 direction_of(double radians) {
  return {static_cast<float>(std::cos(radians)), static_cast<float>(std::sin(radians))};
}

std::array<Side, 2> compared_profiles(const ShapeSetView& view) {
  const Vec2 a = stands[0].in_world({view.profiles[0].x, view.profiles[0].y}),
             b = stands[1].in_world({view.profiles[1].x, view.profiles[1].y});
  const auto length = static_cast<float>(distance(a, b));
  const Vec2 way{(b.x - a.x) / length, (b.y - a.y) / length};
  return {side_of(view.profiles[0], stands[0], way), side_of(view.profiles[1], stands[1], {-way.x, -way.y})};
}

// ---- Supports.

double support(const ShapeSetView& view, unsigned person, unsigned direction) {
  const unsigned own = (direction + 32 - stands[person].heading) % 32;
  const float* const row = view.support + std::size_t{view.roots[person].row} * detail::support_stride;
  return number(row[own % 2 * detail::support_directions + own / 2]);
}

double support_gap(const ShapeSetView& view, unsigned direction) {
  const Vec2 d = direction_of(turn * direction);
  return number(d.x) * (stands[1].x - stands[0].x) + number(d.y) * (stands[1].y - stands[0].y) -
         support(view, 0, direction) - support(view, 1, (direction + 16) % 32);
}

unsigned widest_direction(const ShapeSetView& view) {
  unsigned best = 0;
  for (unsigned k = 1; k < detail::support_directions; ++k)
    if (support_gap(view, k) > support_gap(view, best)) best = k;
  return best;
}

// ---- Inscribed discs.

std::vector<Disc> inscribed(const ShapeSetView& view, unsigned person) {
  std::vector<Disc> discs;
  const detail::DiscBlock& block = view.inscribed[person];
  for (unsigned i = 0; i < detail::block_width; ++i)
    if (std::isfinite(block.x[i]))
      discs.push_back(stands[person].place({block.x[i], block.y[i], block.radius[i]}));
  return discs;
}

double inscribed_gap(const ShapeSetView& view) {
  double least = 1e30;
  for (const Disc& a : inscribed(view, 0))
    for (const Disc& b : inscribed(view, 1)) least = std::min(least, disc_gap(a, b));
  return least;
}

// ---- Traversal.

Disc Traversal::disc(unsigned person, std::uint32_t name, unsigned lane) const {
  const bool is_leaf_block = name >= detail::leaf_bit;
  const std::size_t step = is_leaf_block ? view_.trees[person].stride : detail::block_width;
  const float* const x = view_.nodes + (name & ~detail::leaf_bit) + lane;
  return stands[person].place({x[0], x[step], x[2 * step]});
}

std::vector<Disc> Traversal::top(unsigned person) const {
  std::vector<Disc> discs;
  const std::uint32_t block = view_.trees[person].top;
  for (unsigned i = 0; i < detail::block_width; ++i)
    if (const Disc at = disc(person, block, i);
        std::isfinite(at.x) && !overlapping[person][0].contains(block + i))
      discs.push_back(at);
  return discs;
}

std::vector<Segment> Traversal::segments(unsigned person, std::uint32_t at) const {
  const detail::LeafSegments<void> words{view_.leaf_segments};
  const auto list = words.segments(view_.trees[person], at);
  std::vector<Segment> result;
  for (std::uint32_t i = 0; i < list.count; ++i)
    result.push_back({stands[person].in_world(view_.points[list.point(i)]),
                      stands[person].in_world(view_.points[list.point(i) + 1])});
  return result;
}

void Traversal::compare(std::uint32_t a, std::uint32_t b, std::size_t level) {
  if (!compared.insert({a, b}).second) return;
  for (auto& discs : overlapping) discs.resize(std::max(discs.size(), level + 1));
  for (unsigned i = 0; i < detail::block_width; ++i)
    for (unsigned j = 0; j < detail::block_width; ++j) {
      if (!(disc_gap(disc(0, a, i), disc(1, b, j)) <= 0)) continue;
      overlapping[0][level].insert(a + i), overlapping[1][level].insert(b + j);
      if ((a & b) >= detail::leaf_bit)
        leaves.insert({(a & ~detail::leaf_bit) + i, (b & ~detail::leaf_bit) + j});
      else
        compare(child(a, i), child(b, j), level + 1);
    }
}

std::uint32_t Traversal::child(std::uint32_t name, unsigned lane) const {
  return name >= detail::leaf_bit
             ? name
             : std::bit_cast<std::uint32_t>(view_.nodes[name + detail::block_names + lane]);
}

std::vector<Vec2> crossings(const Traversal& traversal) {
  std::vector<Vec2> result;
  for (const auto& [a, b] : traversal.leaves)
    for (const Segment& of_a : traversal.segments(0, a))
      for (const Segment& of_b : traversal.segments(1, b))
        if (const auto point = crossing(of_a, of_b)) result.push_back(*point);
  return result;
}

}  // namespace bch::lab
