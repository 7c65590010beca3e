// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/agents.hpp>
#include <bch/body_set.hpp>

namespace bch::baselines {

/// Holds the nearest spheres of a pair, those of its own first agent first.
struct BodyClearance {
  float distance;
  std::uint32_t first, second;
};

/// Answers queries of bodies of spheres by comparing every sphere with every sphere, in float with the operations that
/// layout/body/sphere_rounding.hpp lists. Written apart from the kernel, which has to give the same bits.
class BodyReference {
 public:
  explicit BodyReference(const BodySet& bodies);

  /// Returns what collide() answers.
  bool collide(const Agents& agents, Pair pair) const { return within(agents, pair, 0); }
  /// Returns what within() answers.
  bool within(const Agents& agents, Pair pair, double distance) const;
  /// Returns what clearance() answers with Overlap::deepest.
  BodyClearance clearance(const Agents& agents, Pair pair) const;
  /// Returns what time_of_impact() answers where the pair's first agent moves by (x, y, z) relative to the second.
  float time_of_impact(const Agents& agents, Pair pair, double x, double y, double z) const;

 private:
  /// Returns the spheres of the agent with the larger index where they are in the other one's frame.
  std::vector<Sphere> placed(const Agents& agents, Pair pair) const;

  std::vector<std::vector<Sphere>> spheres_;  ///< per body
};

}  // namespace bch::baselines
