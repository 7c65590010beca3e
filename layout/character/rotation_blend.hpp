// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/character/eigen.hpp"

namespace bch::detail {

/// Returns the rotation a share t of the shorter way from a to b, at constant speed; 0 <= t <= 1. By multiplications and
/// square roots alone, so that it is the same everywhere: the trigonometry of a maths library is not.
/// Returns: a unit quaternion, to 1e-9.
Eigen::Quaterniond slerp(const Quaternion& a, const Quaternion& b, float t);

}  // namespace bch::detail
