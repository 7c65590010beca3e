// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/dynamic_shape_set.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/flat_shape.hpp"

namespace bch {
namespace {

bool fits(const ShapeExtent& part, const ShapeExtent& whole) {
  return part.nodes <= whole.nodes && part.rows <= whole.rows && part.contours <= whole.contours &&
         part.points <= whole.points;
}

/// One part of a shape, which gets a new place behind all others where it outgrew its own.
/// Returns: how far that makes the end move.
std::size_t grow(std::size_t needed, std::size_t room, std::size_t end, std::size_t& begin,
                 std::size_t& size) {
  if (needed <= size) return 0;
  begin = end;
  size = room;
  return room;
}

bool has_more_than_a_disc(const FlatShape& flat) {
  return std::any_of(flat.levels.begin(), flat.levels.end(),
                     [](const WideTree& tree) { return !tree.is_single(); });
}

bool has_single_disc(const FlatShape& flat) {
  return std::any_of(flat.levels.begin(), flat.levels.end(),
                     [](const WideTree& tree) { return tree.is_single(); });
}

}  // namespace

DynamicShapeSet::DynamicShapeSet(const ShapeSet& start)
    : plan_(start.plan()), places_(start.shape_count()), set_({}, nullptr) {
  copy(start.arrays());
  set_ = ShapeSet(storage_.arrays(), nullptr);
}

/// Shape by shape: they may lie in any order there, and closer to each other than places may.
void DynamicShapeSet::copy(const ShapeArrays& arrays) {
  storage_.depths.assign(arrays.depths.begin(), arrays.depths.end());
  if (arrays.trees.empty()) {
    storage_.roots.assign(arrays.roots.begin(), arrays.roots.end());
    constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
    std::fill(places_.begin(), places_.end(), Place{{}, {any, any, any, any}});
    return;
  }
  storage_.resize(plan_, places_.size());
  for (std::uint32_t shape = 0; shape < places_.size(); ++shape) {
    const FlatShape flat = flat_shape(arrays, shape);
    const ShapeExtent extent = extent_of(flat);
    make_place(shape, extent, extent);
    storage_.put(shape, flat, places_[shape].begin);
  }
}

void DynamicShapeSet::require(std::uint32_t shape, const FlatShape& flat) const {
  if (shape >= places_.size())
    throw std::out_of_range("dynamic shape set: shape " + std::to_string(shape) + " of " +
                            std::to_string(places_.size()));
  if (set_.roots_only()) {
    if (flat.plan.depths != plan_.depths || has_more_than_a_disc(flat))
      throw std::invalid_argument("dynamic shape set: it has single discs alone, and the shape has more");
  } else if (flat.plan != plan_) {
    throw std::invalid_argument("dynamic shape set: the shape was made flat with another plan");
  }
}

bool DynamicShapeSet::try_replace(std::uint32_t shape, const FlatShape& flat) {
  require(shape, flat);
  if (!fits(extent_of(flat), places_[shape].size)) return false;
  // Else set_ has to learn of single discs, or a kernel would not look for them.
  if (set_.view().rows_in_order && has_single_disc(flat)) return false;
  storage_.put(shape, flat, places_[shape].begin);
  return true;
}

void DynamicShapeSet::replace(std::uint32_t shape, const FlatShape& flat) {
  if (try_replace(shape, flat)) return;
  // Also where an allocation fails half way.
  struct Refresh {
    DynamicShapeSet& of;
    ~Refresh() { of.set_ = ShapeSet(of.storage_.arrays(), nullptr); }
  };
  const Refresh refresh{*this};
  const ShapeExtent needed = extent_of(flat);
  make_place(shape, needed,
             {needed.nodes + needed.nodes / 2, needed.rows, needed.contours + needed.contours / 2,
              needed.points + needed.points / 2});
  storage_.put(shape, flat, places_[shape].begin);
}

/// Parts that have room enough stay where they are.
void DynamicShapeSet::make_place(std::uint32_t shape, const ShapeExtent& needed, const ShapeExtent& room) {
  auto [begin, size] = places_[shape];
  const ShapeExtent grown{grow(needed.nodes, next_line(room.nodes), end_.nodes, begin.nodes, size.nodes),
                          grow(needed.rows, room.rows, end_.rows, begin.rows, size.rows),
                          grow(needed.contours, room.contours, end_.contours, begin.contours, size.contours),
                          grow(needed.points, room.points, end_.points, begin.points, size.points)};
  storage_.make_room(end_, grown);
  places_[shape] = {begin, size};
  end_ = {end_.nodes + grown.nodes, end_.rows + grown.rows, end_.contours + grown.contours,
          end_.points + grown.points};
}

}  // namespace bch
