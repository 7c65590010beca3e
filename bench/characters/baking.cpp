// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/baking.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <utility>
#include <vector>

#include <bch/shape_set_builder.hpp>

#include "bench/base/progress.hpp"

namespace bch::cli {
namespace {

/// The number of shapes a thread that are being built or wait for one before them. It is large enough that
/// neither a slow pose nor writing a piece of a file, which takes as long as some twenty poses, makes the
/// other threads wait.
constexpr std::size_t shapes_in_flight = 64;

}  // namespace

ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                     double threshold, const ShapeSetPlan& plan,
                     const std::function<void(std::span<const float> nodes)>& added,
                     const CostLimits& limits) {
  ShapeSetBuilder builder(plan, sources.size());
  Progress progress("baking shapes", sources.size());
  tbb::enumerable_thread_specific<ShapeMaker> makers(
      [&] { return ShapeMaker(characters, threshold, plan, limits); });
  // Shape i waits in place i % n. They leave in order and no more than n are on their way, so that the place is free
  // again. Indices alone go from stage to stage: the pipeline never destroys what it holds when a stage throws.
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<PreparedShape> places;
  for (std::size_t i = 0; i < shapes_in_flight * threads; ++i) places.emplace_back(plan);
  std::size_t next = 0;
  const auto take = [&](tbb::flow_control& flow) -> std::size_t {
    if (next == sources.size()) flow.stop();
    return next++;
  };
  const auto build = [&](std::size_t i) -> std::size_t {
    places[i % places.size()].prepare(makers.local().make(sources[i]), i);
    return i;
  };
  // Adds shapes in the order of the sources: the bytes do not depend on the thread that built a shape.
  const auto add = [&](std::size_t i) {
    builder.add(places[i % places.size()]);
    if (added) added(builder.nodes());
    progress.advance();
  };
  tbb::parallel_pipeline(places.size(),
                         tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, take) &
                             tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, build) &
                             tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, add));
  return std::move(builder).finish();
}

ShapeOrigins origins_of(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                        double threshold) {
  ShapeOrigins origins{threshold, {}, {}};
  std::vector<std::uint32_t> first_name;  // of a character: its own, then those of its clips
  for (const LoadedCharacter& character : characters) {
    first_name.push_back(static_cast<std::uint32_t>(origins.names.size()));
    origins.names.push_back(file_name(character));
    for (const Clip& clip : character.character.clips) origins.names.push_back(clip.name);
  }
  for (const auto& [character, at, whole] : sources) {
    const std::uint32_t name = first_name[character];
    origins.origins.push_back(
        {name, at.clip == PoseTime::rest ? ShapeOrigin::rest_pose : name + 1 + at.clip, at.seconds});
  }
  return origins;
}

}  // namespace bch::cli
