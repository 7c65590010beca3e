// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/build_implementation.hpp"
#include "layout/character/skinning.hpp"
#include "layout/outline/grid_geometry.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/outline_soups.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::Soup;

Outline build(const Soup& soup) {
  Outline outline;
  OutlineBuilder(soup.triangles, soup.positions.size()).build(soup.positions, outline);
  return outline;
}

/// Triangles of their own vertices, whose corners' coordinates follow each other, in metres: 2^22 steps each in the outline's grid.
Soup soup(const std::string& corners) {
  Soup result;
  std::istringstream numbers(corners);
  for (float x = 0, y = 0; numbers >> x >> y;) result.positions.push_back({x, y, 0});
  for (std::uint32_t v = 0; v < result.positions.size(); v += 3)
    result.triangles.push_back({v, v + 1, v + 2});
  return result;
}

/// The points of each contour, for input whose outline has its corners there.
std::string contours(const Outline& outline) {
  std::ostringstream text;
  text.precision(9);
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    text << (c == 0 ? "" : "; ");
    for (const Vec2& p : outline.contour(c))
      text << (&p == outline.contour(c).data() ? "" : ", ") << p.x << ' ' << p.y;
  }
  return text.str();
}

TEST(OutlineBuilder, GoesRoundTriangles) {
  test::expect_table(__FILE__, "outline_contours.txt",
                     [](const auto& fields) { return contours(build(soup(fields[0]))); });
}

TEST(OutlineBuilder, VerticesThatAPosePartsAreNotTakenForOne) {
  // Two halves of a square with vertices of their own along the diagonal.
  Soup halves = soup("0 0 2 0 2 2  0 0 2 2 0 2");
  const std::vector<Vec3> bind_pose = halves.positions;
  OutlineBuilder builder(halves.triangles, halves.positions.size(), bind_pose);
  Outline outline;
  builder.build(halves.positions, outline);
  EXPECT_EQ(contours(outline), "0 0, 2 0, 2 2, 0 2");
  for (std::size_t v = 3; v < 6; ++v) halves.positions[v].x -= 3;
  builder.build(halves.positions, outline);
  EXPECT_EQ(contours(outline), "-3 0, -1 2, -3 2; 0 0, 2 0, 2 2");
}

TEST(OutlineBuilder, RejectsBadInput) {
  const Soup good = soup("0 0 1 0 0 1");
  Outline outline;
  EXPECT_THROW(OutlineBuilder({}, 3), std::invalid_argument);
  EXPECT_THROW(OutlineBuilder(good.triangles, 2), std::invalid_argument);
  const std::vector<Vec3> two(2);
  EXPECT_THROW(OutlineBuilder(good.triangles, 3, two), std::invalid_argument);
  std::vector<Vec3> bad = good.positions;
  bad[1].z = std::numeric_limits<float>::infinity();
  EXPECT_THROW(OutlineBuilder(good.triangles, 3, bad), std::invalid_argument);
  OutlineBuilder builder(good.triangles, 3);
  EXPECT_THROW(builder.build(two, outline), std::invalid_argument);
}

TEST(OutlineBuilder, RejectsWhatIsNotFiniteWhereverItIs) {
  const Soup good = soup("0 0 1 0 0 1  2 0 3 0 2 1  4 0 5 0 4 1");
  OutlineBuilder builder(good.triangles, good.positions.size());
  Outline outline;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (std::size_t v = 0; v < good.positions.size(); ++v)
    for (const int axis : {0, 1})
      for (const float bad : {nan, -nan, inf, -inf}) {
        std::vector<Vec3> positions = good.positions;
        (axis == 0 ? positions[v].x : positions[v].y) = bad;
        EXPECT_THROW(builder.build(positions, outline), std::invalid_argument)
            << v << ' ' << axis << ' ' << bad;
      }
}

TEST(Fraction, IsComparedExactly) {
  constexpr std::int64_t large = std::int64_t{1} << 49;
  const detail::Fraction smaller(large - 3, large - 2), larger(large - 2, large - 1);
  ASSERT_EQ(smaller.value, larger.value);
  EXPECT_EQ(detail::compare(smaller, larger), -1);
  EXPECT_EQ(detail::compare(larger, smaller), 1);
  EXPECT_EQ(detail::compare(detail::Fraction(1, 3), detail::Fraction(large / 3, large / 3 * 3)), 0);
  EXPECT_EQ(detail::compare(detail::Fraction(0, 1), larger), -1);
}

/// Soups on the grid; and slivers of a few steps, whose contours the rounding of crossings may turn round.
TEST(OutlineBuilder, MakesOutlinesThatAreValid) {
  test::Random random(72);
  const std::uint32_t count = test::samples(20'000);
  for (std::uint32_t i = 0; i < count; ++i) {
    Soup soup = test::random_soup(random);
    if (i % 2 == 0)
      for (Vec3& p : soup.positions) {
        const auto size = static_cast<float>(std::exp2(random.uniform(-30, -10)));
        p.x += size * static_cast<float>(random.uniform(-1, 1));
        p.y += size * static_cast<float>(random.uniform(-1, 1));
      }
    Outline outline;
    try {
      outline = build(soup);
    } catch (const std::invalid_argument&) {
      continue;  // a soup of points
    }
    ASSERT_NO_THROW(validate(outline)) << i;
  }
}

/// The same union, made of the same triangles in another order, turned over, numbered otherwise, some twice.
TEST(OutlineBuilder, DependsOnTheUnionAlone) {
  test::Random random(5);
  for (int i = 0; i < 500; ++i) {
    Soup any = test::random_soup(random);
    Outline outline;
    try {
      outline = build(any);
    } catch (const std::invalid_argument&) {
      continue;
    }
    ASSERT_EQ(bch::outline(any.positions, any.triangles).points, outline.points) << i;
    Soup other;
    for (std::size_t left = any.triangles.size(); left > 0;) {
      const std::size_t t = random.below(static_cast<std::uint32_t>(left));
      auto triangle = any.triangles[t];
      if (random.below(4) != 0) any.triangles[t] = any.triangles[--left];
      if (random.below(2) == 0) std::swap(triangle[1], triangle[2]);
      const auto first = static_cast<std::uint32_t>(other.positions.size());
      for (const std::uint32_t v : triangle) other.positions.push_back(any.positions[v]);
      other.triangles.push_back({first + 1, first + 2, first});
    }
    const Outline again = build(other);
    ASSERT_EQ(again.points, outline.points) << i;
    ASSERT_EQ(again.contour_begin, outline.contour_begin) << i;
  }
}

// ---- On every instruction set

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
    const double fraction = i == 0 ? 0.99 : random.uniform(-0.99, 0.99);
    soup.positions.push_back({on_grid(fraction * x), on_grid(fraction * y), 0});
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
      const Outline expected = bch::outline(positions, character.triangles);
      for (OutlineBuilder& builder : builders) {
        Outline outline;
        builder.build(positions, outline);
        ASSERT_EQ(outline.points, expected.points);
        ASSERT_EQ(outline.contour_begin, expected.contour_begin);
      }
    }
  }
}

// ---- Outlines of many disjoint components. The large ones would take minutes if each component were compared with all others,
// beyond this test's time limit.

Outline built(const Soup& soup) {
  Outline outline;
  OutlineBuilder(soup.triangles, soup.positions.size(), soup.positions).build(soup.positions, outline);
  return outline;
}

void expect_equals_arrangement(const Soup& soup) {
  const Outline outline = built(soup);
  ASSERT_EQ(test::on_grid(outline), test::arrangement_outline(test::on_grid(soup, outline.grid_step)));
}

/// Combs are contours of hundreds of stretches, of which each component asks a few.
TEST(OutlineIslands, SmallSoupsHaveTheOutlinesOfTheirArrangements) {
  test::Random random(7);
  for (const Soup& soup : {test::separate_triangles(30), test::nested_frames(3, 3), test::comb(24, false),
                           test::comb(24, true), test::chain(20), test::nearly_equal_triangles(random, 12, 4),
                           test::nearly_equal_triangles(random, 12, 40)})
    expect_equals_arrangement(soup);
}

TEST(OutlineIslands, JumblesHaveTheOutlinesOfTheirArrangements) {
  test::Random random(8);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("jumble " + std::to_string(i));
    expect_equals_arrangement(test::jumble(random));
    if (HasFatalFailure()) return;
  }
}

/// Many jumbles apart from each other, with more candidates than are looked at without a tree: the outline is that of each.
TEST(OutlineIslands, AFieldOfJumblesHasTheOutlinesOfAllOfThem) {
  constexpr std::int32_t row = 36, pitch = 512;
  test::Random random(9);
  Soup field;
  std::vector<Soup> jumbles;
  for (std::int32_t i = 0; i < row * row; ++i) {
    jumbles.push_back(test::jumble(random));
    test::append(field, jumbles.back(), pitch * (i % row), pitch * (i / row));
  }
  ASSERT_GT(field.triangles.size(), 16'384u);
  const Outline outline = built(field);
  const auto step = static_cast<std::int64_t>(0x1p-10f / outline.grid_step);  // of a jumble's unit
  ASSERT_GT(step, 0);
  std::vector<std::vector<test::IntegerContour>> found(jumbles.size());
  for (test::IntegerContour& contour : test::on_grid(outline)) {
    const auto cell = [&](std::int64_t steps) { return (steps + 64 * step) / (pitch * step); };
    const std::int64_t x = cell(contour[0].x), y = cell(contour[0].y);
    for (test::IntegerPoint& p : contour) p.x -= x * pitch * step, p.y -= y * pitch * step;
    found[static_cast<std::size_t>(y * row + x)].push_back(contour);
  }
  for (std::size_t i = 0; i < jumbles.size(); ++i)
    ASSERT_EQ(found[i], test::arrangement_outline(test::on_grid(jumbles[i], outline.grid_step))) << i;
}

TEST(OutlineIslands, AnIslandInsideALongContourIsLeftOut) {
  for (const bool before : {false, true})
    EXPECT_EQ(built(test::wheel(1000, before)).contours(), before ? 2u : 1u);
}

TEST(OutlineIslands, CountsManySeparateTriangles) {
  constexpr std::uint32_t count = test::samples(360'000);
  const Outline outline = built(test::separate_triangles(count));
  ASSERT_EQ(outline.contours(), count);
  EXPECT_EQ(outline.points.size(), 3 * count);
  for (std::size_t c = 1; c < count; ++c) {
    const Vec2 before = outline.contour(c - 1)[0], now = outline.contour(c)[0];
    ASSERT_TRUE(before.x < now.x || (before.x == now.x && before.y < now.y)) << c;
  }
}

TEST(OutlineIslands, CountsManyNests) {
  const Outline outline = built(test::nested_frames(2000, 25));
  EXPECT_EQ(outline.contours(), 2000u);
  EXPECT_EQ(outline.points.size(), 6000u);
}

TEST(OutlineIslands, CountsIslandsBetweenManyTeeth) {
  constexpr std::uint32_t teeth = test::samples(50'000);
  for (const bool before : {false, true})
    EXPECT_EQ(built(test::comb(teeth, before)).contours(), teeth + 1 + (before ? 1 : 0));
}

TEST(OutlineIslands, CountsOneContourOfAChain) {
  EXPECT_EQ(built(test::chain(100'000)).contours(), 1u);
}

/// On each instruction set that it is compiled for, a builder finds the same.
TEST(OutlineIslands, EqualsItselfOnEveryInstructionSet) {
  const Soup soup = test::separate_triangles(20'000);
  const Outline expected = built(soup);
  for (const detail::BuildImplementation* row : supported_implementations()) {
    Outline outline;
    OutlineBuilder(soup.triangles, soup.positions.size(), soup.positions, *row)
        .build(soup.positions, outline);
    EXPECT_EQ(outline.points, expected.points) << row->name;
    EXPECT_EQ(outline.contour_begin, expected.contour_begin) << row->name;
  }
}

TEST(OutlineIslands, AllocateNothingTheSecondTime) {
  const Soup soup = test::comb(6000, true);
  OutlineBuilder builder(soup.triangles, soup.positions.size(), soup.positions);
  Outline outline;
  builder.build(soup.positions, outline);
  const std::size_t before = test::allocation_count();
  builder.build(soup.positions, outline);
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace bch
