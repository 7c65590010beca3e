// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "bench/race.hpp"
#include "bench/scene.hpp"
#include "kernel/implementation.hpp"

namespace bch::bench {

constexpr std::uint32_t separation_directions = 16;

/// A question that the response to collisions asks beside collide().
struct ResponseQuery {
  const char* name;
  /// All of a workload's pairs, or its agents; the answers were compared with brute force over all discs.
  /// Errors:  throws std::runtime_error on wrong answers.
  Contender (*kernel)(Scene&, const Workload&, const kernel::Implementation&);
  /// Brute force, its answers compared with the kernel's; null where collide()'s stands for it.
  Contender (*reference)(Scene&, const Workload&);
};

/// contacts; separation, along the best of separation_directions; collide_all, whose pairs are those of its broad phase.
std::span<const ResponseQuery> response_queries();

}  // namespace bch::bench
