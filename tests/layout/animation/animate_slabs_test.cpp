// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/slab_triangles.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/animated_cover.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Moving discs of clips in slabs: those of each slab hold the body there at any time, against meshes cut at that very time.

namespace bch {
namespace {

using test::Cover;
using test::Random;

/// What is seen of slabs at random times.
struct Seen {
  double mean_excess = 0;  ///< metres
  std::size_t empty = 0;   ///< covers without discs
};

/// Looks at random times whether covers hold the slabs of the body, cut then.
Seen expect_slabs_held(const Character& character, const std::vector<float>& planes, std::uint32_t times,
                       Random& random) {
  AnimateOptions options;
  options.slices = planes;
  const AnimatedDiscs animated = animate(character, 0, options);
  EXPECT_EQ(animated.slices, planes);
  const AnimatedShape shape(animated);
  EXPECT_EQ(shape.slabs().size(), planes.size() + 1);
  detail::Skinner skinner(character);
  OutlineBuilder builder(character.triangles, character.vertices.size());
  std::vector<Outline> slabs(planes.size() + 1);
  Seen seen;
  double covers = 0;
  for (std::uint32_t i = 0; i < times; ++i) {
    const auto seconds = static_cast<float>(random.uniform(0, double{character.clips[0].seconds}));
    const Heights heights = builder.build(skinner.pose({0, seconds}), planes, slabs);
    EXPECT_LE(animated.heights.bottom, heights.bottom);
    EXPECT_GE(animated.heights.top, heights.top);
    for (std::size_t s = 0; s < slabs.size(); ++s) {
      const Cover cover = test::cover_at(animated.slabs[s], double{seconds});
      EXPECT_EQ(test::left_out(cover, slabs[s].points, slabs[s]), 0u)
          << character.name << ", slab " << s << " at " << seconds << " s";
      seen.empty += cover.discs.empty();
      if (slabs[s].points.empty()) continue;
      const double turn = random.uniform(0, 2 * std::numbers::pi);
      seen.mean_excess += test::excess_in(cover, slabs[s].points, std::cos(turn), std::sin(turn));
      ++covers;
    }
  }
  seen.mean_excess /= covers;
  return seen;
}

TEST(AnimateSlabs, HoldCharactersCutAtAnyHeights) {
  Random random(3151);
  for (Character character : test::default_characters()) {
    character.clips.resize(1);
    character.clips[0].seconds = 0.05f * static_cast<float>(test::samples(8));
    const auto low = static_cast<float>(random.uniform(0.1, 0.6)),
               high = static_cast<float>(random.uniform(0.8, 1.4));
    const Seen seen = expect_slabs_held(character, {low, high}, test::samples(200), random);
    EXPECT_LT(seen.mean_excess, 0.02) << character.name << " cut at " << low << " and " << high;
  }
}

/// Below the knees legs are apart, and from there to the waist hands are: where discs lie between them, some reach out by 15 cm.
TEST(AnimateSlabs, GiveFeetAndHandsRingsOfTheirOwn) {
  Character character = default_male();
  std::erase_if(character.clips, [](const Clip& clip) { return clip.name != "walk"; });
  ASSERT_EQ(character.clips.size(), 1u);
  character.clips[0].seconds = 0.15f * static_cast<float>(test::samples(8));
  AnimateOptions options;
  options.slices = {0.4f, 1};
  const AnimatedDiscs animated = animate(character, 0, options);
  for (const AnimatedChunk& chunk : animated.slabs[0].chunks) EXPECT_EQ(chunk.ring_ends.size(), 2u);
  detail::Skinner skinner(character);
  OutlineBuilder builder(character.triangles, character.vertices.size());
  std::vector<Outline> slabs(3);
  Random random(3154);
  for (std::uint32_t i = 0; i < test::samples(100); ++i) {
    const auto seconds = static_cast<float>(random.uniform(0, double{character.clips[0].seconds}));
    builder.build(skinner.pose({0, seconds}), options.slices, slabs);
    for (std::size_t s = 0; s < slabs.size(); ++s)
      EXPECT_LT(test::most_out(test::cover_at(animated.slabs[s], double{seconds}), slabs[s]), 0.04)
          << "slab " << s << " at " << seconds << " s";
  }
}

/// A bar, 0.4 m times 0.06 m, that swings up about y and back, once a second, on a root that an arm of a length carries along.
Character swinging_bar(float arm, float angle) {
  Character body;
  body.name = "bar";
  const auto turned = [](float by) { return Quaternion{0, -std::sin(by / 2), 0, std::cos(by / 2)}; };
  body.joints = {{"arm", -1, {}}, {"root", 0, {}}};
  body.joints[1].rest.rows[0][3] = arm;
  body.root_joint = 1;
  body.bones = {{1, {}}};
  body.vertices = {{0, -0.03f, 0}, {0.4f, -0.03f, 0}, {0.4f, 0.03f, 0}, {0, 0.03f, 0}};
  body.influence_begin = {0, 1, 2, 3, 4};
  body.influences.assign(4, {0, 1});
  body.triangles = {{0, 1, 2}, {0, 2, 3}};
  Channel channel;
  channel.joint = 0;
  channel.rotations = {{0, turned(0)}, {0.5f, turned(angle)}, {1, turned(0)}};
  body.clips = {{"swing", 1, {channel}}};
  validate(body);
  return body;
}

TEST(AnimateSlabs, AreEmptyWhereTheBodyIsNot) {
  Random random(3152);
  // The bar is flat in the beginning, and its tip 0.39 m high in the middle.
  const Seen seen = expect_slabs_held(swinging_bar(0, 1.35f), {0.1f, 0.3f}, test::samples(800), random);
  EXPECT_GT(seen.empty, test::samples(200));
  // An arm lifts it from 0 to 1.4 m.
  EXPECT_GT(expect_slabs_held(swinging_bar(1, 1.35f), {0.4f}, test::samples(400), random).empty,
            test::samples(100));
}

/// Bounds of parts of the clip may reach above those of the whole clip, where a set would refuse discs.
TEST(AnimateSlabs, AreEmptyBeyondTheHeightsOfTheBody) {
  const Character body = swinging_bar(1, 3);
  AnimateOptions options;
  options.slices = {1};
  const Heights heights = animate(body, 0, options).heights;
  for (const auto& [plane, slab] : {std::pair(heights.top, 1), {std::nextafter(heights.bottom, -9.0f), 0}}) {
    options.slices = {plane};
    const AnimatedDiscs animated = animate(body, 0, options);
    EXPECT_NO_THROW(validate(animated));
    for (const AnimatedChunk& chunk : animated.slabs[static_cast<std::size_t>(slab)].chunks)
      EXPECT_EQ(chunk.disc_count, 0u) << "slab " << slab;
  }
}

/// Over the top of an arm's way, where the ends of a window are lower than its middle.
TEST(AnimateSlabs, KnowHowHighABodyComes) {
  const Character body = swinging_bar(1, 3);
  detail::SlabTriangles triangles(body, 0, 0.01);
  detail::Skinner skinner(body);
  Random random(3153);
  for (std::uint32_t i = 0; i < test::samples(200); ++i) {
    const auto from = static_cast<float>(random.uniform(0, 0.5)),
               to = from + static_cast<float>(random.uniform(0.001, 0.1));
    triangles.look(from, to);
    const Heights heights = triangles.heights();
    float low = 1e9f, high = -1e9f;
    for (float share = 0; share <= 1; share += 0.01f)
      for (const Vec3& p : skinner.pose({0, from + (to - from) * share}))
        low = std::min(low, p.z), high = std::max(high, p.z);
    EXPECT_LE(heights.bottom, low);
    EXPECT_GE(heights.top, high);
    EXPECT_GT(heights.bottom, low - 0.01f);
    EXPECT_LT(heights.top, high + 0.01f);
    EXPECT_EQ(triangles.in({high, 9}).triangles.empty(), false);
    EXPECT_EQ(triangles.in({high + 0.01f, 9}).triangles.empty(), true);
  }
}

/// Also of a body that is whole, and over the top of an arm's way.
TEST(AnimateSlabs, HaveTheHeightsOfTheWholeClip) {
  const Character body = swinging_bar(1, 3);
  const Heights whole = animate(body, 0).heights;
  detail::Skinner skinner(body);
  float low = 1e9f, high = -1e9f;
  for (float share = 0; share <= 1; share += 1.0f / 1024)
    for (const Vec3& p : skinner.pose({0, share})) low = std::min(low, p.z), high = std::max(high, p.z);
  EXPECT_LE(whole.bottom, low);
  EXPECT_GE(whole.top, high);
  EXPECT_GT(whole.bottom, low - 0.01f);
  EXPECT_LT(whole.top, high + 0.01f);
  EXPECT_EQ(animate(body, 0, {.slices = {0.4f}}).heights, whole);
}

TEST(AnimateSlabs, RefusePlanesThatDoNotAscend) {
  AnimateOptions options;
  options.slices = {1, 0.5f};
  EXPECT_EQ(test::complaint([&] { animate(swinging_bar(0, 1), 0, options); }),
            "slices: plane 1 at 0.5 m does not ascend");
}

}  // namespace
}  // namespace bch
