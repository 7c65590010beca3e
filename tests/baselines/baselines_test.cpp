// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cinttypes>
#include <cstdio>

#include "baselines/oracle.hpp"
#include "baselines/placement.hpp"
#include "tests/support/baseline_scene.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Every structure against every other, and a share of the answers against brute force. 1 of `brute_share`
// placements goes to the brute force over triangles; outlines are small enough to check always.

namespace bch {
namespace {

using baselines::Body;
using baselines::Structure;
using baselines::Truth;
using test::PairScene;

constexpr std::size_t brute_share = 32;
/// How close to touching FCL and the exact tests may differ, metres: FCL projects onto normalised products of
/// edges in double, which are off by 1e-16 of lengths of a metre, divided by sines of sliver triangles.
constexpr double fcl_band = 1e-9;
/// How close to touching the placement in double and in long double may differ: 6e-10 of the reach.
constexpr double placement_band = 2e-9;

class Suite {
 public:
  Suite(const std::vector<Character>& characters, std::uint32_t poses)
      : bodies_(test::posed_bodies(characters, poses)), all_(test::build_all(bodies_)) {
    for (const Body& body : bodies_) shapes_.push_back(body.shape);
  }

  void check_random(std::uint64_t seed, std::uint32_t pairs) {
    scene_ = test::placements(seed, bodies_, test::samples(pairs));
    check("random", seed);
  }

  /// Meshes see heights; outlines and projections do not.
  void check_at_heights(std::uint64_t seed, std::uint32_t pairs) {
    scene_ = test::placements(seed, bodies_, test::samples(pairs));
    test::Random random(seed);
    for (std::size_t i = 0; i < scene_.crowd.shape.size(); ++i)
      scene_.crowd.z.push_back(random.uniform(-0.8, 0.8));
    check("at heights", seed);
  }

  void check_touching(std::uint64_t seed, std::uint32_t pairs) {
    scene_ = test::placements(seed, bodies_, test::samples(pairs));
    test::slide_to_contact(seed, scene_,
                           {&of("obb_full"), &of("obb_contour"), &of("obb_projected"), &of("reference")});
    check("touching", seed);
  }

 private:
  const Structure& of(std::string_view name) const { return *answers(name).structure; }
  const std::vector<std::uint8_t>& hits(std::string_view name) const { return answers(name).hits; }
  const test::Answers& answers(std::string_view name) const {
    return *std::find_if(all_.begin(), all_.end(), [&](const auto& a) { return a.kind->name == name; });
  }

  void check(const char* kind, std::uint64_t seed) {
    for (test::Answers& one : all_) {
      one.hits.assign(scene_.pairs.size(), 77);
      one.structure->query(scene_.crowd.agents(), scene_.pairs, one.hits);
    }
    check_outlines();
    check_triangles();
    check_peers();
    std::printf("%s placements, seed %" PRIu64 ": %zu", kind, seed, scene_.pairs.size());
    for (const test::Answers& one : all_)
      std::printf(", %s %td", std::string(one.kind->name).c_str(),
                  std::count(one.hits.begin(), one.hits.end(), 1));
    std::printf("; FCL differs in %zu, long double in %zu\n", fcl_differences_, placement_differences_);
    if (test::replaying()) return;
    // Of the pairs that touch, a quarter was slid to the contact of each of these, and about half of that quarter hits.
    for (const std::string_view name : {"obb_full", "obb_contour", "obb_projected"}) {
      const auto count = std::count(hits(name).begin(), hits(name).end(), 1);
      EXPECT_GT(count, std::ssize(hits(name)) / 10) << name;
      EXPECT_LT(count, std::ssize(hits(name)) * 9 / 10) << name;
    }
  }

  /// Contour forms equal the crossing of outlines, by brute force with the exact tests; and that equals the
  /// crossing in long double wherever the placements' own difference cannot matter.
  void check_outlines() {
    const Agents agents = scene_.crowd.agents();
    const auto crosses = [&](const Agents& at, Pair pair) {
      const auto [a, b] = std::minmax(pair.first, pair.second);
      return test::outlines_meet(outline(at, a), outline(at, b), baselines::placement(at, pair));
    };
    for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
      const bool expected = crosses(agents, scene_.pairs[i]);
      for (const std::string_view name : {"obb_contour", "obb_contour_2d"})
        ASSERT_EQ(hits(name)[i] == 1, expected) << name << ", " << test::replay_line(scene_, i);
      if (i % brute_share != 0) continue;
      const auto [a, b] = std::minmax(scene_.pairs[i].first, scene_.pairs[i].second);
      const baselines::Oracle oracle(outline(agents, a), outline(agents, b),
                                     baselines::exact_placement(agents, a, b));
      if (oracle.cross() == expected) continue;
      ++placement_differences_;
      ASSERT_TRUE(test::touches(scene_, i, placement_band, crosses)) << test::replay_line(scene_, i);
    }
  }

  /// Full and projected forms equal brute force, projected forms each other, and meshes that meet do so seen
  /// from above.
  void check_triangles() {
    const Agents agents = scene_.crowd.agents();
    for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
      ASSERT_EQ(hits("obb_projected")[i], hits("bch_projected")[i]) << test::replay_line(scene_, i);
      ASSERT_LE(hits("obb_full")[i], hits("obb_projected")[i]) << test::replay_line(scene_, i);
      if (i % brute_share != 0) continue;
      const auto [a, b] = std::minmax(scene_.pairs[i].first, scene_.pairs[i].second);
      const Body &body_a = bodies_[agents.shape[a]], &body_b = bodies_[agents.shape[b]];
      const baselines::Placement at = baselines::placement_in_space(agents, scene_.pairs[i]);
      ASSERT_EQ(hits("obb_full")[i] == 1, test::meshes_meet(body_a, body_b, at))
          << test::replay_line(scene_, i);
      ASSERT_EQ(hits("obb_projected")[i] == 1, test::projections_meet(body_a, body_b, at))
          << test::replay_line(scene_, i);
    }
  }

  /// FCL's answers equal ours of the same facets, but for touching, where brute force decides for us.
  void check_peers() {
    for (const test::Answers& peer : all_) {
      if (!peer.kind->name.starts_with("fcl_")) continue;
      const bool full = peer.kind->exact == Truth::mesh;
      const std::string_view name = full ? "obb_full" : "obb_contour";
      for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
        if (peer.hits[i] == hits(name)[i]) continue;
        ++fcl_differences_;
        const Structure& ours = of(name);
        ASSERT_TRUE(
            test::touches(scene_, i, fcl_band,
                          [&](const Agents& at, Pair pair) { return ours.query(at, pair, all_depths); }))
            << peer.kind->name << " says " << int{peer.hits[i]} << ", " << test::replay_line(scene_, i);
        const auto [a, b] = std::minmax(scene_.pairs[i].first, scene_.pairs[i].second);
        const Agents agents = scene_.crowd.agents();
        const baselines::Placement at = baselines::placement_in_space(agents, scene_.pairs[i]);
        const bool expected = full ? test::meshes_meet(bodies_[agents.shape[a]], bodies_[agents.shape[b]], at)
                                   : test::outlines_meet(outline(agents, a), outline(agents, b), at);
        ASSERT_EQ(hits(name)[i] == 1, expected) << name << ", " << test::replay_line(scene_, i);
      }
    }
  }

  const Outline& outline(const Agents& agents, std::uint32_t agent) const {
    return shapes_[agents.shape[agent]].outline;
  }

  std::vector<Body> bodies_;
  std::vector<Shape> shapes_;
  std::vector<test::Answers> all_;
  PairScene scene_;
  std::size_t fcl_differences_ = 0, placement_differences_ = 0;
};

TEST(DefaultCharacters, RandomPlacements) {
  const auto characters = test::default_characters();
  Suite(characters, 16).check_random(1996, 40'000);
}

TEST(DefaultCharacters, PlacementsAtHeights) {
  const auto characters = test::default_characters();
  Suite(characters, 16).check_at_heights(1998, 10'000);
}

TEST(DefaultCharacters, TouchingPlacements) {
  const auto characters = test::default_characters();
  Suite(characters, 16).check_touching(1997, 10'000);
}

TEST(RealCharacters, RandomPlacements) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  const auto characters = test::real_characters(*data);
  Suite(characters, 10).check_random(2012, 15'000);
}

TEST(RealCharacters, TouchingPlacements) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  const auto characters = test::real_characters(*data);
  Suite(characters, 10).check_touching(2014, 4'000);
}

}  // namespace
}  // namespace bch
