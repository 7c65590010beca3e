// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/culling/profile.hpp"
#include "layout/format/contours.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

using test::polygon;

using Contour = std::span<const Vec2>;

Contour contour_of_most_area(const Outline& outline) {
  const auto area_of = [&](std::size_t c) {
    const Contour points = outline.contour(c);
    return area(polygon({points.begin(), points.end()}));
  };
  std::size_t largest = 0;
  for (std::size_t c = 1; c < outline.contours(); ++c)
    if (area_of(c) > area_of(largest)) largest = c;
  return outline.contour(largest);
}

/// How many there are; each is inside by what rounding.hpp asks for and not by much more.
int expect_inside(const Outline& outline) {
  const double max_extent = detail::max_extent(outline.points);
  const detail::Interior found = detail::interior(outline, max_extent);
  const Contour contour = contour_of_most_area(outline);
  const long double margin = detail::rounding::query_margin * max_extent;
  int discs = 0;
  for (std::uint32_t k = 0; k < detail::block_width; ++k) {
    if (std::isinf(found.x[k])) {
      EXPECT_EQ(found.radius[k], 0);
      continue;
    }
    ++discs;
    const long double exact = test::depth_in_contour<long double>(contour, found.x[k], found.y[k]);
    EXPECT_GT(found.radius[k], 0);
    EXPECT_LE(found.radius[k], exact - margin) << found.x[k] << ", " << found.y[k];
    EXPECT_GE(found.radius[k], exact * (1 - 0x1p-21L) - margin) << found.x[k] << ", " << found.y[k];
  }
  return discs;
}

Outline scaled(Outline outline, double factor, double x = 0, double y = 0) {
  for (Vec2& p : outline.points)
    p = {static_cast<float>(static_cast<double>(p.x) * factor + x),
         static_cast<float>(static_cast<double>(p.y) * factor + y)};
  return outline;
}

bool same(const detail::Interior& a, const detail::Interior& b) {
  return a.x == b.x && a.y == b.y && a.radius == b.radius && a.extreme_x == b.extreme_x &&
         a.extreme_y == b.extreme_y;
}

TEST(Interior, DiscsAreInsideTheLargestContour) {
  int discs = 0;
  for (const Shape& shape : test::synthetic_shapes(51, 64)) discs += expect_inside(shape.outline);
  EXPECT_GE(discs, 500);  // of 512: the slender ones have room for fewer
  for (const Character& character : test::people())
    for (const Shape& shape : test::pose_shapes(character, 20)) EXPECT_EQ(expect_inside(shape.outline), 8);
}

TEST(Interior, DiscsAreInsideContoursOfAnySize) {
  test::Random random(7);
  for (const std::uint32_t corners : {3u, 4u, 5u, 7u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u, 100'000u}) {
    const Outline outline = test::star(random, corners, 0.2, 0.4);
    EXPECT_GT(expect_inside(outline), 0) << corners;
    for (const double factor : {3e-6, 1e-3, 1e3, 2e6})
      EXPECT_GT(expect_inside(scaled(outline, factor)), 0) << corners << " at " << factor;
    EXPECT_GT(expect_inside(scaled(outline, 1, 1000, -700)), 0) << corners << " far from the origin";
  }
}

/// A whisker's outer side looks like room for a large disc.
TEST(Interior, WhiskersAndPinchesCostNoDiscs) {
  const Outline whisker = polygon({{0, 0}, {1, 0}, {1, 1}, {5, 6}, {1, 1}, {0, 1}, {-4, 0.5f}, {0, 1}});
  EXPECT_EQ(expect_inside(whisker), 8);
  EXPECT_GT(detail::interior(whisker, 8).radius[0], 0.4f);
  const Outline pinch = polygon({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 3}, {1, 3}, {1, 1}, {0, 1}});
  EXPECT_EQ(expect_inside(pinch), 8);
  const Outline repeated =
      polygon({{0, 0}, {0, 0}, {0.25f, 0}, {0.5f, 0}, {1, 0}, {1, 0}, {1, 1}, {0.5f, 1}, {0, 1}, {0, 1}});
  EXPECT_EQ(expect_inside(repeated), 8);
}

TEST(Interior, WhatHasNoRoomHasNone) {
  EXPECT_EQ(expect_inside(polygon({{0, 0}, {1, 0}})), 0);
  EXPECT_EQ(expect_inside(polygon({{0, 0}, {1, 1}, {3, 3}, {2, 2}})), 0);
  EXPECT_EQ(expect_inside(polygon({{1, 1}})), 0);
  EXPECT_EQ(expect_inside(polygon({{1, 1}, {1, 1}, {1, 1}})), 0);
  EXPECT_EQ(expect_inside(polygon({{0, 0}, {1, 0}, {1, 0x1p-20f}, {0, 0x1p-20f}})), 0);  // below the rounding
  EXPECT_GT(expect_inside(polygon({{0, 0}, {1, 0}, {1, 0x1p-5f}, {0, 0x1p-5f}})), 0);
}

TEST(Interior, WhatWasBuiltBeforeChangesNothingAndMemoryIsReused) {
  std::vector<Shape> shapes = test::synthetic_shapes(52, 48);
  detail::InteriorBuilder builder;
  for (const Shape& shape : shapes) builder.build(shape.outline, shape.hierarchy.max_extent);
  for (const Shape& shape : shapes) {
    const std::size_t before = test::allocation_count();
    const detail::Interior again = builder.build(shape.outline, shape.hierarchy.max_extent);
    EXPECT_EQ(test::allocation_count(), before);
    const detail::Interior fresh = detail::interior(shape.outline, shape.hierarchy.max_extent);
    EXPECT_GT(test::allocation_count(), before);
    EXPECT_TRUE(same(again, fresh));
  }
}

/// Of two people at random whose outlines cross, those that the discs decide. No answer shows how well the
/// discs were chosen, only times do; this does. The share is what a fixed scene had when it was recorded,
/// 2546 of 3000, less what another choice of equal worth may lose.
TEST(Interior, DiscsOfPeopleWhoMeetOverlap) {
  std::vector<Shape> shapes;
  for (const Character& character : test::default_characters())
    for (Shape& shape : test::pose_shapes(character, 12)) shapes.push_back(std::move(shape));
  std::vector<detail::Interior> inside;
  for (const Shape& shape : shapes)
    inside.push_back(detail::interior(shape.outline, shape.hierarchy.max_extent));
  test::Random random(41);
  int meeting = 0, overlapping = 0;
  while (meeting < 3000) {
    const std::uint32_t a = random.below(24), b = random.below(24);
    const detail::Rotation turn = detail::rotation(random.uniform(0, 2 * std::numbers::pi));
    const double x = random.uniform(-0.8, 0.8), y = random.uniform(-0.8, 0.8);
    const auto placed = [&](float px, float py) {
      const double from_x = static_cast<double>(px), from_y = static_cast<double>(py);
      return std::array{x + turn.cosine * from_x - turn.sine * from_y,
                        y + turn.sine * from_x + turn.cosine * from_y};
    };
    bool meets = false, overlaps = false;
    for (const Vec2 p : shapes[b].outline.points)
      meets = meets || test::inside(shapes[a].outline, placed(p.x, p.y)[0], placed(p.x, p.y)[1]);
    if (!meets) continue;
    for (std::uint32_t i = 0; i < detail::block_width; ++i)
      for (std::uint32_t j = 0; j < detail::block_width; ++j) {
        const auto at = placed(inside[b].x[j], inside[b].y[j]);
        overlaps = overlaps || std::hypot(at[0] - static_cast<double>(inside[a].x[i]),
                                          at[1] - static_cast<double>(inside[a].y[i])) <=
                                   static_cast<double>(inside[a].radius[i] + inside[b].radius[j]);
      }
    ++meeting;
    overlapping += overlaps;
  }
  EXPECT_GE(overlapping, 2520);
}

/// People, contours with whiskers, for which candidates are measured once more, and such as have no room.
TEST(Interior, EveryInstructionSetGivesTheSameBits) {
  std::vector<Shape> shapes = test::synthetic_shapes(53, 48);
  for (const Character& character : test::default_characters())
    for (Shape& shape : test::pose_shapes(character, 12)) shapes.push_back(std::move(shape));
  for (const Outline& outline :
       {polygon({{0, 0}, {1, 0}, {1, 1}, {5, 6}, {1, 1}, {0, 1}, {-4, 0.5f}, {0, 1}}),
        polygon({{0, 0}, {1, 0}}), polygon({{1, 1}})})
    shapes.emplace_back().outline = outline;
  detail::InteriorBuilder plain(detail::build_implementations().back());
  for (const detail::BuildImplementation& implementation : detail::build_implementations()) {
    if (!implementation.supported()) continue;
    detail::InteriorBuilder builder(implementation);
    for (const Shape& shape : shapes) {
      const detail::Interior found = builder.build(shape.outline, detail::max_extent(shape.outline.points));
      const detail::Interior expected = plain.build(shape.outline, detail::max_extent(shape.outline.points));
      ASSERT_TRUE(same(found, expected)) << implementation.name;
    }
  }
}

/// Against counting cell by cell, without culling data.
void expect_best_choices(const detail::InteriorLoops& loops) {
  constexpr int cells = detail::DiscCoverage::cells;
  test::Random random(9);
  detail::CandidateDiscs discs;
  discs.count = detail::max_touches;
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    discs.x[k] = static_cast<float>(random.uniform(-2, 34));
    discs.y[k] = static_cast<float>(random.uniform(-2, 34));
    discs.radius[k] = static_cast<float>(random.uniform(0, k % 8 == 0 ? 30 : 6));
  }
  detail::DiscCoverage coverage;
  coverage.offer(loops, discs, 0.5f);
  std::vector<bool> covered(cells * cells), chosen(discs.count);
  const auto new_cells = [&](std::uint32_t k, bool cover) {
    int count = 0;
    for (int cell = 0; cell < cells * cells; ++cell) {
      const double dx = cell % cells + 0.5 - static_cast<double>(discs.x[k]),
                   dy = cell / cells + 0.5 - static_cast<double>(discs.y[k]),
                   radius = static_cast<double>(discs.radius[k]) + 0.5;
      if (covered[static_cast<std::size_t>(cell)] || dx * dx + dy * dy > radius * radius) continue;
      ++count;
      if (cover) covered[static_cast<std::size_t>(cell)] = true;
    }
    return count;
  };
  for (std::uint32_t i = 0; i < discs.count; ++i) {
    const std::uint32_t disc = coverage.choose();
    ASSERT_LT(disc, discs.count);
    ASSERT_FALSE(chosen[disc]);
    chosen[disc] = true;
    const int added = new_cells(disc, false);
    for (std::uint32_t k = 0; k < discs.count; ++k)
      if (!chosen[k]) {
        ASSERT_LE(new_cells(k, false), added);
      }
    new_cells(disc, true);
  }
}

TEST(DiscCoverage, ChoosesWhatAddsMost) {
  for (const detail::BuildImplementation& implementation : detail::build_implementations()) {
    SCOPED_TRACE(implementation.name);
    if (implementation.supported()) expect_best_choices(implementation.loops.interior);
  }
}

/// What no integer holds, or is not a number, becomes a cell of the raster before it is converted, on every processor.
TEST(DiscCoverage, DrawsDiscsThatNoIntegerHolds) {
  struct Drawn {
    float x, radius;
    std::int32_t cells;
  };
  constexpr float infinity = HUGE_VALF;
  constexpr int rows = detail::DiscCoverage::cells;
  for (const detail::BuildImplementation& implementation : detail::build_implementations()) {
    if (!implementation.supported()) continue;
    for (const auto& [x, radius, cells] :
         {Drawn{16, 1e15f, rows * rows}, Drawn{16, infinity, rows * rows}, Drawn{3e38f, 1, 0},
          Drawn{-3e38f, 1, 0}, Drawn{infinity, 1, 0}, Drawn{-infinity, infinity, 0},
          Drawn{infinity, infinity, rows * rows}}) {
      std::uint32_t bits[rows];
      EXPECT_EQ(implementation.loops.interior.draw(x, 16, radius, bits), cells)
          << implementation.name << x << radius;
      for (const std::uint32_t row : bits) EXPECT_EQ(row, cells == 0 ? 0u : ~0u) << implementation.name << x;
    }
  }
}

TEST(Interior, ExtremesAreTheFarthestPoints) {
  test::Random random(3);
  const Outline outline = test::star(random, 40, 0.2, 0.5);
  const detail::Interior inside = detail::interior(outline, 0.5);
  for (std::uint32_t k = 0; k < detail::extreme_directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / detail::extreme_directions;
    const double c = std::cos(angle), s = std::sin(angle);
    double farthest = -HUGE_VAL;
    for (const Vec2& p : outline.points)
      farthest = std::max(farthest, c * static_cast<double>(p.x) + s * static_cast<double>(p.y));
    EXPECT_NEAR(c * static_cast<double>(inside.extreme_x[k]) + s * static_cast<double>(inside.extreme_y[k]),
                farthest, 1e-9);
  }
}

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Direction {
  double x, y;
};

/// As kernels look it up.
std::uint32_t sector_of(Direction d) {
  const auto x = static_cast<float>(d.x), y = static_cast<float>(d.y);
  constexpr float quadrant = detail::profile_sectors / 4;
  const float fraction = quadrant * std::abs(y) / (std::abs(x) + std::abs(y));
  const float half = x < 0 ? 2 * quadrant - fraction : fraction;
  return static_cast<std::uint32_t>(y < 0 ? 4 * quadrant - half : half) % detail::profile_sectors;
}

/// At random, between sectors, and as little to either side as floats go.
std::vector<Direction> directions(test::Random& random) {
  std::vector<Direction> all;
  for (int i = 0; i < 64; ++i) {
    const double angle = random.uniform(-4, 4);
    all.push_back({std::cos(angle), std::sin(angle)});
  }
  constexpr int quadrant = detail::profile_sectors / 4;
  for (int k = -quadrant; k < quadrant; ++k)
    for (const double aside : {-1e-7, -6e-8, 0.0, 6e-8, 1e-7}) {
      const double x = quadrant - std::abs(k), y = k, length = std::sqrt(x * x + y * y);
      for (const double side : {1.0, -1.0}) {
        all.push_back({side * (x - aside * y) / length, side * (y + aside * x) / length});
      }
    }
  return all;
}

detail::Profile profile_of(const Shape& shape) {
  const double max_extent = shape.hierarchy.max_extent;
  detail::Profile result =
      detail::profile(shape.outline, detail::interior(shape.outline, max_extent), max_extent);
  std::vector<float> x, y, radius;
  for (const std::uint32_t node : cut(shape.hierarchy, all_depths)) {
    const Disc& disc = shape.hierarchy.nodes[node].disc;
    x.push_back(disc.x), y.push_back(disc.y), radius.push_back(disc.radius);
  }
  const auto count = static_cast<std::uint32_t>(x.size());
  x.resize(count + 4), y.resize(count + 4), radius.resize(count + 4);
  const detail::Outer found = detail::outer(result, x.data(), y.data(), radius.data(), count, max_extent);
  for (std::uint32_t k = 0; k < detail::profile_sectors; ++k) result.sectors[k].outer = found[k];
  return result;
}

/// What profile.cpp derives that these have to spare.
constexpr double inner_margin = 86 * detail::rounding::unit_roundoff,
                 outer_margin = 110 * detail::rounding::unit_roundoff,
                 extent_margin = 86 * detail::rounding::unit_roundoff;

constexpr double widest_sector = 0.246;  ///< radians, those about a quadrant's middle

/// Returns: of how many sectors something is known of the inside.
std::uint32_t expect_sound(const Shape& shape, test::Random& random) {
  const detail::Profile profile = profile_of(shape);
  const double max_extent = shape.hierarchy.max_extent;
  const std::span<const Vec2> contour = detail::largest_contour(shape.outline);
  for (const Direction& d : directions(random)) {
    const detail::Sector& sector = profile.sectors[sector_of(d)];
    const auto along = [&](double x, double y) {
      return (x - static_cast<double>(profile.x)) * d.x + (y - static_cast<double>(profile.y)) * d.y;
    };
    for (const double fraction : {0.0, random.uniform(0, 1), 1.0}) {
      if (sector.inner == -infinity) continue;
      const double out = fraction * static_cast<double>(sector.inner);
      EXPECT_GE(test::depth_in_contour<double>(contour, static_cast<double>(profile.x) + out * d.x,
                                               static_cast<double>(profile.y) + out * d.y),
                inner_margin * max_extent);
    }
    double farthest = -HUGE_VAL, behind = -HUGE_VAL;
    for (const std::uint32_t node : cut(shape.hierarchy, all_depths)) {
      const Disc& disc = shape.hierarchy.nodes[node].disc;
      farthest = std::max(farthest, along(disc.x, disc.y) + static_cast<double>(disc.radius));
    }
    for (const Vec2 p : shape.outline.points) behind = std::max(behind, -along(p.x, p.y));
    EXPECT_GE(sector.outer, farthest + outer_margin * max_extent);
    EXPECT_LE(sector.outer, farthest + widest_sector * 2 * max_extent);
    EXPECT_LE(sector.extent, behind - extent_margin * max_extent);
  }
  return static_cast<std::uint32_t>(std::count_if(std::begin(profile.sectors), std::end(profile.sectors),
                                                  [](const detail::Sector& s) { return s.inner > 0; }));
}

TEST(Profile, IsSoundForShapesOfManyKinds) {
  test::Random random(71);
  std::uint32_t known = 0;
  for (const Shape& shape : test::synthetic_shapes(72, 64)) known += expect_sound(shape, random);
  EXPECT_GT(known, 64 * detail::profile_sectors / 2);
}

TEST(Profile, IsSoundAndCompleteForPeople) {
  test::Random random(73);
  for (const Character& character : test::default_characters())
    for (const Shape& shape : test::pose_shapes(character, 10))
      EXPECT_EQ(expect_sound(shape, random), detail::profile_sectors);
}

TEST(Profile, IsAlmostTightForASquare) {
  const Outline square = test::polygon({{1, 1}, {3, 1}, {3, 3}, {1, 3}});
  const detail::Profile profile = profile_of({square, contour_hierarchy(square, 0.01f)});
  EXPECT_EQ(profile.x, 2);
  EXPECT_EQ(profile.y, 2);
  for (std::uint32_t k = 0; k < detail::profile_sectors; ++k) {
    const detail::Sector& sector = profile.sectors[k];
    // Sides are nearest at multiples of a quadrant, corners halfway between.
    const std::uint32_t from_side = std::min(k % 8, 7 - k % 8);
    const double nearest = std::hypot(1, from_side / (8.0 - from_side));
    EXPECT_NEAR(sector.inner, nearest, 2e-4) << k;
    EXPECT_GT(sector.outer, 1.05) << k;
    EXPECT_LT(sector.outer, 1.46) << k;
    EXPECT_GT(sector.extent, 0.98) << k;
    EXPECT_LT(sector.extent, 1.42) << k;
  }
}

/// A notch whose tip lies next to the line between two sectors ends the inside in both, whether its sides cross that
/// line or not.
void expect_notch_in_both(float side, float low, float high) {
  Outline notched = test::polygon({{-1, -1}, {1, -1}, {1, low}, {0.5f, 0}, {1, high}, {1, 1}, {-1, 1}});
  detail::Profile found = detail::profile(notched, {}, 1.5);
  // The tip moves the centre, and goes after it.
  for (int i = 0; i < 20; ++i) {
    notched.points[3].y = found.y + side * 1e-6f;
    found = detail::profile(notched, {}, 1.5);
  }
  EXPECT_NEAR(notched.points[3].y, found.y + side * 1e-6f, 2e-7);
  EXPECT_LT(found.sectors[0].inner, 0.5f - found.x) << side;
  EXPECT_LT(found.sectors[detail::profile_sectors - 1].inner, 0.5f - found.x) << side;
  EXPECT_GT(found.sectors[0].inner, 0.49f - found.x) << side;
}

TEST(Profile, MindsWhatIsJustBeyondASector) {
  expect_notch_in_both(1, 0.2f, 0.3f);
  expect_notch_in_both(-1, -0.3f, -0.2f);
  expect_notch_in_both(1, 0.02f, 0.1f);
  expect_notch_in_both(-1, -0.1f, -0.02f);
}

TEST(Profile, KnowsNothingOfTheInsideWhereThereIsNoRoom) {
  const Outline stroke = test::polygon({{1, 1}, {2, 1.5f}});
  for (const detail::Sector& sector : profile_of({stroke, contour_hierarchy(stroke, 0.01f)}).sectors) {
    EXPECT_EQ(sector.inner, -infinity);
    EXPECT_LT(sector.outer, 1.3f);
  }
  // A hook about its own centroid.
  const Outline hook =
      test::polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3.9f}, {3.9f, 3.9f}, {3.9f, 0.1f}, {0, 0.1f}});
  for (const detail::Sector& sector : profile_of({hook, contour_hierarchy(hook, 0.01f)}).sectors)
    EXPECT_EQ(sector.inner, -infinity);
}

TEST(Profile, SaysNothingOfHowSeveralContoursNest) {
  Outline two;
  two.points = {{1, 1}, {2, 1}, {2, 2}, {-1, -1}, {-2, -1}, {-2, -2}};
  two.contour_begin = {0, 3, 6};
  for (const detail::Sector& sector : profile_of({two, contour_hierarchy(two, 0.01f)}).sectors)
    EXPECT_EQ(sector.extent, -infinity);
}

}  // namespace
}  // namespace bch
