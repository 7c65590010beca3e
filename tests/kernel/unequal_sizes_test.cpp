// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/time_of_impact.hpp>

#include "baselines/contact_reference.hpp"
#include "baselines/penetration_reference.hpp"
#include "baselines/reference.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/penetrations.hpp"
#include "tests/support/scenes.hpp"

// Pairs of very unequal shapes at the edge of contact, against all pairs of discs. Margins that grow with the size of one
// shape alone do not hold for the other's rounding: these tests see it.

namespace bch {
namespace {

using baselines::CutLists;
using baselines::Method;
using test::PairScene;
using test::Random;

const ShapeSetPlan plan{{2, all_depths}, true};

/// From the smallest documented reach to what makes nine orders of magnitude.
constexpr double sizes[] = {2e-6, 1e-4, 1e-2, 0.3, 1, 30, 1000};

Outline scaled(std::vector<Vec2> points, double size) {
  for (Vec2& p : points)
    p = {static_cast<float>(size * static_cast<double>(p.x)),
         static_cast<float>(size * static_cast<double>(p.y))};
  Outline outline = test::polygon(std::move(points));
  outline.grid_step = 0;  // nothing but the bounds of layout/base/rounding.hpp enlarges the discs
  return outline;
}

/// Of one size: a stroke along x of many leaves, all of whose pruning discs end where leaves do; the same as one disc, far
/// from its origin; a star of many leaves; and one of a few, far from its origin.
void add_shapes(Random& random, double size, std::vector<Shape>& shapes) {
  const auto threshold = [size](double share) { return static_cast<float>(size * share); };
  const auto add = [&](const Outline& outline, double share) {
    shapes.push_back({outline, contour_hierarchy(outline, threshold(share))});
  };
  add(scaled({{-1, 0}, {1, 0}}, size), 0.03);
  add(scaled({{0.75f, 0.75f}, {0.75f, 1.25f}}, size), 1);
  add(scaled(test::star(random, 9, 0.5, 1).points, size), 0.1);
  add(scaled(test::star(random, 5, 0.2, 0.3, 0.9, 0.1).points, size), 0.2);
}

class UnequalSizes : public testing::Test {
 protected:
  UnequalSizes() {
    for (const double size : sizes) add_shapes(random, size, shapes);
    for (const bool culling : {true, false})
      sets.emplace_back(shapes, ShapeSetPlan{plan.depths, plan.outlines, culling});
    discs = std::make_unique<baselines::Reference>(shapes, plan);
    cuts = std::make_unique<CutLists>(shapes, plan);
  }

  double reach(std::uint32_t shape) const { return shapes[shape].hierarchy.reach; }

  /// Agents of random shapes near the origin. Half of all turn the second one's way along their own x axis, which is that
  /// of the strokes.
  PairScene scene(std::uint32_t pairs) {
    PairScene result;
    for (std::uint32_t i = 0; i < pairs; ++i) {
      for (int k = 0; k < 2; ++k) {
        const std::uint32_t shape = random.below(static_cast<std::uint32_t>(shapes.size()));
        const double heading = random.uniform(-3, 3);
        result.crowd.add({shape, 0, 0, heading, static_cast<std::uint8_t>(random.below(2))});
      }
      result.pairs.push_back(random.below(2) == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
    }
    return result;
  }

  /// Slides every second agent along a line until the cuts are at the edge of an overlap, and leaves it some units in the
  /// last place of the placement on either side.
  void bring_to_contact(PairScene& scene) {
    test::Crowd& crowd = scene.crowd;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const std::size_t a = 2 * i, b = a + 1;
      const double both = reach(crowd.shape[a]) + reach(crowd.shape[b]);
      // Along the x axis of either one, or anywhere.
      const double angles[] = {crowd.heading[a], crowd.heading[b], random.uniform(-3, 3)};
      const double angle = angles[random.below(3)];
      const auto hits_at = [&](double distance) {
        crowd.x[b] = distance * std::cos(angle), crowd.y[b] = distance * std::sin(angle);
        return discs->boundary(crowd.agents(), scene.pairs[i], Method::brute_force);
      };
      double near = 0, far = 1.5 * both;
      if (!hits_at(near)) near = random.uniform(0, both);
      for (int step = 0; step < 45; ++step) {
        const double middle = 0.5 * (near + far);
        (hits_at(middle) ? near : far) = middle;
      }
      hits_at(near + (static_cast<int>(random.below(9)) - 4) * 0x1p-25 * both);
    }
  }

  /// The centre of a disc of one agent on a disc's centre of the other.
  void bring_inside(PairScene& scene) {
    test::Crowd& crowd = scene.crowd;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const std::uint32_t a = static_cast<std::uint32_t>(2 * i), b = a + 1;
      const auto centre = [&](std::uint32_t agent) {
        const auto all = cuts->of(crowd.agents(), agent);
        const Disc disc = all[random.below(static_cast<std::uint32_t>(all.size()))];
        const double c = std::cos(crowd.heading[agent]), s = std::sin(crowd.heading[agent]);
        const double x = disc.x, y = disc.y;
        return std::pair{c * x - s * y, s * x + c * y};
      };
      const auto [ax, ay] = centre(a);
      const auto [bx, by] = centre(b);
      crowd.x[b] = ax - bx, crowd.y[b] = ay - by;
    }
  }

  std::vector<PairScene> scenes(std::uint32_t pairs) {
    PairScene contact = scene(pairs), inside = scene(pairs);
    bring_to_contact(contact);
    bring_inside(inside);
    return {contact, inside};
  }

  Random random{501};
  std::vector<Shape> shapes;
  std::vector<ShapeSet> sets;  ///< with culling data and without
  std::unique_ptr<baselines::Reference> discs;
  std::unique_ptr<CutLists> cuts;
};

template <class Visit>
void for_implementations(Visit visit) {
  for (const auto& implementation : implementations())
    if (implementation.supported()) visit(implementation);
}

TEST_F(UnequalSizes, CollisionsEqualBruteForce) {
  for (const PairScene& scene : scenes(test::samples(12'000))) {
    std::vector<std::uint8_t> expected, found(scene.pairs.size());
    for (const Pair pair : scene.pairs)
      expected.push_back(discs->boundary(scene.crowd.agents(), pair, Method::brute_force));
    EXPECT_GT(std::count(expected.begin(), expected.end(), 1),
              static_cast<std::ptrdiff_t>(found.size() / 10));
    for_implementations([&](const Implementation& implementation) {
      for (const ShapeSet& set : sets) {
        collide(set, scene.crowd.agents(), scene.pairs, found, {Semantics::boundary, &implementation});
        EXPECT_EQ(found, expected) << implementation.name;
      }
    });
  }
}

TEST_F(UnequalSizes, SolidCollisionsEqualBruteForce) {
  for (const PairScene& scene : scenes(test::samples(4'000))) {
    std::vector<std::uint8_t> expected, found(scene.pairs.size());
    for (const Pair pair : scene.pairs)
      expected.push_back(discs->solid(scene.crowd.agents(), pair, Method::brute_force));
    for_implementations([&](const Implementation& implementation) {
      for (const ShapeSet& set : sets) {
        collide(set, scene.crowd.agents(), scene.pairs, found, {Semantics::solid, &implementation});
        EXPECT_EQ(found, expected) << implementation.name;
      }
    });
  }
}

TEST_F(UnequalSizes, ContactsEqualBruteForce) {
  const baselines::LeafSegments segments(shapes, plan, Leaves::segments);
  for (const PairScene& scene : scenes(test::samples(12'000)))
    for_implementations([&](const Implementation& implementation) {
      ContactFinder finder;
      const Rows<DiscPair> table =
          finder.find(sets[0], scene.crowd.agents(), scene.pairs, {.implementation = &implementation});
      for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        const auto expected = baselines::contacts(*cuts, scene.crowd.agents(), scene.pairs[i], &segments);
        const auto found = table[i];
        ASSERT_TRUE(std::equal(
            found.begin(), found.end(), expected.begin(), expected.end(),
            [](const DiscPair& a, const auto& b) { return a.first == b.first && a.second == b.second; }))
            << implementation.name << ", pair " << i;
      }
    });
}

TEST_F(UnequalSizes, ClearancesEqualBruteForce) {
  baselines::ClearanceReference reference(shapes, plan);
  for (const PairScene& scene : scenes(test::samples(12'000))) {
    const auto expected = test::answers(reference, scene, HUGE_VAL, Method::brute_force);
    for_implementations([&](const Implementation& implementation) {
      const auto found = test::answers(sets[0], scene.crowd.agents(), scene.pairs, HUGE_VAL, &implementation);
      for (std::size_t i = 0; i < scene.pairs.size(); ++i)
        ASSERT_TRUE(found.same(i, expected, i)) << implementation.name << ", pair " << i;
    });
  }
}

TEST_F(UnequalSizes, WithinEqualsBruteForce) {
  baselines::ClearanceReference reference(shapes, plan);
  for (const PairScene& scene : scenes(test::samples(12'000))) {
    const Agents agents = scene.crowd.agents();
    const auto apart = test::answers(sets[0], agents, scene.pairs, HUGE_VAL);
    std::vector<double> distances;
    std::vector<std::uint8_t> expected, found(scene.pairs.size());
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double clearance = std::max(0.0, static_cast<double>(apart.distance[i]));
      const double any = std::pow(10, random.uniform(-30, 9));
      distances.push_back(random.below(4) == 0 ? any : clearance * (1 + random.uniform(-2e-6, 0.5e-6)));
      expected.push_back(reference.within(agents, scene.pairs[i], distances[i], Method::brute_force));
    }
    for (const ShapeSet& set : sets)
      for_implementations([&](const Implementation& implementation) {
        within(set, agents, scene.pairs, distances, found, {.implementation = &implementation});
        for (std::size_t i = 0; i < found.size(); ++i)
          ASSERT_EQ(found[i], expected[i]) << implementation.name << ", pair " << i << ", " << distances[i];
      });
  }
}

TEST_F(UnequalSizes, TimeOfImpactsEqualBruteForce) {
  baselines::TimeOfImpactReference reference(shapes, plan);
  for (const PairScene& scene : scenes(test::samples(12'000))) {
    const Agents agents = scene.crowd.agents();
    std::vector<double> x, y;
    for (const auto [first, second] : scene.pairs) {
      // Back a little, then on: past each other's edge, or into each other.
      const double angle = std::atan2(agents.y[second], agents.x[second]) + random.uniform(-2, 2);
      const double length = random.uniform(0, 1) * (reach(agents.shape[first]) + reach(agents.shape[second]));
      x.push_back(length * std::cos(angle)), y.push_back(length * std::sin(angle));
    }
    std::vector<float> found(scene.pairs.size());
    for_implementations([&](const Implementation& implementation) {
      time_of_impact(sets[0], agents, scene.pairs, {x, y}, found, {.implementation = &implementation});
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_EQ(found[i], reference.query(agents, scene.pairs[i], x[i], y[i], Method::brute_force))
            << implementation.name << ", pair " << i;
    });
  }
}

TEST_F(UnequalSizes, PenetrationsEqualBruteForceAndSuffice) {
  for (PairScene scene : scenes(test::samples(8'000))) {
    const auto found = test::best_of(8, sets[0], scene);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const auto expected = baselines::penetration(*cuts, scene.crowd.agents(), scene.pairs[i], 8);
      ASSERT_TRUE(found[i].depth == expected.depth && found[i].x == expected.x && found[i].y == expected.y)
          << i;
      const std::uint32_t first = scene.pairs[i].first;
      scene.crowd.x[first] += static_cast<double>(found[i].depth) * found[i].x;
      scene.crowd.y[first] += static_cast<double>(found[i].depth) * found[i].y;
    }
    std::vector<std::uint8_t> hits(scene.pairs.size());
    collide(sets[0], scene.crowd.agents(), scene.pairs, hits, {Semantics::solid});
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 0);
  }
}

/// Everybody with everybody, some of whom are at the edge of contact.
TEST_F(UnequalSizes, NeighboursEqualBruteForce) {
  CrowdCollider collider;
  for (const PairScene& scene : scenes(test::samples(100))) {
    const auto count = static_cast<std::uint32_t>(scene.crowd.x.size());
    std::vector<std::vector<std::uint32_t>> expected(count);
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = 0; j < count; ++j)
        if (i != j && discs->boundary(scene.crowd.agents(), {i, j}, Method::brute_force))
          expected[i].push_back(j);
    for_implementations([&](const Implementation& implementation) {
      const auto rows =
          collider.collide_all(sets[0], scene.crowd.agents(), {Semantics::boundary, &implementation});
      for (std::uint32_t i = 0; i < count; ++i) {
        const auto row = rows[i];
        EXPECT_TRUE(std::equal(row.begin(), row.end(), expected[i].begin(), expected[i].end()))
            << implementation.name << ", agent " << i;
      }
    });
  }
}

}  // namespace
}  // namespace bch
