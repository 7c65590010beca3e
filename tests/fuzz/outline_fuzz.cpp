// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Outlines of arbitrary triangles: those of every implementation are the same, hold all vertices and, of few
// triangles, are those of the exact arrangement.

#include <cmath>
#include <stdexcept>

#include <bch/outline_builder.hpp>

#include "layout/base/build_implementation.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_soups.hpp"

namespace bch::fuzz {
namespace {

test::Soup soup_of(Bytes& bytes) {
  test::Soup soup;
  const std::uint32_t vertices = bytes.below(24), triangles = bytes.below(32);
  // Few places for points make edges that touch, cross in one point, lie in each other.
  const bool coarse = bytes.below(2) == 0;
  const float step = std::ldexp(1.0f, -static_cast<int>(bytes.below(20)));
  for (std::uint32_t v = 0; v < vertices; ++v)
    soup.positions.push_back(
        coarse ? Vec3{static_cast<float>(bytes.below(8)) * step, static_cast<float>(bytes.below(8)) * step, 0}
               : Vec3{bytes.number(step), bytes.number(step), bytes.number(step)});
  for (std::uint32_t t = 0; t < triangles; ++t)
    soup.triangles.push_back(
        {bytes.below(vertices + 1), bytes.below(vertices + 1), bytes.below(vertices + 1)});
  return soup;
}

bool same(const Outline& a, const Outline& b) {
  return a.points == b.points && a.contour_begin == b.contour_begin && a.grid_step == b.grid_step;
}

/// As the builder snaps: halves to even, and every product is exact.
test::Soup snapped(test::Soup soup, float grid_step) {
  const auto snap = [&](float& coordinate) {
    coordinate = std::nearbyint(coordinate / grid_step) * grid_step;
  };
  for (Vec3& position : soup.positions) snap(position.x), snap(position.y);
  return soup;
}

/// Triangles that are points are left out of outlines.
std::vector<std::array<std::uint32_t, 3>> without_points(const test::Soup& soup,
                                                         const std::vector<test::IntegerTriangle>& grid) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t t = 0; t < grid.size(); ++t)
    if (grid[t][0] != grid[t][1] || grid[t][1] != grid[t][2]) triangles.push_back(soup.triangles[t]);
  return triangles;
}

void check(const test::Soup& soup) {
  const Outline outline = bch::outline(soup.positions, soup.triangles);
  validate(outline);
  for (const detail::BuildImplementation& implementation : detail::build_implementations()) {
    if (!implementation.supported()) continue;
    Outline other;
    OutlineBuilder builder(soup.triangles, soup.positions.size(), soup.positions, implementation);
    builder.build(soup.positions, other);
    require(same(outline, other), "every implementation finds the same outline");
  }
  const auto grid = test::on_grid(snapped(soup, outline.grid_step), outline.grid_step);
  test::expect_covers(outline, soup.positions, without_points(soup, grid));
  if (soup.triangles.size() <= 10)
    require(test::on_grid(outline) == test::arrangement_outline(grid),
            "the outline is that of the arrangement");
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bch::fuzz::Bytes bytes(data, size);
  try {
    bch::fuzz::check(bch::fuzz::soup_of(bytes));
  } catch (const std::invalid_argument&) {  // out of range, not finite, nothing there
  }
  return 0;
}
