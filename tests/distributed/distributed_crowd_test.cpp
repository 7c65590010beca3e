// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <new>

#include <bch/distributed_crowd.hpp>

#include "kernel/distributed/agreement.hpp"
#include "kernel/distributed/curve.hpp"
#include "kernel/distributed/cut.hpp"
#include "kernel/distributed/session.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// Every rank runs these tests, all with the same random numbers: each knows the whole crowd and what one process answers. Tests
// only EXPECT, because a rank that left one early would leave the others waiting.

namespace bch::detail {
namespace {

using test::complaint;
using test::Random;

// A crowd on all ranks, and the same one on each of them.

int rank() {
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int ranks() {
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

struct Answer {
  std::uint32_t first, second;
  float metres;  ///< 0 of collisions
  friend auto operator<=>(const Answer&, const Answer&) = default;
};
using Answers = std::vector<Answer>;

/// The values of all ranks, on each of them.
template <class Value>
std::vector<Value> of_all_ranks(const std::vector<Value>& mine) {
  std::vector<int> sizes(static_cast<std::size_t>(ranks())), begins(sizes);
  const int size = static_cast<int>(mine.size() * sizeof(Value));
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(sizes.begin(), sizes.end(), begins.begin(), 0);
  std::vector<Value> all(static_cast<std::size_t>(begins.back() + sizes.back()) / sizeof(Value));
  MPI_Allgatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE,
                 MPI_COMM_WORLD);
  return all;
}

Answers sorted(Answers answers) {
  std::ranges::sort(answers);
  return answers;
}

Answers collisions(DistributedCrowd& crowd, const AllOptions& options = {}) {
  Answers mine;
  for (const Pair& pair : crowd.collide_all(options)) mine.push_back({pair.first, pair.second, 0});
  return sorted(of_all_ranks(mine));
}

Answers clearances(DistributedCrowd& crowd, const AllOptions& options) {
  Answers mine;
  for (const DistributedCrowd::Distance& one : crowd.clearances(options))
    mine.push_back({one.first, one.second, one.metres});
  return sorted(of_all_ranks(mine));
}

/// The whole crowd, as one process has it: in the order of ids.
struct World {
  std::vector<DistributedCrowd::Agent> agents;
  bool has_heights = false;

  /// The agents that a rank begins with: one here, one there, in no order.
  std::vector<DistributedCrowd::Agent> dealt() const {
    std::vector<DistributedCrowd::Agent> mine;
    for (std::size_t i = 0; i < agents.size(); ++i)
      if (i % static_cast<std::size_t>(ranks()) == static_cast<std::size_t>(rank()))
        mine.push_back(agents[i]);
    std::ranges::reverse(mine);
    return mine;
  }

  test::Crowd columns() const {
    test::Crowd crowd;
    for (const DistributedCrowd::Agent& agent : agents) {
      crowd.add({agent.shape, agent.x, agent.y, agent.heading, agent.level});
      if (has_heights) crowd.z.push_back(agent.z);
    }
    return crowd;
  }

  Answer answer(Pair pair, float metres) const {
    return {agents[pair.first].id, agents[pair.second].id, metres};
  }

  Answers collisions(const ShapeSet& set, const AllOptions& options = {}) const {
    const test::Crowd crowd = columns();
    const std::vector<Pair> pairs = test::candidate_pairs(set, crowd.agents());
    std::vector<std::uint8_t> hits(pairs.size());
    collide(set, crowd.agents(), pairs, hits, options);
    Answers answers;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (hits[i] != 0) answers.push_back(answer(pairs[i], 0));
    return sorted(answers);
  }

  Answers clearances(const ShapeSet& set, const AllOptions& options) const {
    const test::Crowd crowd = columns();
    const std::vector<Pair> pairs = test::candidate_pairs(set, crowd.agents(), options.max_distance);
    std::vector<float> metres(pairs.size());
    clearance(set, crowd.agents(), pairs, {.distance = metres}, options);
    Answers answers;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (std::isfinite(metres[i])) answers.push_back(answer(pairs[i], metres[i]));
    return sorted(answers);
  }
};

/// Moves each agent in the world, and on whichever rank owns it, by the same.
template <class Move>
void move_all(World& world, DistributedCrowd& crowd, const Move& move) {
  for (DistributedCrowd::Agent& agent : world.agents) move(agent);
  for (DistributedCrowd::Agent& agent : crowd.agents()) move(agent);
}

/// Random numbers of an agent's own.
Random random_of(const DistributedCrowd::Agent& agent, std::uint64_t seed) {
  return Random(seed << 32 | agent.id);
}

class Distributed : public testing::Test {
 protected:
  static constexpr std::uint32_t count = 1500;
  const ShapeSet set{test::synthetic_shapes(91, 24), {{0, 3, all_depths}, true}};  // up to 4 m

  /// Agents in a square; their ids are not those of their places in memory.
  World world(double side, std::uint32_t agents = count, std::uint64_t seed = 5) const {
    Random random(seed);
    World world;
    for (std::uint32_t i = 0; i < agents; ++i) {
      DistributedCrowd::Agent agent{.heading = random.uniform(-4, 4), .id = (i * 7919u) % 65521u};
      agent.x = random.uniform(-side / 2, side / 2), agent.y = random.uniform(-side / 2, side / 2);
      agent.shape = random.below(set.shape_count());
      agent.level = static_cast<std::uint8_t>(random.below(set.level_count()));
      world.agents.push_back(agent);
    }
    std::ranges::sort(world.agents, {}, &DistributedCrowd::Agent::id);
    return world;
  }

  /// Expects the answers of one process, and each agent on one rank.
  void expect_same(const World& world, DistributedCrowd& crowd, double margin = 0.5) const {
    crowd.update(margin);
    EXPECT_EQ(collisions(crowd), world.collisions(set));
    EXPECT_EQ(collisions(crowd, {.leaves = Leaves::discs}), world.collisions(set, {.leaves = Leaves::discs}));
    const AllOptions near{.max_distance = margin};
    EXPECT_EQ(clearances(crowd, near), world.clearances(set, near));
    std::vector<std::uint32_t> ids, expected;
    for (const DistributedCrowd::Agent& agent : crowd.agents()) ids.push_back(agent.id);
    for (const DistributedCrowd::Agent& agent : world.agents) expected.push_back(agent.id);
    ids = of_all_ranks(ids);
    std::ranges::sort(ids), std::ranges::sort(expected);
    EXPECT_EQ(ids, expected);
  }
};

TEST_F(Distributed, AnswersLikeOneProcessWhileAgentsWalk) {
  World all = world(60);
  EXPECT_GT(all.collisions(set).size(), 500u);
  DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt(), {.cell = 4, .agent_pairs = 1.3});
  for (std::uint64_t step = 0; step < 6; ++step) {
    expect_same(all, crowd, step % 2 == 0 ? 0.5 : 1.5);
    move_all(all, crowd, [](DistributedCrowd::Agent& agent) {
      agent.x += 0.7 * std::cos(agent.heading), agent.y += 0.7 * std::sin(agent.heading);
    });
  }
}

TEST_F(Distributed, AnswersLikeOneProcessFarFromTheOrigin) {
  World all = world(60);
  for (DistributedCrowd::Agent& agent : all.agents) agent.x = std::floor(agent.x * 0x1p20) * 0x1p-20;
  for (DistributedCrowd::Agent& agent : all.agents) agent.y = std::floor(agent.y * 0x1p20) * 0x1p-20;
  const Answers here = all.collisions(set);
  for (DistributedCrowd::Agent& agent : all.agents) agent.x += 1e8, agent.y -= 1e8;
  DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt());
  expect_same(all, crowd);
  EXPECT_EQ(collisions(crowd), here);
}

TEST_F(Distributed, AgentsStandOnBordersOfSquares) {
  for (const double origin : {0.0, 4096.0}) {
    World all = world(60);
    for (DistributedCrowd::Agent& agent : all.agents) {
      Random random = random_of(agent, 7);
      for (double* const place : {&agent.x, &agent.y}) {
        *place = 2 * std::floor(*place / 2) + origin;
        const std::uint32_t side = random.below(3);
        if (side > 0) *place = std::nextafter(*place, side == 1 ? -1e9 : 1e9);
      }
    }
    DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt(), {.cell = 2});
    expect_same(all, crowd);
  }
}

TEST_F(Distributed, AgentsJumpAcrossTheWorld) {
  World all = world(40, 600);
  DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt());
  for (std::uint64_t step = 0; step < 5; ++step) {
    expect_same(all, crowd);
    move_all(all, crowd, [step](DistributedCrowd::Agent& agent) {
      Random random = random_of(agent, 100 + step);
      const double far = random.below(4) == 0 ? 1e9 - 40 : 0;  // to the corner of all that is allowed
      agent.x = far + random.uniform(-20, 20), agent.y = random.uniform(-20, 20) - far;
    });
  }
}

TEST_F(Distributed, RanksMayBeEmpty) {
  for (const std::uint32_t agents : {0u, 1u, 5u}) {
    World all = world(3, agents);
    DistributedCrowd crowd(MPI_COMM_WORLD, set,
                           rank() == ranks() - 1 ? all.agents : std::vector<DistributedCrowd::Agent>{});
    for (int step = 0; step < 2; ++step) expect_same(all, crowd);
  }
}

TEST_F(Distributed, AllMayStandInOnePlace) {
  World all = world(60, 60);
  for (DistributedCrowd::Agent& agent : all.agents) agent.x = agent.y = 3;
  DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt());
  for (int step = 0; step < 3; ++step) expect_same(all, crowd);
  EXPECT_LE(crowd.counters().cuts, 2u);  // a square cannot be cut: that does not help a second time
}

TEST_F(Distributed, CutsAnewWhereTheCrowdIsDense) {
  const ShapeSet points(test::synthetic_shapes(91, 24), {{0}, false});
  World all = world(200, 3000);
  for (DistributedCrowd::Agent& agent : all.agents) agent.level = 0;
  DistributedCrowd crowd(MPI_COMM_WORLD, points, all.dealt(), {.cell = 2});
  for (std::uint32_t step = 0; step < 8; ++step) {
    crowd.update();
    EXPECT_EQ(collisions(crowd), all.collisions(points));
    if (step == 2)  // a third of all meet in a corner
      move_all(all, crowd, [](DistributedCrowd::Agent& agent) {
        if (agent.id % 3 == 0) agent.x = 70 + agent.x / 8, agent.y = 70 + agent.y / 8;
      });
  }
  crowd.update();
  EXPECT_LT(crowd.counters().imbalance, ranks() < 7 ? 1.1 : 1.5);  // of a square's pairs, which are many here
  EXPECT_GE(crowd.counters().cuts, ranks() > 1 ? 2u : 1u);
  EXPECT_LE(crowd.counters().cuts, 6u);
}

TEST_F(Distributed, AgentsComeAndGo) {
  World all = world(40, 800);
  DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt());
  crowd.update();
  const auto leaves = [](const DistributedCrowd::Agent& agent) { return agent.id % 5 == 0; };
  std::erase_if(all.agents, leaves);
  std::erase_if(crowd.agents(), leaves);
  DistributedCrowd::Agent comes = all.agents.front();
  comes.id = 70'000, comes.x += 0.1;
  all.agents.push_back(comes);
  if (rank() == ranks() / 2) crowd.agents().push_back(comes);
  expect_same(all, crowd);
}

TEST_F(Distributed, AgentsStandAtDifferentHeights) {
  std::vector<Shape> shapes = test::synthetic_shapes(91, 24);
  for (Shape& shape : shapes) shape.heights = {0, 1.75f};
  const ShapeSet bodies(shapes, {.heights = true});
  World all = world(40, 800);
  all.has_heights = true;
  for (DistributedCrowd::Agent& agent : all.agents)
    agent.z = 0.5 * random_of(agent, 3).below(8), agent.level = 0;
  DistributedCrowd crowd(MPI_COMM_WORLD, bodies, all.dealt(), {.heights = true});
  crowd.update();
  const Answers answers = collisions(crowd);
  EXPECT_EQ(answers, all.collisions(bodies));
  all.has_heights = false;
  EXPECT_LT(answers.size(), all.collisions(bodies).size());
}

/// Expects that all ranks have so many agents, and have sent so many bytes of each copy and of each agent that moved.
void expect_sent(const DistributedCrowd::Counters& counters, std::uint64_t agents, std::uint64_t of_copy,
                 std::uint64_t of_agent) {
  std::uint64_t sums[] = {counters.agents, counters.halo_bytes, counters.halo * of_copy,
                          counters.migration_bytes, counters.arrived * of_agent};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(sums[0], agents);
  EXPECT_EQ(sums[1], sums[2]);
  EXPECT_EQ(sums[3], sums[4]);
  EXPECT_EQ(sums[1] > 0, ranks() > 1);
}

TEST_F(Distributed, CountsWhatIsSent) {
  World all = world(60);
  DistributedCrowd crowd(MPI_COMM_WORLD, set, all.dealt());
  crowd.update();
  crowd.collide_all();
  const DistributedCrowd::Counters& counters = crowd.counters();
  EXPECT_EQ(counters.agents, crowd.agents().size());
  EXPECT_EQ(counters.halo, crowd.halo().size());
  expect_sent(counters, count, 33, 41);  // x, y, heading, id, shape, level, and z
  std::uint64_t pairs = counters.pairs;
  MPI_Allreduce(MPI_IN_PLACE, &pairs, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(pairs, test::candidate_pairs(set, all.columns().agents()).size());
}

TEST_F(Distributed, WhatIsWrongOnOneRankIsAnErrorOnAll) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string last = "rank " + std::to_string(ranks() - 1) + ": agent 17: ";
  const auto complaint_about = [&](DistributedCrowd::Agent agent,
                                   const DistributedCrowdOptions& options = {}) {
    DistributedCrowd crowd(MPI_COMM_WORLD, set, world(20, 100).dealt(), options);
    crowd.update();
    if (rank() == ranks() - 1) crowd.agents().push_back(agent);
    return complaint<RankError>([&] { crowd.update(); });
  };
  EXPECT_EQ(complaint_about({.x = nan, .id = 17}),
            last + "expected a position within +-1e9 m, found (nan, 0)");
  EXPECT_EQ(complaint_about({.y = -2e9, .id = 17}),
            last + "expected a position within +-1e9 m, found (0, -2e+09)");
  EXPECT_EQ(complaint_about({.heading = nan, .id = 17}),
            last + "expected a heading within +-1e9 rad, found nan");
  EXPECT_EQ(complaint_about({.id = 17, .shape = 24}), last + "expected a shape of the set, found 24");
  EXPECT_EQ(complaint_about({.id = 17, .level = 3}), last + "expected a level of the set, found 3");
  EXPECT_EQ(complaint_about({.z = nan, .id = 17}), "accepted");
}

TEST(Agreement, WhateverARankThrowsAllThrow) {
  const auto complaint_about = [](const auto& thrown) {
    return complaint<RankError>([&] {
      agree(MPI_COMM_WORLD, [&] {
        if (rank() == ranks() - 1) throw thrown;
      });
    });
  };
  const std::string last = "rank " + std::to_string(ranks() - 1) + ": ";
  EXPECT_EQ(complaint_about(std::bad_alloc()), last + "not enough memory");
  EXPECT_EQ(complaint_about(std::length_error("too long")), last + "too long");
  EXPECT_EQ(complaint_about(17), last + "an exception of no known type");
}

TEST_F(Distributed, WhatMakesNoSenseIsAnError) {
  const auto made_with = [&](const DistributedCrowdOptions& options) {
    return complaint<RankError>([&] { DistributedCrowd(MPI_COMM_WORLD, set, {}, options); });
  };
  EXPECT_EQ(made_with({.cell = -1}), "rank 0: crowd: expected a cell of 0 to 1e6 m, found -1");
  EXPECT_EQ(made_with({.imbalance = 0.5}), "rank 0: crowd: expected an imbalance of at least 1, found 0.5");
  EXPECT_EQ(made_with({.agent_pairs = -1}),
            "rank 0: crowd: expected an agent to count as 0 to 1000 pairs, found -1");
  EXPECT_EQ(made_with({.heights = true}),
            "rank 0: crowd: expected a set that knows heights of bodies, as agents have heights");
  DistributedCrowd crowd(MPI_COMM_WORLD, set, {}, {.cell = 2});
  for (const double margin : {-1.0, 100.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(complaint<RankError>([&] { crowd.update(margin); }).find("rank 0: update: expected a margin "),
              std::string::npos);
  crowd.update(0.5);
  EXPECT_EQ(complaint<RankError>([&] { crowd.clearances({.max_distance = 0.6}); }),
            "rank 0: clearances: expected a max_distance within the margin of the last update()");
}

// ---- Crowds of characters that are posed anew in every step.

class PosedCrowd : public testing::Test {
 protected:
  static constexpr std::uint32_t count = 80;
  static const std::vector<Character>& people() {
    static const std::vector<Character> both{default_pedestrian(Sex::female, 0.9),
                                             default_pedestrian(Sex::male, 2.3)};
    return both;
  }
  const std::vector<Character>& characters = people();

  DistributedCrowd::Agent walker(std::uint32_t id, double side, std::size_t levels) const {
    Random random(900 + id);
    DistributedCrowd::Agent agent{.heading = random.uniform(-4, 4), .id = id};
    agent.x = random.uniform(0, side), agent.y = random.uniform(0, side), agent.z = 0.4 * random.below(5);
    agent.shape = random.below(8) == 0;  // one in eight is tall
    agent.level = static_cast<std::uint8_t>(random.below(static_cast<std::uint32_t>(levels)));
    agent.pose = {random.below(detail::pedestrian_speeds), static_cast<float>(random.uniform(0, 0.5))};
    if (random.below(10) == 0) agent.pose = {};
    return agent;
  }

  World world(double side, std::size_t levels) const {
    World world;
    for (std::uint32_t id = 0; id < count; ++id) world.agents.push_back(walker(id, side, levels));
    return world;
  }

  /// What one process knows: a set with a shape for each agent, who has its number.
  ShapeSet shapes_of(World& world, const ShapeSetPlan& plan) const {
    std::vector<ShapeBuilder> shape_builders;
    for (const Character& character : characters) shape_builders.emplace_back(character, plan);
    std::vector<Shape> shapes;
    for (DistributedCrowd::Agent& agent : world.agents) {
      shapes.push_back(shape_builders[agent.shape].shape(agent.pose));
      agent.shape = static_cast<std::uint32_t>(shapes.size() - 1);
    }
    return ShapeSet(shapes, plan);
  }

  void expect_same(World world, const ShapeSetPlan& plan, DistributedCrowd& crowd) const {
    constexpr AllOptions by_discs{.leaves = Leaves::discs}, near{.max_distance = 0.4};
    crowd.update(0.4);
    const Answers found = collisions(crowd, by_discs), found_near = clearances(crowd, near);
    if (rank() != 0) return;  // one knows what is right: poses take long
    const ShapeSet set = shapes_of(world, plan);
    EXPECT_GT(found.size(), 10u);
    EXPECT_EQ(found, world.collisions(set, by_discs));
    EXPECT_EQ(found_near, world.clearances(set, near));
  }
};

TEST_F(PosedCrowd, AnswersLikeOneProcessWhilePeopleWalk) {
  const ShapeSetPlan plan{.depths = {3, all_depths}, .culling = false};
  World all = world(7, 2);
  DistributedCrowd crowd(MPI_COMM_WORLD, characters, plan, all.dealt(), {.cell = 1});
  for (int step = 0; step < 3; ++step) {
    expect_same(all, plan, crowd);
    move_all(all, crowd, [](DistributedCrowd::Agent& agent) {
      agent.x += 0.5 * std::cos(agent.heading), agent.y += 0.5 * std::sin(agent.heading);
      agent.pose.seconds += 0.1f;
    });
  }
}

TEST_F(PosedCrowd, AnswersLikeOneProcessAtDifferentHeights) {
  const ShapeSetPlan plan{.heights = true};
  World all = world(5, 1);
  all.has_heights = true;
  DistributedCrowd crowd(MPI_COMM_WORLD, characters, plan, all.dealt(), {.cell = 1, .heights = true});
  expect_same(all, plan, crowd);
}

TEST_F(PosedCrowd, PosesTravelAsTwelveBytes) {
  World all = world(6, 1);
  DistributedCrowd crowd(MPI_COMM_WORLD, characters, {.depths = {3}}, all.dealt(), {.cell = 1});
  crowd.update();
  const DistributedCrowd::Counters& counters = crowd.counters();
  EXPECT_EQ(counters.poses, crowd.agents().size() + crowd.halo().size());
  // As of shapes of a set, of which the number of a shape is that of a character; clip and time.
  expect_sent(counters, count, 33 + 8, 41 + 8);
}

TEST_F(PosedCrowd, WhatIsWrongOnOneRankIsAnErrorOnAll) {
  const std::string last = "rank " + std::to_string(ranks() - 1) + ": ";
  const auto complaint_about = [&](const DistributedCrowd::Agent& agent) {
    DistributedCrowd crowd(MPI_COMM_WORLD, characters, {.depths = {0}}, {});
    if (rank() == ranks() - 1) crowd.agents().push_back(agent);
    return complaint<RankError>([&] { crowd.update(); });
  };
  EXPECT_EQ(complaint_about({.id = 9, .shape = 2}),
            last + "agent 9: expected a shape of the characters, found 2");
  EXPECT_EQ(complaint_about({.id = 9, .level = 1}), last + "agent 9: expected a level of the plan, found 1");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {74, 0}}),
            last + "agent 9: expected a clip of the character, found 74");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {0, -1}}),
            last + "agent 9: expected a time within the clip, found -1");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {73, 5}}),
            last + "agent 9: expected a time within the clip, found 5");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {PoseTime::rest, 5}}), "accepted");

  std::vector<Character> damaged = characters;
  if (rank() == ranks() - 1) damaged[1].triangles[0][0] = 1'000'000;
  const std::string complaint_of_damage =
      complaint<RankError>([&] { DistributedCrowd(MPI_COMM_WORLD, damaged, {}, {}); });
  EXPECT_EQ(complaint_of_damage.find(last), 0u) << complaint_of_damage;
  EXPECT_NE(complaint_of_damage.find("1000000"), std::string::npos) << complaint_of_damage;
  EXPECT_NE(complaint<RankError>([&] { DistributedCrowd(MPI_COMM_WORLD, characters, {.depths = {}}, {}); }),
            "accepted");
}

// ---- How places are ordered and cut.

TEST(Curve, GoesFromSquareToSquareThroughAll) {
  struct Step {
    std::uint64_t key;
    Cell cell;
  };
  std::vector<Step> steps;
  for (std::int32_t y = 0; y < 64; ++y)
    for (std::int32_t x = 0; x < 64; ++x) steps.push_back({curve_key({x - 192, y + 1024}), {x, y}});
  std::ranges::sort(steps, {}, &Step::key);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].key, steps[i - 1].key + 1);
    EXPECT_EQ(
        std::abs(steps[i].cell.x - steps[i - 1].cell.x) + std::abs(steps[i].cell.y - steps[i - 1].cell.y), 1);
  }
}

TEST(Curve, SquaresHoldTheirLowerBorders) {
  EXPECT_EQ(cell_at(0, -0.0, 2), (Cell{0, 0}));
  EXPECT_EQ(cell_at(2, -1e-300, 2), (Cell{1, -1}));
  EXPECT_EQ(cell_at(-2, 1e9, 2), (Cell{-1, 500'000'000}));
}

TEST(Cut, PartsWeighTheSameButForAPlace) {
  test::Random random(4);
  for (const int ranks : {1, 2, 3, 7, 16, 1024}) {
    std::vector<Weight> weights;
    std::uint64_t total = 0, largest = 0;
    for (int i = 0; i < 3000; ++i) {
      weights.push_back({random.next(), random.below(1000)});
      total += weights.back().weight, largest = std::max(largest, weights.back().weight);
    }
    std::ranges::sort(weights, {}, &Weight::key);
    const std::vector<Weight> places = weights;
    const Cut cut = cut_evenly(ranks, weight_before(weights));
    EXPECT_EQ(cut.firsts().size() + 1, static_cast<std::size_t>(ranks));
    EXPECT_TRUE(std::ranges::is_sorted(cut.firsts()));
    std::vector<std::uint64_t> sums(static_cast<std::size_t>(ranks), 0);
    for (const Weight& place : places) sums[static_cast<std::size_t>(cut.owner(place.key))] += place.weight;
    EXPECT_LE(*std::ranges::max_element(sums), total / static_cast<std::uint64_t>(ranks) + 1 + largest);
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), total);
  }
}

TEST(Cut, NothingNeedsNoPlace) {
  std::vector<Weight> none;
  const Cut cut = cut_evenly(5, weight_before(none));
  EXPECT_EQ(cut.firsts().size(), 4u);
  EXPECT_EQ(cut.owner(0), 4);  // whoever it is
}

}  // namespace
}  // namespace bch::detail

int main(int argc, char** argv) {
  const bch::detail::Session session(argc, argv);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, session.size() == 1 ? 2 : 1);
  testing::InitGoogleTest(&argc, argv);
  GTEST_FLAG_SET(fail_fast, false);  // a rank that ended early would leave the others waiting
  if (session.rank() != 0)           // whose lines are enough; failures of others are seen by their exit code
    delete testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_result_printer());
  return RUN_ALL_TESTS();
}
