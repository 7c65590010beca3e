// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// Asks every query about pairs of a crowd, for tests that only check
/// that all calls end.
void query_all(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
               const Implementation& implementation);

/// Copies a set as DynamicShapeSet does, replaces a shape by another one's copy, in place and in a new place, and asks
/// all queries before and after.
void query_all_of_a_dynamic_copy(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                                 const Implementation& implementation);

}  // namespace bch::test
