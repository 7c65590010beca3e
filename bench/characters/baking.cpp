// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/baking.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <bch/shapes.hpp>

#include "bench/base/output_file.hpp"
#include "bench/base/progress.hpp"
#include "bench/characters/body_models.hpp"
#include "kernel/baking/pose_baker.hpp"
#include "kernel/runtime/tasks.hpp"
#include "layout/baked/image.hpp"

namespace bch::cli {
ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const PoseId> sources,
                     double threshold, const ShapeSetPlan& plan, const CostLimits& limits) {
  std::vector<detail::BakedCharacter> named;
  for (const LoadedCharacter& each : characters) named.push_back({&each.character, each.source});
  detail::PoseBaker baker(std::move(named), plan, static_cast<float>(threshold), limits.nodes);
  ShapeSetBuilder builder(plan, sources.size());
  Progress progress("baking shapes", sources.size());
  detail::BakeSteps steps;
  steps.outlined = [&](std::size_t i, const Shape& outlines) {
    require_contours(characters[sources[i].character], sources[i].at, outlines, limits);
  };
  steps.added = [&](std::size_t) { progress.advance(); };
  try {
    baker.add(builder, sources, steps);
  } catch (const std::length_error& error) {
    throw InputError(std::string(error.what()) + "; --max-nodes raises the limit");
  } catch (const std::logic_error& error) {
    // Out of the domain: a pose kilometres wide, say. domain_error and invalid_argument are both logic errors.
    throw InputError(error.what());
  }
  return std::move(builder).finish();
}

AnimatedDiscs animate_clip(const BodyModel& model, const std::string& name, std::uint32_t clip,
                           const AnimateOptions& how) {
  try {
    return animate(model, clip, how);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}, clip {}: {}", name, model.character->clips[clip].name, error.what()));
  }
}

std::vector<BakedClip> bake_clips(std::span<const LoadedCharacter> characters,
                                  std::span<const ClipOf> clips) {
  std::vector<std::uint32_t> first_name;
  std::uint32_t names = 0;
  for (const LoadedCharacter& each : characters) {
    first_name.push_back(names);
    names += 1 + static_cast<std::uint32_t>(each.character.clips.size());
  }
  std::vector<BakedClip> baked(clips.size());
  if (clips.empty()) return baked;
  const std::vector<BodyModel> models = make_models(characters, animated_spheres);
  Progress progress("animating clips", clips.size());
  progress.show();
  detail::run_each(clips.size(), [&](std::size_t i) {
    const auto& [character, clip] = clips[i];
    const std::uint32_t name = first_name[character];
    baked[i] = {name, name + 1 + clip,
                animate_clip(models[character], file_name(characters[character]), clip)};
    progress.advance();
  });
  return baked;
}

ShapeOrigins origins_of(std::span<const LoadedCharacter> characters, std::span<const PoseId> sources,
                        double threshold) {
  ShapeOrigins origins{threshold, {}, {}};
  std::vector<std::uint32_t> first_name;  // of a character: its own, then those of its clips
  for (const LoadedCharacter& character : characters) {
    first_name.push_back(static_cast<std::uint32_t>(origins.names.size()));
    origins.names.push_back(file_name(character));
    for (const Clip& clip : character.character.clips) origins.names.push_back(clip.name);
  }
  for (const auto& [character, at] : sources) {
    const std::uint32_t name = first_name[character];
    origins.origins.push_back(
        {name, at.clip == PoseTime::rest ? ShapeOrigin::no_clip : name + 1 + at.clip, at.seconds});
  }
  return origins;
}

BakedShapes bake_file(const std::string& file, std::span<const LoadedCharacter> characters,
                      std::span<const PoseId> sources, double threshold, const ShapeSetPlan& plan,
                      const CostLimits& limits, std::span<const ClipOf> animated, std::uint32_t spheres) {
  OutputFile output(file);  // before hours of work
  BakedShapes baked{bake_shapes(characters, sources, threshold, plan, limits),
                    origins_of(characters, sources, threshold),
                    bake_clips(characters, animated),
                    {}};
  if (spheres > 0)
    for (const BodyModel& model : make_models(characters, spheres, false))
      baked.bodies.push_back(to_bytes(model));
  const detail::BakedImage image(baked.set, baked.origins, baked.clips, baked.bodies);
  for (const std::span<const std::byte> part : image.parts())
    output.write({reinterpret_cast<const char*>(part.data()), part.size()});
  output.commit();
  return baked;
}

}  // namespace bch::cli
