// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <optional>

#include <bch/obstacles.hpp>
#include <bch/time_of_impact.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/calls.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/obstacles.hpp"

struct bch_moment_set {
  bch_moment_set(std::span<const bch::AnimatedShape* const> bodies, const bch::ShapeSetPlan& plan)
      : moments(bodies, plan) {}

  bch::MomentSet moments;
  std::unique_ptr<bch_shape_set> lent;  ///< the shapes that were shown last, once somebody asked for them
};

namespace bch::c_api {
namespace {

/// Ends a loan.
void take_loan_back(bch_moment_set& set) {
  if (set.lent) registry::end_loan(set.lent.get());
  set.lent.reset();
}

Motion motion_of(const bch_motion& given, const std::string& argument) {
  const auto name = [&](const char* member) { return argument + member; };
  return {&object_of(given.shape, name(".shape").c_str()).shape,
          same_array<PathKey>(given.path, given.path_count, name(".path").c_str()), given.clip_begin};
}

std::vector<Motion> motions_of(const bch_motion* motions, std::size_t count, const char* argument) {
  std::vector<Motion> all;
  for (const bch_motion& each : array_of(motions, count, argument))
    all.push_back(motion_of(each, std::string(argument) + "[" + std::to_string(all.size()) + "]"));
  return all;
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_moment_set_create(const bch_animated_shape* const* bodies, size_t count, const bch_plan* plan,
                                 bch_moment_set** set) {
  return guarded([&] {
    required(set, "set");
    std::vector<const AnimatedShape*> of;
    for (const bch_animated_shape* const body : array_of(bodies, count, "bodies"))
      of.push_back(&object_of(body, "a body of bodies").shape);
    hand_out(std::make_unique<bch_moment_set>(of, plan_of(plan)), set);
  });
}

bch_status bch_moment_set_show(bch_moment_set* handle, const uint32_t* body, const double* seconds,
                               size_t count, const bch_work* given, uint32_t* shapes) {
  return guarded([&] {
    bch_moment_set& set = object_of(handle, "set");
    const auto bodies = array_of(body, count, "body");
    const auto times = array_of(seconds, count, "seconds");
    const auto to = array_of(shapes, count, "shapes");
    const bch_work work = sized<bch_work>(given, BCH_WORK_INIT, "work");
    std::vector<uint32_t> shown(count);
    take_loan_back(set);  // the set may move even where memory runs out
    on_threads(work.threads, [&] { set.moments.show(bodies, times, shown); });
    std::copy(shown.begin(), shown.end(), to.begin());
  });
}

bch_status bch_moment_set_get_shapes(bch_moment_set* handle, const bch_shape_set** shapes) {
  return guarded([&] {
    bch_moment_set& set = object_of(handle, "set");
    required(shapes, "shapes");
    if (!set.lent) {
      auto lent = std::make_unique<bch_shape_set>(set.moments.set());
      registry::lend(lent.get(), kind_of(lent.get()));
      set.lent = std::move(lent);
    }
    *shapes = set.lent.get();
  });
}

bch_status bch_moment_set_free(bch_moment_set* set) {
  return guarded([&] {
    if (const auto taken = take_back(set, "set")) take_loan_back(*taken);
  });
}

bch_status bch_first_contact(const bch_motion* motions, size_t motion_count, const bch_pair* pairs,
                             size_t count, double from, double to, double tolerance, uint32_t threads,
                             double* times) {
  return guarded([&] {
    const std::vector<Motion> all = motions_of(motions, motion_count, "motions");
    const auto asked = same_array<Pair>(pairs, count, "pairs");
    const auto answers = array_of(times, count, "times");
    all_or_none(answers, [&](std::span<double> into) {
      on_threads(threads, [&] { first_contact(all, asked, {from, to}, into, tolerance); });
    });
  });
}

bch_status bch_obstacles_first_contact(const bch_motion* motions, size_t motion_count,
                                       const bch_obstacles* obstacles, double from, double to,
                                       double tolerance, uint32_t threads, double* times) {
  return guarded([&] {
    const std::vector<Motion> all = motions_of(motions, motion_count, "motions");
    const ObstacleSet& walls = object_of(obstacles, "obstacles").set;
    all_or_none(array_of(times, motion_count, "times"), [&](std::span<double> into) {
      on_threads(threads, [&] { first_contact(all, walls, {from, to}, into, tolerance); });
    });
  });
}

bch_status bch_free_until(const bch_motion* motion, const bch_motion* others, size_t count, double from,
                          double to, double tolerance, double* time) {
  return guarded([&] {
    required(time, "time");
    const Motion own = motion_of(required(motion, "motion"), "motion");
    *time = free_until(own, motions_of(others, count, "others"), {from, to}, tolerance);
  });
}
