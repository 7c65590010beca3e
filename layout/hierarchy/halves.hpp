// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bch/hierarchy.hpp>

#include "layout/hierarchy/outward_radii.hpp"

namespace bch::detail {

/// Collects lone segments whose pieces are all halved equally often. The number of nodes of such a segment follows
/// from its length. So the nodes are counted while the tree grows and written later, in one loop for all segments
/// with the same number of halvings. Segment by segment, that number would be unpredictable, and its mispredicted
/// branches would cost more than the halving.
class EvenHalves {
 public:
  static constexpr int max_halvings = 3;
  static constexpr int uneven = max_halvings + 1;
  static constexpr std::uint32_t nodes(int halvings) { return (2u << halvings) - 1; }

  /// Sets the length beyond which pieces are halved and the extent of the shape, metres.
  void begin(double longest, double max_extent);
  /// Writes, for four lengths rounded to float, how often segments of these lengths are halved; `uneven` if that is
  /// more than max_halvings or rounding may decide.
  void write_halvings(const float* lengths, std::uint8_t* halvings) const;
  /// Adds a segment by its index `source`; its nodes begin at `node` and are written by write().
  void add(int halvings, std::uint32_t node, std::uint32_t source) {
    segments_[static_cast<std::size_t>(halvings)].push_back({node, source});
  }
  /// Writes the nodes of all added segments.
  void write(const std::vector<Hierarchy::Primitive>& segments, const OutwardRadii& radii,
             std::vector<Hierarchy::Node>& nodes) const;

 private:
  struct Segment {
    std::uint32_t node, source;
  };
  /// Index k: the length up to which a segment is surely halved at most k times, and the length beyond which it is
  /// surely halved more often.
  std::array<float, max_halvings + 1> surely_short_ = {}, surely_long_ = {};
  std::array<std::vector<Segment>, max_halvings + 1> segments_;
};

}  // namespace bch::detail
