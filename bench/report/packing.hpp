// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/shape_set.hpp"

namespace bch::report {

/// How close people can stand: so many of them, in poses and headings at random, on a square whose opposite sides are one. They
/// stand loosely, are pushed apart until nobody overlaps anybody (the solid semantics), the square shrinks by a
/// hundredth of its area, and so on until they do not come apart in 300 steps.
/// Returns: people per square metre in the last square where nobody overlapped, the same for the same arguments.
double densest_packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed);

}  // namespace bch::report
