// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/character/character.hpp"

namespace bch::bench {

/// The character with every triangle cut into four at the middles of its edges, `times` over. A middle moves with
/// the bones of both ends.
Character finer(const Character& character, int times);

/// The same with relief, as cloth and muscles have it at every size: each middle stands out of its edge, or into it, by up to
/// an eighth of the edge's length along the surface's normal. The same for a character everywhere.
Character with_relief(const Character& character, int times);

/// The character with its vertices merged by the cells of a grid, and without the triangles that this closes: the
/// finest grid that leaves no more triangles than `most`.
Character coarser(const Character& character, std::size_t most);

}  // namespace bch::bench
