// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/crowd_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/distributed/agent_validation.hpp"
#include "kernel/distributed/agreement.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

/// What a pair weighs, and an agent 1 more than the pairs that it counts for: those who meet nobody are to be shared out as well.
constexpr std::uint64_t pair_weight = 32;
constexpr double max_squares = 16;  ///< that a reach may span

std::vector<double> radii_of(const ShapeSet& shapes) {
  std::vector<double> radii;
  for (std::uint32_t shape = 0; shape < shapes.shape_count(); ++shape)
    radii.push_back(shapes.bounding_radius(shape));
  return radii;
}

double largest(const std::vector<double>& radii) {
  return radii.empty() ? 0 : *std::ranges::max_element(radii);
}

/// How near an agent and any other may have to be examined, by the agent's shape. Enlarged by more than what is rounded in
/// comparing positions with squares, and by more than the broad phase's margins.
std::vector<double> reaches(const std::vector<double>& radii, double margin) {
  std::vector<double> metres;
  metres.reserve(radii.size());
  for (const double radius : radii) metres.push_back((radius + largest(radii) + margin) * (1 + 1e-5) + 1e-5);
  return metres;
}

MPI_Comm with_threads(MPI_Comm comm) {
  int provided;
  MPI_Query_thread(&provided);
  require_threads(provided);
  return comm;
}

}  // namespace

CrowdState::CrowdState(MPI_Comm of, const ShapeSet& set, std::vector<DistributedCrowd::Agent> mine,
                       const DistributedCrowdOptions& how)
    : CrowdState(of, false, std::move(mine), how) {
  baked = &set;
  agree(comm.get(), [&] {
    radii = radii_of(set);
    prepare(set.has_heights());
  });
}

CrowdState::CrowdState(MPI_Comm of, std::span<const Character> characters, const ShapeSetPlan& plan,
                       std::vector<DistributedCrowd::Agent> mine, const DistributedCrowdOptions& how)
    : CrowdState(of, true, std::move(mine), how) {
  agree(comm.get(), [&] {
    for (const Character& character : characters) validate(character);
    posed.emplace(characters, plan);
    const std::vector<DistributedCrowd::Agent> samples = sampled_agents(characters);
    posed->add(samples);
    radii = posed->radii(samples);
    prepare(plan.heights);
  });
}

CrowdState::CrowdState(MPI_Comm of, bool poses, std::vector<DistributedCrowd::Agent> mine,
                       const DistributedCrowdOptions& how)
    : comm(with_threads(of)),
      whole(true, poses),
      copied(how.heights, poses),
      options(how),
      agents(std::move(mine)) {}

std::int32_t CrowdState::ring() const {
  return static_cast<std::int32_t>(std::ceil(largest(reach) / side));
}

std::uint64_t CrowdState::agent_weight() const {
  return 1 + static_cast<std::uint64_t>(options.agent_pairs * static_cast<double>(pair_weight));
}

void CrowdState::prepare(bool has_heights) {
  if (!(options.cell >= 0 && options.cell <= 1e6))
    throw std::invalid_argument("crowd: expected a cell of 0 to 1e6 m, found " + shortest(options.cell));
  if (!(options.imbalance >= 1))
    throw std::invalid_argument("crowd: expected an imbalance of at least 1, found " +
                                shortest(options.imbalance));
  if (!(options.agent_pairs >= 0 && options.agent_pairs <= 1000))
    throw std::invalid_argument("crowd: expected an agent to count as 0 to 1000 pairs, found " +
                                shortest(options.agent_pairs));
  if (options.heights && !has_heights)
    throw std::invalid_argument("crowd: expected a set that knows heights of bodies, as agents have heights");
  side = std::max(1.0, options.cell > 0 ? options.cell : 4 * largest(radii));
}

void CrowdState::require_margin(double wanted) const {
  if (wanted >= 0 && largest(radii) * 2 + wanted <= max_squares * side) return;
  throw std::invalid_argument(
      "update: expected a margin of at least 0 m and, with the largest radii, at most " +
      shortest(max_squares) + " squares of " + shortest(side) + " m, found " + shortest(wanted));
}

void CrowdState::visit_agents() const {
  for (const DistributedCrowd::Agent& agent : agents) {
    require_valid(agent, options.heights);
    if (posed)
      require_valid(agent, *posed);
    else
      require_valid(agent, *baked);
  }
}

void CrowdState::sort_agents() {
  if (!std::ranges::is_sorted(agents, {}, &DistributedCrowd::Agent::id))
    std::ranges::sort(agents, {}, &DistributedCrowd::Agent::id);
}

void CrowdState::update(double apart) {
  counters.cut_seconds = counters.migration_seconds = counters.halo_seconds = counters.poses_seconds = 0;
  agree(comm.get(), [&] {
    visit_agents(), sort_agents();
    if (!posed) learn_reach(apart);
  });
  cut_where_unbalanced();
  migrate();
  if (posed) make_own_poses(apart);
  exchange_halo();
  fill_columns();
  pairs.clear();
  counters.agents = agents.size();
  counters.halo = halo.size();
}

/// Makes the shapes of the rank's own agents. How far those of all ranks reach, character by character, says who needs copies.
void CrowdState::make_own_poses(double apart) {
  const Stopwatch watch(counters.poses_seconds);
  agree(comm.get(), [&] {
    without_tasks_from_outside([&] {
      posed->clear();
      posed->add(agents);
      radii = posed->radii(agents);
    });
  });
  MPI_Allreduce(MPI_IN_PLACE, radii.data(), static_cast<int>(radii.size()), MPI_DOUBLE, MPI_MAX, comm.get());
  agree(comm.get(), [&] { learn_reach(apart); });
}

void CrowdState::learn_reach(double apart) {
  require_margin(apart);
  const std::int32_t before = ring();
  reach = reaches(radii, apart);
  margin = apart;
  if (ring() != before) owners.reset(cut, ring());
}

void CrowdState::fill_columns() {
  agree(comm.get(), [&] {
    columns.assign(agents, halo, options.heights);
    if (!posed) return;
    const Stopwatch watch(counters.poses_seconds);
    without_tasks_from_outside([&] { posed->add(halo); });
    columns.number_shapes(agents.size());
    counters.poses = columns.id.size();
  });
}

/// Weighs the agents of the last update, where they stood then; before the first one, all agents alike.
std::vector<Weight> CrowdState::weights() const {
  std::vector<Weight> all;
  all.reserve(std::max(agents.size(), columns.id.size()));
  if (counters.cuts == 0) {
    for (const DistributedCrowd::Agent& agent : agents)
      all.push_back({curve_key(cell_at(agent.x, agent.y, side)), 1});
    return all;
  }
  for (std::size_t i = 0; i < columns.id.size(); ++i)
    all.push_back({curve_key(cell_at(columns.x[i], columns.y[i], side)), columns.is_own[i] * agent_weight()});
  for (const Pair& pair : pairs) all[pair.first].weight += pair_weight;
  return all;
}

void CrowdState::cut_where_unbalanced() {
  const Stopwatch watch(counters.cut_seconds);
  std::uint64_t most =
      pairs.empty() ? 0 : pair_weight * pairs.size() + (agent_weight() - 1) * counters.agents;
  std::uint64_t sum = most;
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_UINT64_T, MPI_MAX, comm.get());
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, comm.get());
  const double parts = comm.size();
  counters.imbalance = sum == 0 ? 1 : static_cast<double>(most) * parts / static_cast<double>(sum);
  if (counters.cuts > 0 && counters.imbalance <= options.imbalance * promised) return;
  std::vector<Weight> mine;
  agree(comm.get(), [&] { mine = weights(); });
  cut = cut_evenly(comm.get(), std::move(mine), promised);
  ++counters.cuts;
  graph.reset();
  agree(comm.get(), [&] { owners.reset(cut, ring()); });
}

/// Takes the agents that stand on others' squares away from this rank's.
Outbox CrowdState::leaving() {
  std::vector<std::int32_t> owner(agents.size());
  Outbox out{{}, std::vector<int>(index(comm.size()), 0)};
  for (std::size_t i = 0; i < agents.size(); ++i) {
    owner[i] = owners[cell_at(agents[i].x, agents[i].y, side)].rank;
    if (owner[i] != comm.rank()) ++out.counts[index(owner[i])];
  }
  std::vector<std::size_t> place(out.counts.size() + 1, 0);
  for (std::size_t rank = 0; rank < out.counts.size(); ++rank)
    place[rank + 1] = place[rank] + static_cast<std::size_t>(out.counts[rank]);
  out.agents.resize(place.back());
  std::size_t stay = 0;
  for (std::size_t i = 0; i < agents.size(); ++i)
    (owner[i] == comm.rank() ? agents[stay++] : out.agents[place[index(owner[i])]++]) = agents[i];
  agents.resize(stay);
  return out;
}

void CrowdState::migrate() {
  const Stopwatch watch(counters.migration_seconds);
  counters.arrived = counters.migration_bytes = 0;
  if (comm.size() == 1) return;
  Outbox out;
  agree(comm.get(), [&] { out = leaving(); });
  const auto stayed = static_cast<std::ptrdiff_t>(agents.size());
  exchange_with_all(comm, whole, out, agents);
  agree(comm.get(), [&] {
    const auto arrived = agents.begin() + stayed;
    std::ranges::sort(arrived, agents.end(), {}, &DistributedCrowd::Agent::id);
    std::ranges::inplace_merge(agents, arrived, {}, &DistributedCrowd::Agent::id);
  });
  counters.arrived = agents.size() - static_cast<std::size_t>(stayed);
  counters.migration_bytes = out.agents.size() * whole.bytes();
}

/// Collects the copies that others need, rank by rank.
Outbox CrowdState::copies() {
  std::vector<Copy> all;
  find_copies(agents, {reach, side, comm.rank()}, owners, all);
  std::ranges::stable_sort(all, {}, &Copy::rank);
  Outbox out{{}, std::vector<int>(index(comm.size()), 0)};
  for (const Copy& copy : all) {
    out.agents.push_back(agents[copy.agent]);
    ++out.counts[index(copy.rank)];
  }
  return out;
}

void CrowdState::exchange_halo() {
  const Stopwatch watch(counters.halo_seconds);
  halo.clear();
  if (comm.size() == 1) return;
  Outbox out;
  std::vector<char> receivers;
  agree(comm.get(), [&] {
    out = copies();
    for (const int count : out.counts) receivers.push_back(count > 0);
  });
  graph.include(comm, receivers);
  std::vector<int> counts;
  for (const int rank : graph.ranks()) counts.push_back(out.counts[index(rank)]);
  out.counts = counts;
  graph.exchange(comm, copied, out, halo);
  std::ranges::sort(halo, {}, &DistributedCrowd::Agent::id);
  counters.halo_bytes = out.agents.size() * copied.bytes();
  counters.neighbours = static_cast<std::uint32_t>(graph.ranks().size());
}

void CrowdState::find_pairs(double apart) {
  counters.pairs_seconds = counters.answer_seconds = 0;
  const Stopwatch watch(counters.pairs_seconds);
  keep_owned(columns, broad_phase.find(shapes().view(), columns.agents(), apart), pairs);
  counters.pairs = pairs.size();
}

}  // namespace bch::detail
