// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <utility>

#include <bch/distributed_crowd.hpp>
#include <bch/pairs.hpp>

#include "kernel/distributed/agreement.hpp"
#include "kernel/distributed/crowd_state.hpp"
#include "kernel/distributed/resize.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch {

using namespace detail;

struct DistributedCrowd::State : CrowdState {
  using CrowdState::CrowdState;
};

DistributedCrowd::DistributedCrowd(MPI_Comm comm, const ShapeSet& shapes,
                                   std::vector<DistributedCrowd::Agent> agents,
                                   const DistributedCrowdOptions& options)
    : state_(std::make_unique<State>(comm, shapes, std::move(agents), options)) {}
DistributedCrowd::DistributedCrowd(MPI_Comm comm, std::span<const Character> characters,
                                   const ShapeSetPlan& plan, std::vector<DistributedCrowd::Agent> agents,
                                   const DistributedCrowdOptions& options)
    : state_(std::make_unique<State>(comm, characters, plan, std::move(agents), options)) {}
DistributedCrowd::DistributedCrowd(DistributedCrowd&&) noexcept = default;
DistributedCrowd& DistributedCrowd::operator=(DistributedCrowd&&) noexcept = default;
DistributedCrowd::~DistributedCrowd() = default;

std::vector<DistributedCrowd::Agent>& DistributedCrowd::agents() noexcept {
  return state_->agents;
}

std::span<const DistributedCrowd::Agent> DistributedCrowd::halo() const noexcept {
  return state_->halo;
}

void DistributedCrowd::update(double margin) {
  state_->update(margin);
}

std::span<const Pair> DistributedCrowd::collide_all(const CollideOptions& options) {
  State& state = *state_;
  agree(state.comm.get(), [&] {
    without_tasks_from_outside([&] {
      state.find_pairs(0);
      const Stopwatch watch(state.counters.answer_seconds);
      resize_with_spare(state.hits, state.pairs.size());
      collide(state.shapes(), state.columns.agents(), state.pairs, state.hits, options);
      keep_hits(state.columns, state.pairs, state.hits, state.colliding);
    });
  });
  return state.colliding;
}

std::span<const DistributedCrowd::Distance> DistributedCrowd::clearances(const ClearanceOptions& options) {
  State& state = *state_;
  agree(state.comm.get(), [&] {
    if (!(options.max_distance <= state.margin))
      throw std::invalid_argument(
          "clearances: expected a max_distance within the margin of the last update()");
    without_tasks_from_outside([&] {
      state.find_pairs(options.max_distance);
      const Stopwatch watch(state.counters.answer_seconds);
      resize_with_spare(state.metres, state.pairs.size());
      clearance(state.shapes(), state.columns.agents(), state.pairs, {.distance = state.metres}, options);
      keep_near(state.columns, state.pairs, state.metres, state.near);
    });
  });
  return state.near;
}

const DistributedCrowd::Counters& DistributedCrowd::counters() const noexcept {
  return state_->counters;
}

}  // namespace bch
