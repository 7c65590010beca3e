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

/// Throws std::invalid_argument with the name of the query and the reason.
[[noreturn]] void reject(const char* query, const std::string& why);

/// Checks the interval and tolerance of first_contact().
/// Errors:  throws std::invalid_argument.
void require_valid(const char* query, const TimeInterval& interval, double tolerance);

/// Checks motions. Errors name them by index; the first one has index `named_from`.
/// Returns: their properties for searches, which refer to the motions.
/// Errors:  throws std::invalid_argument as first_contact() does.
std::vector<MotionFacts> valid_motions(const char* query, std::span<const Motion> motions,
                                       std::size_t named_from = 0);

}  // namespace bch::detail
