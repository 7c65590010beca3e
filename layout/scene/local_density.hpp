// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

namespace bch {

/// How dense a crowd is around each agent, people per square metre: those within `radius`, himself among them, over the area
/// of that circle. At the rim of a crowd it is less than inside.
/// Shapes:  x.size() == y.size(); one number an agent.
/// Units:   metres. Takes time n log n beside the neighbours it counts.
/// Errors:  throws std::invalid_argument on sizes that differ, a position that is not finite or beyond 1e9 m, naming the
///          agent, and a radius that is not positive and finite.
std::vector<double> local_densities(std::span<const double> x, std::span<const double> y, double radius = 2);

}  // namespace bch
