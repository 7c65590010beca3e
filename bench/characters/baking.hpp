// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/files.hpp>
#include <bch/poses.hpp>
#include <bch/shapes.hpp>

#include "bench/base/did_you_mean.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/characters/shape_table.hpp"

namespace bch::cli {

/// Builds a set of all sources' shapes in parallel, with a progress bar. No more than some dozens of shapes a
/// thread are in memory in addition to the set. The bytes are the same for any number of threads.
/// Errors:  as build_shapes() throws.
ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const PoseId> sources,
                     double threshold, const ShapeSetPlan& plan, const CostLimits& limits = {});

/// Names a clip of one of several characters, by their indices.
struct ClipOf {
  std::uint32_t character, clip;
  friend bool operator==(const ClipOf&, const ClipOf&) = default;
};

/// Finds the clips of given names, or "all", in the order of the names, each once: `characters` have a Character of that name.
/// Errors:  throws InputError on a name that no character's clip has, naming the option that it was given to.
template <class Holder>
std::vector<ClipOf> find_clips(std::span<const std::string> names, std::span<const Holder> characters,
                               const char* option) {
  std::vector<ClipOf> found;
  for (const std::string& name : names) {
    bool is_there = false;
    std::vector<std::string> known;
    for (std::uint32_t i = 0; i < characters.size(); ++i) {
      const std::vector<Clip>& clips = characters[i].character.clips;
      for (std::uint32_t clip = 0; clip < clips.size(); ++clip) {
        known.push_back(clips[clip].name);
        if (name != "all" && name != clips[clip].name) continue;
        is_there = true;
        if (std::ranges::find(found, ClipOf{i, clip}) == found.end()) found.push_back({i, clip});
      }
    }
    if (!is_there)
      throw InputError(
          fmt::format("{}: no character has a clip named '{}'{}", option, name, did_you_mean(name, known)));
  }
  return found;
}

/// The spheres of bodies that clips are made of as moving spheres.
constexpr std::uint32_t animated_spheres = 256;

/// Makes moving spheres of a clip; errors call its character `name`.
/// Errors:  throws InputError where animate() refuses the clip.
AnimatedDiscs animate_clip(const BodyModel& model, const std::string& name, std::uint32_t clip,
                           const AnimateOptions& how = {});

/// Makes moving spheres of clips in parallel, with a progress bar, as a baked file has them with origins_of().
std::vector<BakedClip> bake_clips(std::span<const LoadedCharacter> characters, std::span<const ClipOf> clips);

/// Returns what a baked file says about the origins of its shapes. Characters go by their sources' file
/// names.
ShapeOrigins origins_of(std::span<const LoadedCharacter> characters, std::span<const PoseId> sources,
                        double threshold);

/// Writes the results of bake_shapes(), origins_of() and, of clips that are to be moving spheres as well, bake_clips() into a file, and
/// models of bodies of so many spheres, unless that is 0.
/// Errors:  as these, BakedImage and OutputFile throw.
BakedShapes bake_file(const std::string& file, std::span<const LoadedCharacter> characters,
                      std::span<const PoseId> sources, double threshold, const ShapeSetPlan& plan,
                      const CostLimits& limits = {}, std::span<const ClipOf> animated = {},
                      std::uint32_t spheres = 0);

}  // namespace bch::cli
