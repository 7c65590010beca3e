// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "layout/hierarchy.hpp"
#include "layout/hierarchy_bounds.hpp"

namespace bch {

/// Lone segments that are halved evenly: all pieces have been halved equally often. What that makes of a segment is
/// known from its length, so that its nodes can be counted while the tree grows and written later, segments of a
/// kind in one loop: one after the other, how often is a coin toss that costs more than the halving.
class EvenHalves {
 public:
  static constexpr int most_halvings = 3;
  static constexpr int uneven = most_halvings + 1;
  static constexpr std::uint32_t nodes(int halvings) { return (2u << halvings) - 1; }
  static constexpr std::uint32_t elements(int halvings) { return 1u << halvings; }

  /// Pieces longer than `longest` are halved, in a shape of a certain reach, both metres.
  void begin(double longest, double reach);
  /// How often a segment of a length is halved: `uneven` where that is too often, or rounding may decide.
  int halvings(double length) const;
  /// Leaves room for a segment's nodes and elements. `source`: its index.
  void add(int halvings, std::uint32_t node, std::uint32_t element, std::uint32_t source) {
    segments_[static_cast<std::size_t>(halvings)].push_back({node, element, source});
  }
  /// Fills the room. The first node's parent has been set.
  void write(const std::vector<Element>& segments, HierarchyArrays& nodes, std::vector<Element>& elements,
             std::vector<std::uint32_t>& sources) const;

 private:
  struct Segment {
    std::uint32_t node, element, source;
  };
  double surely_short_ = 0, surely_long_ = 0;
  std::array<std::vector<Segment>, most_halvings + 1> segments_;
};

}  // namespace bch
