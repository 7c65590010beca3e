// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/crowd.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the agents of a periodic crowd, at positions within one period, followed by images of those near its borders,
/// shifted by a period. Two agents that meet across a border do so twice: each meets an image of the other. PairTest
/// accepts only the pair of the agent with the lower index and the image of the other one: in that order an answer is
/// the same as without a border.
class PeriodicAgents {
 public:
  /// Sets the agents, which are valid. `margin`: as for BroadPhase::find().
  /// Errors:  throws std::invalid_argument on a period of at most four times the farthest extent of an agent.
  void set(const ShapeSetView& shapes, const Agents& agents, CrowdOptions::Period period, double margin);

  Agents agents() const noexcept;
  std::span<const std::uint32_t> origin_of_image() const noexcept { return origin_; }

 private:
  void add_image(std::uint32_t agent, double x, double y);

  std::size_t agents_ = 0;
  std::vector<std::uint32_t> shape_, origin_;
  std::vector<double> x_, y_, heading_, heading_y_, z_;
  std::vector<std::uint8_t> level_;
};

}  // namespace bch::detail
