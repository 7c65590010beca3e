// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

#include "bench/shape_table.hpp"
#include "layout/baked_file.hpp"
#include "layout/shape_origins.hpp"
#include "layout/shape_set.hpp"

namespace bch::cli {

/// A set of all sources' shapes, built in parallel, with a progress bar. No more shapes than threads work on are in
/// memory beside the set. The same bytes for any number of threads.
/// Errors:  as ShapeMaker throws.
ShapeSet bake_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                     double threshold, const ShapeSetPlan& plan);

/// What a baked file says about them. Characters go by their sources' file names.
ShapeOrigins origins_of(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                        double threshold);

/// As write_file().
/// Errors:  as BakedImage and write_file() throw.
void write_baked(const std::string& file, const BakedShapes& baked);

}  // namespace bch::cli
