// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/clearance_measure.hpp"
#include "kernel/distance/facing_segments.hpp"
#include "kernel/distance/nearest_search.hpp"
#include "kernel/distance/segment_gaps.hpp"
#include "kernel/simd/record_fields.hpp"
#include "kernel/simd/relative_transforms.hpp"
#include "kernel/simd/segment_test.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Finds the nearest discs of every pair, or with exact leaves the nearest segments. For each packet of pairs
/// the kernel places B in A's frame, bounds the gaps by the root discs, one pair per lane, and traverses the
/// trees of the pairs that may be within the limit.
template <class Simd>
class ClearanceKernel {
 public:
  static void run(const ClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(ClearanceKernel) <= 256 * 1024, "fits the stack of query.hpp with room for calls");
    ClearanceKernel kernel(arguments);
    for (; begin < end; begin += packet_size) kernel.answer_packet(begin, end);
  }

 private:
  using Float = typename Simd::Float;
  using Measure = ClearanceMeasure<Simd>;
  using Search = NearestSearch<Simd, Measure>;

  explicit ClearanceKernel(const ClearanceArguments& arguments) noexcept
      : arguments_(arguments),
        shapes_(*arguments.in.shapes),
        segments_(shapes_),
        facing_(shapes_),
        search_(shapes_.nodes) {}

  void answer_packet(std::size_t begin, std::size_t end) noexcept {
    transforms_.compute(arguments_.in, begin, end);
    const std::uint32_t size = transforms_.size;
    of_a_.template load<4>(&shapes_.roots->x, transforms_.root_a, transforms_.whole_registers(),
                           arguments_.in.prefetch_shapes);
    of_b_.template load<4>(&shapes_.roots->x, transforms_.root_b, transforms_.whole_registers(),
                           arguments_.in.prefetch_shapes);
    NearestFeatures* const nearest = arguments_.nearest + begin;
    if (shapes_.trees == nullptr) return answer_roots(nearest);
    for (std::uint32_t k = 0; k < size; k += Simd::width) bound_roots(k);
    for (std::uint32_t pair = 0; pair < size; ++pair) {
      const Measure measure = this->measure(pair);
      nearest[pair] = answer(pair, measure);
      if (!(root_bound_[pair] <= measure.best())) continue;
      searched_[search_.size()] = pair;
      search_.add(transforms_.transform(pair), shapes_.trees[transforms_.root_a[pair]],
                  shapes_.trees[transforms_.root_b[pair]], measure);
      if (search_.size() == Search::capacity) answer_searched(nearest);
    }
    answer_searched(nearest);
  }

  void answer_searched(NearestFeatures* nearest) noexcept {
    search_.run([this] {
      segments_.finish();
      for (std::uint32_t k = 0; k < search_.size(); ++k) measure_facing(k);
    });
    segments_.finish();
    for (std::uint32_t k = 0; k < search_.size(); ++k)
      nearest[searched_[k]] = answer(searched_[k], search_.measure(k));
    search_.clear();
  }

  /// Ends a search early, where possible, and measures the few segments that remain. After the first leaves,
  /// FacingSegments (facing_segments.hpp) finds the segments of the outlines' facing sides that may be nearer than
  /// those measured. The search ends if FacingSegments takes both shapes (it refuses large ones) and finds few.
  void measure_facing(std::uint32_t k) noexcept {
    Measure& measure = search_.measure(k);
    const auto [distance, are_discs, a, b] = measure.nearest();
    const std::uint32_t pair = searched_[k];
    if (are_discs || a == no_node || !facing_.takes(transforms_.shape_a[pair], transforms_.shape_b[pair]) ||
        !facing_.find(transforms_.transform(pair), a, b, segments_.max_distance(k, measure)))
      return;
    search_.end(k);
    segments_.measure_pairs(k, measure, [this](auto use) { facing_.visit(use); });
  }

  NearestFeatures answer(std::uint32_t pair, const Measure& measure) const noexcept {
    const auto [distance, are_discs, a, b] = measure.nearest();
    // Of segments, only the first four members are used: see NearestFeatures (clearance_arguments.hpp).
    if (!are_discs) return {distance, a != no_node, a, b, 0, 0, 1, 0};
    const auto disc = [this](std::uint32_t place, std::uint32_t root) {
      const std::size_t stride = shapes_.trees[root].stride;
      return Discs{shapes_.nodes + place, stride, 2 * stride};
    };
    const auto [x, y, r] = disc_pair<Simd>(transforms_.transform(pair), disc(a, transforms_.root_a[pair]),
                                           disc(b, transforms_.root_b[pair]), 0);
    const auto [cosine, sine] = transforms_.heading(pair);
    return {distance, false, a, b, x, y, cosine, sine};
  }

  /// Returns the ClearanceMeasure of a pair: what computes its gaps and keeps the least one. The pair has to be the
  /// next one that is added to search_, because the measure is bound to the slot search_.size().
  Measure measure(std::uint32_t pair) noexcept {
    Measure measure(arguments_.limit, arguments_.stop_below, max_extent(pair));
    const Tree &a = shapes_.trees[transforms_.root_a[pair]], &b = shapes_.trees[transforms_.root_b[pair]];
    if (!arguments_.in.exact_leaves || a.segments == no_segments || b.segments == no_segments) return measure;
    const double margin = segment_margin<Simd>(shapes_, transforms_.shape_a[pair], transforms_.shape_b[pair]);
    segments_.place(search_.size(), transforms_.transform(pair), margin);
    measure.use_segments(&segments_, search_.size(), a, b, margin,
                         facing_.takes(transforms_.shape_a[pair], transforms_.shape_b[pair]));
    return measure;
  }

  float max_extent(std::uint32_t pair) const noexcept {
    return shapes_.max_extent[transforms_.shape_a[pair]] + shapes_.max_extent[transforms_.shape_b[pair]];
  }

  struct Step {
    Float x, y, r;
  };
  /// Returns the vectors from root disc to root disc, and the sums of their radii, one pair per lane.
  Step between_roots(std::uint32_t k) const noexcept {
    const auto [x, y] =
        transforms_.transforms(k).apply(Simd::load(of_b_.field[0] + k), Simd::load(of_b_.field[1] + k));
    return {x - Simd::load(of_a_.field[0] + k), y - Simd::load(of_a_.field[1] + k),
            Simd::load(of_a_.field[2] + k) + Simd::load(of_b_.field[2] + k)};
  }

  void bound_roots(std::uint32_t k) noexcept {
    const Step step = between_roots(k);
    alignas(64) float max_extents[Simd::width], radii[Simd::width];
    for (std::uint32_t lane = 0; lane < Simd::width; ++lane) {
      max_extents[lane] = max_extent(k + lane);
      radii[lane] = shapes_.trees[transforms_.root_a[k + lane]].outer_radius +
                    shapes_.trees[transforms_.root_b[k + lane]].outer_radius;
    }
    Simd::store(root_bound_ + k, Measure::bound(step.x, step.y, Simd::load(radii), Simd::load(max_extents)));
  }

  /// Answers the pairs of a set of single discs.
  void answer_roots(NearestFeatures* nearest) noexcept {
    alignas(64) float gap[packet_size], x_of[packet_size], y_of[packet_size];
    for (std::uint32_t k = 0; k < transforms_.size; k += Simd::width) {
      const auto [x, y, r] = between_roots(k);
      Simd::store(gap + k, Measure::gap(x, y, r));
      Simd::store(x_of + k, x);
      Simd::store(y_of + k, y);
    }
    for (std::uint32_t k = 0; k < transforms_.size; ++k) {
      const bool within = gap[k] <= arguments_.limit;
      const std::uint32_t node = within ? 0 : no_node;
      const auto [cosine, sine] = transforms_.heading(k);
      nearest[k] = {gap[k], false, node, node, x_of[k], y_of[k], cosine, sine};
    }
  }

  const ClearanceArguments& arguments_;
  const ShapeSetView shapes_;
  RelativeTransforms<Simd> transforms_;
  RecordFields<Simd> of_a_, of_b_;
  alignas(64) float root_bound_[packet_size];
  std::uint32_t searched_[Search::capacity];  ///< pairs of the packet
  typename Measure::Segments segments_;
  FacingSegments<Simd> facing_;
  static_assert(Measure::Segments::max_searches == Search::capacity);
  Search search_;
};

}  // namespace bch::detail
