// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/characters.hpp>

namespace bch::bench {

/// Returns the character with every triangle cut into four at the middles of its edges, `times` times. A
/// middle moves with the bones of both ends.
Character finer(const Character& character, int times);

/// Returns the character refined as by finer(), with relief as cloth and muscles have it at every size. Each
/// middle stands out of its edge, or into it, by up to an eighth of the edge's length along the surface's
/// normal. The result is the same for a character everywhere.
Character with_relief(const Character& character, int times);

}  // namespace bch::bench
