// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/oracle.hpp"
#include "baselines/reference.hpp"
#include "baselines/structure.hpp"
#include "kernel/runtime/all_options.hpp"
#include "kernel/runtime/tasks.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_arrays.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/query_references.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"
#include "tests/support/touching_scene.hpp"

// Exact leaves: that leaf segments decide like brute force over all segments, miss no outlines that meet, and take no others
// for meeting than those within the promised gap.

namespace bch {
namespace {

using baselines::Oracle;
using test::oracle;
using test::Random;
using Scene = test::TouchingScene;

std::vector<std::uint8_t> answers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                                  detail::AllOptions options = {}) {
  std::vector<std::uint8_t> hits(pairs.size(), 77);
  collide(set, agents, pairs, hits, options);
  return hits;
}

class ExactLeaves : public testing::Test {
 protected:
  Random random{2401};
  std::vector<Shape> shapes = test::simple_shapes(random, 600);
  ShapeSet set{shapes};
};

TEST_F(ExactLeaves, MissNoOutlinesThatMeetAndTakeNoOthersForMeeting) {
  constexpr std::uint32_t blocks = 400;
  std::vector<Scene> scenes(blocks);
  detail::run_each(blocks, [&](std::size_t i) {
    Random own(2402 + i);
    scenes[i] = test::touching_scene(own, shapes, test::samples(5'000));
  });
  std::size_t crossing = 0, near = 0, tested = 0;
  double largest = 0;
  for (const Scene& scene : scenes)
    for (const Implementation& implementation : test::supported()) {
      const auto hits = answers(set, scene.crowd.agents(), scene.pairs, {&implementation});
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const auto [cross, gap] = scene.truths[i];
        // A set's single discs decide for shapes that are one.
        const auto is_single = [&](std::uint32_t agent) {
          return set.arrays().trees[scene.crowd.shape[agent]].segments == detail::no_segments;
        };
        ASSERT_TRUE(!cross || hits[i]) << implementation.name << ", pair " << i;
        if (is_single(scene.pairs[i].first) || is_single(scene.pairs[i].second)) continue;
        ++tested;
        crossing += cross;
        if (!hits[i] || cross) continue;
        if (test::oracle(shapes, scene.crowd.agents(), scene.pairs[i]).nested()) continue;
        ++near;
        largest = std::max(largest, gap);
      }
    }
  std::printf("%zu answers, %zu cross; %zu hits with a gap, of up to %.3g m per metre of extent\n", tested,
              crossing, near, largest);
  EXPECT_GT(crossing, tested / 4);
  EXPECT_GT(near, tested / 50);
  const double most = detail::rounding::segment_margin +
                      detail::rounding::terms::segment_place * detail::rounding::unit_roundoff;
  EXPECT_LT(largest, most);
  EXPECT_GT(largest, 0.5 * most);
}

TEST_F(ExactLeaves, EqualBruteForceWhereOutlinesTouch) {
  const test::Questions questions =
      questions_about(random, set, touching_scene(random, shapes, test::samples(20'000)));
  expect_answers(set, questions, test::BruteForce(shapes, {}).answers(set, questions), "touching");
}

/// What the kernel's speed is measured against answers as it does: at random, where outlines touch, and inside each other.
TEST_F(ExactLeaves, EqualTheScalarDescent) {
  std::vector<baselines::Body> bodies;
  for (const Shape& shape : shapes) bodies.push_back({{}, {}, shape});
  const auto descent = baselines::kind("reference_segments").build(bodies, {});
  Scene scenes[] = {touching_scene(random, shapes, test::samples(50'000)), {}};
  test::PairScene anywhere = random_scene(random, set, test::samples(50'000));
  scenes[1].crowd = std::move(anywhere.crowd), scenes[1].pairs = std::move(anywhere.pairs);
  std::size_t hit = 0, nested = 0, asked = 0;
  for (Scene& scene : scenes) {
    scene.crowd.level.clear();
    const Agents agents = scene.crowd.agents();
    const auto expected = answers(set, agents, scene.pairs);
    std::vector<std::uint8_t> hits(scene.pairs.size(), 77);
    descent->query(agents, scene.pairs, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_EQ(hits[i], expected[i]) << "pair " << i;
      if (!hits[i]) continue;
      const Oracle exact = oracle(shapes, agents, scene.pairs[i]);
      nested += !exact.cross() && exact.nested();
    }
    hit += static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
    asked += hits.size();
  }
  std::printf("%zu pairs, %zu hits, %zu of them inside the other\n", asked, hit, nested);
  EXPECT_GT(hit, asked / 10);
  EXPECT_LT(hit, asked * 9 / 10);
  EXPECT_GT(nested, asked / 1000);
}

/// Where segments meet, so do leaf discs and all discs above them.
TEST_F(ExactLeaves, HitNothingThatDiscsDoNot) {
  const Scene scene = touching_scene(random, shapes, test::samples(50'000));
  const auto segments = answers(set, scene.crowd.agents(), scene.pairs),
             discs = answers(set, scene.crowd.agents(), scene.pairs, {.leaves = Leaves::discs});
  std::size_t cleared = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    ASSERT_LE(segments[i], discs[i]) << i;
    cleared += segments[i] < discs[i];
  }
  EXPECT_GT(cleared, 0u);
}

/// What people are tested for: exact outlines, and nothing between.
TEST(ExactLeavesOfPeople, AnswerAsOutlinesDo) {
  const std::vector<Shape> shapes = test::pose_shapes(default_male(), 12);
  const ShapeSet set(shapes);
  Random random(2403);
  test::PairScene scene = random_scene(random, set, 4'000);
  scene.crowd.level.clear();
  const auto hits = answers(set, scene.crowd.agents(), scene.pairs);
  std::size_t crossing = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Oracle exact = oracle(shapes, scene.crowd.agents(), scene.pairs[i]);
    const bool cross = exact.cross();
    crossing += cross;
    EXPECT_TRUE(hits[i] == cross || (hits[i] && exact.distance() < 1e-5L)) << i;
  }
  EXPECT_GT(crossing, hits.size() / 4);
  EXPECT_LT(crossing, hits.size() * 3 / 4);
}

/// Walls in one line: every side of every end is a toss of rounding, and only ends tell the gap.
TEST(ExactLeavesOfWalls, SeeTheGapBetweenWallsInOneLine) {
  const std::vector<Shape> shapes = {test::contour_shape(test::polygon({{0, 0}, {1, 0}}), 0.3f)};
  const ShapeSet set(shapes);
  Random random(2404);
  for (std::uint32_t i = 0; i < test::samples(20'000); ++i) {
    const double heading = random.uniform(-4, 4), c = std::cos(heading), s = std::sin(heading);
    const double gap = random.below(2) == 0 ? 1e-5 : -1e-5;
    const std::vector<std::uint32_t> shape = {0, 0};
    const std::vector<double> x = {0, (1 + gap) * c}, y = {0, (1 + gap) * s}, headings = {heading, heading};
    const std::vector<Pair> pairs = {{0, 1}};
    ASSERT_EQ(answers(set, {shape, x, y, headings}, pairs)[0], gap < 0) << heading;
  }
}

/// A leaf with a list: two strokes that are near each other, one of them the outline's last.
TEST(LeafSegments, OfAListDecideAsWell) {
  Outline outline = test::polygon({{0, 0}, {0.004f, 0}, {0.008f, 0}});
  test::append(outline, test::counter_clockwise(test::polygon({{0.5f, 0}, {0.9f, 0.1f}, {0.6f, 0.3f}})));
  test::append(outline, test::polygon({{0.002f, 0.001f}, {0.006f, 0.001f}}));
  const std::vector<Shape> shapes = {test::contour_shape(outline),
                                     test::contour_shape(test::polygon({{0, 0}, {0.1f, 0}}))};
  const ShapeSet set(shapes);
  const auto words = set.arrays().leaf_segments;
  EXPECT_TRUE(
      std::any_of(words.begin(), words.end(), [](std::uint32_t word) { return word >= detail::leaf_list; }));
  const std::vector<std::uint32_t> shape = {0, 1};
  const std::vector<Pair> pairs = {{0, 1}};
  const auto hit = [&](double y) {
    const std::vector<double> xs = {0, 0.004}, ys = {0, y}, headings = {0, std::numbers::pi / 2};
    return answers(set, {shape, xs, ys, headings}, pairs)[0] != 0;
  };
  EXPECT_TRUE(hit(-0.05));
  EXPECT_TRUE(hit(0.0005));
  EXPECT_FALSE(hit(0.0012));
}

/// Outlines a hundred times denser than discs: what two leaves take stays bounded, because discs decide there.
TEST(LeafSegments, OfDenseOutlinesAreDiscs) {
  Random random(2409);
  std::vector<Shape> shapes = {test::contour_shape(test::star(random, 20'000, 0.3, 0.31), 0.05f),
                               test::contour_shape(test::star(random, 40, 0.2, 0.4))};
  const ShapeSet set(shapes);
  const detail::Tree& dense = set.arrays().trees[0];
  EXPECT_EQ(
      std::count(set.arrays().leaf_segments.begin(), set.arrays().leaf_segments.begin() + dense.count, 0u),
      dense.count);
  const test::Questions questions = questions_about(random, set, random_scene(random, set, 300));
  expect_answers(set, questions, test::BruteForce(shapes, {}).answers(set, questions), "dense");
}

/// Agents at levels that have segments beside such at levels that do not: discs decide between those.
TEST(ExactLeavesOfLevels, BesideThatOfAllDepthsAreComparedByDiscs) {
  const std::vector<Shape> shapes = test::synthetic_shapes(2406, 12);
  const ShapeSetPlan plan{{0, 4, all_depths}};
  const ShapeSet set(shapes, plan);
  Random random(2407);
  const test::PairScene scene = random_scene(random, set, 20'000);
  const Agents agents = scene.crowd.agents();
  const auto segments = answers(set, agents, scene.pairs),
             discs = answers(set, agents, scene.pairs, {.leaves = Leaves::discs});
  std::size_t differ = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i] == discs[i]) continue;
    ++differ;
    ASSERT_EQ(agents.level[scene.pairs[i].first], 2) << i;
    ASSERT_EQ(agents.level[scene.pairs[i].second], 2) << i;
  }
  EXPECT_GT(differ, 0u);
}

// ---- The whole way from a character to answers, on all default poses and on real characters.

/// Two outlines in a relative placement bisected to where they begin to cross: no kernel may miss the
/// crossing.
void expect_no_crossing_missed(const std::vector<Shape>& shapes, std::uint32_t pairs) {
  const ShapeSetPlan plan{{0, 3, 6, all_depths}, true};
  const ShapeSet set(shapes, plan);
  const baselines::Reference reference(shapes, plan);
  test::Random random(2014);

  const auto crosses = [&](const Agents& agents, Pair pair) { return oracle(shapes, agents, pair).cross(); };
  pairs = test::samples(pairs);
  test::PairScene scene = random_scene(random, set, pairs);
  for (std::uint32_t i = 0; i < pairs; ++i)
    scene.crowd.shape[2 * i] = i % set.shape_count();  // every pose takes part
  make_tangent(random, scene, crosses);

  const Agents agents = scene.crowd.agents();
  std::vector<bool> crossing;
  for (const Pair& pair : scene.pairs) crossing.push_back(crosses(agents, pair));
  EXPECT_GT(std::count(crossing.begin(), crossing.end(), true), std::ssize(crossing) / 3);
  std::vector<std::uint8_t> expected, hits(pairs);
  for (const Pair pair : scene.pairs)
    expected.push_back(reference.solid(agents, pair, baselines::Method::brute_force));
  for (std::uint32_t i = 0; i < pairs; ++i) EXPECT_TRUE(expected[i] == 1 || !crossing[i]) << i;
  for (const Implementation& implementation : test::supported()) {
    collide(set, agents, scene.pairs, hits, {&implementation});
    EXPECT_EQ(hits, expected) << implementation.name;
  }
}

std::vector<Shape> poses_of(const std::vector<Character>& characters, std::uint32_t poses) {
  std::vector<Shape> shapes;
  for (const Character& character : characters)
    for (Shape& shape : test::pose_shapes(character, poses)) shapes.push_back(std::move(shape));
  return shapes;
}

TEST(SyntheticShapes, NoOutlineCrossingIsMissed) {
  expect_no_crossing_missed(test::synthetic_shapes(20141, 40), 1500);
}

TEST(DefaultPoses, NoOutlineCrossingIsMissed) {
  expect_no_crossing_missed(poses_of(test::default_characters(), 100), 2000);
}

TEST(RealPoses, NoOutlineCrossingIsMissed) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_no_crossing_missed(poses_of(test::real_characters(*data), 50), 2000);
}

}  // namespace
}  // namespace bch
