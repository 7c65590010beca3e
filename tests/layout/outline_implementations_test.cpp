// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <bch/default_characters.hpp>
#include <bch/outline_builder.hpp>

#include "layout/base/build_implementation.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/outline_arrangement.hpp"
#include "tests/support/outline_soups.hpp"

// OutlineBuilder on every instruction set.

namespace bch {
namespace {

using test::Soup;

std::vector<const detail::BuildImplementation*> supported_implementations() {
  std::vector<const detail::BuildImplementation*> supported;
  for (const detail::BuildImplementation& row : detail::build_implementations())
    if (row.supported()) supported.push_back(&row);
  return supported;
}

TEST(OutlineBuilder, EqualsTheArrangementOfAllEdges) {
  test::Random random(2014);
  const auto implementations = supported_implementations();
  int compared = 0;
  Outline outline;
  for (int i = 0; i < 10000; ++i) {
    const Soup any = test::random_soup(random);
    const bool bind_pose = random.below(2) == 0;
    OutlineBuilder builder(any.triangles, any.positions.size(),
                           bind_pose ? std::span(any.positions) : std::span<const Vec3>(),
                           *implementations[static_cast<std::size_t>(i) % implementations.size()]);
    try {
      builder.build(any.positions, outline);
    } catch (const std::invalid_argument&) {
      continue;  // a soup of points
    }
    ++compared;
    ASSERT_EQ(test::on_grid(outline), test::arrangement_outline(test::on_grid(any, outline.grid_step)))
        << "soup " << i;
  }
  EXPECT_GT(compared, 9900);
}

/// Triangles a grid step wide and millions long: which way such a one goes round, floats cannot tell.
Soup soup_of_slivers(test::Random& random) {
  constexpr double step = 0x1p-23;
  const double x = random.uniform(0.6, 1), y = random.uniform(-1, 1);
  const auto on_grid = [&](double metres) {
    return static_cast<float>(step * (std::round(metres / step) + random.below(5) - 2));
  };
  Soup soup;
  const std::uint32_t count = 3 + random.below(4);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double share = i == 0 ? 0.99 : random.uniform(-0.99, 0.99);
    soup.positions.push_back({on_grid(share * x), on_grid(share * y), 0});
  }
  for (std::uint32_t i = 0; i < 6; ++i)
    soup.triangles.push_back({i % count, random.below(count), random.below(count)});
  return soup;
}

TEST(OutlineBuilder, SliversHaveTheOutlineOfTheirArrangement) {
  test::Random random(23);
  Outline outline;
  for (int i = 0; i < 3000; ++i) {
    const Soup slivers = soup_of_slivers(random);
    for (const detail::BuildImplementation* row : supported_implementations()) {
      OutlineBuilder(slivers.triangles, slivers.positions.size(), slivers.positions, *row)
          .build(slivers.positions, outline);
      ASSERT_EQ(outline.grid_step, 0x1p-23f);
      ASSERT_EQ(test::on_grid(outline), test::arrangement_outline(test::on_grid(slivers, outline.grid_step)))
          << row->name << ", soup " << i;
    }
  }
}

/// More candidates than any word of bits holds, all of them at one point: tip after tip, and the centre between.
TEST(OutlineBuilder, AStarIsWalkedTipByTip) {
  for (const detail::BuildImplementation* row : supported_implementations())
    for (const std::size_t tips : {3, 16, 17, 63, 64, 65, 300, 1100, 5000}) {
      Soup star{{{0, 0, 0}}, {}};
      for (std::uint32_t i = 0; i < tips; ++i) {
        const double angle = 6.283185307179586 * (i + 0.25) / static_cast<double>(tips);
        star.positions.push_back(
            {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
        star.triangles.push_back({0, i + 1, i + 1});
      }
      Outline outline;
      OutlineBuilder(star.triangles, star.positions.size(), {}, *row).build(star.positions, outline);
      ASSERT_EQ(outline.contours(), 1u) << row->name << ' ' << tips;
      ASSERT_EQ(outline.points.size(), 2 * tips) << row->name;
      for (std::size_t i = 0; i < tips; ++i) {
        const Vec2 tip = outline.points[2 * i], next = outline.points[(2 * i + 2) % (2 * tips)];
        ASSERT_EQ(outline.points[2 * i + 1], (Vec2{0, 0})) << row->name << ' ' << tips;
        ASSERT_GT(double{tip.x} * double{next.y} - double{tip.y} * double{next.x}, 0)
            << row->name << ' ' << tips;
      }
    }
}

TEST(OutlineBuilder, GivesTheSameBitsOnEveryInstructionSet) {
  const auto implementations = supported_implementations();
  ASSERT_STREQ(implementations.back()->name, detail::base.name);
  for (const Character& character : {default_male(), default_female()}) {
    detail::Skinner skinner(character);
    std::vector<OutlineBuilder> builders;
    for (const detail::BuildImplementation* row : implementations)
      builders.emplace_back(character.triangles, character.vertices.size(), character.vertices, *row);
    for (const PoseTime& time : sample_poses(character, 50)) {
      const auto positions = skinner.pose(time);
      const Outline expected = union_outline(positions, character.triangles);
      for (OutlineBuilder& builder : builders) {
        Outline outline;
        builder.build(positions, outline);
        ASSERT_EQ(outline.points, expected.points);
        ASSERT_EQ(outline.contour_begin, expected.contour_begin);
      }
    }
  }
}

}  // namespace
}  // namespace bch
