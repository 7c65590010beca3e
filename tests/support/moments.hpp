// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/pose_shape.hpp>

#include "tests/support/moving_bodies.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// Bodies of many discs and of few, with rings, which loop and which do not.
class Moments : public testing::Test {
 protected:
  Moments() {
    Random random(3121);
    for (std::uint32_t i = 0; i < 5; ++i) shapes.emplace_back(ringed_body(random, 1 + i % 2, 10 + 12 * i));
    for (const AnimatedShape& shape : shapes) bodies.push_back(&shape);
  }

  std::vector<AnimatedShape> shapes;
  std::vector<const AnimatedShape*> bodies;
};

/// A crowd whose agents show bodies at times.
struct Players {
  std::vector<std::uint32_t> body, shape;
  std::vector<double> seconds, x, y, heading;

  Players(Random& random, std::uint32_t count, std::uint32_t of) : shape(count) {
    const double side = std::sqrt(count / 4.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      body.push_back(random.below(of));
      seconds.push_back(random.uniform(-3, 3));
      x.push_back(random.uniform(0, side));
      y.push_back(random.uniform(0, side));
      heading.push_back(random.uniform(-4, 4));
    }
  }
  Agents agents() const { return {shape, x, y, heading}; }
};
/// The clearances of pairs.
inline std::vector<float> distances(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs) {
  std::vector<float> found(pairs.size());
  clearance(set, agents, pairs, {found, {}, {}, {}});
  return found;
}

}  // namespace bch::test
