// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include <bch/query.hpp>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Does the work of one task: answers pairs begin .. end, each 0 or 1. Writes only their states, so that disjoint ranges may
/// run at the same time.
/// Precondition: everything was validated.
void answer(const Implementation& implementation, const Arguments& arguments, std::size_t begin,
            std::size_t end) noexcept;

}  // namespace bch::detail
