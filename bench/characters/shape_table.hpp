// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bch/poses.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

#include "bench/base/cost_limits.hpp"
#include "bench/characters/characters.hpp"

namespace bch::cli {

/// Lists the poses of all characters, one character after the other, as every command numbers them: a
/// source's index is the number by which files and tables name its shape.
std::vector<PoseId> list_shapes(std::span<const LoadedCharacter> characters, std::uint32_t poses);

/// Lists so many poses of each character, at times drawn at random over all of its clips, the same for a seed
/// everywhere; for a character without clips, its rest pose.
std::vector<PoseId> list_random_shapes(std::span<const LoadedCharacter> characters, std::uint32_t poses,
                                       std::uint64_t seed);

/// Lists the poses of all characters at `rate` poses a second: in every clip those at 0, 1 / rate ... before
/// its end, one at least; for a character without clips, its rest pose.
/// Errors:  throws InputError beyond 1e7 poses.
std::vector<PoseId> list_shapes_at_rate(std::span<const LoadedCharacter> characters, double rate);

/// Returns the pose at a time of the clip of a name.
/// Errors:  throws InputError on a clip that the character has not, and on a time that the clip has not.
PoseId source_at(const LoadedCharacter& from, const std::string& clip, double seconds);

/// Returns the name of a pose's clip, "walk", or "rest pose".
std::string clip_name(const LoadedCharacter& character, PoseTime at);

/// Checks the number of a shape's contours before hierarchies are made of them.
/// Errors:  throws InputError naming the character, clip and time, beyond the limit.
void require_contours(const LoadedCharacter& from, PoseTime at, const Shape& shape, const CostLimits& limits);

struct BuiltShapes {
  std::vector<Shape> shapes;     ///< one a source
  double outline_seconds = 0;    ///< the mean of a shape, one thread: skinning and outline
  double hierarchy_seconds = 0;  ///< likewise: the hierarchy
};

/// Builds contour hierarchies, in parallel, with a progress bar.
/// Errors:  throws InputError naming the character, clip and time of a pose that has no outline, or one of more contours, or a
///          hierarchy of more nodes, than the limits.
BuiltShapes build_shapes(std::span<const LoadedCharacter> characters, std::span<const PoseId> sources,
                         double threshold, const ShapeSetPlan& plan = {}, const CostLimits& limits = {});

}  // namespace bch::cli
