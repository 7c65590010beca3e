// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/character_shapes.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstdlib>

namespace bch::test {

std::optional<std::filesystem::path> test_data() {
  const char* folder = std::getenv("BCH_TEST_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return folder;
}

std::vector<Shape> pose_shapes(const Character& character, std::uint32_t poses) {
  const std::vector<PoseTime> times = sample_poses(character, poses);
  std::vector<Shape> shapes(times.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, times.size()), [&](const auto& range) {
    PoseShaper shaper(character);
    for (std::size_t i = range.begin(); i < range.end(); ++i) shapes[i] = shaper.shape(times[i]);
  });
  return shapes;
}

}  // namespace bch::test
