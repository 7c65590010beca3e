// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#define XXH_INLINE_ALL  // nothing is linked
#include <xxhash.h>

#include "tests/support/baked_bytes.hpp"
#include "tests/support/float_state.hpp"
#include "tests/support/test.hpp"

// What construction makes, as hashes of baked files: the same bytes for every compiler, optimisation and processor. Where
// they change on purpose, so do these.

namespace bch {
namespace {

std::uint64_t hash_of(const std::vector<Shape>& shapes, const ShapeSetPlan& plan) {
  const std::string bytes = test::BakedBytes(ShapeSet(shapes, plan), {}).text();
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t hash_of(const Character& character, const ShapeSetPlan& plan) {
  PoseShaper shaper(character, plan);
  std::vector<Shape> shapes;
  for (const PoseTime& time : sample_poses(character, 3)) shapes.push_back(shaper.shape(time));
  return hash_of(shapes, plan);
}

/// Shapes of outlines that are given, without characters: no function of the standard library has a part in them.
TEST(ConstructionDeterminism, OfHierarchiesAndSets) {
  EXPECT_EQ(hash_of(test::synthetic_shapes(7, 16), {{0, 3, all_depths}, true}), 0x25edb0ce6ecdf41c);
}

TEST(ConstructionDeterminism, OfCharactersInPoses) {
  EXPECT_EQ(hash_of(default_male(), {.depths = {0, 3, all_depths}}), 0x40322cb47bcd0c87);
  EXPECT_EQ(hash_of(default_female(), {.depths = {0, all_depths}, .heights = true}), 0xa26190412d4ddf54);
}

std::uint64_t hash_of(const BodyModel& model) {
  std::vector<std::uint32_t> words(model.core.begin(), model.core.end());
  const auto add = [&](const auto& some) {
    for (const auto& each : some) {
      std::array<std::uint32_t, sizeof(each) / sizeof(std::uint32_t)> as_words;
      std::memcpy(as_words.data(), &each, sizeof(each));
      words.insert(words.end(), as_words.begin(), as_words.end());
    }
  };
  add(model.influence_begin), add(model.influences), add(model.cuts), add(model.corner_begin),
      add(model.corners);
  return XXH3_64bits(words.data(), words.size() * sizeof(words[0]));
}

TEST(ConstructionDeterminism, OfModelsOfBodies) {
  EXPECT_EQ(hash_of(make_body(default_male(), {.spheres = 24, .draft = true})), 0x8b56a2ae2e26918bu);
  EXPECT_EQ(hash_of(make_body(default_male(), {.spheres = 24})), 0xeab1e0ce51280adeu);
}

/// Hashes of all that makes shapes: of given outlines, of capsules and discs, of characters as outlines, roots and moving discs.
std::vector<std::uint64_t> hashes_of_all(std::vector<Shape> given) {
  for (Shape& shape : given) shape.hierarchy = contour_hierarchy(shape.outline, 0.02f);
  const std::vector<Capsule> arm{{{0.1f, 0}, {0.1f, 0.7f}, 0.05f}};
  const std::vector<Disc> pair{{0, -0.2f, 0.15f}, {1e-40f, 0.2f, 0.15f}};
  const Character woman = default_pedestrian(Sex::female, 1.63);
  return {hash_of(given, {{0, 3, all_depths}, true}),
          hash_of({shape_from_capsules(arm)}, {}),
          hash_of({shape_from_discs(pair)}, {}),
          hash_of(default_male(), {.heights = true}),
          hash_of(woman, {.depths = {0}, .outlines = false}),
          hash_of({AnimatedShape(animate(default_body(woman, 64), 0)).shape(0.3)}, {})};
}

/// Whoever links with -ffast-math begins with denormal numbers off.
TEST(ConstructionDeterminism, OfTheThreadsFloatingPointState) {
  const std::vector<Shape> given = test::synthetic_shapes(7, 16);
  const std::vector<std::uint64_t> expected = hashes_of_all(given);
  const unsigned before = test::float_state();
  for (const test::FloatState& state : test::odd_float_states()) {
    test::set_float_state(state.bits);
    const std::vector<std::uint64_t> here = hashes_of_all(given);
    const unsigned after = test::float_state();
    test::set_float_state(before);
    EXPECT_EQ(here, expected) << state.name;
    EXPECT_EQ(after, state.bits) << state.name;
  }
}

}  // namespace
}  // namespace bch
