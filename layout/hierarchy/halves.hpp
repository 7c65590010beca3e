// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bch/hierarchy.hpp>

#include "layout/hierarchy/outward_radii.hpp"

namespace bch::detail {

/// Holds lone segments that are halved evenly: all pieces have been halved equally often. The nodes of such a
/// segment are known from its length. So they are counted while the tree grows and written later, in one loop
/// for all segments with the same number of halvings. In the order of segments that number could not be
/// predicted, which costs more than the halving.
class EvenHalves {
 public:
  static constexpr int max_halvings = 3;
  static constexpr int uneven = max_halvings + 1;
  static constexpr std::uint32_t nodes(int halvings) { return (2u << halvings) - 1; }

  /// Sets the length of pieces beyond which they are halved, `longest`, in a shape of a certain reach, both
  /// metres.
  void begin(double longest, double reach);
  /// Writes how often segments of four lengths, rounded to float, are halved: `uneven` where that is too often, or rounding
  /// may decide.
  void write_halvings(const float* lengths, std::uint8_t* halvings) const;
  /// Leaves room for a segment's nodes. `source`: its index.
  void add(int halvings, std::uint32_t node, std::uint32_t source) {
    segments_[static_cast<std::size_t>(halvings)].push_back({node, source});
  }
  /// Writes the nodes of all segments into the room that add() left.
  void write(const std::vector<Hierarchy::Primitive>& segments, const OutwardRadii& radii,
             std::vector<Hierarchy::Node>& nodes) const;

 private:
  struct Segment {
    std::uint32_t node, source;
  };
  /// Lengths up to which a segment is surely halved so often at most, and beyond which surely once more.
  std::array<float, max_halvings + 1> surely_short_ = {}, surely_long_ = {};
  std::array<std::vector<Segment>, max_halvings + 1> segments_;
};

}  // namespace bch::detail
