// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/character/eigen.hpp"

namespace bch::detail {

/// Returns the rotation at a parameter t, from 0 to 1, of the shorter arc from a to b, which is passed at constant speed. It
/// is computed by multiplications and square roots alone, so it has the same bits everywhere, unlike the trigonometry of
/// a maths library.
/// Returns: a unit quaternion, to 1e-9.
Eigen::Quaterniond slerp(const Quaternion& a, const Quaternion& b, float t);

}  // namespace bch::detail
