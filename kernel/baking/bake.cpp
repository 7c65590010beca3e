// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <utility>
#include <vector>

#include <bch/poses.hpp>

#include "kernel/baking/pose_baker.hpp"
#include "kernel/runtime/progress_report.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch {

using namespace detail;

ShapeSet bake(std::span<const Character> characters, const BakeOptions& options) {
  std::vector<BakedCharacter> named;
  std::vector<PoseId> sampled;
  for (const Character& character : characters) {
    validate(character);
    if (options.shapes.empty())
      for (const PoseTime at : sample_poses(character, options.poses))
        sampled.push_back({static_cast<std::uint32_t>(named.size()), at});
    named.push_back({&character, character.name});
  }
  const std::span<const PoseId> sources = options.shapes.empty() ? sampled : options.shapes;

  ShapeSetBuilder builder(options.plan, sources.size());
  PoseBaker baker(std::move(named), options.plan, options.threshold);
  ProgressReport progress(options.progress, sources.size());
  without_tasks_from_outside([&] {
    baker.add(builder, sources, {.outlined = [&](std::size_t, const Shape&) { progress.part_done(); }});
  });
  progress.all_done();
  return std::move(builder).finish();
}

ShapeSet bake(const Character& character, const BakeOptions& options) {
  return bake(std::span(&character, 1), options);
}

}  // namespace bch
