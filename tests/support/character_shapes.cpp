// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/character_shapes.hpp"

#include <cstdlib>

#include "kernel/runtime/tasks.hpp"

namespace bch::test {

std::optional<std::filesystem::path> test_data() {
  const char* folder = std::getenv("BCH_TEST_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return folder;
}

std::vector<Shape> pose_shapes(const Character& character, std::uint32_t poses) {
  const std::vector<PoseTime> times = sample_poses(character, poses);
  std::vector<Shape> shapes(times.size());
  detail::run_ranges(times.size(), 1, detail::RangeWork([&](std::size_t begin, std::size_t end) {
                       ShapeBuilder shape_builder(character);
                       for (std::size_t i = begin; i < end; ++i) shapes[i] = shape_builder.shape(times[i]);
                     }));
  return shapes;
}

std::vector<Shape> bodies_with_heights(Random& random) {
  std::vector<Shape> shapes;
  for (const Character& character : {default_male(), default_female()}) {
    ShapeBuilder shape_builder(character, {.heights = true});
    for (const PoseTime& time : sample_poses(character, 8)) shapes.push_back(shape_builder.shape(time));
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
