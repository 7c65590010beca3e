// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/shape_set.hpp"
#include "layout/skinning.hpp"

namespace bch {

/// The whole way from a pose to a shape: skinning, the outline of the union of its triangles, the contour
/// hierarchy that splits at the centroid. `threshold`, in metres, is the radius below which a disc is not
/// divided.
/// Errors:  as Skinner::pose(), union_outline() and contour_hierarchy() throw.
Shape pose_shape(Skinner& skinner, PoseTime at, float threshold = 0.01f);

}  // namespace bch
