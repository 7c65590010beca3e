// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

std::vector<float> every(float step, float top) {
  std::vector<float> planes;
  for (int i = 1; static_cast<float>(i) * step < top; ++i) planes.push_back(static_cast<float>(i) * step);
  return planes;
}

std::vector<Shape> people(const std::vector<float>& slices, std::uint32_t poses) {
  std::vector<Shape> shapes;
  for (const Character& character : test::default_characters()) {
    PoseShaper shaper(character, {.slices = slices});
    for (const PoseTime& time : sample_poses(character, poses)) shapes.push_back(shaper.shape(time));
  }
  return shapes;
}

/// Pairs of a random crowd that collide.
std::size_t hits_of(const std::vector<float>& slices) {
  const std::vector<Shape> shapes = people(slices, 30);
  const ShapeSet set(shapes, {.slices = slices});
  test::Random random(262);
  test::Crowd crowd;
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < 4'000; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi), distance = random.uniform(0.2, 1.2);
    crowd.add({random.below(set.shape_count()), 0, 0, random.uniform(-4, 4), 0});
    crowd.add({random.below(set.shape_count()), distance * std::cos(angle), distance * std::sin(angle),
               random.uniform(-4, 4), 0});
    pairs.push_back({2 * i, 2 * i + 1});
  }
  std::vector<std::uint8_t> hits(pairs.size());
  collide(set, crowd.agents(), pairs, hits);
  return static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
}

TEST(BestSlices, ClearMoreThanOthers) {
  const std::vector<float> planes = every(0.05f, 1.85f);
  const std::vector<Shape> shapes = people(planes, 20);
  std::size_t before = hits_of({});
  for (const std::uint32_t slabs : {2u, 3u, 4u, 8u}) {
    const std::vector<float> best = best_slices(shapes, planes, slabs);
    ASSERT_EQ(best.size(), slabs - 1);
    EXPECT_TRUE(std::is_sorted(best.begin(), best.end()));
    EXPECT_EQ(best, best_slices(shapes, planes, slabs));
    const std::size_t hits = hits_of(best);
    EXPECT_LT(hits, before);
    std::vector<float> uniform;
    for (std::uint32_t i = 1; i < slabs; ++i)
      uniform.push_back(1.8f * static_cast<float>(i) / static_cast<float>(slabs));
    EXPECT_LE(100 * hits, 101 * hits_of(uniform)) << slabs;  // another crowd than the one that chose
    // Those for standing people are nearly as good.
    const auto standing = static_cast<double>(hits_of(standing_slices(slabs)));
    EXPECT_LT(standing, 1.04 * static_cast<double>(hits)) << slabs;
    EXPECT_LT(static_cast<double>(hits), 1.02 * standing) << slabs;
    before = hits;
  }
}

TEST(BestSlices, AreAllOfFewPlanes) {
  const std::vector<float> planes = {0.4f, 1.0f};
  const std::vector<Shape> shapes = people(planes, 2);
  EXPECT_EQ(best_slices(shapes, planes, 3), planes);
  EXPECT_EQ(best_slices(shapes, planes, 9), planes);
  EXPECT_TRUE(best_slices(shapes, planes, 1).empty());
}

/// No plane clears pairs of pillars, and one plane clears all pairs of a low body and a high one.
TEST(BestSlices, LeaveOutPlanesThatClearNothingMore) {
  const std::vector<float> planes = every(0.2f, 2);
  const Shape box =
      test::contour_shape(test::polygon({{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}));
  std::vector<Shape> pillars(3), halves(2);
  for (Shape& pillar : pillars) pillar.slabs.assign(planes.size() + 1, box);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    halves[i].slabs.resize(planes.size() + 1);
    halves[i].slabs[i == 0 ? 1 : 5] = box;
  }
  for (const std::uint32_t slabs : {2u, 3u, 4u}) {
    EXPECT_TRUE(best_slices(pillars, planes, slabs).empty()) << slabs;
    const std::vector<float> best = best_slices(halves, planes, slabs);
    ASSERT_EQ(best.size(), 1u) << slabs;
    EXPECT_GE(best[0], planes[1]);
    EXPECT_LE(best[0], planes[4]);
  }
}

TEST(BestSlices, RejectsWhatIsWrong) {
  const std::vector<float> planes = {0.4f, 1.0f};
  const std::vector<Shape> shapes = people({0.4f}, 2);
  EXPECT_EQ(test::complaint([&] { best_slices({}, planes, 2); }), "best slices: no bodies");
  EXPECT_EQ(test::complaint([&] { best_slices(shapes, planes, 0); }), "best slices: no slabs");
  EXPECT_EQ(test::complaint([&] { best_slices(shapes, planes, 2); }),
            "best slices: body 0 has 2 slabs, not 3");
  EXPECT_EQ(test::complaint([] { standing_slices(5); }), "standing slices: 5 slabs, not 1, 2, 3, 4 or 8");
}

}  // namespace
}  // namespace bch
