// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <span>

#include <bch/baked.hpp>
#include <bch/shape_set.hpp>

#include "bench/characters/shape_table.hpp"

namespace bch::cli {

/// Builds a set of all sources' shapes in parallel, with a progress bar. No more than some dozens of shapes a
/// thread are in memory beside the set. The bytes are the same for any number of threads. `added` is called
/// after every shape with all nodes so far, by any thread, one call at a time.
/// Errors:  as ShapeMaker and `added` throw.
ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                     double threshold, const ShapeSetPlan& plan,
                     const std::function<void(std::span<const float> nodes)>& added = {},
                     const CostLimits& limits = {});

/// Returns what a baked file says about the origins of its shapes. Characters go by their sources' file
/// names.
ShapeOrigins origins_of(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                        double threshold);

}  // namespace bch::cli
