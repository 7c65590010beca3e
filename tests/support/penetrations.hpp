// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/scenes.hpp"

namespace bch::test {

inline std::vector<Penetration> best_of(std::uint32_t k, const ShapeSet& set, const PairScene& scene,
                                        const Implementation& implementation = best_implementation()) {
  std::vector<Penetration> found(scene.pairs.size(), {-1, -1, -1});
  penetration(set, scene.crowd.agents(), scene.pairs, k, found, &implementation);
  return found;
}

inline std::vector<Penetration> along(std::span<const Vec2> directions, const ShapeSet& set,
                                      const PairScene& scene,
                                      const Implementation& implementation = best_implementation()) {
  std::vector<Penetration> found(scene.pairs.size(), {-1, -1, -1});
  penetration_along(set, scene.crowd.agents(), scene.pairs, directions, found, &implementation);
  return found;
}

}  // namespace bch::test
