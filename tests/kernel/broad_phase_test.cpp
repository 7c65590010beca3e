// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::precedes;
using test::sorted;

const std::vector<Shape> shapes = test::synthetic_shapes(31, 24);  // radii from 1 cm to 4 m
const ShapeSet set(shapes, {{0, 3, all_depths}, false});

test::Crowd crowd_in(double width, double height, std::uint32_t agents, std::uint64_t seed, double x = 0,
                     double y = 0, const ShapeSet& of = set) {
  test::Random random(seed);
  test::Crowd crowd;
  for (std::uint32_t i = 0; i < agents; ++i)
    crowd.add({random.below(of.shape_count()), x + random.uniform(0, width), y + random.uniform(0, height),
               random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(of.level_count()))});
  return crowd;
}

void append(test::Crowd& crowd, const test::Crowd& more) {
  const Agents agents = more.agents();
  for (std::size_t i = 0; i < agents.size(); ++i)
    crowd.add({agents.shape[i], agents.x[i], agents.y[i], agents.heading.x()[i], agents.level[i]});
}

/// An agent's root disc, its centre relative to the agent; with a margin the disc that holds its cut.
struct Root {
  double x, y, radius;
};

std::vector<Root> roots(const ShapeSet& of, const Agents& agents, bool outer) {
  const detail::ShapeSetView view = of.view();
  std::vector<Root> all;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::size_t root = std::size_t{agents.shape[i]} * of.level_count() + agents.level[i];
    const detail::Rotation r = detail::rotation(agents.heading.x()[i]);
    const double x = view.roots[root].x, y = view.roots[root].y;
    const double radius =
        outer && view.trees != nullptr ? view.trees[root].outer_radius : view.roots[root].radius;
    all.push_back({r.cosine * x - r.sine * y, r.sine * x + r.cosine * y,
                   radius + 128 * detail::rounding::unit_roundoff * (std::abs(x) + std::abs(y) + radius)});
  }
  return all;
}

/// Every pair whose root discs overlap, or are apart by at most `gap` times the sum of their radii and by
/// `gap_of_all` metres.
std::vector<Pair> brute_force(const ShapeSet& of, const Agents& agents, double gap = 0,
                              double gap_of_all = 0) {
  const std::vector<Root> discs = roots(of, agents, gap_of_all > 0x1p-20);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < agents.size(); ++i)
    for (std::uint32_t j = i + 1; j < agents.size(); ++j) {
      const double x = (agents.x[j] - agents.x[i]) + (discs[j].x - discs[i].x);
      const double y = (agents.y[j] - agents.y[i]) + (discs[j].y - discs[i].y);
      const double r = (discs[i].radius + discs[j].radius) * (1 + gap) + gap_of_all;
      if (x * x + y * y <= r * r) pairs.push_back({i, j});
    }
  return pairs;
}

void expect_between(const std::vector<Pair>& needed, const std::vector<Pair>& found,
                    const std::vector<Pair>& allowed) {
  EXPECT_TRUE(std::ranges::includes(found, needed, precedes));
  EXPECT_TRUE(std::ranges::includes(allowed, found, precedes));
}

/// All that overlap are there once, and no others but by the documented slack: 2^-20 of a radius in the disc
/// and as much in the test, 2^-50 of the extent, and a few units, each 2^-29 of the widest cell.
void expect_right(const test::Crowd& crowd, const ShapeSet& of = set) {
  const Agents agents = crowd.agents();
  const auto [min_x, max_x] = std::minmax_element(crowd.x.begin(), crowd.x.end());
  const auto [min_y, max_y] = std::minmax_element(crowd.y.begin(), crowd.y.end());
  double largest = 0;
  for (const Root& root : roots(of, agents, false)) largest = std::max(largest, root.radius);
  const double extent = std::max(*max_x - *min_x, *max_y - *min_y) + 4 * largest;
  const double widest = std::max(2.01 * largest, 0x1p-30 * extent);

  const std::vector<Pair> found = sorted(test::candidate_pairs(of, agents));
  for (const Pair pair : found) ASSERT_LT(pair.first, pair.second);
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
  const std::vector<Pair> needed = brute_force(of, agents);
  const std::vector<Pair> allowed = brute_force(of, agents, 0x1p-18, 0x1p-47 * extent + 0x1p-25 * widest);
  expect_between(needed, found, allowed);
}

TEST(BroadPhase, FindsWhatBruteForceFinds) {
  expect_right(crowd_in(20, 20, 1500, 1));
  expect_right(crowd_in(60, 60, 3000, 2, -30, -30));
  expect_right(crowd_in(1e8, 1e8, 300, 5, -5e7, -5e7));
  expect_right(crowd_in(2e9, 2e9, 300, 6, -1e9, -1e9));
  for (const std::uint32_t agents : {1u, 2u, 3u, 5u}) expect_right(crowd_in(1, 1, agents, 9));
}

TEST(BroadPhase, Lines) {
  expect_right(crowd_in(400, 0.1, 1000, 3));
  expect_right(crowd_in(0, 400, 1000, 3));
  test::Crowd diagonal = crowd_in(400, 400, 1000, 3);
  diagonal.y = diagonal.x;
  expect_right(diagonal);
}

TEST(BroadPhase, AllInOnePlace) {
  expect_right(crowd_in(0.01, 0.01, 100, 4));
  const test::Crowd crowd = crowd_in(0, 0, 1200, 4, 3e5, -3e5);
  EXPECT_EQ(brute_force(set, crowd.agents()).size(), 1200u * 1199 / 2);
  expect_right(crowd);
}

TEST(BroadPhase, FindsNoMorePairsThanIsWanted) {
  const test::Crowd spot = crowd_in(0, 0, 2000, 40);  // in several blocks
  constexpr std::size_t pairs = 2000 * 1999 / 2;
  Crowd all({.max_pairs = pairs});
  EXPECT_EQ(all.candidates(set, spot.agents()).size(), pairs);
  for (const std::size_t most : {pairs - 1, std::size_t{0}}) {
    Crowd fewer({.max_pairs = most});
    EXPECT_EQ(test::complaint<std::length_error>([&] { fewer.candidates(set, spot.agents()); }),
              "candidates: expected at most " + std::to_string(most) + " pairs, found more");
  }
}

TEST(BroadPhase, ClustersAtTheEndsOfTheWorld) {
  test::Crowd crowd = crowd_in(8, 8, 500, 10, -1e9, -1e9);
  append(crowd, crowd_in(8, 8, 500, 11, 1e9 - 8, 1e9 - 8));
  append(crowd, crowd_in(8, 8, 500, 12));
  append(crowd, crowd_in(1e9, 1e9, 200, 13));
  EXPECT_GT(brute_force(set, crowd.agents()).size(), 3000u);
  expect_right(crowd);
}

/// Centres in an exact grid of cells, at their very edges and one step of the format away.
TEST(BroadPhase, DiscsThatTouch) {
  const std::vector<Shape> one(shapes.begin(), shapes.begin() + 1);
  const ShapeSet single(one, {{0, 3, all_depths}, false});
  test::Crowd crowd = crowd_in(0, 0, 900, 14, 0, 0, single);
  crowd.level.assign(900, 0);
  crowd.heading.assign(900, 0);
  const double diameter = 2 * roots(single, crowd.agents(), false)[0].radius;
  test::Random random(15);
  for (std::uint32_t i = 0; i < 900; ++i) {
    crowd.x[i] = diameter * (i % 30) * (1 + 0x1p-52 * random.below(3));
    crowd.y[i] = diameter * (i / 30) * (1 - 0x1p-52 * random.below(3));
  }
  EXPECT_GT(brute_force(single, crowd.agents()).size(), 500u);
  expect_right(crowd, single);
}

/// From 1 mm to 130 m in one crowd: more than the classes of sizes hold.
TEST(BroadPhase, VeryDifferentSizes) {
  test::Random random(16);
  std::vector<Shape> sizes;
  for (double radius = 1e-3; radius < 200; radius *= 3.25)
    sizes.push_back(
        test::contour_shape(test::star(random, 5, radius / 2, radius), static_cast<float>(radius / 8)));
  const ShapeSet mixed(sizes, {{0, 3, all_depths}, false});
  for (const double side : {1.0, 40.0, 900.0}) {
    expect_right(crowd_in(side, side, 1000, 17, 0, 0, mixed), mixed);
    expect_right(crowd_in(side, side, 1000, 18, 7e8, -1e9, mixed), mixed);
  }
  test::Crowd small = crowd_in(90, 90, 1500, 19, 0, 0, mixed);
  for (std::size_t i = 0; i < small.x.size(); ++i)
    small.shape[i] = i % 500 == 7 ? mixed.shape_count() - 1 : small.shape[i] % 3;
  append(small, crowd_in(0, 0, 1, 20, 1e9, 1e9, mixed));
  expect_right(small, mixed);
}

TEST(BroadPhase, FarFromTheOriginItIsTheSame) {
  test::Crowd crowd = crowd_in(20, 20, 1000, 6);
  for (auto* values : {&crowd.x, &crowd.y})
    for (double& at : *values) at = std::round(at * 0x1p20) * 0x1p-20;
  const auto near = sorted(test::candidate_pairs(set, crowd.agents()));
  for (double& at : crowd.x) at += 1e7;
  for (double& at : crowd.y) at -= 9e8;
  EXPECT_EQ(sorted(test::candidate_pairs(set, crowd.agents())), near);
  expect_right(crowd);
}

/// Who is within a margin, now or soon, and hardly anybody else.
TEST(BroadPhase, LeavesNobodyOutWithinAMargin) {
  const test::Crowd crowd = crowd_in(40, 40, 500, 8);
  const Agents agents = crowd.agents();
  const std::vector<Pair> all = test::all_pairs(500);
  std::vector<float> distances(all.size()), times(all.size());
  clearance(set, agents, all, {distances});
  test::Random random(9);
  for (const double margin : {1e-6, 0.1, 0.5, 3.0, 20.0}) {
    const auto found = sorted(test::candidate_pairs(set, agents, margin));
    std::vector<double> x, y;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double angle = random.uniform(-3.2, 3.2);
      x.push_back(margin * std::cos(angle)), y.push_back(margin * std::sin(angle));
    }
    time_of_impact(set, agents, all, {x, y}, times);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool is_near = static_cast<double>(distances[k]) <= margin || times[k] <= 1;
      ASSERT_TRUE(!is_near || std::binary_search(found.begin(), found.end(), all[k], precedes))
          << margin << ": " << all[k].first << ", " << all[k].second;
    }
    const std::vector<Pair> needed = brute_force(set, agents, 0, margin);
    const std::vector<Pair> allowed = brute_force(set, agents, 0x1p-16, margin * (1 + 0x1p-15));
    SCOPED_TRACE(margin);
    expect_between(needed, found, allowed);
    EXPECT_LT(found.size(), all.size());
  }
}

/// Offsets must not be rounded to the step of the world's coordinates: the disc is smaller than its offset.
TEST(BroadPhase, TinyOnesFarOut) {
  test::Random random(22);
  const std::vector<Shape> tiny = {test::contour_shape(test::star(random, 9, 1e-4, 2e-4, 0.01, 0.02), 1e-4f)};
  const ShapeSet tiny_set(tiny, {{0, 3, all_depths}, false});
  test::Crowd crowd = crowd_in(6e-4, 6e-4, 1500, 23, 9.9e8, -1e9, tiny_set);
  for (double& heading : crowd.heading) heading *= 1e-3;
  EXPECT_GT(brute_force(tiny_set, crowd.agents()).size(), 300'000u);
  expect_right(crowd, tiny_set);
}

/// Pairs that are near each other stand near each other: what the answering of a large crowd lives on.
TEST(BroadPhase, OrderIsByPlace) {
  const test::Crowd crowd = crowd_in(300, 300, 20'000, 21);
  const auto pairs = test::candidate_pairs(set, crowd.agents());
  ASSERT_GT(pairs.size(), 1000u);
  std::size_t jumps = 0;
  for (std::size_t k = 1; k < pairs.size(); ++k)
    jumps += std::abs(crowd.y[pairs[k].first] - crowd.y[pairs[k - 1].first]) > 40;
  EXPECT_LT(jumps, pairs.size() / 100);
}

/// So many agents that collide() fetches them ahead: the answers are those of small crowds of two.
TEST(BroadPhase, AnswersOfALargeCrowdAreThoseOfItsPairs) {
  const test::Crowd crowd = crowd_in(900, 900, 120'000, 24);
  const auto pairs = test::candidate_pairs(set, crowd.agents());
  std::vector<std::uint8_t> hits(pairs.size());
  collide(set, crowd.agents(), pairs, hits);
  std::size_t found = 0;
  for (std::size_t k = 0; k < pairs.size(); k += 16) {
    test::Crowd two;
    for (const std::uint32_t i : {pairs[k].first, pairs[k].second})
      two.add({crowd.shape[i], crowd.x[i], crowd.y[i], crowd.heading[i], crowd.level[i]});
    const Pair pair{0, 1};
    std::uint8_t hit = 2;
    collide(set, two.agents(), {&pair, 1}, {&hit, 1});
    ASSERT_EQ(hits[k], hit) << pairs[k].first << ", " << pairs[k].second;
    found += hit;
  }
  EXPECT_GT(found, 1000u);
}

TEST(BroadPhase, AnyNumberOfThreads) {
  const test::Crowd crowd = crowd_in(60, 60, 9000, 8);
  const auto expected = test::candidate_pairs(set, crowd.agents());
  for (unsigned threads = 1; threads <= 8; ++threads)
    test::on_threads(threads,
                     [&] { EXPECT_EQ(test::candidate_pairs(set, crowd.agents()), expected) << threads; });
}

/// Also where it has moved.
TEST(BroadPhase, OneObjectServesManyCrowds) {
  Crowd one;
  for (const std::uint32_t agents : {3000u, 10u, 0u, 5000u, 1u, 2999u}) {
    const test::Crowd crowd = crowd_in(50, 50, agents, agents);
    const std::vector<Pair> expected = test::candidate_pairs(set, crowd.agents());
    EXPECT_TRUE(std::ranges::equal(one.candidates(set, crowd.agents()), expected)) << agents;
    Crowd moved(std::move(one));
    one = std::move(moved);
  }
}

}  // namespace
}  // namespace bch
