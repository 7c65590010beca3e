// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/workload.hpp"
#include "bench/workload/motions.hpp"
#include "layout/character/eigen.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/test.hpp"

namespace bch::bench {
namespace {

/// Where all of a shape is its root disc, no pair's root discs overlap while its hierarchies do not.
TEST(RandomPairs, GivesUpWhereNoneIsWanted) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}};
  std::uint32_t asked = 0;
  try {
    random_pairs("no_hit", 1, shapes, 10, [&](const Agents&, Pair) { return ++asked <= 3; });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "workload no_hit: of 1000000 pairs at random after the first 3 none is wanted");
  }
}

TEST(RandomPairs, HasAsManyAsAreWanted) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}};
  std::uint32_t asked = 0;
  const Workload workload =
      random_pairs("every third", 1, shapes, 10, [&](const Agents&, Pair) { return ++asked % 3 == 0; });
  EXPECT_EQ(workload.pairs.size(), 10u);
  EXPECT_EQ(workload.crowd.size(), 20u);
  EXPECT_EQ(asked, 30u);
}

/// How much later than its first contact a pair collides at a sample, seconds.
std::vector<double> delays_of_samples(const MotionScene& scene, const MotionScene& shown) {
  const SampledMotions samples(shown, 1000, 1000);
  std::vector<double> delays;
  for (std::size_t i = 0; i < scene.pairs().size(); ++i)
    if (const double met = samples.first_contact(scene.pairs()[i]); std::isfinite(met))
      delays.push_back(met - scene.contacts()[i]);
  return delays;
}

/// Spheres at a millisecond do not meet before the first contact, and mostly soon after.
TEST(BodiesInMotion, MeetBehindFirstContacts) {
  const std::vector<cli::LoadedCharacter> people = {cli::load_character("default:male", {})};
  const std::vector<AnimatedClip> clips = animated_clips(people, "walk", 0.6);
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0].seconds, 0.5);
  const MotionScene scene(clips, 60, 1);
  EXPECT_NO_THROW(scene.check(20));
  const std::vector<double> delays = delays_of_samples(scene, scene);
  const std::size_t contacts = scene.pairs(true).size();
  EXPECT_GT(contacts, 20u);
  EXPECT_LE(delays.size(), contacts);
  EXPECT_GT(delays.size(), contacts * 3 / 4);
  double sum = 0;
  for (const double delay : delays) {
    EXPECT_GE(delay, 0);
    sum += delay;
  }
  EXPECT_GT(sum, 0);
  EXPECT_LT(sum, 0.1 * static_cast<double>(delays.size()));
}

/// Bodies of which only a small sphere is left have their first contacts later than people meet.
TEST(BodiesInMotion, MeetBeforeThoseOfBodiesThatAreTooSmall) {
  const std::vector<cli::LoadedCharacter> people = {cli::load_character("default:male", {})};
  const std::vector<AnimatedClip> clips = animated_clips(people, "walk", 0.6);
  std::vector<AnimatedClip> small = animated_clips(people, "walk", 0.6);
  small[0].shape = AnimatedShape({{{{0, 0.5}, 1, {{0, 0, 0.1f}, {0, 0, 0.1f}}, {1, 1}}}, true});
  const std::vector<double> delays = delays_of_samples(MotionScene(small, 60, 1), MotionScene(clips, 60, 1));
  EXPECT_GT(delays.size(), 20u);
  for (const double delay : delays) EXPECT_LT(delay, 0);
}

TEST(MeshDetail, ReliefStandsOutOfTheSurface) {
  const Character man = default_male(), flat = finer(man, 1), relief = with_relief(man, 1);
  ASSERT_EQ(relief.vertices.size(), flat.vertices.size());
  EXPECT_EQ(relief.triangles, flat.triangles);
  float farthest = 0;
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    const float moved = (detail::to_eigen(relief.vertices[v]) - detail::to_eigen(flat.vertices[v])).norm();
    EXPECT_TRUE(v >= man.vertices.size() || moved == 0) << v;
    farthest = std::max(farthest, moved);
  }
  EXPECT_GT(farthest, 0.003f);
  EXPECT_LT(farthest, 0.03f);
  EXPECT_EQ(with_relief(man, 1).vertices, relief.vertices);
}

}  // namespace
}  // namespace bch::bench
