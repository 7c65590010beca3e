// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <span>

#include "baselines/structure.hpp"

/// Declares the builders behind the rows of kinds().
namespace bch::baselines {

using Build = std::unique_ptr<Structure>(std::span<const Body> bodies, const BuildOptions& options);

Build build_reference, build_reference_segments, build_paper_descent, build_single, build_fixed,
    build_bch_projected;
Build build_obb_full, build_obb_contour, build_obb_contour_2d, build_obb_projected;

/// Returns the rows of the Flexible Collision Library; none where the build did not find it.
std::span<const Kind> fcl_kinds();

}  // namespace bch::baselines
