// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/body_set.hpp>

namespace bch::detail {

/// Chooses the spheres that most collisions meet first, the first eight of them before the rest: by random exchange on sample collisions of the body
/// with itself, in these poses. Begins with the given ones.
std::array<std::uint32_t, core_spheres> choose_core(std::span<const std::vector<Sphere>> poses,
                                                    std::array<std::uint32_t, core_spheres> core);

}  // namespace bch::detail
