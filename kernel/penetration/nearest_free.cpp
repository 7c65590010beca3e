// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <memory>

#include <bch/pairs.hpp>

#include "kernel/body/body_hits.hpp"
#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_search.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/space_point.hpp"

namespace bch {

using namespace detail;

namespace {

/// Holds a direction, and a place along it that the answer is not before.
struct Way {
  double x, y;       ///< in the world
  float to_x, to_y;  ///< in A's frame
  float place;
};

/// Returns the best way of a pair that collides, as seen from the agent with the lower index. The way that may be the shortest is followed by
/// a step, until it has ended.
Penetration best_way(const BodySetView& view, const Agents& agents, std::uint32_t a, std::uint32_t b,
                     const Axes& axes, FreeSearch& search) {
  const SpaceFrame frame(agents, a, b);
  search.begin(view.record(agents.shape[a]), view.record(agents.shape[b]), frame);
  std::array<Way, max_directions> ways;
  const std::uint32_t count = 2 * axes.count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1, x = sign * axes.x[i / 2], y = sign * axes.y[i / 2];
    const SpacePoint e = frame.way(x, y, 0);
    const auto to_x = static_cast<float>(e.x), to_y = static_cast<float>(e.y);
    ways[i] = {x, y, to_x, to_y, search.bound(to_x, to_y)};
  }
  for (const Way* turned = nullptr;;) {
    Way& way = *std::min_element(ways.begin(), ways.begin() + count,
                                 [](const Way& left, const Way& right) { return left.place < right.place; });
    if (&way != turned) search.turn(way.to_x, way.to_y);
    turned = &way;
    const float next = search.next(way.place);
    if (next == way.place) return {next, way.x, way.y};
    way.place = next;
  }
}

constexpr std::size_t pairs_at_once = 64;

}  // namespace

void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  check_size({"nearest_free", "pair", pairs.size()}, out.size(), "answers");
  const Implementation& implementation = chosen(wanted, "nearest_free");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    const auto search = std::make_unique<FreeSearch>();
    std::uint8_t hits[pairs_at_once];
    find_hits(implementation, view, agents, pairs.subspan(begin, size), hits);
    for (std::size_t k = 0; k < size; ++k) {
      const auto [first, second] = pairs[begin + k];
      const auto [a, b] = std::minmax(first, second);
      Penetration way = hits[k] != 0 ? best_way(view, agents, a, b, axes, *search) : Penetration{0, 1, 0};
      if (second < first) way.x = -way.x, way.y = -way.y;
      out[begin + k] = way;
    }
  });
}

}  // namespace bch
