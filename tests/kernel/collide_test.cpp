// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/reference.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/processor.hpp"
#include "layout/format/contours.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

using baselines::Method;
using baselines::Reference;
using test::PairScene;
using test::Random;

const ShapeSetPlan plan{{0, 3, 6, all_depths}, true};

std::vector<std::uint8_t> answers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                                  const Implementation& implementation) {
  std::vector<std::uint8_t> hits(pairs.size(), 77);
  collide(set, agents, pairs, hits, {&implementation});
  return hits;
}

/// Every implementation against brute force; says which pair differs and where it stands.
void expect_equal_to_brute_force(const ShapeSet& set, const Reference& reference, const PairScene& scene,
                                 const std::string& what) {
  const Agents agents = scene.crowd.agents();
  std::vector<std::uint8_t> expected;
  for (const Pair& pair : scene.pairs) expected.push_back(reference.solid(agents, pair, Method::brute_force));
  const auto hits = std::count(expected.begin(), expected.end(), 1);
  EXPECT_GT(hits, 0) << what;
  EXPECT_LT(hits, std::ssize(expected)) << what;
  for (const Implementation& implementation : test::supported()) {
    const auto hits_of = answers(set, agents, scene.pairs, implementation);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(hits_of[i], expected[i])
          << what << ", " << implementation.name << ", pair " << i << ": shapes " << agents.shape[2 * i]
          << " and " << agents.shape[2 * i + 1];
  }
}

class Differential : public test::Differential {
 protected:
  Differential() : test::Differential(20141, plan) {}
};

/// Beside those of queries_test, to a million: at random, near tangent, and of either kind far from the origin.
TEST_F(Differential, ManyPairs) {
  for (std::uint32_t i = 0; i < test::samples(28); ++i) {
    PairScene scene = i % 2 == 0 ? random_scene(random, set, 25'000) : tangent_scene(25'000);
    if (i % 4 >= 2) test::move_away(scene, 1e7, -8e8);
    expect_equal_to_brute_force(set, discs, scene, "scene " + std::to_string(i));
  }
}

/// A wedge points to where its sector is that a direction of zero length has. Inside it lies a smaller one, whose far end
/// sticks out farther behind the common centre than the larger one goes on before it.
TEST(Collide, AContourInsideAnotherOfTheSameCentreIsFound) {
  const Outline wedge = test::polygon({{-1, 0}, {0.25f, -0.5f}, {0.25f, 0.5f}});
  Outline smaller = wedge;
  for (Vec2& p : smaller.points) p = {0.75f * p.x, 0.75f * p.y};
  const std::vector<Shape> shapes = {test::contour_shape(wedge), test::contour_shape(smaller)};
  const ShapeSet set(shapes), discs(shapes, {.outlines = false});
  const detail::Profile* const profiles = set.view().profiles;
  ASSERT_EQ(profiles[0].y, 0);
  ASSERT_EQ(profiles[1].y, 0);
  test::PairScene scene;
  scene.crowd.add({0, 0, 0, 0, 0});
  scene.crowd.add({1, static_cast<double>(profiles[0].x) - static_cast<double>(profiles[1].x), 0, 0, 0});
  scene.pairs = {{0, 1}};
  for (const Implementation& implementation : test::supported()) {
    EXPECT_EQ(answers(set, scene.crowd.agents(), scene.pairs, implementation)[0], 1) << implementation.name;
    EXPECT_EQ(answers(discs, scene.crowd.agents(), scene.pairs, implementation)[0], 0) << implementation.name;
  }
}

TEST(Collide, TouchingCountsAndAnAgentMeetsItself) {
  const ShapeSet set(std::vector<Shape>{{{}, detail::fixed_cylinder(0.25f)}});
  const float radius = set.view().roots[0].radius;
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  crowd.add({0, 2 * static_cast<double>(radius), 0, 0, 0});
  crowd.add({0, -2 * static_cast<double>(std::nextafter(radius, 1.0f)), 0, 0, 0});
  const std::vector<Pair> pairs = {{0, 1}, {0, 2}, {1, 2}, {1, 1}};
  std::vector<std::uint8_t> hits(4);
  collide(set, crowd.agents(), pairs, hits);
  EXPECT_EQ(hits, (std::vector<std::uint8_t>{1, 0, 0, 1}));
}

TEST(Implementations, AreNamedAndEndWithOnesThatRunEverywhere) {
  const auto all = implementations();
  const std::vector<std::string> names{BCH_ON_X86("avx512", "avx2", "sse2", ) BCH_ON_NEON("neon", ) "scalar"};
  ASSERT_EQ(all.size(), names.size());
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(all[i].name, names[i]);
    known += (i == 0 ? "" : ", ") + names[i];
  }
  EXPECT_TRUE(all.back().supported());
  EXPECT_EQ(implementation("scalar").kernels->width, 1u);
  EXPECT_EQ(test::complaint([] { implementation("altivec"); }),
            "expected an implementation of " + known + ", found \'altivec\'");
}

constexpr std::uint8_t levels = 3;

/// On the same grid, as outlines have to be.
Outline scaled(const Outline& outline, double factor) {
  Outline result = outline;
  const double step = outline.grid_step;
  for (Vec2& p : result.points)
    p = {static_cast<float>(std::round(factor * static_cast<double>(p.x) / step) * step),
         static_cast<float>(std::round(factor * static_cast<double>(p.y) / step) * step)};
  return result;
}

/// Whether a corner of the second agent's outline is inside the first one's: then their areas meet.
bool has_corner_inside(const Outline& outer, const Outline& inner, double x, double y, double heading) {
  const detail::Rotation turn = detail::rotation(heading);
  return std::any_of(inner.points.begin(), inner.points.end(), [&](Vec2 p) {
    const double px = p.x, py = p.y;
    return test::inside(outer, x + turn.cosine * px - turn.sine * py, y + turn.sine * px + turn.cosine * py);
  });
}

/// A small copy of the shape at every place of a raster over it, where the two meet.
test::PairScene copies_inside(test::Random& random, const Outline& big, const Outline& small) {
  test::PairScene scene;
  constexpr int raster = 40;
  const double size = detail::max_extent(big.points);
  for (int j = 0; j < raster; ++j)
    for (int i = 0; i < raster; ++i) {
      const double x = size * (2.0 * i / raster - 1), y = size * (2.0 * j / raster - 1),
                   heading = random.uniform(-3, 3);
      if (!has_corner_inside(big, small, x, y, heading)) continue;
      const auto index = static_cast<std::uint32_t>(scene.crowd.shape.size());
      const auto level = [&] { return static_cast<std::uint8_t>(random.below(levels)); };
      scene.crowd.add({0, 0, 0, 0, level()});
      scene.crowd.add({1, x, y, heading, level()});
      scene.pairs.push_back({index, index + 1});
    }
  return scene;
}

void expect_all_found(const std::vector<Shape>& poses) {
  test::Random random(77);
  std::size_t clear_inside = 0;
  for (const Shape& pose : poses) {
    const Outline small = scaled(pose.outline, 0.3);
    const std::vector<Shape> shapes = {pose, test::contour_shape(small)};
    const ShapeSet set(shapes, {{2, 5, all_depths}}), discs(shapes, {{2, 5, all_depths}, false});
    const test::PairScene scene = copies_inside(random, pose.outline, small);
    ASSERT_GT(scene.pairs.size(), 100u);
    std::vector<std::uint8_t> hits(scene.pairs.size()), hits_of_discs(hits);
    for (const Implementation& implementation : test::supported()) {
      collide(set, scene.crowd.agents(), scene.pairs, hits, {&implementation});
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 0), 0) << implementation.name;
    }
    // Without outlines the inscribed discs decide nothing either.
    collide(ShapeSet(shapes, {{2, 5, all_depths}, false, false}), scene.crowd.agents(), scene.pairs, hits);
    collide(discs, scene.crowd.agents(), scene.pairs, hits_of_discs);
    EXPECT_EQ(hits_of_discs, hits);
    clear_inside += static_cast<std::size_t>(std::count(hits_of_discs.begin(), hits_of_discs.end(), 0));
  }
  EXPECT_GT(clear_inside, 10 * poses.size());  // there are copies that touch no edge
}

TEST(Containment, ASmallCopyIsFoundEverywhereInAPose) {
  expect_all_found(test::pose_shapes(default_male(), 10));
  expect_all_found(test::pose_shapes(default_female(), 10));
}

TEST(Containment, ASmallCopyIsFoundEverywhereInARealPose) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set";
  for (const Character& character : test::real_characters(*data))
    expect_all_found(test::pose_shapes(character, 5));
}

/// Outlines from elsewhere may overlap themselves, or have contours inside others. Inside is what a contour goes round an
/// odd number of times, with culling data and without.
TEST(Containment, InsideIsWhatAContourGoesRoundAnOddNumberOfTimes) {
  const std::vector<Outline> outlines = {
      test::polygon({{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}}),  // a star in one stroke
      test::polygon(
          {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-3, -3}, {2, -2}, {2, 2}, {-2, 2}}),  // most of it twice
      test::polygon({{-3, -2}, {3, 2}, {3, -2}, {-3, 3}}),                            // one half clockwise
  };
  const Outline probe =
      test::polygon({{-0.125f, -0.125f}, {0.125f, -0.125f}, {0.125f, 0.125f}, {-0.125f, 0.125f}});
  test::Random random(78);
  for (const Outline& outline : outlines) {
    const std::vector<Shape> shapes = {test::contour_shape(outline), test::contour_shape(probe)};
    test::PairScene scene;
    for (std::uint32_t i = 0; i < 2'000; ++i) {
      scene.crowd.add({0, 0, 0, 0, 0});
      scene.crowd.add({1, random.uniform(-3, 3), random.uniform(-3, 3), 0, 0});
      scene.pairs.push_back({2 * i, 2 * i + 1});
    }
    std::vector<std::uint8_t> hits(scene.pairs.size()), hits_of_discs(hits);
    std::size_t inside = 0, in_a_hole = 0;
    for (const bool culling : {false, true}) {
      const ShapeSet set(shapes, {.culling = culling}),
          discs(shapes, {.outlines = false, .culling = culling});
      for (const Implementation& implementation : test::supported()) {
        collide(discs, scene.crowd.agents(), scene.pairs, hits_of_discs, {&implementation});
        collide(set, scene.crowd.agents(), scene.pairs, hits, {&implementation});
        for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
          if (hits_of_discs[i] != 0) continue;
          const bool is_inside = test::inside(outline, scene.crowd.x[2 * i + 1], scene.crowd.y[2 * i + 1]);
          ASSERT_EQ(hits[i], is_inside) << implementation.name << (culling ? " with" : " without");
          (is_inside ? inside : in_a_hole) += 1;
        }
      }
    }
    EXPECT_GT(inside, 100u);
    EXPECT_GT(in_a_hole, 100u);
  }
}

/// A wheelchair holds a small cart, of which it knows the outline, but not a cylinder, which has none.
TEST(Containment, ABodyWithoutAnOutlineIsItsDiscsAlone) {
  const auto square = [](float half) {
    return test::contour_shape(test::polygon({{-half, -half}, {half, -half}, {half, half}, {-half, half}}));
  };
  const std::vector<Shape> shapes = {square(1), square(0.1f), {{}, detail::fixed_cylinder(0.1f)}};
  test::Crowd crowd;
  for (const double x : {0.0, 0.95})
    for (std::uint32_t shape = 0; shape < 3; ++shape) crowd.add({shape, shape == 0 ? 0 : x, 0, 0.3, 0});
  const std::vector<Pair> pairs = {{0, 1}, {0, 2}, {3, 4}, {3, 5}};
  for (const bool culling : {false, true}) {
    const ShapeSet set(shapes, {.culling = culling});
    for (const Implementation& implementation : test::supported()) {
      std::vector<std::uint8_t> hits(pairs.size());
      collide(set, crowd.agents(), pairs, hits, {&implementation});
      EXPECT_EQ(hits, (std::vector<std::uint8_t>{1, 0, 1, 1})) << implementation.name;
    }
  }
}

}  // namespace
}  // namespace bch
