// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <bch/default_characters.hpp>
#include <bch/pose_shape.hpp>

#include "bench/report/coverage.hpp"
#include "bench/report/front.hpp"
#include "bench/report/mesh_volume.hpp"
#include "bench/report/packing.hpp"
#include "bench/report/slide.hpp"
#include "bench/report/statistics.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/tree_size.hpp"
#include "bench/report/words.hpp"
#include "bench/workload/mesh_detail.hpp"
#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/temporary_folder.hpp"

// What experiments are made of.

namespace bch::report {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ReportParts, TablesComeBackAsTheyWere) {
  Table table({"name, with a comma", "number (m)"});
  table.add({"a \"quoted\" word, and more", 0.1});
  table.add({"", std::nan("")});
  table.add({"x", 1.0 / 3});
  const TemporaryFolder folder;
  const Table read = read_table(folder.write("t.csv", csv_of(table)));
  EXPECT_EQ(read.columns(), table.columns());
  EXPECT_EQ(read.rows(), table.rows());
  EXPECT_EQ(read.number({{"name, with a comma", "x"}}, "number (m)"), 1.0 / 3);
  EXPECT_TRUE(std::isnan(read.number(1, "number (m)")));
  EXPECT_THROW(read.number({{"name, with a comma", "y"}}, "number (m)"), std::out_of_range);
  EXPECT_THROW(table.add({"too few"}), std::logic_error);
}

TEST(ReportParts, NumbersAreShownInThreeDigits) {
  EXPECT_EQ(brief(12345.6), "12 346");
  EXPECT_EQ(brief(-1234), "-1 234");
  EXPECT_EQ(brief(456.7), "457");
  EXPECT_EQ(brief(45.67), "45.7");
  EXPECT_EQ(brief(4.567), "4.57");
  EXPECT_EQ(brief(0.012345), "0.0123");
  EXPECT_EQ(brief(20), "20");
  EXPECT_EQ(brief(0), "0");
  EXPECT_EQ(brief(1.1711490269966849e-07), "1.17e-07");
  EXPECT_EQ(brief(-0.00012345), "-0.000123");
  EXPECT_EQ(brief(1e300), "1e+300");
  EXPECT_EQ(shown("<b> & c"), "&lt;b&gt; &amp; c");
}

TEST(ReportParts, QuartilesAreInterpolated) {
  const Quartiles q = quartiles({4, 1, 2, 3});
  EXPECT_DOUBLE_EQ(q.low, 1.75);
  EXPECT_DOUBLE_EQ(q.median, 2.5);
  EXPECT_DOUBLE_EQ(q.high, 3.25);
}

TEST(ReportParts, BootstrapIsAsWideAsTheNormalInterval) {
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(i % 20);
  const Estimate e = estimate(values, 5);
  EXPECT_DOUBLE_EQ(e.mean, 9.5);
  EXPECT_NEAR(e.deviation, 5.773, 0.01);
  EXPECT_NEAR(e.low, 9.5 - 1.96 * e.deviation / 20, 0.08);
  EXPECT_NEAR(e.high, 9.5 + 1.96 * e.deviation / 20, 0.08);
  EXPECT_EQ(estimate(values, 5).low, e.low);
}

TEST(ReportParts, SharesHaveWilsonsInterval) {
  const Estimate tenth = share(1, 10);  // 0.0179 to 0.4042: a figure of many textbooks
  EXPECT_NEAR(tenth.low, 0.0179, 1e-4);
  EXPECT_NEAR(tenth.high, 0.4042, 1e-4);
  EXPECT_EQ(share(0, 10).low, 0);
  EXPECT_GT(share(0, 10).high, 0.2);
}

TEST(ReportParts, FrontHasWhatNothingBeats) {
  Table points({"structure", "depth", "threshold (cm)", "semantics", "error", "missed collisions (%)",
                "crowd (ns/pair)", "near miss (ns/pair)"});
  points.add({"exact and slow", "all", "", "boundary", 0, 0, 90, 100});
  points.add({"beaten", "all", "", "boundary", 5, 0, 91, 101});
  points.add({"fast", "0", "", "boundary", 20, 0, 2, 3});
  points.add({"fast and missing", "0", "", "boundary", 1, 2, 1, 1});
  points.add({"as good and slower", "0", "", "boundary", 20, 0, 3, 4});
  points.add({"good", "6", "1", "solid", 6, 0, 10, 101});
  points.add({"not known", "6", "1", "solid", std::nan(""), 0, 1, 1});
  const Table best = front(points, "error");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < best.rows().size(); ++i)
    names.push_back(best.text(i, "pairs") + " " + best.text(i, "structure"));
  EXPECT_EQ(names, (std::vector<std::string>{"crowd exact and slow", "crowd good", "crowd fast",
                                             "near miss exact and slow", "near miss fast"}));
}

Outline square(float half) {
  return {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, {0, 4}, 0x1p-20f};
}

TEST(ReportParts, RasterCountsAreas) {
  const std::vector<Disc> discs = {{0.3f, 0.1f, 0.4f}};
  const Coverage alone = rasterise({}, discs), both = rasterise(square(0.25f), discs);
  EXPECT_NEAR(alone.discs, pi * 0.16, 1e-4);
  EXPECT_EQ(alone.outline, 0);
  EXPECT_NEAR(both.outline, 0.25, 1e-4);
  EXPECT_EQ(both.discs, alone.discs);
  EXPECT_GT(both.filled, both.discs);
  EXPECT_LT(both.filled, both.discs + both.outline);
  // Beside each other they add up.
  const Coverage apart = rasterise(square(0.25f), std::vector<Disc>{{2, 0, 0.4f}});
  EXPECT_NEAR(apart.filled, pi * 0.16 + 0.25, 2e-4);
}

/// People who may turn, and then change their poses, stand closer.
TEST(ReportParts, PackingIsDenserWhereMoreIsFree) {
  const Character woman = default_female();
  PoseShaper shaper(woman);
  std::vector<Shape> shapes;
  for (const PoseTime& at : sample_poses(woman, 10)) shapes.push_back(shaper.shape(at));
  const ShapeSet set(shapes, {{3}, true});
  const double fixed = densest_packing(set, 30, 3), turned = densest_packing(set, 30, 3, Freedom::headings),
               changed = densest_packing(set, 30, 3, Freedom::poses, 10);
  EXPECT_GT(turned, fixed);
  EXPECT_GT(changed, 1.1 * turned);
  EXPECT_EQ(densest_packing(set, 30, 3, Freedom::poses, 10), changed);
}

struct People {
  std::vector<baselines::Body> bodies;
  std::vector<Shape> shapes;
};

People men(std::uint32_t poses) {
  const Character man = default_male();
  detail::Skinner skinner(man);
  PoseShaper shaper(man);
  People people;
  for (const PoseTime& at : sample_poses(man, poses)) {
    const auto positions = skinner.pose(at);
    people.shapes.push_back(shaper.shape(at));
    people.bodies.push_back({{positions.begin(), positions.end()}, man.triangles, people.shapes.back()});
  }
  return people;
}

TEST(ReportParts, TestsAndTreesAreCounted) {
  const People people = men(2);
  const auto plain = baselines::kind("reference").build(people.bodies, {});
  const bench::Workload workload =
      bench::random_pairs("any", 1, people.shapes, 50,
                          [&](const Agents& agents, Pair pair) { return plain->query(agents, pair, 0); });
  EXPECT_EQ(subject_of(*plain, 0).tests(workload).nodes, 1);
  EXPECT_GT(subject_of(*plain).tests(workload).nodes, 5);
  EXPECT_TRUE(std::isnan(subject_of(ShapeSet(people.shapes)).tests(workload).nodes));
  const auto size = [&](std::string_view kind) {
    return tree_size({.name = kind, .kind = kind}, people.bodies);
  };
  EXPECT_EQ(size("single").nodes, 1);
  EXPECT_EQ(size("reference").nodes, tree_size(people.shapes).nodes);
  for (const char* kind : {"bch_projected", "obb_projected", "obb_full"}) {
    EXPECT_EQ(size(kind).nodes, 2 * 2864 - 1) << kind;  // a triangle a leaf
    EXPECT_GT(size(kind).height, 11) << kind;
    EXPECT_LT(size(kind).height, 40) << kind;
  }
  EXPECT_TRUE(std::isnan(size("fcl_obb_full").nodes));
}

TEST(ReportParts, RandomPosesAreTheSameForASeed) {
  const std::vector<cli::LoadedCharacter> man = {{"man", default_male(), {}}};
  const auto first = cli::list_random_shapes(man, 50, 1), again = cli::list_random_shapes(man, 50, 1),
             other = cli::list_random_shapes(man, 50, 2);
  ASSERT_EQ(first.size(), 50u);
  std::size_t different = 0;
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(first[i].at.seconds, again[i].at.seconds);
    EXPECT_LE(first[i].at.seconds, man[0].character.clips[first[i].at.clip].seconds);
    different += first[i].at.seconds != other[i].at.seconds ? 1 : 0;
  }
  EXPECT_GT(different, 45u);
}

TEST(ReportParts, ClosedMeshesHaveAVolume) {
  const std::vector<Vec3> corners = {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {5, 5, 6}};
  std::vector<std::array<std::uint32_t, 3>> sides = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_TRUE(is_closed(sides));
  EXPECT_NEAR(enclosed_volume(corners, sides), 1.0 / 6, 1e-6);
  sides.pop_back();
  EXPECT_FALSE(is_closed(sides));
  sides.push_back({1, 3, 2});  // the other way round
  EXPECT_FALSE(is_closed(sides));
  EXPECT_TRUE(is_closed(default_bulky_male().triangles));
}

TEST(ReportParts, ReliefStandsOutOfTheSurface) {
  const Character man = default_male(), flat = bench::finer(man, 1), relief = bench::with_relief(man, 1);
  ASSERT_EQ(relief.vertices.size(), flat.vertices.size());
  EXPECT_EQ(relief.triangles, flat.triangles);
  EXPECT_TRUE(is_closed(relief.triangles));
  float farthest = 0;
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    const float moved = (detail::to_eigen(relief.vertices[v]) - detail::to_eigen(flat.vertices[v])).norm();
    EXPECT_TRUE(v >= man.vertices.size() || moved == 0) << v;
    farthest = std::max(farthest, moved);
  }
  EXPECT_GT(farthest, 0.003f);
  EXPECT_LT(farthest, 0.03f);
  EXPECT_EQ(bench::with_relief(man, 1).vertices, relief.vertices);
}

TEST(ReportParts, PackingIsDenseAndWithinTheHexagonalBound) {
  std::vector<Shape> discs(1);
  discs[0].hierarchy = fixed_cylinder(0.25f);
  const double densest = densest_packing(ShapeSet(discs, {{0}}), 40, 3);
  EXPECT_GT(densest, 0.75 / (pi * 0.0625));
  EXPECT_LT(densest, 0.9069 / (pi * 0.0625));
}

TEST(ReportParts, SlidesPassUpToHalfAMetreBesideAndMeet) {
  const People people = men(6);
  const SlideCases cases(people.shapes, 200, 3);
  double least = 0, most = 0;
  for (const Pair pair : cases.pairs()) {
    const double beside = cases.agents().y[pair.first] - cases.agents().y[pair.second];
    least = std::min(least, beside), most = std::max(most, beside);
  }
  EXPECT_GE(least, -0.5);
  EXPECT_LT(least, -0.3);
  EXPECT_LE(most, 0.5);
  EXPECT_GT(most, 0.3);
  EXPECT_EQ(known(cases.contacts(ShapeSet(people.shapes))).size(), 200u);
}

TEST(ReportParts, SlidesEndWhereKernelAndStructuresSay) {
  const auto [bodies, shapes] = men(6);
  const SlideCases cases(shapes, 12, 9);
  const auto plain = baselines::kind("reference").build(bodies, {});
  for (const std::uint32_t depth : {0u, 4u, all_depths}) {
    const auto by_kernel = cases.contacts(ShapeSet(shapes, {{depth}})),
               by_steps = cases.contacts(*plain, depth);
    for (std::size_t i = 0; i < cases.size(); ++i)
      EXPECT_TRUE(by_kernel[i] == by_steps[i] || (std::isnan(by_kernel[i]) && std::isnan(by_steps[i])))
          << depth << ' ' << i << ": " << by_kernel[i] << ", " << by_steps[i];
  }
  const auto distances = baselines::fcl_mesh_distances(bodies);
  if (!distances) GTEST_SKIP() << "no FCL";
  const auto full = baselines::kind("obb_full").build(bodies, {});
  const auto places = cases.contacts(*full, all_depths);
  EXPECT_GT(known(places).size(), 10u);  // an arm may pass over a leg
  for (const double centimetres : known(cases.distances(*distances, places))) EXPECT_LT(centimetres, 1e-4);
  // A centimetre earlier they are apart, by no more than that.
  std::vector<double> earlier = places;
  for (double& place : earlier) place -= 0.01;
  for (const double centimetres : known(cases.distances(*distances, earlier))) {
    EXPECT_GT(centimetres, 0);
    EXPECT_LT(centimetres, 1.0001);
  }
}

}  // namespace
}  // namespace bch::report
