// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/height_scenes.hpp"

#include "tests/support/test_characters.hpp"

namespace bch::test {

std::vector<Shape> bodies_with_heights(Random& random) {
  std::vector<Shape> shapes;
  for (const Character& character : default_characters()) {
    PoseShaper shaper(character, {.heights = true});
    for (const PoseTime& time : sample_poses(character, 8)) shapes.push_back(shaper.shape(time));
  }
  for (Shape& shape : synthetic_shapes(26, 12)) {
    const auto bottom = static_cast<float>(random.uniform(-0.5, 1.5));
    shape.heights = {bottom, bottom + static_cast<float>(random.uniform(0, 1))};
    if (random.below(3) == 0) shape.heights = {};
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

void raise(Random& random, Crowd& crowd) {
  for (std::size_t i = 0; i < crowd.x.size(); ++i)
    crowd.z.push_back(random.below(2) == 0 ? 5 : 5 + random.uniform(-1, 1));
}

}  // namespace bch::test
