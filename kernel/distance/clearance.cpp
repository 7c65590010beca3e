// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/distance/apart_pairs.hpp"
#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/distance/nearest_features.hpp"
#include "kernel/runtime/pair_heights.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"

namespace bch {

using namespace detail;

namespace {

/// Writes the answers of a range of pairs.
class RangeAnswers {
 public:
  RangeAnswers(const Implementation& implementation, const ClearanceArguments& arguments,
               const Agents& agents, std::span<const Pair> pairs, const ClearanceAnswers& answers) noexcept
      : implementation_(implementation),
        arguments_(arguments),
        shapes_(*arguments.in.shapes),
        agents_(agents),
        pairs_(pairs),
        answers_(answers) {}

  /// At most `ApartPairs::capacity` pairs.
  void write() {
    // In a set of single discs the search is as fast as collide(). Segments are measured only for pairs that do
    // not collide.
    if (arguments_.stop_below == 0 && shapes_.trees != nullptr) {
      open_.collect_apart(implementation_, arguments_.in, pairs_);
      for (std::size_t i = 0; i < pairs_.size(); ++i) store_distance(answers_, i, 0);
    } else {
      open_.collect_all(pairs_);
    }
    search();
  }

 private:
  /// Not inlined, so that its stack memory is not in use together with that of the other kernel.
  [[gnu::noinline]] void search() noexcept {
    NearestFeatures nearest[ApartPairs::capacity];
    arguments_.in.pairs = open_.pairs().data();
    arguments_.nearest = nearest;
    implementation_.kernels->clearance(arguments_, 0, open_.size());
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const Pair pair = open_.pairs()[k];
      if (heights_meet(arguments_.in, pair))
        store(k, {shapes_, agents_, in_order(pair), nearest[k]});
      else
        store_distance(answers_, open_.index(k), std::numeric_limits<float>::infinity());
    }
  }

  static Pair in_order(Pair pair) noexcept {
    return pair.first <= pair.second ? pair : Pair{pair.second, pair.first};
  }

  /// Writes the answer for an open pair.
  void store(std::size_t k, const PlacedFeatures& found) noexcept {
    const std::size_t i = open_.index(k);
    const NearestFeatures& nearest = found.nearest();
    if (nearest.a == no_node) return store_distance(answers_, i, std::numeric_limits<float>::infinity());
    if (nearest.distance <= arguments_.stop_below) return store_distance(answers_, i, 0);
    const bool is_turned = open_.pairs()[k].second < open_.pairs()[k].first;
    answers_.distance[i] = nearest.distance;
    if (!answers_.direction.empty()) answers_.direction[i] = found.direction(is_turned ? -1 : 1);
    if (!answers_.discs.empty()) {
      const DiscPair discs = found.numbers();
      answers_.discs[i] = is_turned ? DiscPair{discs.second, discs.first} : discs;
    }
    if (!answers_.points.empty()) {
      const NearestPoints at = found.points();
      answers_.points[i] = is_turned ? NearestPoints{at.second, at.first} : at;
    }
  }

  const Implementation& implementation_;
  ClearanceArguments arguments_;
  const ShapeSetView& shapes_;
  const Agents& agents_;
  const std::span<const Pair> pairs_;
  const ClearanceAnswers& answers_;
  ApartPairs open_;  ///< pairs without an answer yet
};

}  // namespace

void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const ClearanceOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "pair", pairs.size()}, answers, options);
  const Implementation& implementation = chosen(options.implementation, "clearance");
  const ShapeSetView& view = shapes.view();
  require_valid(implementation, view, agents, pairs);

  const float stop_below = options.overlap == Overlap::zero ? 0 : -std::numeric_limits<float>::infinity();
  // Depths of overlaps are always those of discs.
  const bool of_segments =
      exact_leaves(shapes, options.leaves, "clearance") && options.overlap == Overlap::zero;
  ClearanceArguments arguments{arguments_for(view, agents, {}),
                               rounding::round_down(std::min(options.max_distance, double{largest_limit})),
                               stop_below, nullptr};
  arguments.in.exact_leaves = of_segments;
  const auto part = [](auto span, std::size_t begin, std::size_t size) {
    return span.empty() ? span : span.subspan(begin, size);
  };
  for_pair_ranges(pairs.size(), ApartPairs::capacity, [&](std::size_t begin, std::size_t size) {
    const ClearanceAnswers its_answers{part(answers.distance, begin, size),
                                       part(answers.direction, begin, size), part(answers.discs, begin, size),
                                       part(answers.points, begin, size)};
    RangeAnswers(implementation, arguments, agents, pairs.subspan(begin, size), its_answers).write();
  });
}

}  // namespace bch
