// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/body_set.hpp>

namespace bch::detail {

/// Orders the spheres of a body so that those of each leaf, so many in a row, are near each other in all of the given poses: ranges are
/// split again and again where the parts' discs and heights become small. Only the last leaf may have fewer.
std::vector<std::uint32_t> leaf_order(std::span<const std::vector<Sphere>> poses, std::uint32_t leaf_size);

}  // namespace bch::detail
