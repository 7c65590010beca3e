// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/penetration.hpp>
#include <bch/time_of_impact.hpp>

#include "baselines/oracle.hpp"
#include "tests/support/scenes.hpp"

// Footprints with integer corners at integer positions and heading 0, as simulators have them. Many corners are exactly
// level with each other, edges lie on each other, and agents touch in single points. Every query is compared with the
// outlines themselves, whose predicates are exact for such numbers.

namespace bch {
namespace {

constexpr float threshold = 0.04f;
/// A point of a leaf disc is at most that far from the outline.
constexpr double leaf_size = 2 * 0.04;
constexpr int farthest = 9;  ///< metres along each axis from one agent of a pair to the other

/// Big ones, each of which has room for small ones.
std::vector<Outline> big_footprints() {
  return {
      test::polygon({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}),                                      // square
      test::polygon({{-4, -4}, {4, -4}, {4, 0}, {0, 0}, {0, 4}, {-4, 4}}),                      // L
      test::polygon({{-4, 0}, {-1, 0}, {-1, -4}, {1, -4}, {1, 0}, {4, 0}, {4, 4}, {-4, 4}}),    // T
      test::polygon({{-4, -4}, {4, -4}, {4, 4}, {2, 4}, {2, -2}, {-2, -2}, {-2, 4}, {-4, 4}}),  // U
      test::polygon({{4, 0}, {0, 4}, {-4, 0}, {0, -4}}),                                        // diamond
      test::polygon({{4, 0}, {1, 1}, {0, 4}, {-1, 1}, {-4, 0}, {-1, -1}, {0, -4}, {1, -1}}),    // star
      test::polygon(
          {{-4, -3}, {0, -3}, {4, -3}, {2, 0}, {4, 3}, {0, 3}, {-4, 3}, {-2, 0}}),  // corners beside it
      test::polygon({{-4, -2}, {-2, 0}, {0, -2}, {2, 0}, {4, -2}, {4, 4}, {0, 2}, {-4, 4}}),  // teeth
  };
}

std::vector<Outline> small_footprints() {
  Outline islands = test::polygon({{-3, -1}, {-2, -1}, {-2, 0}, {-3, 0}});
  test::append(islands, test::polygon({{2, 0}, {3, 0}, {3, 1}, {2, 1}}));
  return {
      test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}),    // a corner at the origin
      test::polygon({{-1, 0}, {0, -1}, {1, 0}, {0, 1}}),  // begins beside its position, level with it
      test::polygon({{-3, 0}, {3, 0}, {3, 1}, {-3, 1}}),  // bar
      test::polygon({{0, 0}, {2, 0}, {0, 1}}),            // triangle
      test::polygon({{0, 0}, {1, 0}, {0, 0}, {0, 1}}),    // whiskers
      islands,
  };
}

class Lattice : public testing::Test {
 protected:
  Lattice() {
    outlines = big_footprints();
    for (const Outline& each : small_footprints()) outlines.push_back(each);
    for (const Outline& each : outlines) shapes.push_back(test::contour_shape(each, threshold));
    for (const bool culling : {true, false})
      sets.emplace_back(shapes, ShapeSetPlan{{all_depths}, true, culling});
  }

  baselines::Oracle oracle(const Agents& agents, Pair pair) const {
    return {outlines[agents.shape[pair.first]], outlines[agents.shape[pair.second]],
            baselines::exact_placement(agents, pair.first, pair.second)};
  }

  /// Both agents at integers, the second one at every place about the first one. Pairs name them in either order.
  test::PairScene all_places(std::uint32_t a, std::uint32_t b) const {
    test::PairScene scene;
    for (int j = -farthest; j <= farthest; ++j)
      for (int i = -farthest; i <= farthest; ++i) {
        const auto first = static_cast<std::uint32_t>(scene.crowd.x.size());
        scene.crowd.add({a, 1000, -77, 0, 0});
        scene.crowd.add({b, 1000.0 + i, -77.0 + j, 0, 0});
        scene.pairs.push_back((i + j) % 2 == 0 ? Pair{first, first + 1} : Pair{first + 1, first});
      }
    return scene;
  }

  template <class Visit>
  void for_pairs_of_shapes(Visit visit) const {
    const auto count = static_cast<std::uint32_t>(shapes.size());
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = a; b < count; ++b) visit(all_places(a, b));
  }

  std::vector<Outline> outlines;
  std::vector<Shape> shapes;
  std::vector<ShapeSet> sets;  ///< with culling data and without
};

template <class Visit>
void for_implementations(Visit visit) {
  for (const auto& implementation : implementations())
    if (implementation.supported()) visit(implementation);
}

TEST_F(Lattice, CollisionsAreThoseOfTheOutlines) {
  std::size_t crossing = 0, nested = 0, apart = 0;
  for_pairs_of_shapes([&](const test::PairScene& scene) {
    std::vector<std::uint8_t> boundary, solid, found(scene.pairs.size());
    for (const Pair pair : scene.pairs) {
      const baselines::Oracle truth = oracle(scene.crowd.agents(), pair);
      const bool cross = truth.cross(), inside = !cross && truth.nested();
      boundary.push_back(cross), solid.push_back(cross || inside);
      crossing += cross, nested += inside, apart += !cross && !inside;
    }
    for_implementations([&](const Implementation& implementation) {
      for (const ShapeSet& set : sets) {
        collide(set, scene.crowd.agents(), scene.pairs, found, {Semantics::boundary, &implementation});
        EXPECT_EQ(found, boundary) << implementation.name;
        collide(set, scene.crowd.agents(), scene.pairs, found, {Semantics::solid, &implementation});
        EXPECT_EQ(found, solid) << implementation.name;
      }
    });
  });
  EXPECT_GT(crossing, 5'000u);
  EXPECT_GT(nested, 300u);
  EXPECT_GT(apart, 5'000u);
}

TEST_F(Lattice, ClearancesAreThoseOfTheOutlines) {
  for_pairs_of_shapes([&](const test::PairScene& scene) {
    std::vector<double> distance;
    for (const Pair pair : scene.pairs)
      distance.push_back(static_cast<double>(oracle(scene.crowd.agents(), pair).distance()));
    for_implementations([&](const Implementation& implementation) {
      std::vector<float> found(scene.pairs.size());
      clearance(sets[0], scene.crowd.agents(), scene.pairs, {found, {}}, {.implementation = &implementation});
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_LE(static_cast<double>(found[i]), distance[i]) << implementation.name;
        ASSERT_GE(static_cast<double>(found[i]), distance[i] - 2 * leaf_size - 1e-4) << implementation.name;
      }
    });
  });
}

TEST_F(Lattice, ContactsAreThereWhereOutlinesCross) {
  for_pairs_of_shapes([&](const test::PairScene& scene) {
    for_implementations([&](const Implementation& implementation) {
      ContactFinder finder;
      const Rows<DiscPair> table =
          finder.find(sets[0], scene.crowd.agents(), scene.pairs, {.implementation = &implementation});
      for (std::size_t i = 0; i < scene.pairs.size(); ++i)
        ASSERT_EQ(!table[i].empty(), oracle(scene.crowd.agents(), scene.pairs[i]).cross())
            << implementation.name;
    });
  });
}

/// The first agent of a pair comes towards the second one's place, goes a metre further, and turns neither.
TEST_F(Lattice, TimeOfImpactsAreThoseOfTheOutlines) {
  std::size_t meetings = 0;
  for_pairs_of_shapes([&](const test::PairScene& scene) {
    const Agents agents = scene.crowd.agents();
    std::vector<double> x, y, time;
    for (const auto [first, second] : scene.pairs) {
      x.push_back(agents.x[second] - agents.x[first] + 1);
      y.push_back(agents.y[second] - agents.y[first]);
      const baselines::Oracle truth = oracle(agents, {first, second});
      time.push_back(truth.cross() ? 0 : static_cast<double>(truth.time_of_impact(x.back(), y.back())));
      meetings += time.back() > 0 && time.back() <= 1;
    }
    for_implementations([&](const Implementation& implementation) {
      std::vector<float> found(scene.pairs.size());
      time_of_impact(sets[0], agents, scene.pairs, {x, y}, found, {.implementation = &implementation});
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_LE(static_cast<double>(found[i]), time[i]) << implementation.name;
        if (found[i] > 1) continue;
        // There the outlines are as near each other as two leaf discs that touch.
        test::Crowd then = scene.crowd;
        then.x[scene.pairs[i].first] += static_cast<double>(found[i]) * x[i];
        then.y[scene.pairs[i].first] += static_cast<double>(found[i]) * y[i];
        ASSERT_LE(static_cast<double>(oracle(then.agents(), scene.pairs[i]).distance()), 2 * leaf_size + 1e-4)
            << implementation.name;
      }
    });
  });
  EXPECT_GT(meetings, 5'000u);
}

/// How far an outline extends along an axis.
struct Box {
  double low[2], high[2];

  Box(const Outline& outline, double x, double y) {
    const auto [left, right] = std::minmax_element(outline.points.begin(), outline.points.end(),
                                                   [](Vec2 a, Vec2 b) { return a.x < b.x; });
    const auto [bottom, top] = std::minmax_element(outline.points.begin(), outline.points.end(),
                                                   [](Vec2 a, Vec2 b) { return a.y < b.y; });
    low[0] = x + static_cast<double>(left->x), high[0] = x + static_cast<double>(right->x);
    low[1] = y + static_cast<double>(bottom->y), high[1] = y + static_cast<double>(top->y);
  }
};

/// The least way along an axis until one box is beside the other.
double box_depth(const Box& a, const Box& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2; ++k) least = std::min({least, b.high[k] - a.low[k], a.high[k] - b.low[k]});
  return std::max(least, 0.0);
}

TEST_F(Lattice, PenetrationsAreThoseOfTheBoxes) {
  for_pairs_of_shapes([&](const test::PairScene& scene) {
    const Agents agents = scene.crowd.agents();
    const auto box = [&](std::uint32_t agent) {
      return Box(outlines[agents.shape[agent]], agents.x[agent], agents.y[agent]);
    };
    for_implementations([&](const Implementation& implementation) {
      std::vector<Penetration> found(scene.pairs.size());
      penetration(sets[0], agents, scene.pairs, 4, found, {.implementation = &implementation});
      test::PairScene after = scene;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const auto [first, second] = scene.pairs[i];
        const double depth = found[i].depth, least = box_depth(box(first), box(second));
        ASSERT_GE(depth, least) << implementation.name;
        ASSERT_LE(depth, least + 2 * leaf_size + 1e-4) << implementation.name;
        after.crowd.x[first] += depth * found[i].x;
        after.crowd.y[first] += depth * found[i].y;
      }
      std::vector<std::uint8_t> hits(scene.pairs.size());
      collide(sets[0], after.crowd.agents(), after.pairs, hits, {Semantics::solid, &implementation});
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 0) << implementation.name;
    });
  });
}

TEST_F(Lattice, NeighboursInACrowdAreThoseOfTheOutlines) {
  test::Random random(401);
  test::Crowd crowd;
  constexpr std::uint32_t size = 240;  // of which some are inside others, also with sanitizers
  for (std::uint32_t i = 0; i < size; ++i)
    crowd.add({random.below(static_cast<std::uint32_t>(shapes.size())), static_cast<double>(random.below(60)),
               static_cast<double>(random.below(60)) - 30, 0, 0});
  std::vector<std::vector<std::uint32_t>> boundary(size), solid(size);
  for (std::uint32_t i = 0; i < size; ++i)
    for (std::uint32_t j = 0; j < size; ++j) {
      if (i == j) continue;
      const baselines::Oracle truth = oracle(crowd.agents(), {i, j});
      if (truth.cross()) boundary[i].push_back(j);
      if (truth.cross() || truth.nested()) solid[i].push_back(j);
    }
  EXPECT_NE(boundary, solid);
  CrowdCollider collider;
  for_implementations([&](const Implementation& implementation) {
    for (const ShapeSet& set : sets)
      for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
        const auto rows = collider.collide_all(set, crowd.agents(), {semantics, &implementation});
        const auto& expected = semantics == Semantics::solid ? solid : boundary;
        for (std::uint32_t i = 0; i < size; ++i) {
          const auto row = rows[i];
          EXPECT_TRUE(std::equal(row.begin(), row.end(), expected[i].begin(), expected[i].end()))
              << implementation.name << ", agent " << i;
        }
      }
  });
}

}  // namespace
}  // namespace bch
