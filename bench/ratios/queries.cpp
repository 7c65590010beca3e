// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <bch/crowd.hpp>
#include <bch/obstacles.hpp>
#include <bch/pairs.hpp>

#include "baselines/clearance_reference.hpp"
#include "baselines/contact_reference.hpp"
#include "baselines/pair_distances.hpp"
#include "baselines/penetration_reference.hpp"
#include "baselines/reference.hpp"
#include "baselines/segment_clearance.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "bench/ratios/ratios.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/base/heading.hpp"

// Each query other than collide() is a struct with the same members:
//   run_query()            asks the kernel for all pairs
//   search(i, ...)   asks the reference for a pair: a scalar search with the same pruning, or brute force
//   is_right(i, ...) compares the kernel's last answer for a pair with that

namespace bch::bench {
namespace {

using baselines::Method;

constexpr double personal_space = 0.1;  ///< metres, that within() asks for
constexpr double walking_speed = 1.3;   ///< metres a second, along the heading
constexpr double walking_time = 0.5;    ///< seconds
constexpr std::uint32_t penetration_directions = 16;
constexpr float of_leaf_discs = 0.04f;  ///< metres, by which outlines may be farther apart than their discs

/// What is asked, and of whom.
struct Question {
  Scene& scene;
  const Workload& workload;
  Agents agents = workload.agents();
  std::span<const Pair> pairs = workload.pairs;
  baselines::Reference collisions;

  Question(Scene& in, const Workload& of, Leaves leaves = Leaves::discs)
      : scene(in), workload(of), collisions(scene.shapes(), {}, leaves) {}

  /// Returns whether a pair collides, also by one inside the other, which no search for distances sees.
  bool collide(std::size_t i) const { return collisions.solid(agents, pairs[i], Method::depth_first); }
};

/// clearance(), with directions.
struct ClearanceQuery : Question {
  using Question::Question;
  std::vector<float> distance = std::vector<float>(pairs.size());
  std::vector<Vec2> direction = std::vector<Vec2>(pairs.size());
  baselines::ClearanceReference reference{scene.shapes(), {}};

  void run_query(detail::AllOptions options) {
    options.max_distance = clearance_limit;
    clearance(scene.set(), agents, pairs, {distance, direction}, options);
  }
  auto search(std::size_t i, Method method) {
    const auto found = at_least_zero(reference.query(agents, pairs[i], clearance_limit, method));
    return std::pair{found.distance, found.direction};
  }
  bool is_right(std::size_t i, Method method) {
    return (collide(i) ? std::pair{0.0f, Vec2{}} : search(i, method)) == std::pair{distance[i], direction[i]};
  }
};

/// The same with exact leaves. All answers are compared with those of discs, and one in 64 with brute force over
/// all segments.
struct ExactClearanceQuery : ClearanceQuery {
  ExactClearanceQuery(Scene& in, const Workload& of) : ClearanceQuery(in, of, Leaves::segments) {}
  std::vector<float> of_discs = distances_of_discs();
  baselines::SegmentClearance segments{scene.shapes(), {}};

  std::vector<float> distances_of_discs() {
    std::vector<float> all(pairs.size());
    clearance(scene.set(), agents, pairs, {all, direction});
    return all;
  }
  void run_query(detail::AllOptions options) {
    options.distance_leaves = Leaves::segments;
    ClearanceQuery::run_query(options);
  }
  bool is_right(std::size_t i, Method) {
    const float least = of_discs[i], most = least + of_leaf_discs;
    const bool may_be_beyond = std::isinf(distance[i]) && most > static_cast<float>(clearance_limit);
    if (!may_be_beyond && !(distance[i] >= least - 1e-5f && distance[i] <= most)) return false;
    if (i % 64 != 0) return true;
    const auto found = segments.distance(agents, pairs[i], clearance_limit);
    return (collide(i) ? 0 : found.value_or(distance[i])) == distance[i];
  }
};

struct WithinQuery : Question {
  using Question::Question;
  Hits hits = Hits(pairs.size());
  baselines::ClearanceReference reference{scene.shapes(), {}};

  void run_query(const detail::AllOptions& options) {
    within(scene.set(), agents, pairs, {&personal_space, 1}, hits, options);
  }
  bool search(std::size_t i, Method method) {
    return reference.within(agents, pairs[i], personal_space, method);
  }
  bool is_right(std::size_t i, Method method) { return hits[i] == (collide(i) || search(i, method)); }
};

/// All walk where they are heading.
struct TimeOfImpactQuery : Question {
  std::vector<double> x, y;  ///< relative displacements of pairs
  std::vector<float> times = std::vector<float>(pairs.size());
  baselines::TimeOfImpactReference reference{scene.shapes(), {}};

  TimeOfImpactQuery(Scene& in, const Workload& of) : Question(in, of) {
    for (const auto& [first, second] : pairs) {
      const detail::Rotation a = detail::rotation(agents.heading[first]),
                             b = detail::rotation(agents.heading[second]);
      x.push_back(walking_speed * walking_time * (a.cosine - b.cosine));
      y.push_back(walking_speed * walking_time * (a.sine - b.sine));
    }
  }
  void run_query(const detail::AllOptions& options) {
    time_of_impact(scene.set(), agents, pairs, {x, y}, times, options);
  }
  float search(std::size_t i, Method method) { return reference.query(agents, pairs[i], x[i], y[i], method); }
  bool is_right(std::size_t i, Method method) { return times[i] == (collide(i) ? 0 : search(i, method)); }
};

struct ContactsQuery : Question {
  using Question::Question;
  bch::Crowd finder;
  Rows<DiscPair> rows;
  baselines::CutLists cuts{scene.shapes(), {}};

  void run_query(const detail::AllOptions& options) {
    rows = finder.contacts(scene.set(), agents, pairs,
                           {.implementation = options.implementation, .leaves = Leaves::discs});
  }
  auto search(std::size_t i, Method) { return baselines::contacts(cuts, agents, pairs[i]); }
  bool is_right(std::size_t i, Method method) {
    return std::ranges::equal(rows[i], search(i, method), [](const DiscPair& own, const auto& other) {
      return own.first == other.first && own.second == other.second;
    });
  }
};

struct PenetrationQuery : Question {
  using Question::Question;
  std::vector<Penetration> depths = std::vector<Penetration>(pairs.size());
  baselines::CutLists cuts{scene.shapes(), {}};

  void run_query(const detail::AllOptions& options) {
    penetration(scene.set(), agents, pairs, penetration_directions, depths, options);
  }
  auto search(std::size_t i, Method) {
    return baselines::penetration(cuts, agents, pairs[i], penetration_directions);
  }
  bool is_right(std::size_t i, Method method) {
    const auto [depth, x, y] = search(i, method);
    return depths[i] == Penetration{depth, x, y};
  }
};

/// nearest_free(), with the leaves that collide() has by default.
struct NearestFreeQuery : Question {
  std::vector<Penetration> moves = std::vector<Penetration>(pairs.size());

  NearestFreeQuery(Scene& in, const Workload& of) : Question(in, of, Leaves::segments) {}
  void run_query(const detail::AllOptions& options) {
    nearest_free(scene.set(), agents, pairs, penetration_directions, moves,
                 {.implementation = options.implementation, .leaves = Leaves::segments});
  }
  bool is_right(std::size_t i, Method) const { return (moves[i].depth > 0) == collide(i); }
};

/// nearest_free() of each agent out of all others that it is paired with, at once.
struct FreeOfAllQuery : Question {
  std::vector<Pair> both_ways{pairs.begin(), pairs.end()};
  std::vector<Penetration> moves = std::vector<Penetration>(agents.size());

  FreeOfAllQuery(Scene& in, const Workload& of) : Question(in, of, Leaves::segments) {
    for (const auto& [first, second] : pairs) both_ways.push_back({second, first});
  }
  void run_query(const detail::AllOptions& options) {
    nearest_free(scene.set(), agents, both_ways, nullptr, penetration_directions, moves,
                 {.implementation = options.implementation, .leaves = Leaves::segments});
  }
  bool is_right(std::size_t i, Method) const {
    const bool both = moves[pairs[i].first].depth > 0 && moves[pairs[i].second].depth > 0;
    return both || !collide(i);
  }
};

/// Crowd::collisions() by agent. The reference of collide() serves for it.
struct CollisionsQuery : Question {
  using Question::Question;
  bch::Crowd finder;
  Rows<bch::Crowd::Neighbour> rows;
  const Hits& hits = scene.expected(Leaves::discs, workload);
  std::size_t neighbours = 2 * static_cast<std::size_t>(std::ranges::count(hits, 1));

  void run_query(const detail::AllOptions& options) {
    rows = finder
               .collisions(scene.set(), agents,
                           {.implementation = options.implementation, .leaves = Leaves::discs})
               .by_agent();
  }
  static bool has(std::span<const bch::Crowd::Neighbour> row, std::uint32_t agent) {
    return std::ranges::binary_search(row, agent, {}, &bch::Crowd::Neighbour::agent);
  }
  bool is_right(std::size_t i, Method) {
    const auto [first, second] = pairs[i];
    const bool hit = hits[i] != 0;
    return rows.values.size() == neighbours && has(rows[first], second) == hit &&
           has(rows[second], first) == hit;
  }
};

template <class Query>
void require_right(Query& query, Method method) {
  for (std::size_t i = 0; i < query.pairs.size(); ++i)
    if (!query.is_right(i, method))
      throw std::runtime_error(
          fmt::format("pair {} of {} is answered otherwise than by the reference", i, query.workload.name));
}

template <class Query>
Contender by_kernel(Scene& scene, const Workload& workload, const Implementation& implementation) {
  const auto query = std::make_shared<Query>(scene, workload);
  const auto call = [query, options = detail::AllOptions{.implementation = &implementation}] {
    query->run_query(options);
  };
  call();
  require_right(*query, Method::brute_force);
  return {call, workload.pairs.size()};
}

template <class Query>
Contender by_search(Scene& scene, const Workload& workload) {
  const auto query = std::make_shared<Query>(scene, workload);
  query->run_query({});
  require_right(*query, Method::depth_first);
  const auto call = [query] {
    for (std::size_t i = 0; i < query->pairs.size(); ++i)
      benchmark::DoNotOptimize(query->search(i, Method::depth_first));
  };
  return {call, workload.pairs.size()};
}

/// FCL's distances of the outlines, as walls or as one triangle a segment, which clearances bound.
Contender by_fcl(Scene& scene, const Workload& workload, bool walls) {
  const std::shared_ptr<const baselines::PairDistances> fcl =
      walls ? baselines::fcl_outline_distances(scene.bodies())
            : baselines::fcl_segment_distances(scene.bodies());
  const Agents agents = workload.agents();
  std::vector<float> least(workload.pairs.size());
  clearance(scene.set(), agents, workload.pairs, {least}, {.overlap = Overlap::deepest});
  for (std::size_t i = 0; i < least.size(); ++i) {
    const double found = std::max(0.0, fcl->query(agents, workload.pairs[i])), own = double{least[i]};
    if (!(found >= own - 1e-9 && found <= std::max(0.0, own) + double{of_leaf_discs}))
      throw std::runtime_error(
          fmt::format("pair {}: {} m by FCL where the clearance is {} m", i, found, own));
  }
  const auto call = [fcl, &workload, agents] {
    for (const Pair pair : workload.pairs) benchmark::DoNotOptimize(fcl->query(agents, pair));
  };
  return {call, workload.pairs.size()};
}

template <class Query, bool has_reference = true>
void add_query(Scene& scene, std::string_view query, std::string_view name) {
  for (const Implementation* implementation : supported_implementations())
    add_for_threads(fmt::format("{}/{}/{}", query, name, implementation->name),
                    [&scene, name, implementation] {
                      return by_kernel<Query>(scene, scene.workload(name), *implementation);
                    });
  if constexpr (has_reference)
    add(fmt::format("{}/{}/reference", query, name),
        [&scene, name] { return by_search<Query>(scene, scene.workload(name)); });
}

}  // namespace

void add_queries(Scene& scene) {
  for (const std::string_view name : workload_names()) {
    add_query<ClearanceQuery>(scene, "clearance", name);
    add_query<ExactClearanceQuery, false>(scene, "exact_clearance", name);
    add_query<WithinQuery>(scene, "within", name);
    add_query<TimeOfImpactQuery>(scene, "time_of_impact", name);
  }
  for (const std::string_view name : {"colliding", "crowd"}) {
    add_query<ContactsQuery>(scene, "contacts", name);
    add_query<PenetrationQuery>(scene, "penetration", name);
    add_query<NearestFreeQuery, false>(scene, "nearest_free", name);
  }
  add_query<FreeOfAllQuery, false>(scene, "nearest_free_of_all", "crowd");
  // Agents of pairs of their own stand anywhere, also in each other.
  add_query<CollisionsQuery, false>(scene, "collisions", "crowd");
  if (has_kind("fcl_obb_contour"))
    for (const bool walls : {true, false})
      add(walls ? "clearance/near_miss/fcl_walls" : "clearance/near_miss/fcl_segments",
          [&scene, walls] { return by_fcl(scene, scene.workload("near_miss"), walls); });
}

}  // namespace bch::bench
