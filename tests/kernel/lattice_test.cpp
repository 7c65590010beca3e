// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/query_answers.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

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

/// How far an outline extends along both axes.
struct Box {
  double low[2], high[2];

  Box(const Outline& outline, double x, double y) {
    const auto [left, right] = std::ranges::minmax_element(outline.points, {}, &Vec2::x);
    const auto [bottom, top] = std::ranges::minmax_element(outline.points, {}, &Vec2::y);
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

class Lattice : public testing::Test {
 protected:
  Lattice() {
    std::vector<Outline> outlines = big_footprints();
    for (const Outline& each : small_footprints()) outlines.push_back(each);
    for (const Outline& each : outlines) shapes.push_back(test::contour_shape(each, threshold));
    for (const bool culling : {true, false})
      sets.emplace_back(shapes, ShapeSetPlan{{all_depths}, true, culling});
  }

  /// Both agents at integers, the second one at every place about the first one; pairs name them in either order. The first one of a pair
  /// comes towards the second one's place, goes a metre further, and turns neither.
  test::Questions all_places(std::uint32_t a, std::uint32_t b) const {
    test::Questions scene;
    scene.lines = 4;
    for (int j = -farthest; j <= farthest; ++j)
      for (int i = -farthest; i <= farthest; ++i) {
        const auto first = static_cast<std::uint32_t>(scene.crowd.x.size());
        scene.crowd.add({a, 1000, -77, 0, 0});
        scene.crowd.add({b, 1000.0 + i, -77.0 + j, 0, 0});
        const bool in_order = (i + j) % 2 == 0;
        scene.pairs.push_back(in_order ? Pair{first, first + 1} : Pair{first + 1, first});
        scene.way_x.push_back((in_order ? i : -i) + 1);
        scene.way_y.push_back(in_order ? j : -j);
        scene.directions.push_back({1, 0});
        scene.distances.push_back(0);
      }
    return scene;
  }

  /// Returns the outlines after the first agent's move.
  baselines::Oracle moved(test::Crowd crowd, Pair pair, double x, double y) const {
    crowd.x[pair.first] += x, crowd.y[pair.first] += y;
    return test::oracle(shapes, crowd.agents(), pair);
  }

  double least_way(const test::Crowd& crowd, Pair pair) const {
    const auto box = [&](std::uint32_t agent) {
      return Box(shapes[crowd.shape[agent]].outline, crowd.x[agent], crowd.y[agent]);
    };
    return box_depth(box(pair.first), box(pair.second));
  }

  std::vector<Shape> shapes;
  std::vector<ShapeSet> sets;  ///< with culling data and without
};

TEST_F(Lattice, AnswersAreThoseOfTheOutlines) {
  std::size_t crossing = 0, nested = 0, apart = 0, meetings = 0;
  constexpr double slack = 2 * leaf_size + 1e-4;
  for (std::uint32_t a = 0; a < shapes.size(); ++a)
    for (std::uint32_t b = a; b < shapes.size(); ++b) {
      const test::Questions scene = all_places(a, b);
      test::Questions after = scene;
      const std::vector<test::PairAnswers> all = run_query(sets[0], scene);
      const std::string what = std::to_string(a) + " and " + std::to_string(b);
      expect_answers(sets[0], scene, all, what);
      expect_same(run_query(sets[1], scene), all, what + ", without culling");
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Pair pair = scene.pairs[i];
        const double x = scene.way_x[i], y = scene.way_y[i];
        const baselines::Oracle truth = test::oracle(shapes, scene.crowd.agents(), pair);
        const bool cross = truth.cross(), inside = !cross && truth.nested();
        crossing += cross, nested += inside, apart += !cross && !inside;
        ASSERT_EQ(all[i].hit, cross || inside);
        ASSERT_EQ(!all[i].contacts.empty(), cross);

        const auto distance = inside ? 0 : static_cast<double>(truth.distance());
        ASSERT_LE(static_cast<double>(all[i].nearest.distance), distance);
        ASSERT_GE(static_cast<double>(all[i].nearest.distance), distance - slack);

        const double found = all[i].time,
                     time = cross || inside ? 0 : static_cast<double>(truth.time_of_impact(x, y));
        meetings += time > 0 && time <= 1;
        ASSERT_LE(found, time);
        if (found <= 1 &&
            !inside) {  // there the outlines are as near each other as two leaf discs that touch
          ASSERT_LE(static_cast<double>(moved(scene.crowd, pair, found * x, found * y).distance()), slack);
        }

        const auto& [depth, way_x, way_y] = all[i].best;
        const double least = least_way(scene.crowd, pair);
        ASSERT_GE(static_cast<double>(depth), least);
        ASSERT_LE(static_cast<double>(depth), least + slack);
        after.crowd.x[pair.first] += static_cast<double>(depth) * way_x;
        after.crowd.y[pair.first] += static_cast<double>(depth) * way_y;
      }
      for (const test::PairAnswers& each : run_query(sets[0], after)) ASSERT_EQ(each.hit, 0);
    }
  EXPECT_GT(crossing, 5'000u);
  EXPECT_GT(nested, 300u);
  EXPECT_GT(apart, 5'000u);
  EXPECT_GT(meetings, 5'000u);
}

}  // namespace
}  // namespace bch
