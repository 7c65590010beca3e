// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <optional>

#include <bch/motion.hpp>
#include <bch/obstacles.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/calls.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/obstacles.hpp"

namespace bch::c_api {
namespace {

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

bch_status bch_first_contact(const bch_motion* motions, size_t motion_count, const bch_pair* pairs,
                             size_t count, double from, double to, double tolerance, uint32_t threads,
                             double* times) {
  return guarded([&] {
    const std::vector<Motion> all = motions_of(motions, motion_count, "motions");
    const auto queried = same_array<Pair>(pairs, count, "pairs");
    const auto answers = array_of(times, count, "times");
    all_or_none(answers, [&](std::span<double> into) {
      on_threads(threads, [&] { first_contact(all, queried, {from, to}, into, tolerance); });
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
