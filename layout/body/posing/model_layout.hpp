// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/bodies.hpp>

#include "layout/body/body_layout.hpp"

namespace bch::detail {

/// Returns the layout of a model's bodies: spheres stand in the order of their numbers.
BodyLayout layout_of(const BodyModel& model);

}  // namespace bch::detail
