// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/verify.hpp"
#include "layout/format/shape_validation.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/damaged_arrays.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// What verify() says of sets that were made honestly, and of such with one number changed.

namespace bch::test {
namespace {

using detail::Finding;
using detail::verify;
using detail::baked::Section;

const ShapeSetPlan plans[] = {{},
                              {{0}, false, false},
                              {{0, 3, 6, all_depths}, true, true},
                              {{2, 5}, true},
                              {{0, 6}, false, false},
                              {{4}, false, true, true},
                              {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, all_depths}, true}};

void expect_nothing(const ShapeSet& set) {
  for (const Finding& finding : verify(set, 5)) ADD_FAILURE() << text_of(finding);
}

TEST(Verify, FindsNothingInSyntheticShapes) {
  const std::vector<Shape> shapes = synthetic_shapes(91, samples(400));
  for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
}

TEST(Verify, FindsNothingInCharacters) {
  for (const Character& character : people()) {
    const std::vector<Shape> shapes = pose_shapes(character, 60);
    for (const ShapeSetPlan& plan : plans) expect_nothing(ShapeSet(shapes, plan));
  }
}

TEST(Verify, FindsNothingInShapesWithoutOutlines) {
  std::vector<Shape> shapes = synthetic_shapes(92, 40);
  for (Shape& shape : shapes) shape.outline = {};
  shapes.push_back({{}, detail::fixed_cylinder(0.25f)});
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

struct Lie {
  const char* array;
  const char* says;
  std::function<void(DamagedArrays&)> tell;
};

using Arrays = DamagedArrays;

constexpr std::size_t first_support = detail::first_row * detail::support_stride;

const std::vector<Lie>& lies() {
  static const std::vector<Lie> all = {
      {"depths", "discs at depth 1", [](Arrays& a) { a.own.depths[1] = 1; }},
      {"nodes", "needs", [](Arrays& a) { a.lowest_block()[detail::block_outer] *= 0.9f; }},
      {"nodes", "needs", [](Arrays& a) { a.tree().outer *= 1.01f; }},
      {"nodes", "needs", [](Arrays& a) { a.tree().outer *= 0.99f; }},
      {"nodes", "is not below", [](Arrays& a) { add(a.name(a.lowest_block(), 1), 1); }},
      {"nodes", "sticks out of the one above", [](Arrays& a) { a.radii()[0] *= 3; }},
      {"nodes", "belongs to none", [](Arrays& a) { a.radii()[0] = 1; }},
      {"nodes", "cover", [](Arrays& a) { a.discs()[4] += 0.01f; }},
      {"nodes", "cover", [](Arrays& a) { a.own.points[7].x *= 0.5f; }},
      {"reach", "its discs say", [](Arrays& a) { a.own.reach[1] *= 0.9f; }},
      {"reach", "the outline reaches", [](Arrays& a) { a.own.reach[0] *= 1.001f; }},
      {"support", "number 11", [](Arrays& a) { a.own.support[first_support + 11] -= 0.001f; }},
      {"support", "number 63", [](Arrays& a) { a.own.support[first_support + 63] += 0.001f; }},
      {"inscribed", "disc 2", [](Arrays& a) { a.own.inscribed[0].radius[2] += 0.01f; }},
      {"inscribed", "disc 1", [](Arrays& a) { a.own.inscribed[1].x[1] += 0.5f; }},
      {"inscribed", "disc 0", [](Arrays& a) { a.own.inscribed[1].y[0] -= 0.05f; }},
      {"profiles", "centre", [](Arrays& a) { a.own.profiles[0].x += 0.01f; }},
      {"profiles", "inner of sector 3", [](Arrays& a) { a.own.profiles[0].sectors[3].inner += 0.01f; }},
      {"profiles", "outer of sector 4", [](Arrays& a) { a.own.profiles[0].sectors[4].outer -= 0.01f; }},
      {"profiles", "extent of sector 5", [](Arrays& a) { a.own.profiles[0].sectors[5].extent += 0.01f; }},
      {"profiles", "shallow_outer of sector 6",
       [](Arrays& a) { a.own.profiles[0].sectors[6].shallow_outer -= 0.01f; }},
      {"contours", "contour 0",  // still about the points that it has
       [](Arrays& a) {
         detail::Contour& contour = a.own.contours[0];
         Disc& disc = contour.disc;
         disc.x += 0.05f, disc.radius = 0;
         for (std::uint32_t i = 0; i < contour.end; ++i)
           disc.radius =
               std::max(disc.radius, std::hypot(a.own.points[i].x - disc.x, a.own.points[i].y - disc.y));
       }},
      {"leaf_segments", "no leaves that name segment",
       [](Arrays& a) {
         std::uint32_t& word = a.own.leaf_segments[5];
         word = std::uint32_t{1} << detail::leaf_count_shift | (word + 3) % 8;
       }},
      {"segment_margin", "is below what rounding needs", [](Arrays& a) { a.own.segment_margin[0] *= 0.2f; }},
  };
  return all;
}

TEST(Verify, NamesTheLie) {
  for (const Lie& lie : lies()) {
    Arrays arrays;
    lie.tell(arrays);
    ASSERT_NO_THROW(validate(arrays.view())) << lie.array << ", " << lie.says;
    bool found = false;
    std::string all;
    for (const Finding& finding : verify(ShapeSet(arrays.view(), nullptr))) {
      all += text_of(finding) + "\n";
      found |= finding.array == std::string(lie.array) && finding.what.find(lie.says) != std::string::npos;
    }
    EXPECT_TRUE(found) << lie.array << ", " << lie.says << ":\n" << all;
  }
}

TEST(Verify, SaysNoMoreThanItIsAskedFor) {
  Arrays arrays;
  for (std::size_t i = first_support; i < arrays.own.support.size(); ++i) arrays.own.support[i] -= 0.1f;
  const ShapeSet set(arrays.view(), nullptr);
  EXPECT_EQ(verify(set, 7).size(), 7u);
  EXPECT_GT(verify(set, 1000).size(), 100u);
}

TEST(Verify, LooksAtRootsWithoutTrees) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}};
  BakedBytes bytes(ShapeSet(shapes, {.depths = {0, 2}}), origins_of(1));
  bytes.section<detail::Root>(Section::roots)[1].radius = 0.3f;
  bytes.seal();
  const auto findings = verify(bytes.load().set);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].array, std::string("roots"));
}

}  // namespace
}  // namespace bch::test
