// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cinttypes>
#include <cstdio>

#include "baselines/exact_tests.hpp"
#include "baselines/oracle.hpp"
#include "baselines/placement.hpp"
#include "baselines/structure.hpp"
#include "tests/support/baseline_scene.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Every structure against every other, and a share of the answers against brute force. 1 of `brute_stride`
// placements goes to the brute force over triangles; outlines are small enough to check always.

namespace bch {
namespace {

// What is true of two bodies, without trees: every facet that reaches into the other body's bounding box
// against every such facet, by the exact tests.

using baselines::Body;
using baselines::Placement;
using baselines::Point2;
using baselines::Point3;

struct Box {
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Point3& p) {
    const double at[] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], at[i]);
      high[i] = std::max(high[i], at[i]);
    }
  }
  bool meets(const Box& other) const {
    for (int i = 0; i < 3; ++i)
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    return true;
  }
};

template <class Facet>
struct Boxed {
  Facet facet;
  Box box;
};

template <class Facet>
Box whole(const std::vector<Boxed<Facet>>& facets) {
  Box box;
  for (const auto& [facet, of] : facets) {
    box.add({of.low[0], of.low[1], of.low[2]});
    box.add({of.high[0], of.high[1], of.high[2]});
  }
  return box;
}

template <class Facet, class Meet>
bool any_meet(std::vector<Boxed<Facet>> a, std::vector<Boxed<Facet>> b, Meet meet) {
  const Box box_a = whole(a), box_b = whole(b);
  std::erase_if(a, [&](const Boxed<Facet>& f) { return !f.box.meets(box_b); });
  std::erase_if(b, [&](const Boxed<Facet>& f) { return !f.box.meets(box_a); });
  for (const auto& s : a)
    for (const auto& t : b)
      if (s.box.meets(t.box) && meet(s.facet, t.facet)) return true;
  return false;
}

/// Triangles in space, or dropped to the ground.
std::vector<Boxed<baselines::Triangle3>> triangles(const Body& body, const Placement* at, bool flat) {
  std::vector<Point3> placed;
  for (const Vec3& p : body.positions) {
    const Vec2 ground{p.x, p.y};
    const Point2 q = at != nullptr ? at->place(ground) : baselines::exact(ground);
    const double rise = at != nullptr ? at->z : 0;
    placed.push_back({q.x, q.y, flat ? 0.0 : rise + static_cast<double>(p.z)});
  }
  std::vector<Boxed<baselines::Triangle3>> result;
  for (const auto& [i, j, k] : body.triangles) {
    auto& [facet, box] = result.emplace_back();
    facet = {placed[i], placed[j], placed[k]};
    for (const Point3& p : facet) box.add(p);
  }
  return result;
}

std::vector<Boxed<baselines::Segment2>> segments(const Outline& outline, const Placement* at) {
  std::vector<Boxed<baselines::Segment2>> result;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 from = points[i], to = points[(i + 1) % points.size()];
      auto& [facet, box] = result.emplace_back();
      facet = at != nullptr ? baselines::Segment2{at->place(from), at->place(to)}
                            : baselines::Segment2{baselines::exact(from), baselines::exact(to)};
      box.add({facet.a.x, facet.a.y, 0});
      box.add({facet.b.x, facet.b.y, 0});
    }
  }
  return result;
}

bool meshes_meet(const Body& a, const Body& b, const Placement& at) {
  return any_meet(triangles(a, nullptr, false), triangles(b, &at, false),
                  [](const auto& s, const auto& t) { return baselines::triangles_meet(s, t); });
}

bool outlines_meet(const Outline& a, const Outline& b, const Placement& at) {
  return any_meet(segments(a, nullptr), segments(b, &at),
                  [](const auto& s, const auto& t) { return baselines::segments_meet(s, t); });
}

bool projections_meet(const Body& a, const Body& b, const Placement& at) {
  const auto flat = [](const baselines::Triangle3& t) {
    return baselines::Triangle2{Point2{t[0].x, t[0].y}, Point2{t[1].x, t[1].y}, Point2{t[2].x, t[2].y}};
  };
  return any_meet(triangles(a, nullptr, true), triangles(b, &at, true),
                  [&](const auto& s, const auto& t) { return baselines::triangles_meet(flat(s), flat(t)); });
}

using baselines::Kind;
using baselines::Structure;
using baselines::TestCounts;
using baselines::Truth;
using test::complaint;
using test::PairScene;

constexpr std::size_t brute_stride = 32;
/// How close to touching FCL and the exact tests may differ, metres: FCL projects onto normalised products of
/// edges in double, which are off by 1e-16 of lengths of a metre, divided by sines of sliver triangles.
constexpr double fcl_band = 1e-9;
/// How close to touching the placement in double and in long double may differ: 6e-10 of the extent.
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
      return outlines_meet(outline(at, a), outline(at, b), baselines::placement(at, pair));
    };
    for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
      const bool expected = crosses(agents, scene_.pairs[i]);
      for (const std::string_view name : {"obb_contour", "obb_contour_2d"})
        ASSERT_EQ(hits(name)[i] == 1, expected) << name << ", " << test::replay_line(scene_, i);
      if (i % brute_stride != 0) continue;
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
      if (i % brute_stride != 0) continue;
      const auto [a, b] = std::minmax(scene_.pairs[i].first, scene_.pairs[i].second);
      const Body &body_a = bodies_[agents.shape[a]], &body_b = bodies_[agents.shape[b]];
      const baselines::Placement at = baselines::placement_in_space(agents, scene_.pairs[i]);
      ASSERT_EQ(hits("obb_full")[i] == 1, meshes_meet(body_a, body_b, at)) << test::replay_line(scene_, i);
      ASSERT_EQ(hits("obb_projected")[i] == 1, projections_meet(body_a, body_b, at))
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
        const bool expected = full ? meshes_meet(bodies_[agents.shape[a]], bodies_[agents.shape[b]], at)
                                   : outlines_meet(outline(agents, a), outline(agents, b), at);
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
  Suite(test::default_characters(), 16).check_random(1996, 40'000);
}

TEST(DefaultCharacters, PlacementsAtHeights) {
  Suite(test::default_characters(), 16).check_at_heights(1998, 10'000);
}

TEST(DefaultCharacters, TouchingPlacements) {
  Suite(test::default_characters(), 16).check_touching(1997, 10'000);
}

TEST(RealCharacters, RandomAndTouchingPlacements) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  Suite suite(test::real_characters(*data), 10);
  suite.check_random(2012, 15'000);
  suite.check_touching(2014, 4'000);
}

// ---- What theory says of limited depth: exact hits stay hits at every depth.

class Depths : public testing::Test {
 protected:
  std::array<Character, 2> people{default_male(), default_female()};
  std::vector<Body> bodies = test::posed_bodies({people.begin(), people.end()}, 5);

  std::vector<std::uint8_t> hits(const Structure& structure, const PairScene& scene,
                                 std::uint32_t depth = all_depths) {
    std::vector<std::uint8_t> result(scene.pairs.size());
    structure.query(scene.crowd.agents(), scene.pairs, result, depth);
    return result;
  }
};

TEST_F(Depths, ExactHitsStayHitsAtEveryDepth) {
  const PairScene scene = test::placements(31, bodies, 20'000);
  std::printf("seed 31, %zu placements\n", scene.pairs.size());
  for (const baselines::Kind& kind : baselines::kinds()) {
    const auto structure = kind.build(bodies, {});
    const auto deepest = hits(*structure, scene);
    if (!kind.has_depth) {
      EXPECT_EQ(hits(*structure, scene, 2), deepest) << kind.name;
      continue;
    }
    EXPECT_EQ(hits(*structure, scene, 100), deepest) << kind.name;
    if (kind.name == "paper_descent") continue;  // what it hits depends on its way down
    // Boxes stick out of those above, so single answers may come back; numbers shrink.
    const bool only_shrinks = kind.name.starts_with("reference") || kind.name == "bch_projected";
    std::vector<std::uint8_t> before(deepest.size(), 1);
    for (const std::uint32_t depth : {0u, 1u, 2u, 3u, 4u, 6u, 8u, 12u}) {
      const auto at_depth = hits(*structure, scene, depth);
      for (std::size_t i = 0; i < deepest.size(); ++i)
        ASSERT_TRUE(at_depth[i] >= deepest[i] && (!only_shrinks || at_depth[i] <= before[i]))
            << kind.name << " to depth " << depth << ", " << test::replay_line(scene, i);
      EXPECT_LE(std::count(at_depth.begin(), at_depth.end(), 1),
                std::count(before.begin(), before.end(), 1) + (test::replaying() ? 1 : 20))
          << kind.name << " to depth " << depth;
      before = at_depth;
    }
  }
}

TEST_F(Depths, DiscsAloneCoverTheTrianglesTheyStandFor) {
  const PairScene scene = test::placements(34, bodies, 20'000);
  std::printf("seed 34, %zu placements\n", scene.pairs.size());
  const baselines::Kind& kind = baselines::kind("bch_projected");
  const auto exact = kind.build(bodies, {}), discs = kind.build(bodies, {.projected_triangles = false});
  EXPECT_LT(discs->bytes(0), exact->bytes(0));
  const auto with = hits(*exact, scene), without = hits(*discs, scene);
  for (std::size_t i = 0; i < with.size(); ++i) ASSERT_GE(without[i], with[i]) << test::replay_line(scene, i);
  if (!test::replaying()) {
    EXPECT_GT(std::count(without.begin(), without.end(), 1), std::count(with.begin(), with.end(), 1));
  }
}

// ---- The interface all structures share: names, counts, order, bad input; and solids that touch exactly.

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const Triangles block_triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

Body body_of(const std::vector<Vec3>& positions, const Triangles& triangles) {
  Body body{positions, triangles, {}};
  body.shape.outline = bch::outline(positions, triangles);
  body.shape.hierarchy = contour_hierarchy(body.shape.outline, 0.01f);
  return body;
}

/// A block from -half to half on the ground, and from `bottom` to `top`.
Body block(float half_x, float half_y, float bottom, float top) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        {(i & 1) != 0 ? half_x : -half_x, (i & 2) != 0 ? half_y : -half_y, (i & 4) != 0 ? top : bottom});
  return body_of(corners, block_triangles);
}

/// At the origin, so that the second one stands exactly where it is meant to.
test::Crowd two(std::uint32_t a, std::uint32_t b, double x, double y, double heading) {
  test::Crowd crowd;
  crowd.add({a, 0, 0, 0, 0});
  crowd.add({b, x, y, heading, 0});
  return crowd;
}

bool by_truth(Truth exact, bool mesh, bool outline, bool projection) {
  return exact == Truth::mesh ? mesh : exact == Truth::outline ? outline : projection;
}

TEST(Kinds, HaveTheirNames) {
  std::set<std::string_view> names;
  for (const Kind& kind : baselines::kinds()) names.insert(kind.name);
  for (const char* name : {"reference", "reference_segments", "paper_descent", "single", "fixed",
                           "bch_projected", "obb_full", "obb_contour", "obb_contour_2d", "obb_projected"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_TRUE(names.size() == 10 || names.size() == 15) << names.size();
  EXPECT_EQ(&baselines::kind("obb_full"), &baselines::kind("obb_full"));
  EXPECT_TRUE(complaint([] {
                baselines::kind("obb");
              }).starts_with("no structure 'obb' (known: reference, reference_segments,"));
}

TEST(Kinds, AnswerInAnyOrderOneByOneAndCounted) {
  const Character man = default_male();
  const std::vector<Body> bodies = test::posed_bodies({man}, 3);
  test::PairScene scene = test::placements(5, bodies, 500);
  const Agents agents = scene.crowd.agents();
  for (const test::Answers& one : test::build_all(bodies)) {
    SCOPED_TRACE(one.kind->name);
    EXPECT_EQ(one.structure->shape_count(), 3u);
    EXPECT_GT(one.structure->bytes(2), 0u);
    EXPECT_THROW(one.structure->bytes(3), std::out_of_range);
    std::vector<std::uint8_t> hits(scene.pairs.size(), 77);
    one.structure->query(agents, scene.pairs, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Pair pair = scene.pairs[i];
      TestCounts counts;
      EXPECT_EQ(one.structure->query(agents, pair, all_depths), hits[i] == 1);
      EXPECT_EQ(one.structure->query(agents, {pair.second, pair.first}, all_depths), hits[i] == 1);
      EXPECT_EQ(one.structure->query(agents, pair, all_depths, counts), hits[i] == 1);
      EXPECT_GE(counts.nodes, 1u);
      if (one.kind->exact != Truth::none && hits[i] == 1) {
        EXPECT_GE(counts.leaves, 1u);
      }
      EXPECT_TRUE(one.structure->query(agents, {pair.first, pair.first}, all_depths));
    }
  }
}

/// Blocks that share a face, an edge, a corner, or miss each other by the last bit of a coordinate: there is
/// one right answer, and the structures that claim to be exact give it. What FCL says of them is its own
/// affair.
TEST(Kinds, TouchingSolidsHaveOneAnswer) {
  const std::vector<Body> bodies = {block(0.5f, 0.25f, 0, 1), block(0.5f, 0.25f, 1, 2),
                                    block(0.5f, 0.25f, std::nextafter(1.0f, 2.0f), 2)};
  struct Case {
    std::uint32_t other;
    double x, y;
    bool mesh, outline, projection;
  };
  const double beyond = 0x1p-51;
  const Case cases[] = {
      {0, 1, 0, true, true, true},  // side by side
      {0, 1 + beyond, 0, false, false, false},
      {0, 1, 0.5, true, true, true},  // corner to corner
      {0, 1, 0.5 + beyond, false, false, false},
      {0, 0, 0.5, true, true, true},
      {1, 0, 0, true, true, true},  // on top of each other
      {1, 0.25, 0.125, true, true, true},
      {1, 1, 0.5, true, true, true},  // a corner on a corner
      {1, 1 + beyond, 0.5, false, false, false},
      {2, 0.25, 0.125, false, true, true},  // above, by one bit
      {2, 1, 0.5, false, true, true},
  };
  for (const test::Answers& one : test::build_all(bodies)) {
    if (one.kind->exact == Truth::none || one.kind->name.starts_with("fcl_")) continue;
    for (const Case& c : cases) {
      const test::Crowd crowd = two(0, c.other, c.x, c.y, 0);
      const bool expected = by_truth(one.kind->exact, c.mesh, c.outline, c.projection);
      EXPECT_EQ(one.structure->query(crowd.agents(), {0, 1}, all_depths), expected)
          << one.kind->name << ", " << c.x << ", " << c.y << ", other " << c.other;
    }
  }
}

TEST(Kinds, TheFixedCylinderHasItsRadius) {
  const std::vector<Body> bodies = {block(0.5f, 0.25f, 0, 1)};
  const auto narrow = baselines::kind("fixed").build(bodies, {.fixed_radius = 0.2f});
  const auto wide = baselines::kind("fixed").build(bodies, {});
  EXPECT_FALSE(narrow->query(two(0, 0, 0.45, 0, 1).agents(), {0, 1}, all_depths));
  EXPECT_TRUE(wide->query(two(0, 0, 0.45, 0, 1).agents(), {0, 1}, all_depths));
  EXPECT_FALSE(wide->query(two(0, 0, 0.55, 0, 1).agents(), {0, 1}, all_depths));
}

/// A triangle seen edge-on, one that is a segment, and one that is a point beside others.
TEST(Kinds, TakeDegenerateTriangles) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {0.4f, 0, 0}, {0.2f, 0, 0.5f}, {0, 0.3f, 0}};
  const std::vector<Triangles> meshes = {{{0, 1, 2}}, {{0, 1, 1}, {3, 3, 3}}, {{0, 1, 3}, {2, 2, 2}}};
  std::vector<Body> bodies;
  for (const Triangles& triangles : meshes) bodies.push_back(body_of(positions, triangles));
  test::Random random(12);
  const auto all = test::build_all(bodies);
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t a = random.below(3), b = random.below(3);
    const test::Crowd crowd = two(a, b, 0.1 * random.below(5), 0.1 * random.below(5), 0.5 * random.below(8));
    const baselines::Placement at = baselines::placement(crowd.agents(), {0, 1});
    for (const test::Answers& one : all) {
      if (one.kind->exact == Truth::none || one.kind->name.starts_with("fcl_")) continue;
      const bool expected = by_truth(one.kind->exact, meshes_meet(bodies[a], bodies[b], at),
                                     outlines_meet(bodies[a].shape.outline, bodies[b].shape.outline, at),
                                     projections_meet(bodies[a], bodies[b], at));
      ASSERT_EQ(one.structure->query(crowd.agents(), {0, 1}, all_depths), expected)
          << one.kind->name << ", case " << i << ": " << a << " and " << b;
    }
  }
}

TEST(BadInput, BodiesAreNamedWithWhatIsWrong) {
  const Triangles wild = {{0, 1, 8}};
  for (const Kind& kind : baselines::kinds()) {
    SCOPED_TRACE(kind.name);
    const bool uses_triangles = kind.exact == Truth::mesh || kind.exact == Truth::projection;
    const auto build = [&](auto damage) {
      std::vector<Body> bodies(2, block(0.5f, 0.25f, 0, 1));
      damage(bodies[1]);
      return complaint([&] { kind.build(bodies, {}); });
    };
    EXPECT_EQ(build([](Body&) {}), "accepted");
    const std::string hierarchy = build([](Body& body) { body.shape.hierarchy.nodes.clear(); });
    const bool uses_hierarchy =
        kind.name.starts_with("reference") || kind.name == "paper_descent" || kind.name == "single";
    EXPECT_EQ(hierarchy, uses_hierarchy ? "body 1: a hierarchy without nodes" : "accepted");
    const std::string outline = build([](Body& body) { body.shape.outline = {}; });
    EXPECT_EQ(outline, kind.exact == Truth::outline ? "body 1: outline: contour offsets do not fit 0 points"
                                                    : "accepted");
    for (const std::string& message :
         {build([](Body& body) { body.triangles = {}; }), build([&](Body& body) { body.triangles = wild; }),
          build([](Body& body) { body.positions[3].x = NAN; }),
          build([](Body& body) { body.positions[3].x = 2e6f; })})
      EXPECT_TRUE(uses_triangles ? message.starts_with("body 1: ") : message == "accepted") << message;
  }
  for (const float radius : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), 2e6f})
    EXPECT_NE(complaint([&] { baselines::kind("fixed").build({}, {.fixed_radius = radius}); }), "accepted");
}

}  // namespace
}  // namespace bch
