// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set_builder.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace bch {

ShapeSetBuilder::ShapeSetBuilder(const ShapeSetPlan& plan) : plan_(plan) {
  validate(plan);
  storage_.depths.assign(plan.depths.begin(), plan.depths.end());
}

void ShapeSetBuilder::add(const FlatShape& flat) {
  const ShapeExtent size = extent_of(flat);
  ShapeExtent at = end_;
  at.nodes = next_line(end_.nodes);
  storage_.resize(plan_, shapes_ + 1);
  storage_.make_room(at, size);
  storage_.put(shapes_++, flat, at);
  end_ = {at.nodes + size.nodes, at.rows + size.rows, at.contours + size.contours, at.points + size.points};
}

ShapeSet ShapeSetBuilder::finish() && {
  // An add() that threw may have left more.
  storage_.resize(plan_, shapes_);
  storage_.make_room(end_, {});
  // Single discs need blocks only to meet those that are not, and never contain what they do not overlap.
  const auto is_single = [](const Root& root) { return root.row == single_disc; };
  if (std::all_of(storage_.roots.begin(), storage_.roots.end(), is_single)) {
    ShapeStorage roots_only;
    roots_only.depths = std::move(storage_.depths), roots_only.roots = std::move(storage_.roots);
    storage_ = std::move(roots_only);
  }
  const auto kept = std::make_shared<const ShapeStorage>(std::move(storage_));
  return ShapeSet(kept->arrays(), kept);
}

}  // namespace bch
