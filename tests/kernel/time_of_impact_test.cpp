// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/time_of_impact_reference.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

namespace bch {
namespace {

using baselines::Method;
using baselines::TimeOfImpactReference;
using test::four_levels;
using test::PairScene;
using test::Random;

constexpr float no_impact = std::numeric_limits<float>::infinity();

/// Pairs that move.
struct Motion : PairScene {
  std::vector<double> x, y;
  Displacements displacements() const { return {x, y}; }
};

std::vector<float> times(const ShapeSet& set, const Motion& motion,
                         const Implementation* implementation = nullptr) {
  std::vector<float> all(motion.pairs.size(), -1);
  time_of_impact(set, motion.crowd.agents(), motion.pairs, motion.displacements(), all, implementation);
  return all;
}

class TimeOfImpactDifferential : public test::Differential {
 protected:
  TimeOfImpactDifferential() : Differential(2602, four_levels) {}

  TimeOfImpactReference reference{shapes, four_levels};

  /// Ways of random lengths up to `longest`, half of them about towards the other agent.
  Motion moving(PairScene scene, double longest) {
    Motion motion{std::move(scene), {}, {}};
    for (const auto& [first, second] : motion.pairs) {
      const double towards = std::atan2(motion.crowd.y[second] - motion.crowd.y[first],
                                        motion.crowd.x[second] - motion.crowd.x[first]);
      const double angle = towards + random.uniform(-1, 1) * (random.below(2) == 0 ? std::numbers::pi : 0.5);
      const double length = longest * random.uniform(0, 1);
      motion.x.push_back(length * std::cos(angle));
      motion.y.push_back(length * std::sin(angle));
    }
    return motion;
  }

  /// The same with the first agents so far back that most start apart.
  Motion approaching(std::uint32_t pairs, double back) {
    PairScene scene = random_scene(random, set, pairs);
    for (std::size_t i = 0; i < scene.crowd.x.size(); i += 2)
      scene.crowd.x[i] -= back * random.uniform(0.5, 1);
    return moving(std::move(scene), 2 * back);
  }

  float expected(const Motion& motion, std::size_t i, Method method) {
    if (discs.solid(motion.crowd.agents(), motion.pairs[i], Method::depth_first)) return 0;
    return reference.query(motion.crowd.agents(), motion.pairs[i], motion.x[i], motion.y[i], method);
  }

  void expect_equal_to_brute_force(const Motion& motion, const std::string& what) {
    std::vector<float> brute_force;
    for (std::size_t i = 0; i < motion.pairs.size(); ++i)
      brute_force.push_back(expected(motion, i, Method::brute_force));
    const auto between =
        std::count_if(brute_force.begin(), brute_force.end(), [](float t) { return t > 0 && t <= 1; });
    EXPECT_GT(between, std::ssize(brute_force) / 20) << what;
    for (const Implementation& implementation : test::supported()) {
      const std::vector<float> of = times(set, motion, &implementation);
      for (std::size_t i = 0; i < motion.pairs.size(); ++i)
        ASSERT_EQ(of[i], brute_force[i]) << what << ", " << implementation.name << ", pair " << i;
    }
  }
};

/// Ways that end at the touch of two discs, or pass by within the last bits.
TEST_F(TimeOfImpactDifferential, NearTangentPairs) {
  Motion motion = approaching(20'000, 1);
  for (std::size_t i = 0; i < motion.pairs.size(); ++i) {
    const float t = expected(motion, i, Method::depth_first);
    if (!(t <= 1)) continue;
    const double exactly = static_cast<double>(t) * (1 + 0x1p-24 * (static_cast<int>(random.below(9)) - 4));
    motion.x[i] *= exactly, motion.y[i] *= exactly;
  }
  expect_equal_to_brute_force(motion, "ends at the touch");
  for (std::size_t i = 0; i < motion.pairs.size(); ++i) {
    const double x = motion.x[i], y = motion.y[i];
    const auto meets_at = [&](double angle) {
      motion.x[i] = 3 * (x * std::cos(angle) - y * std::sin(angle));
      motion.y[i] = 3 * (x * std::sin(angle) + y * std::cos(angle));
      return expected(motion, i, Method::depth_first) <= 1;
    };
    double hit = 0, miss = std::numbers::pi;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (hit + miss);
      (meets_at(middle) ? hit : miss) = middle;
    }
    meets_at(random.below(2) == 0 ? hit : miss);
  }
  expect_equal_to_brute_force(motion, "passes by");
}

/// A small body arrives at the near end of a long one. What bounds leave to spare has to be that of both: the small one alone
/// is nothing beside the rounding of the long one's nodes.
TEST(TimeOfImpact, OfASmallBodyAtTheEndOfALongOne) {
  Random random(2603);
  const Disc small[] = {{0, 0, 0.02f}, {0.01f, 0, 0.02f}};
  std::vector<Shape> shapes = {shape_from_discs(small)};
  std::vector<double> radius = {0};  // of the near end
  for (std::uint32_t i = 1; i < 40; ++i) {
    std::vector<Disc> row;
    const double step = std::pow(10, random.uniform(2, 4));
    for (std::uint32_t k = 0; k < 12; ++k)
      row.push_back({static_cast<float>(k * step), 0, static_cast<float>(random.uniform(0.05, 1))});
    shapes.push_back(shape_from_discs(row));
    radius.push_back(row[0].radius);
  }
  Motion motion;
  TimeOfImpactReference reference(shapes, {});
  for (std::uint32_t i = 0; i < test::samples(4'000); ++i) {
    const std::uint32_t shape = 1 + random.below(39);
    const double heading = random.uniform(-4, 4), gap = std::pow(10, random.uniform(-2, 0));
    const double away = radius[shape] * 1.1 + 0.1 + gap;
    motion.crowd.add({0, -away * std::cos(heading), -away * std::sin(heading), random.uniform(-4, 4), 0});
    motion.crowd.add({shape, 0, 0, heading, 0});
    motion.pairs.push_back({2 * i, 2 * i + 1});
    motion.x.push_back(1.5 * away * std::cos(heading)), motion.y.push_back(1.5 * away * std::sin(heading));
    const double t = reference.query(motion.crowd.agents(), motion.pairs[i], motion.x[i], motion.y[i],
                                     Method::brute_force);
    ASSERT_LE(t, 1);
    const double exactly = t * (1 + 0x1p-24 * (static_cast<int>(random.below(9)) - 4));
    motion.x[i] *= exactly, motion.y[i] *= exactly;
  }
  for (const bool culling : {false, true}) {
    const ShapeSet set(shapes, {.culling = culling});
    for (const Implementation& implementation : test::supported()) {
      const std::vector<float> of = times(set, motion, &implementation);
      for (std::size_t i = 0; i < of.size(); ++i)
        ASSERT_EQ(of[i], reference.query(motion.crowd.agents(), motion.pairs[i], motion.x[i], motion.y[i],
                                         Method::brute_force))
            << implementation.name << ", pair " << i;
    }
  }
}

TEST_F(TimeOfImpactDifferential, WithoutAWayItIsCollide) {
  Motion motion{random_scene(random, set, 50'000), {}, {}};
  motion.x.assign(motion.pairs.size(), 0), motion.y = motion.x;
  std::vector<std::uint8_t> hits(motion.pairs.size());
  collide(set, motion.crowd.agents(), motion.pairs, hits, {.leaves = Leaves::discs});
  const std::vector<float> all = times(set, motion);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(all[i], hits[i] ? 0 : no_impact) << i;
  // As floats these are 0, and a way whose length cannot be divided by.
  for (const double length : {1e-300, 1e-17}) {
    motion.x.assign(motion.pairs.size(), length);
    const std::vector<float> hardly = times(set, motion);
    for (std::size_t i = 0; i < hits.size(); ++i)
      ASSERT_EQ(hardly[i], expected(motion, i, Method::brute_force)) << length << " m, pair " << i;
  }
}

/// Never later than the outlines' contact; before it discs do not overlap, and at it they do, but for rounding.
TEST_F(TimeOfImpactDifferential, IsNotLaterThanTheContactOfTheOutlines) {
  const ShapeSet finest(shapes);
  std::vector<Motion> motions = {approaching(test::samples(1'000), 1), approaching(test::samples(500), 20),
                                 approaching(test::samples(500), 1)};
  test::move_away(motions[2], 1e7, -8e8);
  std::size_t contacts = 0;
  for (Motion& motion : motions) {
    motion.crowd.level.clear();
    const Agents agents = motion.crowd.agents();
    const std::vector<float> all = times(finest, motion);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::uint32_t a = motion.pairs[i].first;
      const baselines::Oracle oracle = test::oracle(shapes, agents, motion.pairs[i]);
      const long double c = std::cos(static_cast<long double>(agents.heading.x()[a])),
                        s = std::sin(static_cast<long double>(agents.heading.x()[a]));
      const long double x = motion.x[i], y = motion.y[i];
      const long double exact = oracle.time_of_impact(c * x + s * y, c * y - s * x);
      contacts += exact > 0 && exact <= 1;
      if (exact <= 1) {
        EXPECT_LE(all[i], exact) << i;
      }
    }
  }
  EXPECT_GT(contacts, test::samples(300));
}

/// Tip against tip nothing but the margins is between the answer and the outlines, at any distance.
TEST(TimeOfImpact, OfTipsIsThatOfTheOutlinesLessTheMargin) {
  const std::vector<Shape> shapes = {test::contour_shape(test::needle())};
  const ShapeSet set(shapes);
  Random random(12);
  Motion motion;
  std::vector<long double> exact, margin;
  for (std::uint32_t i = 0; i < test::samples(4'000); ++i) {
    const double angle = random.uniform(-4, 4), length = 0.8 + std::pow(10, random.uniform(-6, 3));
    const double x = random.uniform(-50, 50), y = random.uniform(-50, 50), way = random.uniform(0.5, 2);
    motion.crowd.add({0, x, y, angle, 0});
    motion.crowd.add(
        {0, x + length * std::cos(angle), y + length * std::sin(angle), angle + std::numbers::pi, 0});
    motion.pairs.push_back({2 * i, 2 * i + 1});
    motion.x.push_back(way * length * std::cos(angle));
    motion.y.push_back(way * length * std::sin(angle));
    const baselines::Oracle oracle = test::oracle(shapes, motion.crowd.agents(), motion.pairs[i]);
    // Tips may pass each other by a rounding, so by their distance instead of where corners arrive.
    exact.push_back(oracle.distance() / (static_cast<long double>(way) * length));
    margin.push_back(4e-6L * (1 + length) / (static_cast<long double>(way) * length));
  }
  const std::vector<float> all = times(set, motion);
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (exact[i] > 1) continue;
    ++contacts;
    EXPECT_LE(all[i], exact[i]) << i;
    EXPECT_GE(all[i], exact[i] - margin[i]) << i;
  }
  EXPECT_GT(contacts, test::samples(1'000));
}

}  // namespace
}  // namespace bch
