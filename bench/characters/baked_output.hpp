// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <bch/baked.hpp>

#include "bench/base/output_file.hpp"
#include "bench/characters/baking.hpp"
#include "bench/characters/shape_table.hpp"

namespace bch::cli {

/// Writes a baked file, most of which is written while its set is built. This is possible because the offset
/// of the nodes is known, and the nodes of shapes that are there will not change. The time for the rest at
/// the end does not depend on the number of threads.
class BakedOutput {
 public:
  /// Opens a file for a set of so many shapes and levels.
  /// Errors:  as OutputFile throws.
  BakedOutput(const std::string& file, std::size_t shapes, const ShapeSetPlan& plan);

  /// Writes the nodes of the shapes so far, from the first one on; they must not change any more.
  void write_ahead(std::span<const float> nodes);
  /// Writes the rest and gives the file its name.
  /// Errors:  as BakedImage and OutputFile throw.
  void finish(const BakedShapes& baked);

 private:
  void write_arrays(const detail::ShapeArrays& shapes);

  OutputFile file_;
  bool can_write_ahead_;  ///< where it is known how many parts stand before the nodes
  std::uint64_t nodes_offset_;
  std::size_t ahead_ = 0;  ///< bytes of nodes that are written
};

/// Writes the results of bake_shapes(), origins_of() and, of clips that are to be moving discs as well, bake_clips() into a file.
BakedShapes bake_file(const std::string& file, std::span<const LoadedCharacter> characters,
                      std::span<const ShapeSource> sources, double threshold, const ShapeSetPlan& plan,
                      const CostLimits& limits = {}, std::span<const ClipOf> animated = {});

}  // namespace bch::cli
