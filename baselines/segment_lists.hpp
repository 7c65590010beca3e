// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <bch/hierarchy.hpp>
#include <bch/shapes.hpp>

#include "baselines/leaf_segments.hpp"
#include "baselines/placement.hpp"
#include "baselines/segment_meeting.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::baselines {

/// Holds the segments of all shapes' leaves, for pairs one after the other: what LeafSegments answers, made to be fast.
class SegmentLists {
 public:
  /// Adds the nodes of the next shape.
  void add(const Shape& shape) {
    const Hierarchy& hierarchy = shape.hierarchy;
    const bool decide = hierarchy.of_segments && hierarchy.nodes.size() > 1 && shape.outline.contours() > 0;
    const std::size_t before = segments_.size();
    margins_.push_back(decide ? LeafSegments::margin_of(shape) : no_segments);
    for (std::size_t node = 0; node < hierarchy.nodes.size(); ++node) {
      const auto begin = static_cast<std::uint32_t>(segments_.size());
      if (decide && hierarchy.nodes[node].is_leaf()) {
        const auto [from, to] = hierarchy.primitive_ranges[node];
        for (std::uint32_t i = from; i < to; ++i)
          segments_.push_back(ends(shape.outline, hierarchy.source[i]));
      }
      ranges_.push_back({begin, static_cast<std::uint32_t>(segments_.size())});
    }
    bytes_.push_back(hierarchy.nodes.size() * sizeof(Hierarchy::Range) +
                     (segments_.size() - before) * sizeof(Ends));
  }

  /// Returns the distance within which segments of two shapes meet; below 0 where segments do not decide.
  double margin(std::uint32_t shape_a, std::uint32_t shape_b) const noexcept {
    return margins_[shape_a] + margins_[shape_b];
  }

  /// Returns the closest relation of segments of two leaves.
  template <class Counts>
  Meeting closest(const FloatPlacement& place, double margin, std::uint32_t leaf_a, std::uint32_t leaf_b,
                  Counts counts) const noexcept {
    const Hierarchy::Range of_a = ranges_[leaf_a], of_b = ranges_[leaf_b];
    if (std::max(of_a.end - of_a.begin, of_b.end - of_b.begin) > detail::max_leaf_segments)
      return Meeting::within_margin;
    const Placement in_a{double{place.cosine}, double{place.sine}, double{place.x}, double{place.y}};
    Meeting best = Meeting::none;
    for (std::uint32_t j = of_b.begin; j < of_b.end; ++j) {
      const Segment b{in_a.place(segments_[j].from), in_a.place(segments_[j].to)};
      for (std::uint32_t i = of_a.begin; i < of_a.end; ++i) {
        counts.leaf();
        const Meeting found = meeting({exact(segments_[i].from), exact(segments_[i].to)}, b, margin);
        if (found == Meeting::sure) return found;
        best = std::max(best, found);
      }
    }
    return best;
  }

  /// Returns the memory of a shape.
  std::size_t bytes(std::uint32_t shape) const noexcept { return bytes_[shape]; }

 private:
  static constexpr double no_segments = -std::numeric_limits<double>::infinity();

  struct Ends {
    Vec2 from, to;
  };

  static Ends ends(const Outline& outline, std::uint32_t number) {
    const auto [from, to] = LeafSegments::segment(outline, number);
    return {{static_cast<float>(from.x), static_cast<float>(from.y)},
            {static_cast<float>(to.x), static_cast<float>(to.y)}};
  }

  std::vector<Ends> segments_;
  std::vector<Hierarchy::Range> ranges_;  ///< per node: of segments
  std::vector<double> margins_;           ///< per shape, metres
  std::vector<std::size_t> bytes_;        ///< per shape
};

}  // namespace bch::baselines
