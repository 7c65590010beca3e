// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/clearance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "kernel/collide/answer.hpp"
#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/part_items.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

/// Pairs a task.
constexpr std::size_t grain = 1024;

/// The largest float that is not above max_distance.
float limit_of(double max_distance) {
  const float nearest = static_cast<float>(std::min(max_distance, static_cast<double>(largest_limit)));
  return static_cast<double>(nearest) > max_distance ? std::nextafter(nearest, -1.0f) : nearest;
}

DiscPair nearest_discs(const ShapeSetView& shapes, const Agents& agents, Pair pair,
                       const NearestDiscs& nearest) {
  if (nearest.a == no_node) return no_discs;
  const auto index = [&](std::uint32_t agent, std::uint32_t node) {
    if (shapes.trees == nullptr) return node;
    return node - shapes.trees[agents.root(agent, shapes.level_count)].discs;
  };
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const DiscPair nodes{index(a, nearest.a), index(b, nearest.b)};
  return pair.second < pair.first ? DiscPair{nodes.second, nodes.first} : nodes;
}

/// Returns the direction of a clearance. It is computed in double, where squares do not underflow.
Vec2 direction(Pair pair, const NearestDiscs& nearest) {
  if (nearest.a == no_node) return {0, 0};
  const double x = nearest.x, y = nearest.y;
  const double sign = pair.second < pair.first ? -1 : 1;
  if (x == 0 && y == 0) return {static_cast<float>(sign), 0};
  const double c = nearest.cosine, s = nearest.sine, world_x = c * x - s * y, world_y = s * x + c * y;
  const double scale = sign / std::sqrt(world_x * world_x + world_y * world_y);
  return {static_cast<float>(scale * world_x), static_cast<float>(scale * world_y)};
}

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

  /// At most `grain` pairs.
  void write() {
    drop_what_collides();
    asks_parts(shapes_, agents_) ? search_parts() : search_shapes();
  }

 private:
  /// Answers what collides, and lists the other pairs. A set of roots alone is as quickly searched.
  void drop_what_collides() noexcept {
    std::uint8_t hits[grain] = {};
    if (arguments_.enough == 0 && shapes_.trees != nullptr) {
      Arguments in = arguments_.in;
      in.pairs = pairs_.data(), in.codes = hits;
      detail::answer(implementation_, in, 0, pairs_.size());
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (hits[i] != 0) put(i, 0, {0, 0}, no_discs);
      open_[open_count_] = pairs_[i];
      index_[open_count_] = static_cast<std::uint16_t>(i);
      open_count_ += hits[i] == 0;
    }
  }

  /// Not inlined, so that what it keeps on the stack is not there beside the other kernel.
  [[gnu::noinline]] void search_shapes() noexcept {
    NearestDiscs nearest[grain];
    arguments_.in.pairs = open_;
    arguments_.nearest = nearest;
    implementation_.kernels->clearance(arguments_, 0, open_count_);
    for (std::size_t k = 0; k < open_count_; ++k)
      put(k, nearest[k], [&] { return nearest_discs(shapes_, agents_, open_[k], nearest[k]); });
  }

  /// Bodies in slabs or at different heights: the nearest parts, in a tie those in the lowest slabs.
  void search_parts() {
    PartItems items;
    items.expand(shapes_, agents_, {open_, open_count_});
    std::vector<NearestDiscs> nearest(items.size());
    const Agents agents = items.agents();
    const ShapeSetView parts = parts_as_shapes(shapes_);
    ClearanceArguments arguments = arguments_;
    arguments.in = arguments_for(parts, agents, items.pairs());
    arguments.nearest = nearest.data();
    implementation_.kernels->clearance(arguments, 0, items.size());
    const auto is_before = [&](std::size_t a, std::size_t b) {
      const auto key = [&](std::size_t i) {
        const float distance =
            nearest[i].a != no_node ? nearest[i].distance : std::numeric_limits<float>::infinity();
        return std::tuple(distance, items.origin(i).slab_a, items.origin(i).slab_b);
      };
      return key(a) < key(b);
    };
    for (std::size_t k = 0; k < open_count_; ++k) {
      std::size_t best = items.begin(k);
      for (std::size_t i = best + 1; i < items.begin(k + 1); ++i)
        if (is_before(i, best)) best = i;
      if (items.begin(k) == items.begin(k + 1)) {
        put_beyond(index_[k]);
        continue;
      }
      put(k, nearest[best], [&] {
        const DiscPair local = nearest_discs(parts, agents, items.pairs()[best], nearest[best]);
        const DiscPair discs{local.first + items.origin(best).first_disc_a,
                             local.second + items.origin(best).first_disc_b};
        return open_[k].second < open_[k].first ? DiscPair{discs.second, discs.first} : discs;
      });
    }
  }

  /// Writes the answer for an open pair.
  template <class DiscsOf>
  void put(std::size_t k, const NearestDiscs& nearest, DiscsOf discs_of) noexcept {
    const std::size_t i = index_[k];
    if (nearest.a == no_node) return put_beyond(i);
    if (nearest.distance <= arguments_.enough) return put(i, 0, {0, 0}, no_discs);
    put(i, nearest.distance, answers_.direction.empty() ? Vec2{} : direction(open_[k], nearest),
        answers_.discs.empty() ? no_discs : discs_of());
  }

  void put_beyond(std::size_t i) noexcept {
    put(i, std::numeric_limits<float>::infinity(), {0, 0}, no_discs);
  }

  void put(std::size_t i, float distance, Vec2 direction, DiscPair discs) noexcept {
    answers_.distance[i] = distance;
    if (!answers_.direction.empty()) answers_.direction[i] = direction;
    if (!answers_.discs.empty()) answers_.discs[i] = discs;
  }

  const Implementation& implementation_;
  ClearanceArguments arguments_;
  const ShapeSetView& shapes_;
  const Agents& agents_;
  const std::span<const Pair> pairs_;
  const ClearanceAnswers& answers_;
  std::size_t open_count_ = 0;
  Pair open_[grain + 1];            ///< the pairs that are not answered yet, and room for one that is
  std::uint16_t index_[grain + 1];  ///< of each
};

void require_answers(const ClearanceAnswers& answers, std::size_t pairs) {
  const auto require = [pairs](std::size_t size, const char* name, bool optional) {
    if (size == pairs || (optional && size == 0)) return;
    throw std::invalid_argument("clearance: " + std::to_string(pairs) + " pairs but " + std::to_string(size) +
                                " " + name);
  };
  require(answers.distance.size(), "distances", false);
  require(answers.direction.size(), "directions", true);
  require(answers.discs.size(), "discs", true);
}

}  // namespace

void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_answers(answers, pairs.size());
  if (!(options.max_distance >= 0))
    throw std::invalid_argument("clearance: a max_distance of " + shortest(options.max_distance) + " m");
  if (options.overlap != Overlap::zero && options.overlap != Overlap::deepest)
    throw std::invalid_argument("clearance: no overlap is " +
                                std::to_string(static_cast<int>(options.overlap)) +
                                ", only zero (0) and deepest (1)");
  const Implementation& implementation = chosen(options, "clearance");
  const ShapeSetView& view = shapes.view();
  require_valid(implementation, view, agents, pairs);

  const float enough = options.overlap == Overlap::zero ? 0 : -std::numeric_limits<float>::infinity();
  const ClearanceArguments arguments{arguments_for(view, agents, {}), limit_of(options.max_distance), enough,
                                     nullptr};
  const auto part = [](auto span, std::size_t begin, std::size_t size) {
    return span.empty() ? span : span.subspan(begin, size);
  };
  for_pair_ranges(pairs.size(), grain, [&](std::size_t begin, std::size_t size) {
    const ClearanceAnswers its_answers{part(answers.distance, begin, size),
                                       part(answers.direction, begin, size),
                                       part(answers.discs, begin, size)};
    RangeAnswers(implementation, arguments, agents, pairs.subspan(begin, size), its_answers).write();
  });
}

}  // namespace bch
