// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <span>

#include "bench/characters/shape_table.hpp"
#include "layout/baked/shape_origins.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch::cli {

/// A set of all sources' shapes, built in parallel, with a progress bar. No more than some dozens of shapes a thread
/// are in memory beside the set. The same bytes for any number of threads. `added` is told the nodes so far after every shape,
/// by any thread, one at a time.
/// Errors:  as ShapeMaker and `added` throw.
ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                     double threshold, const ShapeSetPlan& plan,
                     const std::function<void(std::span<const float> nodes)>& added = {},
                     const CostLimits& limits = {});

/// What a baked file says about them. Characters go by their sources' file names.
ShapeOrigins origins_of(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                        double threshold);

}  // namespace bch::cli
