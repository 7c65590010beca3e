// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/shape_set_builder.hpp>

#include "layout/shape_set/chunk_level.hpp"

namespace bch::detail {

/// Makes animated shapes flat at times of their clips. Where a plan asks for the level of all depths alone, without culling data,
/// all but the discs is there from the beginning, and takes about as much memory as two keys of each chunk do.
class MomentFlattener {
 public:
  /// Holds what a thread works with.
  struct Memory {
    explicit Memory(const ShapeSetPlan& plan) : prepared(plan) {}
    Shape shape;
    PlacedChunk nodes;
    PreparedShape prepared;
  };

  /// Takes bodies that outlive this, and a valid plan.
  MomentFlattener(std::span<const AnimatedShape* const> bodies, const ShapeSetPlan& plan);

  std::span<const AnimatedShape* const> bodies() const noexcept { return bodies_; }

  /// Returns a body at a time, for sets of the plan, in memory.
  /// Errors:  throws as PreparedShape::prepare() does, naming the shape by `index`.
  const PreparedShape& flatten(std::uint32_t body, double seconds, std::uint32_t index, Memory& memory) const;

 private:
  void flatten_level(std::uint32_t body, double seconds, Memory& memory) const;

  std::vector<const AnimatedShape*> bodies_;
  ShapeSetPlan plan_;
  std::vector<std::vector<ChunkLevel>> levels_;  ///< per body and chunk, where the plan asks for these alone
};

}  // namespace bch::detail
