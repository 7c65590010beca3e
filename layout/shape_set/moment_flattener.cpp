// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/moment_flattener.hpp"

#include "layout/shape_set/shape_flattener.hpp"

namespace bch::detail {

MomentFlattener::MomentFlattener(std::span<const AnimatedShape* const> bodies, const ShapeSetPlan& plan)
    : bodies_(bodies.begin(), bodies.end()), plan_(plan) {
  if (plan.depths != std::vector{all_depths} || plan.culling) return;
  for (const AnimatedShape* const body : bodies) {
    const auto& chunks = body->tree().chunks;
    levels_.emplace_back(chunks.begin(), chunks.end());
  }
}

const PreparedShape& MomentFlattener::flatten(std::uint32_t body, double seconds, std::uint32_t index,
                                              Memory& memory) const {
  if (!levels_.empty()) {
    flatten_level(body, seconds, memory);
  } else {
    bodies_[body]->shape(seconds, memory.shape);
    memory.prepared.prepare(memory.shape, index);
  }
  return memory.prepared;
}

void MomentFlattener::flatten_level(std::uint32_t body, double seconds, Memory& memory) const {
  const AnimatedTree& tree = bodies_[body]->tree();
  const KeyPlace at = key_place(tree, time_in_clip(tree, seconds));
  FlatBody& flat = memory.prepared.flat();
  flat.plan = plan_;
  flat.heights = bodies_[body]->heights();
  flat.shape.reach = tree.reach;
  flat.shape.levels.resize(1);
  levels_[body][at.chunk].place(at, tree.reach, memory.nodes, flat.shape.levels[0]);
  if (!plan_.outlines) return;
  memory.shape.hierarchy.reach = tree.reach;
  take_outline(tree.chunks[at.chunk], at, memory.shape.outline);
  ShapeFlattener::add_outline(memory.shape, flat.shape);
}

}  // namespace bch::detail
