// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Hierarchies of arbitrary contours and of arbitrary triangles, and the flat form of both.

#include <cmath>
#include <stdexcept>
#include <utility>

#include <bch/hierarchy.hpp>
#include <bch/shapes.hpp>

#include "layout/format/contours.hpp"
#include "layout/format/shape_validation.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/hierarchy_checks.hpp"
#include "tests/support/scenes.hpp"

namespace bch::fuzz {
namespace {

Outline outline_of(Bytes& bytes) {
  Outline outline;
  const float step = std::ldexp(1.0f, static_cast<int>(bytes.below(36)) - 30);
  outline.grid_step = bytes.below(8) == 0 ? 0 : step;
  const std::uint32_t contours = 1 + bytes.below(4);
  for (std::uint32_t c = 0; c < contours; ++c) {
    const std::uint32_t points = bytes.below(32);
    for (std::uint32_t p = 0; p < points; ++p)
      outline.points.push_back({bytes.number(step), bytes.number(step)});
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
  return test::counter_clockwise(std::move(outline));  // others are refused
}

/// Sound, and accepted by the check of what files hold.
void check(const Shape& shape, bool solid) {
  test::expect_sound(shape.hierarchy);
  const ShapeSet set({&shape, 1}, {{0, 2, all_depths}, solid});
  validate(set.arrays());
}

void check_contours(Bytes& bytes) {
  const Outline outline = outline_of(bytes);
  validate(outline);
  // A small threshold would halve segments by the million.
  const auto threshold = static_cast<float>(detail::max_extent(outline.points) / (1 + bytes.below(64)));
  for (const detail::SplitRule rule : {detail::SplitRule::centroid, detail::SplitRule::centre}) {
    const Shape shape{outline, contour_hierarchy(outline, threshold, rule)};
    test::expect_covers_outline(shape.hierarchy, outline);
    // The check knows outlines on fine grids alone.
    test::expect_leaves_below(shape.hierarchy, threshold + 1.5f * outline.grid_step);
    check(shape, true);
  }
}

void check_triangles(Bytes& bytes) {
  const std::vector<Vec2> vertices = outline_of(bytes).points;
  std::vector<std::array<std::uint32_t, 3>> triangles(bytes.below(48));
  const auto corners = static_cast<std::uint32_t>(vertices.size() + 1);
  for (auto& triangle : triangles)
    triangle = {bytes.below(corners), bytes.below(corners), bytes.below(corners)};
  // Not in one expression: GCC 12 frees the empty outline twice where the hierarchy throws.
  Shape shape;
  shape.hierarchy = detail::projected_hierarchy(vertices, triangles);
  check(shape, false);
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bch::fuzz::Bytes bytes(data, size);
  try {
    if (bytes.below(4) > 0)
      bch::fuzz::check_contours(bytes);
    else
      bch::fuzz::check_triangles(bytes);
  } catch (const std::invalid_argument&) {  // outside the documented domain
  }
  return 0;
}
