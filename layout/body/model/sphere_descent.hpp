// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/base/heading.hpp"
#include "layout/base/random.hpp"
#include "layout/body/model/sphere_fit.hpp"
#include "layout/body/model/sphere_slide.hpp"

namespace bch::detail {

inline float dot_of(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns how much longer a map makes lengths in the mean.
float scale_of(const double (&rows)[3][4]);

/// Moves the spheres that meet first in random slides of a body against itself, so that they meet later, and counts how often each does.
class SphereDescent {
 public:
  explicit SphereDescent(SphereFit& fit);

  /// Makes slides, whose number is slides_a_round, and steps of at most that length, metres. Counts anew.
  void round(float length);
  /// Forgets the path that a sphere went.
  void restart(std::uint32_t sphere) { descents_[sphere].assign(fit_.balls[sphere].influences.size(), {}); }

  static constexpr int steps_a_round = 100, slides_a_round = 100 * steps_a_round;

  // Of the last round, by sphere:
  std::vector<float> blame;  ///< what it would be worth that its radius towards the other body were smaller
  std::vector<float> contacts;  ///< each as often as slides meet earlier where it grows

 private:
  using Space = std::array<float, 3>;

  /// Remembers the gradients of a centre in the frame of one bone.
  struct Descent {
    Space mean = {};
    float square = 0;
  };

  void step(float length);
  void note(std::uint32_t sphere, std::size_t pose, const Rotation& turn, const float (&normal)[3],
            float sign, float leverage);
  void descend(std::size_t sphere, float length);

  SphereFit& fit_;
  Random random_;
  SlidingBody first_, second_;
  std::vector<std::vector<Descent>> descents_;
  std::vector<std::vector<Space>> gradients_;
};

}  // namespace bch::detail
