// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/baking.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <utility>
#include <vector>

#include <bch/shape_set_builder.hpp>

#include "bench/base/progress.hpp"
#include "kernel/runtime/ordered_build.hpp"

namespace bch::cli {
ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                     double threshold, const ShapeSetPlan& plan,
                     const std::function<void(std::span<const float> nodes)>& added,
                     const CostLimits& limits) {
  ShapeSetBuilder builder(plan, sources.size());
  Progress progress("baking shapes", sources.size());
  tbb::enumerable_thread_specific<ShapeMaker> makers(
      [&] { return ShapeMaker(characters, threshold, plan, limits); });
  detail::add_in_order(
      builder, plan, sources.size(),
      [&](std::size_t i) -> const Shape& { return makers.local().make(sources[i]); },
      [&](std::size_t) {
        if (added) added(builder.nodes());
        progress.advance();
      });
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
