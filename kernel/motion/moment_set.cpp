// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/shape_set_builder.hpp>
#include <bch/time_of_impact.hpp>

#include "kernel/motion/moment_table.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/shortest.hpp"
#include "layout/shape_set/animated_tree.hpp"
#include "layout/shape_set/moment_flattener.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr const char* query = "moments";
constexpr std::size_t moments_a_task = 8;
constexpr double largest_time = 1e6;  ///< seconds

/// Returns the moment with the most discs.
Moment largest_moment(std::span<const AnimatedShape* const> bodies) {
  Moment largest{0, bodies[0]->begin()};
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (const AnimatedTreeChunk& chunk : bodies[i]->tree().chunks)
      if (chunk.nodes() > most)
        most = chunk.nodes(), largest = {i, std::midpoint(chunk.times.front(), chunk.times.back())};
  }
  return largest;
}

}  // namespace

struct MomentSet::State {
  State(std::span<const AnimatedShape* const> of, const ShapeSetPlan& with, std::size_t least)
      : plan(with), kept(least), set(ShapeSetBuilder(plan).finish()), flattener(of, plan), memories([this] {
          return MomentFlattener::Memory(plan);
        }) {}

  void require_valid(std::span<const std::uint32_t> body, std::span<const double> seconds,
                     std::size_t shapes) const;
  Moment moment(std::uint32_t body, double seconds) const;
  void find(std::span<const std::uint32_t> body, std::span<const double> seconds,
            std::span<std::uint32_t> shapes);
  bool give_places();
  void grow();
  void make();

  const PreparedShape& flatten(const Moment& moment, std::uint32_t place) {
    return flattener.flatten(moment.body, moment.seconds, place, memories.local());
  }

  ShapeSetPlan plan;
  std::size_t kept;
  DynamicShapeSet set;
  MomentFlattener flattener;
  tbb::enumerable_thread_specific<MomentFlattener::Memory> memories;
  std::size_t places = 0;            ///< shapes of the set
  std::size_t oldest = 0;            ///< the place to give next
  std::vector<Moment> moments;       ///< that of each place; in show(), then those that are new
  std::vector<std::uint8_t> shown;   ///< per place
  std::vector<std::uint32_t> given;  ///< per new moment, its place
  std::vector<std::uint8_t> outgrown;
  MomentTable table;
};

void MomentSet::State::require_valid(std::span<const std::uint32_t> body, std::span<const double> seconds,
                                     std::size_t shapes) const {
  const Asked asked{query, "agent", body.size()};
  require_as_many(asked, seconds.size(), "seconds");
  require_as_many(asked, shapes, "shapes");
  const auto reject = [](std::size_t agent, const std::string& why) {
    throw std::invalid_argument(std::string(query) + ": agent " + std::to_string(agent) + ": " + why);
  };
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (const std::size_t bodies = flattener.bodies().size(); body[i] >= bodies)
      reject(i, "body " + std::to_string(body[i]) + " of " + std::to_string(bodies));
    if (!(std::abs(seconds[i]) <= largest_time))
      reject(i, "at " + shortest(seconds[i]) + " s, not within +-1e6");
  }
}

Moment MomentSet::State::moment(std::uint32_t body, double seconds) const {
  const AnimatedTree& tree = flattener.bodies()[body]->tree();
  return {body, std::clamp(time_in_clip(tree, seconds), tree.begin(), tree.end()) + 0.0};
}

/// Writes the place of each agent's moment in the list, behind the places where it is new.
void MomentSet::State::find(std::span<const std::uint32_t> body, std::span<const double> seconds,
                            std::span<std::uint32_t> shapes) {
  moments.resize(places);
  shown.assign(places, 0);
  table.clear(places + body.size());
  for (std::uint32_t i = 0; i < places; ++i)
    if (moments[i].body != Moment::nobody) table.add(i, moments);
  for (std::size_t i = 0; i < body.size(); ++i) {
    shapes[i] = table.place(moment(body[i], seconds[i]), moments);
    if (shapes[i] < places) shown[shapes[i]] = 1;
  }
}

/// Gives each new moment a place whose moment nobody shows, from that on which has been there longest.
/// Returns: whether there are enough.
bool MomentSet::State::give_places() {
  const std::size_t fresh = moments.size() - places;
  given.clear();
  for (std::size_t seen = 0; seen < places && given.size() < fresh; ++seen) {
    if (shown[oldest] == 0) given.push_back(static_cast<std::uint32_t>(oldest));
    oldest = oldest + 1 < places ? oldest + 1 : 0;
  }
  return given.size() == fresh;
}

/// Makes room for all moments of this call, and half as many: places in which the largest one fits. None is there any more.
void MomentSet::State::grow() {
  const std::size_t needed =
      moments.size() - static_cast<std::size_t>(std::count(shown.begin(), shown.end(), 0));
  const std::size_t room = std::max({needed, places + places / 2, kept});
  ShapeSetBuilder builder(plan, room);
  const PreparedShape& prepared = flatten(largest_moment(flattener.bodies()), 0);
  for (std::size_t i = 0; i < room; ++i) builder.add(prepared);
  DynamicShapeSet larger(std::move(builder).finish());
  moments.assign(room, {});
  set = std::move(larger);
  places = room, oldest = 0;
}

/// Makes the new moments. Until they are there their places are nobody's, in case that memory runs out.
void MomentSet::State::make() {
  for (const std::uint32_t place : given) moments[place].body = Moment::nobody;
  outgrown.assign(given.size(), 0);
  const auto made = [&](std::size_t i) -> const PreparedShape& {
    return flatten(moments[places + i], given[i]);
  };
  for_ranges(given.size(), moments_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) outgrown[i] = !set.try_replace(given[i], made(i));
  });
  for (std::size_t i = 0; i < given.size(); ++i)
    if (outgrown[i] != 0) set.replace(given[i], made(i));
  for (std::size_t i = 0; i < given.size(); ++i) moments[given[i]] = moments[places + i];
}

MomentSet::MomentSet(std::span<const AnimatedShape* const> bodies, const ShapeSetPlan& plan,
                     std::size_t kept) {
  if (bodies.empty()) throw std::invalid_argument(std::string(query) + ": no bodies");
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i] == nullptr)
      throw std::invalid_argument(std::string(query) + ": body " + std::to_string(i) + " is missing");
  state_ = std::make_unique<State>(bodies, plan, kept);
}
MomentSet::MomentSet(MomentSet&&) noexcept = default;
MomentSet& MomentSet::operator=(MomentSet&&) noexcept = default;
MomentSet::~MomentSet() = default;

void MomentSet::show(std::span<const std::uint32_t> bodies, std::span<const double> seconds,
                     std::span<std::uint32_t> shapes) {
  State& state = *state_;
  const FloatingPointStateGuard floats;
  state.require_valid(bodies, seconds, shapes.size());
  without_tasks_from_outside([&] {
    state.find(bodies, seconds, shapes);
    if (!state.give_places()) {
      state.grow();
      state.find(bodies, seconds, shapes);
      state.give_places();
    }
    state.make();
  });
  for (std::uint32_t& shape : shapes)
    if (shape >= state.places) shape = state.given[shape - state.places];
}

const ShapeSet& MomentSet::set() const noexcept {
  return state_->set.set();
}

}  // namespace bch
