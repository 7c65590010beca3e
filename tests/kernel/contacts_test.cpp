// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/contacts.hpp>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <bch/broad_phase.hpp>
#include <bch/collide.hpp>
#include <bch/default_characters.hpp>

#include "baselines/contact_reference.hpp"
#include "layout/format/shape_arrays.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/differential.hpp"

namespace bch {
namespace {

using baselines::CutLists;
using test::PairScene;

const ShapeSetPlan plan{{0, 3, 6, all_depths}, false};

/// Rows that own their memory.
struct Table {
  std::vector<std::uint64_t> offsets;
  std::vector<DiscPair> contacts;

  Table(const Rows<DiscPair>& rows = {})
      : offsets(rows.offsets.begin(), rows.offsets.end()), contacts(rows.values.begin(), rows.values.end()) {}
  Rows<DiscPair> rows() const { return {offsets, contacts}; }
  friend bool operator==(const Table&, const Table&) = default;
};

Table table_of(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
               const Implementation& implementation = best_implementation()) {
  return ContactFinder().find(set, agents, pairs, {.implementation = &implementation});
}

/// Row after row, by every disc of one cut against every disc of the other.
Table brute_force(const CutLists& cuts, const Agents& agents, std::span<const Pair> pairs) {
  Table table;
  table.offsets = {0};
  for (const Pair pair : pairs) {
    for (const auto& [i, j] : baselines::contacts(cuts, agents, pair)) table.contacts.push_back({i, j});
    table.offsets.push_back(table.contacts.size());
  }
  return table;
}

class Contacts : public test::Differential {
 protected:
  Contacts() : Differential(81, plan) {}

  CutLists cuts{shapes, plan};

  void expect_brute_force(const PairScene& scene, const char* what) {
    const Table expected = brute_force(cuts, scene.crowd.agents(), scene.pairs);
    EXPECT_GT(expected.contacts.size(), scene.pairs.size() / 3);
    for (const auto& implementation : implementations())
      if (implementation.supported()) {
        EXPECT_TRUE(table_of(set, scene.crowd.agents(), scene.pairs, implementation) == expected)
            << what << ", " << implementation.name;
      }
  }
};

TEST_F(Contacts, EqualBruteForce) {
  for (int i = 0; i < 4; ++i) {
    PairScene scene = random_scene(random, set, 25'000);
    expect_brute_force(scene, "random");
    test::move_away(scene, 1e7, -8e8);
    expect_brute_force(scene, "far from the origin");
  }
}

TEST_F(Contacts, EqualBruteForceNearTangency) {
  for (int i = 0; i < 4; ++i) expect_brute_force(tangent_scene(25'000), "near tangent");
}

TEST_F(Contacts, OfPeople) {
  shapes = test::pose_shapes(default_female(), 20);
  set = ShapeSet(shapes, plan);
  cuts = CutLists(shapes, plan);
  expect_brute_force(random_scene(random, set, 5'000), "people");
}

/// Makes a body of discs in no order: its nodes hold them.
Shape body_of_discs(test::Random& random, std::uint32_t count) {
  const double size = std::pow(10, random.uniform(-3, 1));
  std::vector<Disc> discs;
  while (discs.size() < count)
    discs.push_back({static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(random.uniform(0.02, 0.4) * size)});
  return shape_from_discs(discs);
}

/// Hits of such bodies are not verified where neither is much larger than the other; brute force does.
TEST_F(Contacts, OfBodiesOfDiscs) {
  for (const std::uint32_t most : {8u, 40u}) {
    shapes.clear();
    for (std::uint32_t i = 0; i < 40; ++i) shapes.push_back(body_of_discs(random, 1 + random.below(most)));
    set = ShapeSet(shapes, plan);
    cuts = CutLists(shapes, plan);
    discs = baselines::Reference(shapes, plan);
    const std::uint32_t levels = set.level_count();
    for (std::uint32_t i = 0; i < shapes.size(); ++i)
      EXPECT_EQ(set.arrays().trees[i * levels + levels - 1].nodes_hold_discs, 1u) << i;
    expect_brute_force(random_scene(random, set, 50'000), "bodies of discs");
    expect_brute_force(tangent_scene(50'000), "bodies of discs, near tangent");
    // Few pairs of light shapes are answered in one pass.
    expect_brute_force(random_scene(random, set, 1'500), "few");
  }
}

/// Broad and narrow phase, in any set: the same as one after the other.
TEST_F(Contacts, OfACrowdAreThoseOfItsCandidates) {
  std::vector<Shape> few_discs;
  for (std::uint32_t i = 0; i < 10; ++i) few_discs.push_back(body_of_discs(random, 5));
  const ShapeSet sets[] = {ShapeSet(shapes, plan), ShapeSet(few_discs),
                           ShapeSet(few_discs, {.heights = true})};
  for (const ShapeSet& of : sets) {
    ContactFinder finder;
    for (const std::uint32_t count : {0u, 1u, 150u, 700u, 20u}) {
      test::Crowd crowd;
      const double extent = std::sqrt(count) / 2;
      for (std::uint32_t i = 0; i < count; ++i)
        crowd.add({random.below(of.shape_count()), random.uniform(0, extent), random.uniform(0, extent),
                   random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(of.level_count()))});
      if (of.has_heights())
        for (std::uint32_t i = 0; i < count; ++i) crowd.z.push_back(random.below(2));
      const std::vector<Pair> pairs = candidate_pairs(of, crowd.agents());
      const CrowdContacts found = finder.find_all(of, crowd.agents());
      EXPECT_TRUE(std::equal(pairs.begin(), pairs.end(), found.pairs.begin(), found.pairs.end())) << count;
      EXPECT_TRUE(Table(found.contacts) == table_of(of, crowd.agents(), pairs)) << count;
      EXPECT_EQ(found.contacts.size(), pairs.size());
      EXPECT_EQ(found.contacts.values.empty(), count < 2) << count;
    }
  }
}

TEST_F(Contacts, OfACrowdAreChecked) {
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  crowd.add({set.shape_count(), 0, 0, 0, 0});
  EXPECT_THROW(ContactFinder().find_all(set, crowd.agents()), std::invalid_argument);
  crowd.shape[1] = 0;
  EXPECT_THROW(ContactFinder().find_all(set, crowd.agents(), {.leaves = static_cast<Leaves>(5)}),
               std::invalid_argument);
}

TEST(DiscPair, IsEqualWhereBothDiscsAre) {
  EXPECT_EQ((DiscPair{1, 2}), (DiscPair{1, 2}));
  EXPECT_NE((DiscPair{1, 2}), (DiscPair{1, 3}));
  EXPECT_NE((DiscPair{1, 2}), (DiscPair{3, 2}));
}

TEST_F(Contacts, OfSingleDiscs) {
  const ShapeSetPlan single{{0}, false};
  const ShapeSet roots(shapes, single);
  ASSERT_TRUE(roots.roots_only());
  const PairScene scene = random_scene(random, roots, 3'000);
  EXPECT_TRUE(table_of(roots, scene.crowd.agents(), scene.pairs) ==
              brute_force(CutLists(shapes, single), scene.crowd.agents(), scene.pairs));
}

TEST_F(Contacts, AreThereWhereAgentsCollide) {
  const PairScene scene = tangent_scene(50'000);
  std::vector<std::uint8_t> hits(scene.pairs.size());
  collide(set, scene.crowd.agents(), scene.pairs, hits);
  const Table table = table_of(set, scene.crowd.agents(), scene.pairs);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(table.rows()[i].empty(), hits[i] == 0) << i;
}

TEST_F(Contacts, OfTheOtherOrderAreTheSameExchanged) {
  PairScene scene = tangent_scene(20'000);
  const Table table = table_of(set, scene.crowd.agents(), scene.pairs);
  for (Pair& pair : scene.pairs) std::swap(pair.first, pair.second);
  const Table other = table_of(set, scene.crowd.agents(), scene.pairs);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    std::vector<DiscPair> exchanged;
    for (const DiscPair& contact : other.rows()[i]) exchanged.push_back({contact.second, contact.first});
    std::sort(exchanged.begin(), exchanged.end(), [](const DiscPair& a, const DiscPair& b) {
      return a.first < b.first || (a.first == b.first && a.second < b.second);
    });
    const auto row = table.rows()[i];
    ASSERT_TRUE(std::equal(row.begin(), row.end(), exchanged.begin(), exchanged.end())) << i;
  }
}

/// Where most discs overlap, no list is long enough by chance; and an agent overlaps itself.
TEST_F(Contacts, OfCoincidentAgentsAndOfAnAgentWithItself) {
  test::Crowd crowd;
  std::vector<Pair> pairs;
  for (std::uint32_t shape = 0; shape < set.shape_count(); ++shape)
    for (std::uint8_t level = 0; level < set.level_count(); ++level) {
      const auto agent = static_cast<std::uint32_t>(crowd.x.size());
      crowd.add({shape, 1, 2, 3, level});
      crowd.add({shape, 1, 2, 3, level});
      pairs.insert(pairs.end(), {{agent, agent}, {agent + 1, agent}});
    }
  const Table table = table_of(set, crowd.agents(), pairs);
  EXPECT_TRUE(table == brute_force(cuts, crowd.agents(), pairs));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto row = table.rows()[i];
    EXPECT_EQ(std::count_if(row.begin(), row.end(), [](const DiscPair& c) { return c.first == c.second; }),
              std::ssize(cuts.of(crowd.agents(), pairs[i].first)));
  }
}

TEST_F(Contacts, BatchesOfEverySizeAndAnyNumberOfThreads) {
  const PairScene scene = random_scene(random, set, 3'000);
  const Table whole = table_of(set, scene.crowd.agents(), scene.pairs);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 2, 3, 8}) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
      ContactFinder finder;
      for (const std::size_t size : {0u, 1u, 15u, 16u, 17u, 255u, 256u, 257u, 3000u}) {
        const Rows<DiscPair> table =
            finder.find(set, scene.crowd.agents(), std::span(scene.pairs).first(size));
        ASSERT_EQ(table.offsets.size(), size + 1);
        EXPECT_TRUE(std::equal(table.offsets.begin(), table.offsets.end(), whole.offsets.begin()));
        ASSERT_EQ(table.values.size(), table.offsets[size]);
        EXPECT_TRUE(std::equal(table.values.begin(), table.values.end(), whole.contacts.begin()));
      }
    });
  }
}

TEST_F(Contacts, BadInputLeavesTheLastRows) {
  PairScene scene = random_scene(random, set, 10);
  ContactFinder finder;
  const Rows<DiscPair> rows = finder.find(set, scene.crowd.agents(), scene.pairs);
  const Table before = rows;
  scene.crowd.heading[7] = std::numeric_limits<double>::quiet_NaN();
  try {
    finder.find(set, scene.crowd.agents(), scene.pairs);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("pair 3: agent 7: heading nan"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(Table(rows) == before);
}

}  // namespace
}  // namespace bch
