// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/arguments.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "kernel/runtime/tasks.hpp"
#include "layout/base/shortest.hpp"

namespace bch::c_api {

void check_size(const void* given, std::size_t known, const char* argument) {
  uint32_t size;
  std::memcpy(&size, given, sizeof size);
  const auto* const bytes = static_cast<const unsigned char*>(given);
  const bool absurd = size < sizeof size || size > 4096;
  if (absurd || std::any_of(bytes + std::min<std::size_t>(size, known), bytes + size,
                            [](unsigned char b) { return b != 0; }))
    throw Failure(BCH_INVALID_ARGUMENT,
                  std::string(argument) + "->size is " + std::to_string(size) +
                      (absurd ? "; expected the size of the struct"
                              : "; expected 0 in members that this version does not know"));
}

void reject_cut(std::uint32_t size, const char* argument) {
  throw Failure(BCH_INVALID_ARGUMENT, std::string(argument) + "->size is " + std::to_string(size) +
                                          "; expected the end of a member");
}

void check_index(std::size_t index, std::size_t count, const char* argument) {
  if (index >= count)
    throw Failure(BCH_OUT_OF_RANGE,
                  std::string(argument) + " is " + std::to_string(index) + " of " + std::to_string(count));
}

void require_file(const char* path) {
  std::error_code error;
  static_cast<void>(std::filesystem::status(path, error));
  if (error == std::errc::no_such_file_or_directory)
    throw Failure(BCH_FILE_NOT_FOUND, std::string(path) + ": no such file");
}

Agents agents_of(const bch_agents* given) {
  const bch_agents agents = sized(&required(given, "agents"), bch_agents BCH_AGENTS_INIT, "agents");
  if (agents.numbers != BCH_DOUBLES && agents.numbers != BCH_FLOATS)
    throw Failure(BCH_INVALID_ARGUMENT, "agents->numbers is " + std::to_string(agents.numbers) +
                                            "; expected 0 (doubles) or 1 (floats)");
  const auto of = [&]<class Value>(const Value* values, std::size_t stride, const char* name) {
    array_of(values, agents.count, name);  // of any number, but not NULL
    return Strided<Value>(values, agents.count, stride == 0 ? sizeof(Value) : stride);
  };
  const auto numbers = [&](const void* values, std::size_t stride, const char* name) -> Numbers {
    if (agents.numbers == BCH_FLOATS) return of(static_cast<const float*>(values), stride, name);
    return of(static_cast<const double*>(values), stride, name);
  };
  Agents all{of(agents.shape, agents.shape_stride, "agents->shape"),
             numbers(agents.x, agents.x_stride, "agents->x"), numbers(agents.y, agents.y_stride, "agents->y"),
             numbers(agents.heading, agents.heading_stride, "agents->heading")};
  if (agents.heading_y != nullptr)
    all.heading =
        Headings(all.heading.x(), numbers(agents.heading_y, agents.heading_y_stride, "agents->heading_y"));
  if (agents.level != nullptr) all.level = of(agents.level, agents.level_stride, "agents->level");
  if (agents.z != nullptr) all.z = numbers(agents.z, agents.z_stride, "agents->z");
  return all;
}

ShapeSetPlan plan_of(const bch_plan* given) {
  const bch_plan plan = sized<bch_plan>(given, BCH_PLAN_INIT, "plan");
  ShapeSetPlan all{
      .outlines = plan.outlines != 0, .culling = plan.culling != 0, .heights = plan.heights != 0};
  const auto depths = array_of(plan.depths, plan.depth_count, "plan->depths");
  if (!depths.empty()) all.depths.assign(depths.begin(), depths.end());
  validate(all);
  return all;
}

float threshold_of(const bch_plan* given) {
  const float threshold = sized<bch_plan>(given, BCH_PLAN_INIT, "plan").threshold;
  if (!(threshold > 0 && threshold <= 1e6f))
    throw Failure(BCH_INVALID_ARGUMENT, "plan->threshold is " + detail::shortest(threshold) +
                                            "; expected above 0 and at most 1e6 m");
  return threshold;
}

CallOptions options_of(const bch_query_options* given) {
  const bch_query_options options = sized<bch_query_options>(given, BCH_QUERY_OPTIONS_INIT, "options");
  const detail::AllOptions query{
      .implementation = options.implementation == nullptr ? nullptr : &implementation(options.implementation),
      .leaves = one_of(options.leaves, Leaves::segments, "options->leaves"),
      .max_distance = options.max_distance,
      .overlap = one_of(options.overlap, Overlap::deepest, "options->overlap"),
      .distance_leaves = one_of(options.distance_leaves, Leaves::segments, "options->distance_leaves")};
  return {query, options.threads};
}

namespace {

constexpr std::uint32_t max_threads = 1024;

}  // namespace

void on_threads(std::uint32_t threads, const std::function<void()>& work) {
  if (threads == 0) return work();
  if (threads > max_threads)
    throw Failure(BCH_INVALID_ARGUMENT, "threads is " + std::to_string(threads) + "; expected at most " +
                                            std::to_string(max_threads));
  const auto run = [&](std::size_t, std::size_t) { work(); };
  detail::run_on_threads(threads, detail::RangeWork(run));
}

}  // namespace bch::c_api
