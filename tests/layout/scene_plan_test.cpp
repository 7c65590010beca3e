// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// The nearer the finer.
std::uint32_t depth_at(double metres) {
  return metres < 5 ? all_depths : metres < 10 ? 6 : metres < 20 ? 3 : 0;
}

/// Agents in a few poses of a clip, up to 30 m away.
std::vector<ScenePlan::Agent> walkers(std::uint32_t count, test::Random& random) {
  std::vector<ScenePlan::Agent> agents;
  for (std::uint32_t i = 0; i < count; ++i)
    agents.push_back(
        {{random.below(2), {0, 0.125f * static_cast<float>(random.below(6))}}, random.uniform(0, 30)});
  return agents;
}

TEST(ScenePlan, NamesEveryShapeOnce) {
  test::Random random(91);
  const std::vector<ScenePlan::Agent> agents = walkers(300, random);
  const ScenePlan plan = plan_scene(agents);
  EXPECT_EQ(plan.shapes.size(), 12u);
  ASSERT_EQ(plan.agent_shape.size(), 300u);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const PoseId& shape = plan.shapes.at(plan.agent_shape[i]);
    EXPECT_EQ(shape.character, agents[i].pose.character);
    EXPECT_EQ(shape.at.clip, agents[i].pose.at.clip);
    EXPECT_EQ(shape.at.seconds, agents[i].pose.at.seconds);
  }
}

TEST(ScenePlan, SharesShapesWithinThePoseStep) {
  std::vector<ScenePlan::Agent> agents;
  for (int i = 0; i < 1000; ++i) agents.push_back({{0, {0, 0.01f * static_cast<float>(i)}}, 0});
  EXPECT_EQ(plan_scene(agents).shapes.size(), 1000u);
  const ScenePlan plan = plan_scene(agents, {.pose_step = 0.5f});
  EXPECT_EQ(plan.shapes.size(), 20u);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const float later = agents[i].pose.at.seconds - plan.shapes[plan.agent_shape[i]].at.seconds;
    EXPECT_GE(later, 0);
    EXPECT_LT(later, 0.5f);
  }
}

TEST(ScenePlan, DepthFollowsTheDensity) {
  std::vector<ScenePlan::Agent> agents;
  for (const double density : {0.5, 1.2, 2.7, 5.0}) agents.push_back({{0, {}}, 7, density});
  const ScenePlan plan = plan_scene(agents, {.density_depth = depth_at_density});
  EXPECT_EQ(plan.set.depths, (std::vector<std::uint32_t>{0, all_depths}));
  EXPECT_EQ(plan.agent_level, (std::vector<std::uint8_t>{0, 1, 1, 1}));
  // The coarser of both: 6 at seven metres.
  const ScenePlan both = plan_scene(agents, {.depth = depth_at, .density_depth = depth_at_density});
  EXPECT_EQ(both.set.depths, (std::vector<std::uint32_t>{0, 6}));
  EXPECT_EQ(both.agent_level, (std::vector<std::uint8_t>{0, 1, 1, 1}));
  for (const double wrong : {-0.5, std::numeric_limits<double>::infinity(), static_cast<double>(nan)}) {
    agents[1].density = wrong;
    EXPECT_THROW(plan_scene(agents), std::invalid_argument) << wrong;
  }
}

TEST(ScenePlan, LocalDensitiesEqualCounting) {
  test::Random random(17);
  std::vector<double> x, y;
  for (int i = 0; i < 400; ++i) x.push_back(random.uniform(-6, 9)), y.push_back(random.uniform(-4, 4));
  x.push_back(2), y.push_back(0), x.push_back(4), y.push_back(0);  // 2 m apart, touching the circle
  const std::vector<double> densities = local_densities(x, y, 2);
  for (std::size_t i = 0; i < x.size(); ++i) {
    int count = 0;
    for (std::size_t j = 0; j < x.size(); ++j)
      count += (x[i] - x[j]) * (x[i] - x[j]) + (y[i] - y[j]) * (y[i] - y[j]) <= 4 ? 1 : 0;
    EXPECT_DOUBLE_EQ(densities[i], count / (std::numbers::pi * 4)) << i;
  }
  EXPECT_TRUE(local_densities({}, {}).empty());
  EXPECT_THROW(local_densities(x, std::span(y).first(3)), std::invalid_argument);
  EXPECT_THROW(local_densities(x, y, 0), std::invalid_argument);
  x[5] = nan;
  EXPECT_THROW(local_densities(x, y), std::invalid_argument);
}

/// Whatever the step, up to the very end of every clip.
TEST(ScenePlan, NamesTimesThatClipsHave) {
  const Character character = test::default_characters().front();
  detail::Skinner skinner(character);
  for (const float step : {0.3f, 1.0f / 30, 0.7f, 100.0f})
    for (std::uint32_t clip = 0; clip < character.clips.size(); ++clip) {
      const float end = character.clips[clip].seconds;
      for (const float at : {end, std::nextafter(end, 0.0f), end - 0.01f}) {
        const ScenePlan plan =
            plan_scene(std::vector<ScenePlan::Agent>{{{0, {clip, at}}, 0}}, {.pose_step = step});
        EXPECT_NO_THROW(skinner.pose(plan.shapes[0].at)) << character.clips[clip].name << ' ' << at;
      }
    }
}

/// The rest pose has no time.
TEST(ScenePlan, SharesTheRestPose) {
  std::vector<ScenePlan::Agent> agents;
  for (int i = 0; i < 100; ++i) agents.push_back({{0, {PoseTime::rest, 0.1f * static_cast<float>(i)}}, 0});
  EXPECT_EQ(plan_scene(agents).shapes.size(), 1u);
}

TEST(ScenePlan, HasTheDepthsThatAgentsAskFor) {
  test::Random random(92);
  const std::vector<ScenePlan::Agent> agents = walkers(300, random);
  const ScenePlan plan = plan_scene(agents, {.depth = depth_at});
  EXPECT_EQ(plan.set.depths, (std::vector<std::uint32_t>{0, 3, 6, all_depths}));
  for (std::size_t i = 0; i < agents.size(); ++i)
    EXPECT_EQ(plan.set.depths.at(plan.agent_level[i]), depth_at(agents[i].distance));
  EXPECT_EQ(plan_scene(agents, {.depth = [](double) { return 0u; }}).set.depths,
            std::vector<std::uint32_t>{0});
  EXPECT_EQ(plan_scene(agents).set.depths, std::vector<std::uint32_t>{all_depths});
  EXPECT_EQ(plan_scene({}).set.depths, std::vector<std::uint32_t>{all_depths});
}

TEST(ScenePlan, HasTheShortcutsThatPay) {
  EXPECT_TRUE(plan_scene({}).set.culling);
  EXPECT_FALSE(plan_scene({}, {.pairs_per_shape = 6}).set.culling);
  EXPECT_FALSE(plan_scene({}, {.outlines = false}).set.outlines);
  EXPECT_FALSE(plan_scene({}).set.heights);
  EXPECT_TRUE(plan_scene({}, {.heights = true}).set.heights);
}

/// A set by the plan answers like one with everything.
TEST(ScenePlan, ChangesNoAnswer) {
  test::Random random(93);
  const std::vector<ScenePlan::Agent> agents = walkers(400, random);
  const std::vector<Character> characters = test::default_characters();
  std::vector<ShapeBuilder> shape_builders(characters.begin(), characters.end());
  std::vector<double> x, y, heading;
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < agents.size(); ++i) {
    x.push_back(random.uniform(0, 8)), y.push_back(random.uniform(0, 8)),
        heading.push_back(random.uniform(0, 6));
    for (std::uint32_t j = 0; j < i; ++j) pairs.push_back({j, i});
  }
  const auto hits = [&](const ScenePlan& plan, const ShapeSetPlan& set_plan) {
    std::vector<Shape> shapes;
    for (const PoseId& source : plan.shapes)
      shapes.push_back(shape_builders[source.character].shape(source.at));
    std::vector<std::uint8_t> answers(pairs.size());
    collide(ShapeSet(shapes, set_plan), {plan.agent_shape, x, y, heading, plan.agent_level}, pairs, answers);
    return answers;
  };
  for (const bool outlines : {false, true})
    for (const double many : {6.0, 1e9}) {
      const ScenePlan plan =
          plan_scene(agents, {.outlines = outlines, .depth = depth_at, .pairs_per_shape = many});
      const auto answers = hits(plan, plan.set);
      EXPECT_EQ(answers, hits(plan, {.depths = plan.set.depths, .outlines = outlines}));
      EXPECT_GT(std::count(answers.begin(), answers.end(), 1), 300);
    }
}

TEST(ScenePlan, RejectsWhatIsNoNumber) {
  const auto plan = [](const ScenePlan::Agent& agent) {
    return plan_scene(std::vector<ScenePlan::Agent>{{}, agent});
  };
  EXPECT_THROW(plan({{}, -1}), std::invalid_argument);
  EXPECT_THROW(plan({{}, std::numeric_limits<double>::infinity()}), std::invalid_argument);
  EXPECT_THROW(plan({{0, {0, nan}}, 0}), std::invalid_argument);
  EXPECT_THROW(plan_scene({}, {.pose_step = -1}), std::invalid_argument);
  EXPECT_THROW(plan_scene({}, {.pose_step = nan}), std::invalid_argument);
  EXPECT_THROW(plan_scene({}, {.pairs_per_shape = static_cast<double>(nan)}), std::invalid_argument);
  const std::vector<ScenePlan::Agent> many(300);
  std::uint32_t next = 0;
  EXPECT_THROW(plan_scene(many, {.depth = [&](double) { return next++; }}), std::invalid_argument);
}

}  // namespace
}  // namespace bch
