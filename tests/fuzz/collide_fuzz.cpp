// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Compares answers of every implementation with brute force and the scalar reference, for arbitrary
// star-shaped outlines in arbitrary places.

#include <cmath>
#include <numbers>

#include <bch/pairs.hpp>

#include "baselines/reference.hpp"
#include "layout/base/rounding.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/scenes.hpp"

namespace bch::fuzz {
namespace {

Outline star_of(Bytes& bytes, float size) {
  const std::uint32_t corners = 3 + bytes.below(40);
  const float step = std::ldexp(size, -20), narrow = std::ldexp(1.0f, -static_cast<int>(bytes.below(8)));
  Outline outline;
  outline.grid_step = step;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = 1 + bytes.below(256);
    const auto on_grid = [&](double value) {
      return static_cast<float>(std::floor(std::ldexp(value, 11))) * step;
    };
    outline.points.push_back(
        {on_grid(radius * std::cos(angle)), on_grid(static_cast<double>(narrow) * radius * std::sin(angle))});
  }
  outline.contour_begin.push_back(corners);
  return outline;
}

/// Sizes from 1 mm to 1 km in powers of two.
std::vector<Shape> shapes_of(Bytes& bytes) {
  std::vector<Shape> shapes;
  for (int i = 0; i < 3; ++i) {
    const float size = std::ldexp(1.0f, static_cast<int>(bytes.below(20)) - 10);
    shapes.push_back(
        test::contour_shape(star_of(bytes, size), size / (1.0f + static_cast<float>(bytes.below(24)))));
  }
  return shapes;
}

double heading_of(Bytes& bytes) {
  const std::uint32_t kind = bytes.below(4);
  if (kind == 0) return bytes.below(9) * std::numbers::pi / 4;
  const auto any = bytes.take<std::int32_t>();
  return kind == 1 ? 1e-12 * any : kind == 2 ? 1e-9 * any : 0.25 * any;
}

/// Its own placement, and one beside it by about the shapes' sizes.
void add_pair(Bytes& bytes, const std::vector<Shape>& shapes, test::Crowd& crowd) {
  constexpr double worlds[] = {0, 1, -1e3, 1e6, 1e7, -9e8};
  const double x = worlds[bytes.below(6)], y = worlds[bytes.below(6)];
  const std::uint32_t a = bytes.below(3), b = bytes.below(3);
  const double max_extent = shapes[a].hierarchy.max_extent + shapes[b].hierarchy.max_extent;
  const double dx = std::ldexp(max_extent * bytes.take<std::int32_t>(), -31),
               dy = std::ldexp(max_extent * bytes.take<std::int32_t>(), -31);
  crowd.add({a, x, y, heading_of(bytes), static_cast<std::uint8_t>(bytes.below(3))});
  crowd.add({b, x + dx, y + dy, heading_of(bytes), static_cast<std::uint8_t>(bytes.below(3))});
}

void check(const ShapeSet& set, const baselines::Reference& reference, const Agents& agents,
           const std::vector<Pair>& pairs) {
  const auto run_query = [&](Pair pair, baselines::Method method) {
    return reference.solid(agents, pair, method);
  };
  std::vector<std::uint8_t> expected;
  for (const Pair pair : pairs) {
    expected.push_back(run_query(pair, baselines::Method::brute_force));
    require(run_query(pair, baselines::Method::depth_first) == (expected.back() != 0),
            "the plain traversal answers like brute force");
  }
  std::vector<std::uint8_t> hits(pairs.size());
  for (const Implementation& implementation : implementations()) {
    if (!implementation.supported()) continue;
    collide(set, agents, pairs, hits, {&implementation});
    require(hits == expected, implementation.name);
  }
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  fuzz::Bytes bytes(data, size);
  const std::vector<Shape> shapes = fuzz::shapes_of(bytes);
  const ShapeSetPlan plan{{0, 3, all_depths}, true, bytes.below(4) > 0};
  test::Crowd crowd;
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < 12; ++i) {
    fuzz::add_pair(bytes, shapes, crowd);
    pairs.push_back({2 * i, 2 * i + 1});
  }
  const ShapeSet set(shapes, plan);
  const baselines::Reference reference(shapes, plan);
  fuzz::check(set, reference, crowd.agents(), pairs);
  return 0;
}
