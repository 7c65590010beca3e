// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <iostream>
#include <optional>

#include "layout/character/skinning.hpp"
#include "tests/support/baseline_scene.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/outline_soups.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Never a miss: wherever meshes have a point in common, bodies in slabs collide, at every level. What meshes do is decided by
// exact tests of their triangles.

namespace bch {
namespace {

using baselines::Body;
using test::PairScene;
using test::Random;

const ShapeSetPlan whole_plan{.depths = {0, 3, all_depths}};

ShapeSetPlan cut_at(std::vector<float> planes) {
  return {.depths = {0, 3, all_depths}, .slices = std::move(planes)};
}

const ShapeSetPlan three = cut_at({0.4f, 1.0f}),
                   eight = cut_at({0.35f, 0.7f, 0.85f, 0.95f, 1.05f, 1.2f, 1.45f});

/// Long edges of soups are not divided into centimetres.
Shape slab_of(const Outline& outline) {
  if (outline.contours() == 0) return {};
  return {outline, contour_hierarchy(outline, std::max(0.01f, 0x1p12f * outline.grid_step))};
}

/// The slabs of a body; none where all triangles are points.
std::optional<Shape> cut_shape(OutlineBuilder& builder, std::span<const Vec3> positions,
                               std::span<const float> planes) {
  std::vector<Outline> outlines(planes.size() + 1);
  Shape shape;
  try {
    shape.heights = builder.build(positions, planes, outlines);
  } catch (const std::invalid_argument&) {
    return {};
  }
  for (const Outline& outline : outlines) shape.slabs.push_back(slab_of(outline));
  return shape;
}

/// Returns the body with all heights raised, or none where floats do not hold one of them.
std::optional<Body> raised(const Body& body, double by) {
  Body result = body;
  for (Vec3& p : result.positions) {
    const double z = static_cast<double>(p.z) + by;
    p.z = static_cast<float>(z);
    if (static_cast<double>(p.z) != z) return {};
  }
  return result;
}

/// Requires a hit at every level, of discs and of segments, wherever meshes meet.
/// Returns: the hits at the deepest level, with segments.
std::vector<std::uint8_t> expect_no_miss(const ShapeSet& set, PairScene scene,
                                         const std::vector<std::uint8_t>& meet, const std::string& what) {
  std::vector<std::uint8_t> hits(scene.pairs.size());
  for (const Leaves leaves : {Leaves::discs, Leaves::segments})
    for (std::uint8_t level = 0; level < set.level_count(); ++level) {
      std::fill(scene.crowd.level.begin(), scene.crowd.level.end(), level);
      collide(set, scene.crowd.agents(), scene.pairs, hits, {.leaves = leaves});
      for (std::size_t i = 0; i < hits.size(); ++i)
        if (meet[i] > hits[i]) {
          ADD_FAILURE() << what << ": a miss at level " << int{level} << ", "
                        << (leaves == Leaves::discs ? "discs" : "segments") << ", pair " << i << ", heights "
                        << (scene.crowd.z.empty() ? 0 : scene.crowd.z[2 * i + 1] - scene.crowd.z[2 * i])
                        << " m apart; " << test::replay_line(scene, i);
          return hits;
        }
    }
  return hits;
}

/// Agents' heights above each other. Positions are multiples of 2^-20 m in height, so that floats hold the sums.
constexpr double rises[] = {0, 0x1p-10, 205 * 0x1p-10, -358 * 0x1p-10, 0.5, -717 * 0x1p-10, 1, -1.375};
constexpr auto rise_count = static_cast<std::uint32_t>(std::size(rises));

/// Characters in poses, whole and in slabs, and their meshes at every rise.
class People {
 public:
  People(const std::vector<Character>& characters, std::uint32_t poses) {
    std::vector<Shape> shapes, in_three, in_eight;
    std::vector<Body> at_rises;
    for (const Character& character : characters) {
      detail::Skinner skinner(character);
      OutlineBuilder builder(character.triangles, character.vertices.size(), character.vertices);
      for (const PoseTime& time : sample_poses(character, poses)) {
        const auto pose = skinner.pose(time);
        Body body{{pose.begin(), pose.end()}, character.triangles, {}};
        for (Vec3& p : body.positions) p.z = std::nearbyint(p.z * 0x1p20f) * 0x1p-20f;
        builder.build(body.positions, body.shape.outline);
        body.shape.hierarchy = contour_hierarchy(body.shape.outline, 0.01f);
        shapes.push_back(body.shape);
        in_three.push_back(cut_shape(builder, body.positions, three.slices).value());
        in_eight.push_back(cut_shape(builder, body.positions, eight.slices).value());
        for (const double rise : rises) at_rises.push_back(raised(body, rise).value());
        bodies.push_back(std::move(body));
      }
    }
    meshes = baselines::kind("obb_full").build(at_rises, {});
    whole = ShapeSet(shapes, whole_plan);
    of_three = ShapeSet(in_three, three);
    of_eight = ShapeSet(in_eight, eight);
  }

  std::vector<Body> bodies;
  std::unique_ptr<baselines::Structure> meshes;  ///< of body * rise_count + rise
  ShapeSet whole{std::vector<Shape>{}}, of_three{std::vector<Shape>{}}, of_eight{std::vector<Shape>{}};
};

/// A scene twice: for meshes, and for slabs.
struct Placements {
  PairScene of_meshes, of_slabs;

  void take_positions() { of_slabs.crowd.x = of_meshes.crowd.x, of_slabs.crowd.y = of_meshes.crowd.y; }
};

class NoMiss : public testing::Test {
 protected:
  Random random{20264};
  std::size_t asked = 0, met = 0;

  /// Random placements, on one ground or not.
  Placements place(const People& people, std::uint32_t pairs, bool on_one_ground) {
    PairScene scene = test::placements(random.next(), people.bodies, pairs);
    Placements both{scene, scene};
    for (std::size_t i = 0; i < scene.crowd.shape.size(); ++i) {
      const bool is_second = i % 2 == 1;
      const std::uint32_t rise = is_second && !on_one_ground ? random.below(rise_count) : 0;
      both.of_meshes.crowd.shape[i] = scene.crowd.shape[i] * rise_count + rise;
      if (on_one_ground) continue;
      auto& z = both.of_slabs.crowd.z;
      z.push_back(is_second ? z.back() + rises[rise] : 0x1p-4 * random.below(1000));
    }
    return both;
  }

  std::vector<std::uint8_t> meetings(const People& people, const Placements& placements) {
    std::vector<std::uint8_t> meet(placements.of_meshes.pairs.size());
    people.meshes->query(placements.of_meshes.crowd.agents(), placements.of_meshes.pairs, meet);
    asked += meet.size(), met += static_cast<std::size_t>(std::count(meet.begin(), meet.end(), 1));
    return meet;
  }

  void expect_none(const People& people, const Placements& placements, const std::string& what) {
    const std::vector<std::uint8_t> meet = meetings(people, placements);
    expect_no_miss(people.of_three, placements.of_slabs, meet, what + ", three slabs");
    expect_no_miss(people.of_eight, placements.of_slabs, meet, what + ", eight slabs");
  }

  /// Placements at which meshes begin to meet; then the same on a grid, where they are, and far away.
  void expect_none_near_tangent(const People& people, std::uint32_t pairs, bool on_one_ground) {
    Placements placements = place(people, pairs, on_one_ground);
    slide_to_contact(random.next(), placements.of_meshes, {people.meshes.get()});
    placements.take_positions();
    expect_none(people, placements, "near tangent");
    for (auto* at : {&placements.of_meshes.crowd.x, &placements.of_meshes.crowd.y})
      for (double& each : *at) each = std::nearbyint(each * 0x1p26) * 0x1p-26;
    placements.take_positions();
    const std::vector<std::uint8_t> meet = meetings(people, placements);
    for (const ShapeSet* set : {&people.of_three, &people.of_eight}) {
      const auto here = expect_no_miss(*set, placements.of_slabs, meet, "near tangent on a grid");
      PairScene far = placements.of_slabs;
      test::move_away(far, 1e7, -1e7);
      EXPECT_EQ(expect_no_miss(*set, far, meet, "far away"), here);
    }
  }

  /// How many pairs that do not meet are told to collide.
  void count_false_hits(const People& people, const std::string& name) {
    const Placements placements = place(people, 100'000, true);
    const std::vector<std::uint8_t> meet = meetings(people, placements);
    const auto false_hits = [&](const ShapeSet& set, const std::string& what) {
      const auto hits = expect_no_miss(set, placements.of_slabs, meet, what);
      std::size_t count = 0;
      for (std::size_t i = 0; i < hits.size(); ++i) count += hits[i] > meet[i];
      RecordProperty("false_hits_" + name + "_" + what, std::to_string(count));
      return count;
    };
    const std::size_t of_whole = false_hits(people.whole, "whole"),
                      of_three = false_hits(people.of_three, "three_slabs"),
                      of_eight = false_hits(people.of_eight, "eight_slabs");
    std::cout << name << ": of " << meet.size() << " placements " << std::count(meet.begin(), meet.end(), 1)
              << " meet; false hits: " << of_whole << " of whole bodies, " << of_three << " of three slabs, "
              << of_eight << " of eight\n";
    EXPECT_LT(of_three, of_whole * 9 / 10);
    EXPECT_LT(of_eight, of_three * 9 / 10);
  }

  void expect_none_of(const People& people, const std::string& name) {
    count_false_hits(people, name);
    expect_none(people, place(people, 60'000, false), "at heights");
    expect_none_near_tangent(people, 10'000, true);
    expect_none_near_tangent(people, 10'000, false);
    EXPECT_GE(asked, test::samples(200'000));
    EXPECT_GT(met, asked / 5);
    RecordProperty("meet_" + name, std::to_string(met));
  }
};

TEST_F(NoMiss, OfDefaultCharacters) {
  expect_none_of(People(test::default_characters(), 10), "default");
}

TEST_F(NoMiss, OfRealCharacters) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_none_of(People(test::real_characters(*data), 7), "real");
}

/// Few heights, which are those of planes or next to them: triangles lie in planes, touch them and end there. A third are slivers.
test::Soup flat_soup(Random& random, std::span<const float> heights) {
  test::Soup soup = test::random_soup(random);
  const float thin = random.below(3) == 0 ? 0x1p-8f : 1;
  for (Vec3& p : soup.positions) {
    p.z = heights[random.below(static_cast<std::uint32_t>(heights.size()))];
    if (random.below(6) == 0) p.z = std::nextafter(p.z, random.below(2) == 0 ? -9.0f : 9.0f);
    p.y *= thin;
  }
  return soup;
}

/// Outlines leave out triangles that are points on their grid, if nothing joins them; a body of a distant triangle has a coarse one.
bool has_points(const test::Soup& soup, const Shape& shape) {
  const auto slab = std::find_if(shape.slabs.begin(), shape.slabs.end(),
                                 [](const Shape& each) { return each.outline.contours() > 0; });
  const float step = slab->outline.grid_step;
  const auto is_point = [&](const std::array<std::uint32_t, 3>& corners) {
    const auto on_grid = [&](std::uint32_t v) {
      return std::pair(std::nearbyint(soup.positions[v].x / step),
                       std::nearbyint(soup.positions[v].y / step));
    };
    return on_grid(corners[0]) == on_grid(corners[1]) && on_grid(corners[0]) == on_grid(corners[2]);
  };
  return std::any_of(soup.triangles.begin(), soup.triangles.end(), is_point);
}

TEST_F(NoMiss, OfSoups) {
  const std::vector<float> heights = {0.0f, 0.375f, 0.8125f, 1.125f, 1.5625f, 2.6875f};
  const std::uint32_t rounds = test::samples(200);
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const std::uint32_t begin = random.below(4), count = 1 + random.below(5 - begin);
    const ShapeSetPlan plan = cut_at({heights.begin() + begin, heights.begin() + begin + count});
    std::vector<Body> bodies;
    std::vector<Shape> shapes;
    while (bodies.size() < 200) {
      const test::Soup soup = flat_soup(random, heights);
      OutlineBuilder builder(soup.triangles, soup.positions.size(), soup.positions);
      std::optional<Shape> shape = cut_shape(builder, soup.positions, plan.slices);
      if (!shape || has_points(soup, *shape)) continue;
      bodies.push_back({soup.positions, soup.triangles, {}});
      shapes.push_back(std::move(*shape));
    }
    PairScene scene;
    std::vector<std::uint8_t> meet;
    for (std::uint32_t i = 0; i < test::samples(5'000);) {
      const std::uint32_t a = random.below(200), b = random.below(200);
      const double rise = random.below(2) == 0   ? 0
                          : random.below(2) == 0 ? 0x1p-10 * (static_cast<int>(random.below(3000)) - 1500)
                                                 : static_cast<double>(heights[random.below(6)]) -
                                                       static_cast<double>(heights[random.below(6)]);
      const std::optional<Body> body_b = raised(bodies[b], rise);
      if (!body_b) continue;
      const auto step = [&] { return 0x1p-10 * (static_cast<int>(random.below(5)) - 2); };
      const auto turn = [&] { return random.below(3) == 0 ? random.uniform(-4, 4) : 0; };
      scene.crowd.add({a, 5, -3, turn(), 0});
      scene.crowd.add({b, 5 + step(), -3 + step(), turn(), 0});
      scene.crowd.z.insert(scene.crowd.z.end(), {2, 2 + rise});
      scene.pairs.push_back({2 * i, 2 * i + 1});
      meet.push_back(test::meshes_meet(bodies[a], *body_b,
                                       baselines::placement(scene.crowd.agents(), scene.pairs.back())));
      met += meet.back();
      ++i;
    }
    asked += meet.size();
    const ShapeSet set(shapes, plan);
    const std::string what = "soups, round " + std::to_string(round);
    const auto here = expect_no_miss(set, scene, meet, what);
    test::move_away(scene, 1e7, -8e8);
    EXPECT_EQ(expect_no_miss(set, scene, meet, what + ", far away"), here);
    if (HasFailure()) return;
  }
  EXPECT_GT(met, asked / 10);
  EXPECT_LT(met, asked * 4 / 5);
  RecordProperty("meet", std::to_string(met));
}

}  // namespace
}  // namespace bch
