// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/pairs.hpp>

#include "kernel/runtime/pair_validation.hpp"

namespace bch::detail {

// The input of queries about distances, of pairs and of agents against obstacles.
// Errors: each throws std::invalid_argument naming the query, the pair or agent where each has a value, and the value.

/// Requires of clearance() the sizes of its answers, and its options.
void require_valid(const QueryName& context, const ClearanceAnswers& answers,
                   const ClearanceOptions& options);
void require_valid(const QueryName& context, const BodyClearanceAnswers& answers,
                   const BodyClearanceOptions& options);
/// Requires of within() one distance, or as many as it answers, none of them negative or NaN.
void require_distances(const QueryName& context, std::span<const double> distances);
/// Requires of time_of_impact() the sizes of displacements and times, and displacements within the limits.
void require_valid(const QueryName& context, const Displacements& displacements, std::size_t times);
/// Refuses displacements in z.
void require_on_ground(const QueryName& context, const Displacements& displacements);

/// Writes the distance of a pair or an agent and nothing else.
void store_distance(const ClearanceAnswers& answers, std::size_t i, float distance) noexcept;
void store_distance(const BodyClearanceAnswers& answers, std::size_t i, float distance) noexcept;

}  // namespace bch::detail
