// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include "kernel/body/body_arguments.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/runtime/pair_validation.hpp"

namespace bch::detail {

/// Finds which pairs of bodies collide, on the caller's thread: one hit, 0 or 1, a pair. The arguments are valid.
inline void find_hits(const Implementation& implementation, const BodySetView& bodies, const Agents& agents,
                      std::span<const Pair> pairs, std::uint8_t* hits) {
  BodyArguments arguments{arguments_for(bodies.ground, agents, pairs), &bodies};
  arguments.pairs.states = hits;
  implementation.kernels->run_bodies(arguments, 0, pairs.size());
}

}  // namespace bch::detail
