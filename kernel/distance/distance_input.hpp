// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/pairs.hpp>

#include "kernel/runtime/pair_validation.hpp"

namespace bch::detail {

// The input of queries about distances, of pairs and of agents against obstacles.
// Errors: each function throws std::invalid_argument naming the query, the value, and the pair or agent if it
// belongs to one.

/// Checks the sizes of the answers of clearance(), and its options.
void require_valid(const QueryName& context, const ClearanceAnswers& answers,
                   const ClearanceOptions& options);
void require_valid(const QueryName& context, const BodyClearanceAnswers& answers,
                   const BodyClearanceOptions& options);
/// Checks the distances of within(): one, or one per answer, none negative or NaN.
void require_distances(const QueryName& context, std::span<const double> distances);
/// Checks the sizes of displacements and times of time_of_impact(), and that displacements are within the
/// limits.
void require_valid(const QueryName& context, const Displacements& displacements, std::size_t times);
/// Rejects displacements in z.
void require_on_ground(const QueryName& context, const Displacements& displacements);

/// Writes the distance of a pair or agent, and "none" to its other outputs.
void store_distance(const ClearanceAnswers& answers, std::size_t i, float distance) noexcept;
void store_distance(const BodyClearanceAnswers& answers, std::size_t i, float distance) noexcept;

}  // namespace bch::detail
