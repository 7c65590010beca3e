// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/base/instruction_set.hpp"

namespace bch::detail {

struct DiscSets;
struct OutlineLoops;
struct InteriorLoops;
struct PosingLoops;
struct BlendLoops;
struct DiscRun;

/// Holds the loops of construction, compiled for one instruction set. All sets give the same bits.
struct BuildLoops {
  void (*solve_discs)(const DiscSets& sets) noexcept;
  const OutlineLoops& outline;
  const InteriorLoops& interior;
  const PosingLoops& posing;
  const BlendLoops& blend;
  void (*heights)(const DiscRun& run, const float* cosine, const float* sine,
                  float* height) noexcept;  ///< see CutLanes
};

/// Represents one implementation of construction: an instruction set and the loops compiled for it.
struct BuildImplementation : InstructionSet {
  const BuildLoops& loops;
};

/// Returns all compiled implementations, the best first; the last one runs on every processor.
std::span<const BuildImplementation> build_implementations() noexcept;

/// Returns the first implementation that this processor supports.
const BuildImplementation& best_build_implementation() noexcept;

}  // namespace bch::detail
