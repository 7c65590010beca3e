// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <vector>

#include <bch/pairs.hpp>

#include "kernel/penetration/free_sources.hpp"
#include "kernel/penetration/free_way.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

namespace {

/// Holds a move, and where it ends, which is searched where somebody asks for it.
struct Answer {
  Penetration move{0, 1, 0};
  Penetration::Touch touch{{0, 0, 0}, {0, 0, 0}};
};

/// Returns the answer of a pair as seen from the agent with the higher index, which moves in place of the other.
Answer from_b(const Agents& agents, std::uint32_t a, std::uint32_t b, const Answer& from_a) {
  const auto& [depth, x, y] = from_a.move;
  Answer answer = from_a;
  answer.move = {depth, -x, -y};
  if (depth == 0) return answer;
  Vec3 &point = answer.touch.point, &normal = answer.touch.normal;
  const double z = agents.z.empty() ? 0 : agents.z[a] - agents.z[b];
  point.x = static_cast<float>(double{point.x} + (agents.x[a] - agents.x[b] + double{depth} * x));
  point.y = static_cast<float>(double{point.y} + (agents.y[a] - agents.y[b] + double{depth} * y));
  point.z = static_cast<float>(double{point.z} + z);
  normal = {-normal.x, -normal.y, -normal.z};
  return answer;
}

constexpr std::size_t pairs_at_once = 64;

/// Answers pairs, each as seen from the agent with the lower index. Searches need memory, so answers are written once all have ended.
template <class Source>
void answer_pairs(const Source& source, std::span<const Pair> pairs, const Axes& axes,
                  std::span<Penetration> out, std::span<Penetration::Touch> to_touches) {
  using Search = FreeWaySearch<Source, NoWalls>;
  std::vector<Penetration> ways(pairs.size());
  std::vector<Penetration::Touch> touches(to_touches.size());
  Spares<Search> spares;
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    const auto search = spares.borrow([&] { return Search(source); });
    std::uint8_t hits[pairs_at_once];
    source.find_hits(source.agents(), pairs.subspan(begin, size), hits);
    for (std::size_t k = 0; k < size; ++k) {
      const auto [first, second] = pairs[begin + k];
      const auto [a, b] = std::minmax(first, second);
      Answer answer;
      if (hits[k] != 0) {
        const FreeWay way = search->find(a, {&b, 1}, axes);
        answer.move = {way.place, way.x, way.y};
        if (!touches.empty()) answer.touch = search->touch(way);
      }
      if (second < first) answer = from_b(source.agents(), a, b, answer);
      ways[begin + k] = answer.move;
      if (!touches.empty()) touches[begin + k] = answer.touch;
    }
  });
  std::copy(ways.begin(), ways.end(), out.begin());
  std::copy(touches.begin(), touches.end(), to_touches.begin());
}

void check_sizes(std::span<const Pair> pairs, std::span<Penetration> out,
                 std::span<Penetration::Touch> touches) {
  check_size({"nearest_free", "pair", pairs.size()}, out.size(), "answers");
  if (!touches.empty()) check_size({"nearest_free", "pair", pairs.size()}, touches.size(), "touches");
}

}  // namespace

void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted,
                  std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_sizes(pairs, out, touches);
  const Implementation& implementation = chosen(wanted, "nearest_free");
  require_valid(implementation, bodies.view().ground, agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  answer_pairs(SphereSource(bodies.view(), agents, implementation), pairs, axes, out, touches);
}

void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const CollideOptions& options,
                  std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_sizes(pairs, out, touches);
  const bool exact = exact_leaves(shapes, options.leaves, "nearest_free");
  const Implementation& implementation = chosen(options.implementation, "nearest_free");
  require_valid(implementation, shapes.view(), agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  answer_pairs(OutlineSource(shapes, agents, implementation, exact), pairs, axes, out, touches);
}

}  // namespace bch
