// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <bch/collide.hpp>
#include <bch/shape_set.hpp>

#include "tests/support/part_references.hpp"
#include "tests/support/slab_scenes.hpp"

namespace bch::test {

/// Pairs that move, and ways out of each other.
struct MovingScene : PairScene {
  std::vector<double> x, y;
  std::vector<Vec2> along;
};

/// The fixture for comparisons of queries of bodies in slabs, or at different heights, with what the scalar references say of
/// every pair of parts that may meet. The parameter lists the slices; none makes whole bodies.
class SlabComparison : public testing::TestWithParam<std::vector<float>> {
 protected:
  Random random{20263};
  ShapeSetPlan plan = plan_of(GetParam());
  std::vector<Shape> shapes = bodies(random, plan);
  ShapeSet set{shapes, plan};
  PartReferences reference{shapes, plan, set};

  /// Makes ways of up to 3 m, half of them towards the other agent, some of none; of whole bodies at different heights only.
  MovingScene scene_of(std::uint32_t pairs, bool raised, double apart = 0) {
    MovingScene scene{random_scene(random, set, pairs), {}, {}, {}};
    for (std::size_t i = 0; i < scene.crowd.x.size(); i += 2)
      scene.crowd.x[i] -= apart * random.uniform(0, 1);
    if (raised || GetParam().empty()) raise(random, scene);
    for (const auto& [first, second] : scene.pairs) {
      const double towards = std::atan2(scene.crowd.y[second] - scene.crowd.y[first],
                                        scene.crowd.x[second] - scene.crowd.x[first]);
      const double angle = towards + random.uniform(-1, 1) * (random.below(2) == 0 ? std::numbers::pi : 0.5);
      const double length = random.below(8) == 0 ? 0 : random.uniform(0, 3);
      scene.x.push_back(length * std::cos(angle)), scene.y.push_back(length * std::sin(angle));
      const double out = random.uniform(-4, 4), size = std::exp(random.uniform(-20, 20));
      scene.along.push_back(
          {static_cast<float>(size * std::cos(out)), static_cast<float>(size * std::sin(out))});
    }
    return scene;
  }

  /// Makes the same with pairs at the edge of a collision.
  MovingScene tangent_scene(std::uint32_t pairs, bool raised) {
    MovingScene scene = scene_of(pairs, raised);
    make_tangent(random, scene, [&](const Agents& agents, Pair pair) {
      std::uint8_t hit = 0;
      collide(set, agents, {&pair, 1}, {&hit, 1});
      return hit != 0;
    });
    return scene;
  }

  std::vector<MovingScene> scenes(std::uint32_t pairs) {
    std::vector<MovingScene> all;
    for (const bool raised : {false, true}) {
      all.push_back(scene_of(pairs, raised));
      all.push_back(tangent_scene(pairs / 2, raised));
      all.push_back(scene_of(pairs / 2, raised, 2));
      move_away(all.back(), 1e7, -8e8);
    }
    return all;
  }

  /// Asks every implementation. `same` compares with what is expected of pair i.
  template <class Ask, class Same>
  void expect_of_all(const MovingScene& scene, Ask ask, Same same) {
    for (const auto& implementation : implementations()) {
      if (!implementation.supported()) continue;
      const auto found = ask(implementation);
      for (std::size_t i = 0; i < scene.pairs.size(); ++i)
        ASSERT_TRUE(same(found, i)) << implementation.name << ", pair " << i << ": shapes "
                                    << scene.crowd.shape[2 * i] << " and " << scene.crowd.shape[2 * i + 1];
    }
  }

 private:
  static ShapeSetPlan plan_of(const std::vector<float>& slices) {
    ShapeSetPlan plan = levels_of(slices);
    plan.heights = true;
    return plan;
  }
};

}  // namespace bch::test
