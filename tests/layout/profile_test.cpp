// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/profile.hpp"

#include "layout/base/rounding.hpp"
#include "layout/culling/interior.hpp"
#include "layout/format/contours.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Direction {
  double x, y;
};

/// As kernels look it up.
std::uint32_t sector_of(Direction d) {
  const auto x = static_cast<float>(d.x), y = static_cast<float>(d.y);
  constexpr float quadrant = detail::profile_sectors / 4;
  const float share = quadrant * std::abs(y) / (std::abs(x) + std::abs(y));
  const float half = x < 0 ? 2 * quadrant - share : share;
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
  const double reach = shape.hierarchy.reach;
  detail::Profile result = detail::profile(shape.outline, detail::interior(shape.outline, reach), reach);
  std::vector<float> x, y, radius;
  for (const std::uint32_t node : cut(shape.hierarchy, all_depths)) {
    const Disc& disc = shape.hierarchy.nodes[node].disc;
    x.push_back(disc.x), y.push_back(disc.y), radius.push_back(disc.radius);
  }
  const auto count = static_cast<std::uint32_t>(x.size());
  x.resize(count + 4), y.resize(count + 4), radius.resize(count + 4);
  const detail::Outer found = detail::outer(result, x.data(), y.data(), radius.data(), count, reach);
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
  const double reach = shape.hierarchy.reach;
  const std::span<const Vec2> contour = detail::largest_contour(shape.outline);
  for (const Direction& d : directions(random)) {
    const detail::Sector& sector = profile.sectors[sector_of(d)];
    const auto along = [&](double x, double y) {
      return (x - static_cast<double>(profile.x)) * d.x + (y - static_cast<double>(profile.y)) * d.y;
    };
    for (const double share : {0.0, random.uniform(0, 1), 1.0}) {
      if (sector.inner == -infinity) continue;
      const double out = share * static_cast<double>(sector.inner);
      EXPECT_GE(test::depth_in_contour<double>(contour, static_cast<double>(profile.x) + out * d.x,
                                               static_cast<double>(profile.y) + out * d.y),
                inner_margin * reach);
    }
    double farthest = -HUGE_VAL, behind = -HUGE_VAL;
    for (const std::uint32_t node : cut(shape.hierarchy, all_depths)) {
      const Disc& disc = shape.hierarchy.nodes[node].disc;
      farthest = std::max(farthest, along(disc.x, disc.y) + static_cast<double>(disc.radius));
    }
    for (const Vec2 p : shape.outline.points) behind = std::max(behind, -along(p.x, p.y));
    EXPECT_GE(sector.outer, farthest + outer_margin * reach);
    EXPECT_LE(sector.outer, farthest + widest_sector * 2 * reach);
    EXPECT_LE(sector.extent, behind - extent_margin * reach);
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
