// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/workload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <bch/crowd.hpp>

#include "layout/base/heading.hpp"
#include "layout/base/plane_point.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr std::string_view names[] = {"colliding",  "near_miss", "no_hit",         "crowd",
                                      "candidates", "paper500",  "paper500_cached"};
constexpr double world = 100;                        ///< metres: where pairs with agents of their own stand
constexpr std::uint32_t max_candidates = 1'000'000;  ///< without one that is wanted

/// Returns the offset of a shape's root disc, turned by a heading.
detail::PlanePoint root_offset(const Shape& shape, double heading) {
  const Disc& disc = shape.hierarchy.nodes[0].disc;
  const double x = static_cast<double>(disc.x), y = static_cast<double>(disc.y);
  const detail::Rotation turn = detail::rotation(heading);
  return {turn.cosine * x - turn.sine * y, turn.sine * x + turn.cosine * y};
}

void add_candidate(detail::Random& random, std::span<const Shape> shapes, cli::Crowd& crowd) {
  const auto count = static_cast<std::uint32_t>(shapes.size());
  const std::uint32_t a = random.below(count), b = random.below(count);
  const double heading_a = random.uniform(2 * std::numbers::pi);
  const double heading_b = random.uniform(2 * std::numbers::pi);
  const detail::PlanePoint at{random.uniform(world), random.uniform(world)};
  const double angle = random.uniform(2 * std::numbers::pi);
  const double most = static_cast<double>(shapes[a].hierarchy.nodes[0].disc.radius) +
                      static_cast<double>(shapes[b].hierarchy.nodes[0].disc.radius);
  const double distance = most * std::sqrt(random.uniform(1));  // uniform over the area
  const detail::Rotation turn = detail::rotation(angle);
  const detail::PlanePoint from = root_offset(shapes[a], heading_a), to = root_offset(shapes[b], heading_b);
  add_agent(crowd, a, at.x, at.y, heading_a);
  add_agent(crowd, b, at.x + from.x + distance * turn.cosine - to.x,
            at.y + from.y + distance * turn.sine - to.y, heading_b);
}

}  // namespace

void add_agent(cli::Crowd& crowd, std::uint32_t shape, double x, double y, double heading) {
  crowd.shape.push_back(shape);
  crowd.x.push_back(x), crowd.y.push_back(y), crowd.heading.push_back(heading);
}

std::span<const std::string_view> workload_names() {
  return names;
}

Workload random_pairs(std::string_view name, std::uint64_t seed, std::span<const Shape> shapes,
                      std::uint32_t pairs, const std::function<bool(const Agents&, Pair)>& wanted) {
  Workload workload{std::string(name), {}, {}};
  workload.crowd.side = world;
  detail::Random random(seed);
  for (std::uint32_t in_vain = 0; workload.pairs.size() < pairs;) {
    if (in_vain++ == max_candidates)
      throw std::runtime_error(
          fmt::format("workload {}: of {} pairs at random after the first {} none is wanted", name,
                      max_candidates, workload.pairs.size()));
    const auto agent = static_cast<std::uint32_t>(workload.crowd.size());
    const Pair pair{agent, agent + 1};
    add_candidate(random, shapes, workload.crowd);
    if (wanted(workload.agents(), pair)) {
      workload.pairs.push_back(pair);
      in_vain = 0;
    } else {
      auto& [side, shape, x, y, heading, z] = workload.crowd;
      shape.resize(agent), x.resize(agent), y.resize(agent), heading.resize(agent);
    }
  }
  return workload;
}

Workload crowd_pairs(const ShapeSet& set, std::uint32_t agents, double margin) {
  Workload workload{margin > 0 ? "candidates" : "crowd",
                    cli::place_crowd(agents, agents_per_square_metre, set.shape_count(), crowd_seed),
                    {}};
  bch::Crowd finder;
  const bch::Crowd::Pairs pairs = finder.candidates(set, workload.agents(), margin);
  workload.pairs.assign(pairs.begin(), pairs.end());
  return workload;
}

Workload on_stairs(Workload workload) {
  constexpr double rise = 0.17, tread = 0.3;  // metres, of a staircase in a house
  for (const double x : workload.crowd.x) workload.crowd.z.push_back(rise * std::floor(x / tread));
  return workload;
}

Workload repeated(std::string_view name, const Workload& from, std::uint32_t cases, std::uint32_t pairs,
                  bool cached) {
  Workload workload{std::string(name), from.crowd, {}};
  cases = std::min(cases, static_cast<std::uint32_t>(from.pairs.size()));
  const std::uint32_t times = std::max(1u, pairs / cases);
  for (std::uint32_t i = 0; i < cases * times; ++i)
    workload.pairs.push_back(from.pairs[cached ? i / times : i % cases]);
  return workload;
}

}  // namespace bch::bench
