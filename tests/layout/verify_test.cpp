// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/verify.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include <bch/dynamic_shape_set.hpp>
#include <bch/pose_shape.hpp>

#include "layout/format/shape_set_view.hpp"
#include "layout/format/shape_validation.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_characters.hpp"

// What verify() says of sets that were made honestly, and of such with one number changed.

namespace bch::test {
namespace {

using detail::baked::Section;

const ShapeSetPlan plans[] = {{},
                              {{0}, false, false},
                              {{0, 3, 6, all_depths}, true, true},
                              {{2, 5}, true},
                              {{0, 6}, false, false},
                              {{4}, false},
                              {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, all_depths}, true}};

void expect_nothing(const ShapeSet& set) {
  for (const Finding& finding : verify(set, 5)) ADD_FAILURE() << text_of(finding);
}

TEST(Verify, FindsNothingInSyntheticShapes) {
  const std::vector<Shape> shapes = synthetic_shapes(91, samples(400));
  for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
}

TEST(Verify, FindsNothingInCharacters) {
  for (const Character& character : default_characters()) {
    const std::vector<Shape> shapes = pose_shapes(character, 60);
    for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
  }
}

TEST(Verify, FindsNothingInRealCharacters) {
  const auto data = test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set";
  for (const Character& character : real_characters(*data)) {
    const std::vector<Shape> shapes = pose_shapes(character, 20);
    for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
  }
}

TEST(Verify, FindsNothingInShapesWithoutOutlines) {
  std::vector<Shape> shapes = synthetic_shapes(92, 40);
  for (Shape& shape : shapes) shape.outline = {};
  shapes.push_back({{}, fixed_cylinder(0.25f)});
  for (const ShapeSetPlan& plan : plans)
    if (!plan.outlines) expect_nothing(ShapeSet(shapes, plan));
}

/// Their nodes hold their discs, as their trees say.
TEST(Verify, LooksAtBodiesOfDiscs) {
  std::vector<Disc> body;
  for (int i = 0; i < 12; ++i)
    body.push_back({0.125f * static_cast<float>(i), 0.0625f * static_cast<float>(i % 3), 0.25f});
  const std::vector<Shape> shapes(2, shape_from_discs(body));
  for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
  // A disc that is large enough to be beyond the nodes above it, though it touches the same others.
  BakedBytes bytes(ShapeSet(shapes), origins_of(2));
  const detail::Tree& tree = bytes.section<detail::Tree>(Section::trees)[1];
  ASSERT_NE(tree.nodes_hold_discs, 0u);
  bytes.section<float>(Section::nodes)[tree.discs + 2 * tree.stride + 1] += 0.125f;
  bytes.seal();
  bool said = false;
  for (const Finding& finding : verify(bytes.load().set, 50))
    said |= finding.what.find("does not hold the discs below it") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(Verify, LooksAtEverySlab) {
  const ShapeSetPlan plan{.depths = {0, 3, all_depths}, .slices = {0.4f, 1}};
  const Character man = default_characters()[0];
  PoseShaper shaper(man, plan);
  std::vector<Shape> shapes;
  for (const PoseTime& time : sample_poses(man, 5)) shapes.push_back(shaper.shape(time));
  shapes.push_back(synthetic_shapes(97, 1)[0]);
  const ShapeSet set(shapes, plan);
  expect_nothing(set);
  BakedBytes bytes(set, {});
  bytes.section<float>(Section::hull_support)[detail::support_stride + 6] -= 0.01f;
  bytes.seal();
  const std::vector<Finding> findings = verify(bytes.load().set);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].shape, 1u);
  EXPECT_EQ(findings[0].array, std::string("hull_support"));
  EXPECT_NE(text_of(findings[0]).find("shape 1, slab "), std::string::npos) << text_of(findings[0]);
  EXPECT_NE(text_of(findings[0]).find("number 6 is "), std::string::npos) << text_of(findings[0]);
}

TEST(Verify, FindsNothingInADynamicSet) {
  const std::vector<Shape> pool = synthetic_shapes(93, 40);
  const ShapeSetPlan plan{{0, 3, all_depths}, true};
  DynamicShapeSet dynamic(ShapeSet({pool.data(), 8}, plan));
  Random random(94);
  PreparedShape prepared(plan);
  for (int i = 0; i < 60; ++i) {
    prepared.prepare(pool[random.below(40)], 0);
    dynamic.replace(random.below(8), prepared);
    expect_nothing(dynamic.set());
  }
}

constexpr std::size_t finest = 2;

/// The first block below the first shape's finest level all of whose names are windows.
float* lowest_block(BakedBytes& bytes) {
  float* block =
      bytes.section<float>(Section::nodes).data() + bytes.section<detail::Tree>(Section::trees)[finest].top;
  while (std::bit_cast<std::uint32_t>(block[detail::block_names]) < detail::leaf_window)
    block += detail::block_floats;
  return block;
}

/// The first disc of the finest level, and from it to its y.
float* finest_discs(BakedBytes& bytes) {
  return bytes.section<float>(Section::nodes).data() +
         bytes.section<detail::Tree>(Section::trees)[finest].discs;
}
std::uint32_t stride(BakedBytes& bytes) {
  return bytes.section<detail::Tree>(Section::trees)[finest].stride;
}

struct Lie {
  const char* array;
  const char* says;
  std::function<void(BakedBytes&)> tell;
};

const std::vector<Lie>& lies() {
  static const std::vector<Lie> all = {
      {"depths", "discs at depth 1", [](BakedBytes& b) { b.section<std::uint32_t>(Section::depths)[1] = 1; }},
      {"nodes", "needs", [](BakedBytes& b) { lowest_block(b)[detail::block_outer] *= 0.9f; }},
      {"nodes", "needs",
       [](BakedBytes& b) { b.section<detail::Tree>(Section::trees)[finest].outer *= 1.01f; }},
      {"nodes", "needs",
       [](BakedBytes& b) { b.section<detail::Tree>(Section::trees)[finest].outer *= 0.99f; }},
      {"nodes", "is not below",
       [](BakedBytes& b) {
         float& name = lowest_block(b)[detail::block_names + 1];
         name = std::bit_cast<float>(std::bit_cast<std::uint32_t>(name) + 1);
       }},
      {"nodes", "sticks out of the one above",
       [](BakedBytes& b) { finest_discs(b)[2 * std::size_t{stride(b)}] *= 3; }},
      {"nodes", "belongs to none", [](BakedBytes& b) { finest_discs(b)[2 * std::size_t{stride(b)}] = 1; }},
      {"nodes", "cover", [](BakedBytes& b) { finest_discs(b)[4] += 0.01f; }},
      {"reach", "its discs say", [](BakedBytes& b) { b.section<float>(Section::reach)[1] *= 0.9f; }},
      {"reach", "the outline reaches", [](BakedBytes& b) { b.section<float>(Section::reach)[0] *= 1.001f; }},
      {"support", "number 11",
       [](BakedBytes& b) {
         b.section<float>(Section::support)[detail::first_row * detail::support_stride + 11] -= 0.001f;
       }},
      {"support", "number 63",
       [](BakedBytes& b) {
         b.section<float>(Section::support)[detail::first_row * detail::support_stride + 63] += 0.001f;
       }},
      {"inscribed", "disc 2",
       [](BakedBytes& b) { b.section<detail::DiscBlock>(Section::inscribed)[0].radius[2] += 0.01f; }},
      {"inscribed", "disc 1",
       [](BakedBytes& b) { b.section<detail::DiscBlock>(Section::inscribed)[1].x[1] += 0.5f; }},
      {"inscribed", "disc 0",
       [](BakedBytes& b) { b.section<detail::DiscBlock>(Section::inscribed)[1].y[0] -= 0.05f; }},
      {"extremes", "point 5",
       [](BakedBytes& b) { b.section<detail::Extremes>(Section::extremes)[0].x[5] += 0.01f; }},
      {"extremes", "point 20",  // one of the contour's, but on the other side
       [](BakedBytes& b) {
         detail::Extremes& extremes = b.section<detail::Extremes>(Section::extremes)[0];
         extremes.x[20] = extremes.x[28], extremes.y[20] = extremes.y[28];
       }},
      {"profiles", "centre",
       [](BakedBytes& b) { b.section<detail::Profile>(Section::profiles)[0].x += 0.01f; }},
      {"profiles", "inner of sector 3",
       [](BakedBytes& b) { b.section<detail::Profile>(Section::profiles)[0].sectors[3].inner += 0.01f; }},
      {"profiles", "outer of sector 4",
       [](BakedBytes& b) { b.section<detail::Profile>(Section::profiles)[0].sectors[4].outer -= 0.01f; }},
      {"profiles", "extent of sector 5",
       [](BakedBytes& b) { b.section<detail::Profile>(Section::profiles)[0].sectors[5].extent += 0.01f; }},
      {"profiles", "shallow_outer of sector 6",
       [](BakedBytes& b) {
         b.section<detail::Profile>(Section::profiles)[0].sectors[6].shallow_outer -= 0.01f;
       }},
      {"contours", "contour 0",  // still about the points that it has
       [](BakedBytes& b) {
         detail::Contour& contour = b.section<detail::Contour>(Section::contours)[0];
         const auto points = b.section<Vec2>(Section::points).subspan(0, contour.end);
         contour.disc.x += 0.05f;
         contour.disc.radius = 0;
         for (const Vec2 p : points)
           contour.disc.radius =
               std::max(contour.disc.radius, std::hypot(p.x - contour.disc.x, p.y - contour.disc.y));
       }},
      {"nodes", "cover", [](BakedBytes& b) { b.section<Vec2>(Section::points)[7].x *= 0.5f; }},
      {"leaf_segments", "no leaves that name segment",
       [](BakedBytes& b) {
         std::uint32_t& word = b.section<std::uint32_t>(Section::leaf_segments)[5];
         word = std::uint32_t{1} << detail::leaf_count_shift | (word + 3) % 8;
       }},
      {"segment_margin", "is below what rounding needs",
       [](BakedBytes& b) { b.section<float>(Section::segment_margin)[0] *= 0.2f; }},
  };
  return all;
}

BakedBytes honest() {
  return {ShapeSet(few_shapes(), {.depths = {0, 3, all_depths}, .outlines = true}), origins_of(3)};
}

TEST(Verify, NamesTheLie) {
  for (const Lie& lie : lies()) {
    BakedBytes bytes = honest();
    lie.tell(bytes);
    bytes.seal();
    ASSERT_EQ(bytes.error(), "") << lie.array << ", " << lie.says;
    const BakedShapes baked = bytes.load();
    bool found = false;
    std::string all;
    for (const Finding& finding : verify(baked.set)) {
      all += text_of(finding) + "\n";
      found |= finding.array == std::string(lie.array) && finding.what.find(lie.says) != std::string::npos;
    }
    EXPECT_TRUE(found) << lie.array << ", " << lie.says << ":\n" << all;
  }
}

TEST(Verify, SaysNoMoreThanItIsAskedFor) {
  BakedBytes bytes = honest();
  for (float& height :
       bytes.section<float>(Section::support).subspan(detail::first_row * detail::support_stride))
    height -= 0.1f;
  bytes.seal();
  const BakedShapes baked = bytes.load();
  EXPECT_EQ(verify(baked.set, 7).size(), 7u);
  EXPECT_GT(verify(baked.set, 1000).size(), 100u);
}

TEST(Verify, LooksAtRootsWithoutTrees) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
  BakedBytes bytes(ShapeSet(shapes, {.depths = {0, 2}}), origins_of(1));
  bytes.section<detail::Root>(Section::roots)[1].radius = 0.3f;
  bytes.seal();
  const auto findings = verify(bytes.load().set);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].array, std::string("roots"));
}

}  // namespace
}  // namespace bch::test
