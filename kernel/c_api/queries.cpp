// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include "kernel/c_api/calls.hpp"

using namespace bch;
using namespace bch::c_api;

const char* bch_implementation_name(uint32_t i) {
  return i < implementations().size() ? implementations()[i].name : nullptr;
}

int32_t bch_implementation_supported(uint32_t i) {
  return i < implementations().size() && implementations()[i].supported() ? 1 : 0;
}

bch_status bch_set_executor(bch_run_tasks run, void* user, uint32_t threads) {
  return guarded([&] { Executor::set({run, user, threads}); });
}

bch_status bch_validate_agents(const bch_shape_set* set, const bch_agents* agents) {
  return guarded([&] { validate(object_of(set, "set").set, agents_of(agents)); });
}

bch_status bch_collide(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                       size_t count, const bch_query_options* options, uint8_t* hits) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const auto to = array_of(hits, count, "hits");
    call.run([&] { collide(call.shapes, call.agents, call.pairs, to, call.options); });
  });
}

bch_status bch_within(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs, size_t count,
                      const double* distances, size_t distance_count, const bch_query_options* options,
                      uint8_t* answers) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const auto near = array_of(distances, distance_count, "distances");
    const auto to = array_of(answers, count, "answers");
    call.run([&] { within(call.shapes, call.agents, call.pairs, near, to, call.options); });
  });
}

bch_status bch_clearance(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                         size_t count, const bch_query_options* options, const bch_clearance_out* out) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const ClearanceAnswers to = clearance_answers(out, count);
    call.run([&] { clearance(call.shapes, call.agents, call.pairs, to, call.options); });
  });
}

bch_status bch_penetration(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                           size_t count, uint32_t directions, const bch_query_options* options,
                           bch_penetration_depth* depths) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const auto to = penetrations(depths, count);
    call.run([&] { penetration(call.shapes, call.agents, call.pairs, directions, to, call.options); });
  });
}

bch_status bch_nearest_free(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                            size_t count, uint32_t directions, const bch_query_options* options,
                            bch_penetration_depth* depths, bch_touch* touches) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const auto to = penetrations(depths, count);
    const auto ends = touches_of(touches, count);
    call.run([&] { nearest_free(call.shapes, call.agents, call.pairs, directions, to, call.options, ends); });
  });
}

bch_status bch_penetration_along(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                                 size_t count, const bch_vec2* directions, const bch_query_options* options,
                                 bch_penetration_depth* depths) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const auto along = same_array<Vec2>(directions, count, "directions");
    const auto to = penetrations(depths, count);
    call.run([&] { penetration_along(call.shapes, call.agents, call.pairs, along, to, call.options); });
  });
}

bch_status bch_time_of_impact(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                              size_t count, const double* x, const double* y,
                              const bch_query_options* options, float* times) {
  return guarded([&] {
    const PairCall call(set, agents, pairs, count, options);
    const Displacements displacements{array_of(x, count, "x"), array_of(y, count, "y")};
    const auto to = array_of(times, count, "times");
    call.run([&] { time_of_impact(call.shapes, call.agents, call.pairs, displacements, to, call.options); });
  });
}
