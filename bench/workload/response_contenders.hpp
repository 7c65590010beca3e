// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "bench/workload/race.hpp"

namespace bch::bench {

constexpr std::uint32_t separation_directions = 16;

/// contacts; separation, along the best of separation_directions; collide_all, whose pairs are those of its broad phase. The
/// reference is brute force; of collide_all there is none, as collide()'s stands for it.
std::span<const TimedQuery> response_queries();

}  // namespace bch::bench
