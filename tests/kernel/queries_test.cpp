// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/kernels.hpp"
#include "layout/format/shape_arrays.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/shape_set/bvh8.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/query_references.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

// All queries of all implementations against brute force: shapes of many kinds x plans x placements of pairs.

namespace bch {
namespace {

using baselines::Method;
using test::BruteForce;
using test::expect_answers;
using test::expect_same;
using test::PairAnswers;
using test::PairScene;
using test::Questions;
using test::Random;

// Shapes.

std::vector<Shape> of_many_kinds(Random& random) {
  return test::synthetic_shapes(random.next(), 40);
}

std::vector<Shape> people(Random&) {
  return test::pose_shapes(default_female(), 20);
}

std::vector<Shape> of_few_corners(Random& random) {
  return test::simple_shapes(random, 60);
}

Outline scaled(std::vector<Vec2> points, double size) {
  for (Vec2& p : points)
    p = {static_cast<float>(size * static_cast<double>(p.x)),
         static_cast<float>(size * static_cast<double>(p.y))};
  Outline outline = test::polygon(std::move(points));
  outline.grid_step = 0;  // nothing but the bounds of layout/base/rounding.hpp enlarges the discs
  return outline;
}

/// From the smallest documented extent to nine orders of magnitude more. Of every size a stroke along x of many leaves, all of whose
/// pruning discs end where leaves do; the same as one disc, far from its origin; a star of many leaves; and one of a few, far from its
/// origin. Margins that grow with the size of one shape alone do not hold for the other's rounding.
std::vector<Shape> of_unequal_sizes(Random& random) {
  std::vector<Shape> shapes;
  for (const double size : {2e-6, 1e-4, 1e-2, 0.3, 1.0, 30.0, 1000.0}) {
    const auto add = [&](const Outline& outline, double fraction) {
      shapes.push_back(test::contour_shape(outline, static_cast<float>(fraction * size)));
    };
    add(scaled({{-1, 0}, {1, 0}}, size), 0.03);
    add(scaled({{0.75f, 0.75f}, {0.75f, 1.25f}}, size), 1);
    add(scaled(test::star(random, 9, 0.5, 1).points, size), 0.1);
    add(scaled(test::star(random, 5, 0.2, 0.3, 0.9, 0.1).points, size), 0.2);
  }
  return shapes;
}

/// A chain of discs in a tree of which every inner node's first child is a leaf. All inner nodes overlap but for the fourth,
/// which is far above most leaves.
Shape comb(Random& random, std::uint32_t leaves) {
  Shape shape;
  std::vector<Hierarchy::Node>& nodes = shape.hierarchy.nodes;
  shape.hierarchy.max_extent = 2;
  double x = 0, y = 0, turn = random.uniform(-3, 3);
  for (std::uint32_t i = 0; i < leaves; ++i) {
    const Disc disc{static_cast<float>(x), static_cast<float>(y),
                    static_cast<float>(random.uniform(0.008, 0.012))};
    if (i + 1 < leaves) {
      const auto self = static_cast<std::uint32_t>(nodes.size());
      nodes.push_back({{disc.x, disc.y, i == 3 ? 0.4f : 2}, self + 2});
    }
    nodes.push_back({disc, 0});
    turn += random.uniform(-0.5, 0.5);
    x = std::clamp(x + 0.015 * std::cos(turn), -1.0, 1.0),
    y = std::clamp(y + 0.015 * std::sin(turn), -1.0, 1.0);
  }
  return shape;
}

/// Trees as deep as kernels' stacks allow; cuts of more discs than people have; and a thistle, whose groups all lie over each other, so
/// that pairs of it leave more steps open than a search lists.
std::vector<Shape> of_deep_trees(Random& random) {
  std::vector<Shape> shapes;
  for (std::uint32_t leaves = 58; leaves < 72; ++leaves) shapes.push_back(comb(random, leaves));
  shapes.push_back(test::contour_shape(test::star(random, 100, 0.3, 0.5), 0.004f));
  shapes.push_back(test::contour_shape(test::star(random, 100, 0.02, 0.35)));
  return shapes;
}

/// Bodies of discs in no order, whose nodes hold them: hits of such bodies are not verified where neither is much larger than the other.
std::vector<Shape> of_discs(Random& random) {
  std::vector<Shape> shapes;
  while (shapes.size() < 40)
    shapes.push_back(test::body_of_discs(random, 1 + random.below(shapes.size() % 2 == 0 ? 8 : 40)));
  return shapes;
}

/// Projections without an outline, all to the left of their origins.
std::vector<Shape> beside_their_origin(Random& random) {
  std::vector<Shape> shapes;
  while (shapes.size() < 30) {
    std::vector<Vec2> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < 12; ++i) {
      const double x = random.uniform(-1.5, -0.4), y = random.uniform(-0.5, 0.5);
      for (std::uint32_t k = 0; k < 3; ++k)
        vertices.push_back({static_cast<float>(x + random.uniform(-0.1, 0.1)),
                            static_cast<float>(y + random.uniform(-0.1, 0.1))});
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    shapes.push_back({{}, detail::projected_hierarchy(vertices, triangles)});
  }
  return shapes;
}

struct Kind {
  const char* name;
  std::vector<Shape> (*shapes)(Random&);
  std::uint32_t pairs;  ///< of each placement: fewer where brute force takes longer
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}
const Kind kinds[] = {{"ManyKinds", of_many_kinds, 800},
                      {"People", people, 600},
                      {"FewCorners", of_few_corners, 3'000},
                      {"UnequalSizes", of_unequal_sizes, 4'000},
                      {"DeepTrees", of_deep_trees, 300},
                      {"Discs", of_discs, 3'000},
                      {"BesideTheirOrigin", beside_their_origin, 3'000}};

// Plans, which differ in what lets kernels skip traversals.

struct Levels {
  const char* name;
  ShapeSetPlan plan;
};
void PrintTo(const Levels& levels, std::ostream* out) {
  *out << levels.name;
}
const Levels plans[] = {{"FourLevels", {{0, 3, 6, all_depths}}},
                        {"OneLevel", {}},
                        {"NoCulling", {.depths = {2, all_depths}, .culling = false}},
                        {"RootsAlone", {{0}}}};

// RelativeTransforms.

struct World {
  std::vector<Shape> shapes;
  ShapeSetPlan plan;
  ShapeSet set{shapes, plan};
  BruteForce brute_force{shapes, plan};

  double extent(const test::Crowd& crowd, std::size_t agent) const {
    return static_cast<double>(set.bounding_radius(crowd.shape[agent]));
  }
};

/// Agents of random shapes at the origin.
PairScene together(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    for (int k = 0; k < 2; ++k) {
      const std::uint32_t shape = random.below(world.set.shape_count());
      const double heading = random.uniform(-4, 4);
      scene.crowd.add(
          {shape, 0, 0, heading, static_cast<std::uint8_t>(random.below(world.set.level_count()))});
    }
    scene.pairs.push_back(random.below(2) == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  return scene;
}

PairScene anywhere(Random& random, const World& world, std::uint32_t pairs) {
  return random_scene(random, world.set, pairs);
}

/// The second agent is slid along a line until discs are at the edge of an overlap, and left some units in the last place of the placement
/// on either side.
PairScene at_contact(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene = together(random, world, pairs);
  test::Crowd& crowd = scene.crowd;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const std::size_t a = 2 * i, b = a + 1;
    const double both = world.extent(crowd, a) + world.extent(crowd, b);
    // Along the x axis of either one, which is that of the strokes, or anywhere.
    const double angles[] = {crowd.heading[a], crowd.heading[b], random.uniform(-4, 4)};
    const double angle = angles[random.below(3)];
    const auto hits_at = [&](double distance) {
      crowd.x[b] = distance * std::cos(angle), crowd.y[b] = distance * std::sin(angle);
      return world.brute_force.collisions_of_discs.boundary(crowd.agents(), scene.pairs[i],
                                                            Method::depth_first);
    };
    double near = 0, far = 1.5 * both;
    if (!hits_at(near)) near = random.uniform(0, both);  // any edge of the answer will do
    for (int step = 0; step < 48; ++step) {
      const double middle = 0.5 * (near + far);
      (hits_at(middle) ? near : far) = middle;
    }
    hits_at(near + (static_cast<int>(random.below(9)) - 4) * 0x1p-25 * both);
  }
  return scene;
}

/// The centre of a disc of one agent lies on a disc's centre of the other.
PairScene inside(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene = together(random, world, pairs);
  test::Crowd& crowd = scene.crowd;
  for (std::uint32_t b = 1; b < crowd.x.size(); b += 2)
    for (const std::uint32_t agent : {b - 1, b}) {
      const auto all = world.brute_force.cuts.of(crowd.agents(), agent);
      const Disc disc = all[random.below(static_cast<std::uint32_t>(all.size()))];
      const double c = std::cos(crowd.heading[agent]), s = std::sin(crowd.heading[agent]), x = disc.x,
                   y = disc.y;
      crowd.x[b] += (agent == b ? -1 : 1) * (c * x - s * y),
          crowd.y[b] += (agent == b ? -1 : 1) * (s * x + c * y);
    }
  return scene;
}

/// Positions or headings that are the same but for a few bits or half a turn, of agents of any or of one shape, and of agents with themselves:
/// lines that a kernel draws through both have no direction, and hardly a segment crosses another.
PairScene coincident(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene = together(random, world, pairs);
  test::Crowd& crowd = scene.crowd;
  for (std::size_t b = 1; b < crowd.x.size(); b += 2) {
    if (random.below(2) == 0) crowd.shape[b] = crowd.shape[b - 1];
    if (random.below(8) == 0) scene.pairs[b / 2].first = scene.pairs[b / 2].second;
    const double turns[] = {random.uniform(-4, 4), 0, 1e-7 * random.uniform(-1, 1), std::numbers::pi};
    crowd.heading[b] = crowd.heading[b - 1] + turns[random.below(4)];
    crowd.x[b] += random.below(4) == 0 ? 1e-5 * random.uniform(-1, 1) : 0;
  }
  return scene;
}

/// Copies of one shape, unturned, at places on a grid: many gaps are equal, and the first one counts.
PairScene on_a_grid(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene = together(random, world, pairs);
  test::Crowd& crowd = scene.crowd;
  for (std::size_t a = 0; a < crowd.x.size(); a += 2) {
    crowd.shape[a + 1] = crowd.shape[a], crowd.level[a + 1] = crowd.level[a];
    const double step = std::exp2(std::floor(std::log2(world.extent(crowd, a))) - 1);
    crowd.heading[a] = crowd.heading[a + 1] = 0.5 * std::numbers::pi * random.below(4);
    for (const std::size_t agent : {a, a + 1}) {
      crowd.x[agent] = step * random.below(9);
      crowd.y[agent] = step * random.below(9);
    }
  }
  return scene;
}

PairScene far_from_the_origin(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene = random_scene(random, world.set, pairs);
  test::move_away(scene, 1e7, -8e8);
  return scene;
}

/// The farthest so far that rounding hides a body and all leaves are equally near: those take long.
PairScene far_apart(Random& random, const World& world, std::uint32_t pairs) {
  PairScene scene = random_scene(random, world.set, pairs);
  for (std::size_t b = 1; b < scene.crowd.x.size(); b += 2) {
    const double apart = random.below(32) == 0 ? 1.4e9 : std::pow(10, random.uniform(0, 5));
    scene.crowd.x[b] -= 0.5 * apart, scene.crowd.x[b - 1] += 0.5 * apart;
  }
  return scene;
}

struct Placement {
  const char* name;
  PairScene (*place)(Random&, const World&, std::uint32_t pairs);
};
const Placement placements[] = {{"anywhere", anywhere},   {"at contact", at_contact},
                                {"inside", inside},       {"coincident", coincident},
                                {"on a grid", on_a_grid}, {"far from the origin", far_from_the_origin},
                                {"far apart", far_apart}};

class QueriesOf : public testing::TestWithParam<std::tuple<Kind, Levels>> {};

TEST_P(QueriesOf, EqualBruteForce) {
  const auto& [kind, levels] = GetParam();
  Random random(2701);
  World world{kind.shapes(random), levels.plan};
  std::size_t pairs = 0, hits = 0, on_the_way = 0;
  for (const Placement& placement : placements) {
    const Questions questions =
        questions_about(random, world.set, placement.place(random, world, test::samples(kind.pairs)));
    const std::vector<PairAnswers> expected = world.brute_force.answers(world.set, questions);
    expect_answers(world.set, questions, expected, placement.name);
    for (const PairAnswers& all : expected)
      ++pairs, hits += all.hit, on_the_way += all.time > 0 && all.time <= 1;
  }
  EXPECT_GT(hits, pairs / 5);
  EXPECT_LT(hits, pairs * 4 / 5);
  EXPECT_GT(on_the_way, pairs / 20);
}

/// Where the first agents move by penetration(), nothing collides.
TEST_P(QueriesOf, PenetrationsSuffice) {
  const auto& [kind, levels] = GetParam();
  Random random(2703);
  const World world{kind.shapes(random), levels.plan};
  for (const auto place : {at_contact, inside}) {
    Questions questions = questions_about(random, world.set, place(random, world, test::samples(500)));
    const std::vector<PairAnswers> before = run_query(world.set, questions);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto& [depth, x, y] = before[i].best;
      questions.crowd.x[questions.pairs[i].first] += static_cast<double>(depth) * x;
      questions.crowd.y[questions.pairs[i].first] += static_cast<double>(depth) * y;
    }
    for (const PairAnswers& after : run_query(world.set, questions)) {
      EXPECT_EQ(after.hit, 0);
      EXPECT_EQ(after.hit_of_discs, 0);
    }
  }
}

/// Broad and narrow phase of crowds, everybody with everybody.
TEST_P(QueriesOf, NeighboursEqualBruteForce) {
  const auto& [kind, levels] = GetParam();
  Random random(2702);
  const World world{kind.shapes(random), levels.plan};
  bch::Crowd collider;
  for (const std::uint32_t pairs : {test::samples(40), 0u, 1u, 15u}) {
    const PairScene scene = at_contact(random, world, pairs);
    const auto count = static_cast<std::uint32_t>(scene.crowd.x.size());
    std::vector<std::vector<std::uint32_t>> expected(count);
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        if (world.brute_force.collisions.solid(scene.crowd.agents(), {i, j}, Method::brute_force))
          expected[i].push_back(j), expected[j].push_back(i);
    for (const Implementation& each : test::supported()) {
      EXPECT_EQ(
          test::neighbours(collider.collisions(world.set, scene.crowd.agents(), {.implementation = &each})),
          expected)
          << each.name;
    }
  }
}

std::string name_of(const testing::TestParamInfo<std::tuple<Kind, Levels>>& of) {
  return std::string(std::get<0>(of.param).name) + std::get<1>(of.param).name;
}
INSTANTIATE_TEST_SUITE_P(Shapes, QueriesOf,
                         testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(plans)), name_of);

std::uint32_t depth_of(const detail::Bvh8& tree, std::uint32_t node) {
  if (node >= detail::leaf_bit) return 1;
  std::uint32_t below = 0;
  for (std::uint32_t lane = 0; lane < detail::block_width; ++lane)
    if (std::isfinite(tree.blocks[node].discs.x[lane]))
      below = std::max(below, depth_of(tree, tree.blocks[node].child[lane]));
  return below + 1;
}

TEST(DeepTrees, AreAsDeepAsStacksAllow) {
  Random random(2704);
  std::uint32_t most = 0;
  for (const Shape& shape : of_deep_trees(random)) {
    const detail::Bvh8 tree = detail::bvh8(shape.hierarchy, all_depths);
    most = std::max(most, depth_of(tree, tree.top));
  }
  EXPECT_EQ(most, detail::max_wide_levels);
}

/// Small ones alone, of which few pairs are answered in one pass, and larger ones alone; many of them near tangent.
TEST(BodiesOfDiscs, EqualBruteForce) {
  Random random(2706);
  for (const std::uint32_t most : {8u, 40u}) {
    std::vector<Shape> shapes;
    while (shapes.size() < 40) shapes.push_back(test::body_of_discs(random, 1 + random.below(most)));
    World world{shapes, plans[0].plan};
    for (std::uint32_t i = 0, levels = world.set.level_count(); i < shapes.size(); ++i)
      EXPECT_EQ(world.set.arrays().trees[i * levels + levels - 1].conservative_nodes, 1u) << i;
    for (const PairScene& scene :
         {anywhere(random, world, 1'500), at_contact(random, world, test::samples(20'000))}) {
      const Questions questions = questions_about(random, world.set, scene);
      expect_answers(world.set, questions, world.brute_force.answers(world.set, questions), "discs");
    }
  }
}

/// What does not change an answer.
class Queries : public testing::Test {
 protected:
  Random random{2705};
  World world{of_many_kinds(random), plans[0].plan};
  Questions questions = questions_about(random, world.set, at_contact(random, world, test::samples(20'000)));
};

TEST_F(Queries, OfManyPairsEqualBruteForce) {
  expect_answers(world.set, questions, world.brute_force.answers(world.set, questions), "many pairs");
}

/// One after the other, as kernels keep what they know of an agent.
TEST_F(Queries, OfPairsThatShareAnAgentEqualBruteForce) {
  PairScene scene = anywhere(random, world, 40);
  scene.pairs.clear();
  for (std::uint32_t i = 0; i < 80; ++i)
    for (std::uint32_t j = 0; j < test::samples(80); ++j) scene.pairs.push_back({i, j});
  const Questions all = questions_about(random, world.set, scene);
  expect_answers(world.set, all, world.brute_force.answers(world.set, all), "all pairs");
}

TEST_F(Queries, InBatchesOfAnySizeAndOffset) {
  const std::vector<PairAnswers> whole = run_query(world.set, questions);
  for (const Implementation& each : test::supported()) {
    const std::size_t width = each.kernels->width;
    for (const std::size_t size : std::vector<std::size_t>{0, 1, width - 1, width, width + 1, 3 * width, 127,
                                                           128, 129, 255, 256, 257, 513, 1025})
      for (const std::size_t offset : {0, 1, 3, 13, 62}) {
        const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(offset);
        expect_same(
            run_query(world.set, questions.part(offset, size), each),
            {begin, begin + static_cast<std::ptrdiff_t>(size)},
            std::string(each.name) + ", " + std::to_string(size) + " pairs from " + std::to_string(offset));
      }
  }
}

TEST_F(Queries, OnAnyNumberOfThreads) {
  const std::vector<PairAnswers> expected = run_query(world.set, questions);
  for (unsigned threads = 1; threads <= 8; ++threads)
    test::on_threads(threads, [&] {
      expect_same(run_query(world.set, questions), expected, std::to_string(threads) + " threads");
    });
}

TEST_F(Queries, OfExchangedAgentsAreExchanged) {
  std::vector<PairAnswers> expected = run_query(world.set, questions),
                           other = run_query(world.set, questions.exchanged());
  for (PairAnswers& each : other) each = each.exchanged();
  for (PairAnswers& each : expected) each = each.exchanged().exchanged();  // as 0 - 0 and no other zero
  expect_same(other, expected, "exchanged");
}

TEST_F(Queries, FarFromTheOriginAreTheSame) {
  Questions far = questions_about(random, world.set, anywhere(random, world, test::samples(20'000)));
  test::move_away(far, 0, 0);
  const std::vector<PairAnswers> expected = run_query(world.set, far);
  test::move_away(far, 1e7, -8e8);
  expect_same(run_query(world.set, far), expected, "far from the origin");
}

/// Kernels prefetch where there are many shapes.
TEST_F(Queries, AmongManyShapesAreTheSame) {
  const std::vector<PairAnswers> expected = run_query(world.set, questions);
  const ShapeSet large(test::repeated(world.shapes), world.plan);
  for (std::size_t i = 0; i < questions.crowd.shape.size(); ++i)
    questions.crowd.shape[i] += static_cast<std::uint32_t>(i * world.shapes.size() % large.shape_count());
  expect_answers(large, questions, expected, "many shapes");
}

/// A descent that leaves out what cannot count finds what brute force finds.
TEST_F(Queries, OfTheReferencesAgree) {
  BruteForce& all = world.brute_force;
  const Agents agents = questions.crowd.agents();
  for (std::size_t i = 0; i < questions.pairs.size(); ++i) {
    const Pair pair = questions.pairs[i];
    const auto agree = [](auto query) { return query(Method::depth_first) == query(Method::brute_force); };
    const auto clearance = [&](Method method) {
      const auto [distance, direction, first, second] =
          all.clearances.query(agents, pair, questions.limit, method);
      return std::tuple(distance, direction, first, second);
    };
    ASSERT_TRUE(agree([&](Method method) { return all.collisions.boundary(agents, pair, method); })) << i;
    ASSERT_TRUE(agree([&](Method method) { return all.collisions.solid(agents, pair, method); })) << i;
    ASSERT_TRUE(agree([&](Method method) { return all.collisions_of_discs.boundary(agents, pair, method); }))
        << i;
    ASSERT_TRUE(agree(clearance)) << i;
    ASSERT_TRUE(agree([&](Method method) {
      return all.clearances.within(agents, pair, questions.distances[i], method);
    })) << i;
    ASSERT_TRUE(agree([&](Method method) {
      return all.times.query(agents, pair, questions.way_x[i], questions.way_y[i], method);
    })) << i;
  }
}

}  // namespace
}  // namespace bch
