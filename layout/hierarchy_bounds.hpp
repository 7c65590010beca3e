// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "layout/hierarchy.hpp"

namespace bch {

/// The nodes of a hierarchy while it is built, array by array. Only as many as have been made count.
struct HierarchyArrays {
  std::vector<Vec2> centre;
  std::vector<double> square_radius;  ///< of the smallest disc about that very centre
  std::vector<std::uint32_t> second_child, element_begin, parent;

  // Scratch of publish_nodes().
  std::vector<float> radius, bound;
  std::vector<float> distance;  ///< to the parent and to its parent, in turn

  void resize(std::size_t nodes);
};

/// Writes the hierarchy's nodes: discs enlarged by a margin, bounds, and element ranges. Its elements and
/// reach are there already.
void publish_nodes(HierarchyArrays& arrays, std::uint32_t count, double margin, Hierarchy& hierarchy);

}  // namespace bch
