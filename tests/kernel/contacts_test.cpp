// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/contact_reference.hpp"
#include "layout/format/shape_arrays.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"

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
  Crowd crowd;
  return crowd.contacts(set, agents, pairs, {.implementation = &implementation});
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
    bch::Crowd finder;
    for (const std::uint32_t count : {0u, 1u, 150u, 700u, 20u}) {
      test::Crowd crowd;
      const double extent = std::sqrt(count) / 2;
      for (std::uint32_t i = 0; i < count; ++i)
        crowd.add({random.below(of.shape_count()), random.uniform(0, extent), random.uniform(0, extent),
                   random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(of.level_count()))});
      if (of.has_heights())
        for (std::uint32_t i = 0; i < count; ++i) crowd.z.push_back(random.below(2));
      const std::vector<Pair> pairs = test::candidate_pairs(of, crowd.agents());
      const bch::Crowd::Contacts found = finder.contacts(of, crowd.agents());
      const Table expected = table_of(of, crowd.agents(), pairs);
      std::vector<Pair> touching;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!expected.rows()[i].empty()) touching.push_back(pairs[i]);
      EXPECT_TRUE(std::ranges::equal(found.pairs, touching)) << count;
      EXPECT_EQ(Table(found.contacts).contacts, expected.contacts) << count;
      ASSERT_EQ(found.contacts.size(), touching.size());
      for (std::size_t i = 0; i < touching.size(); ++i) EXPECT_FALSE(found.contacts[i].empty()) << count;
      EXPECT_EQ(touching.empty(), count < 2) << count;
    }
  }
}

TEST(DiscPair, IsEqualWhereBothDiscsAre) {
  EXPECT_EQ((DiscPair{1, 2}), (DiscPair{1, 2}));
  EXPECT_NE((DiscPair{1, 2}), (DiscPair{1, 3}));
  EXPECT_NE((DiscPair{1, 2}), (DiscPair{3, 2}));
}

}  // namespace
}  // namespace bch
