// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/distributed_crowd.hpp>

#include "kernel/runtime/all_options.hpp"
#include "tests/distributed/world.hpp"
#include "tests/support/test.hpp"

// Crowds of characters that are posed anew in every step.

namespace bch {
namespace {

using namespace test;

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
    agent.pose = {random.below(pedestrian_speeds), static_cast<float>(random.uniform(0, 0.5))};
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
    std::vector<PoseShaper> shapers;
    for (const Character& character : characters) shapers.emplace_back(character, plan);
    std::vector<Shape> shapes;
    for (DistributedCrowd::Agent& agent : world.agents) {
      shapes.push_back(shapers[agent.shape].shape(agent.pose));
      agent.shape = static_cast<std::uint32_t>(shapes.size() - 1);
    }
    return ShapeSet(shapes, plan);
  }

  void expect_same(World world, const ShapeSetPlan& plan, DistributedCrowd& crowd) const {
    constexpr detail::AllOptions by_discs{.leaves = Leaves::discs}, near{.max_distance = 0.4};
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
  std::uint64_t sums[] = {counters.agents, counters.halo_bytes, counters.halo * (33 + 8),
                          counters.migration_bytes, counters.arrived * (41 + 8)};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(sums[0], count);
  EXPECT_EQ(
      sums[1],
      sums[2]);  // as of shapes of a set, of which the number of a shape is that of a character; clip and time
  EXPECT_EQ(sums[3], sums[4]);
  EXPECT_EQ(sums[1] > 0, ranks() > 1);
}

TEST_F(PosedCrowd, WhatIsWrongOnOneRankIsAnErrorOnAll) {
  const std::string last = "rank " + std::to_string(ranks() - 1) + ": ";
  const auto complaint_about = [&](const DistributedCrowd::Agent& agent) {
    DistributedCrowd crowd(MPI_COMM_WORLD, characters, {.depths = {0}}, {});
    if (rank() == ranks() - 1) crowd.agents().push_back(agent);
    return complaint<RankError>([&] { crowd.update(); });
  };
  EXPECT_EQ(complaint_about({.id = 9, .shape = 2}), last + "agent 9: shape is 2, not one of the characters");
  EXPECT_EQ(complaint_about({.id = 9, .level = 1}), last + "agent 9: level is 1, not one of the plan");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {74, 0}}),
            last + "agent 9: clip is 74, not one of the character's");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {0, -1}}), last + "agent 9: time is -1, not within the clip");
  EXPECT_EQ(complaint_about({.id = 9, .pose = {73, 5}}), last + "agent 9: time is 5, not within the clip");
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

}  // namespace
}  // namespace bch
