// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include <bch/query.hpp>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Does the work of one task: answers pairs begin .. end, each 0 or 1. Writes nothing but their codes, so that
/// ranges may run at the same time.
/// Precondition: everything was validated.
void answer(const Implementation& implementation, const Arguments& arguments, std::size_t begin,
            std::size_t end) noexcept;

/// Answers all pairs, at most a chunk, when nothing but sizes was validated. Returns false, and writes
/// nothing, where something may be invalid, or where there are more pairs or none.
bool answer_if_valid(const Implementation& implementation, const Arguments& arguments,
                     std::size_t count) noexcept;

}  // namespace bch::detail
