// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <bch/motion.hpp>

#include "kernel/motion/moving_body.hpp"

namespace bch::detail {

/// Says of what a query complains.
[[noreturn]] void reject(const char* query, const std::string& why);

/// Requires an interval and a tolerance to be as first_contact() says.
/// Errors:  throws std::invalid_argument.
void require_valid(const char* query, const TimeInterval& interval, double tolerance);

/// Checks motions, which are named in errors by the index that the first one has and those behind it.
/// Returns: what searches know of them beforehand, as long as they live.
/// Errors:  throws std::invalid_argument as first_contact() does.
std::vector<MotionFacts> valid_motions(const char* query, std::span<const Motion> motions,
                                       std::size_t named_from = 0);

}  // namespace bch::detail
