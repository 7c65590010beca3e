// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/dynamic_shape_set.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/shape_set/flat_shape.hpp"

namespace bch {
namespace {

bool fits(const ShapeExtent& part, const ShapeExtent& whole) {
  bool all = true;
  for_each_part([&](std::size_t needed, std::size_t room) { all &= needed <= room; }, part, whole);
  return all;
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
                     [](const Bvh8& tree) { return !tree.is_single(); });
}

bool has_single_disc(const FlatShape& flat) {
  return std::any_of(flat.levels.begin(), flat.levels.end(),
                     [](const Bvh8& tree) { return tree.is_single(); });
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
    Place any;
    for_each_part([](std::size_t& part) { part = std::numeric_limits<std::size_t>::max(); }, any.size);
    std::fill(places_.begin(), places_.end(), any);
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
  // Else set_ has to learn of single discs, or a kernel would not look for them; and that an outline is missing.
  if (set_.view().rows_in_order && has_single_disc(flat)) return false;
  if (set_.solid() && !set_.roots_only() && flat.outline.contours() == 0) return false;
  storage_.put(shape, flat, places_[shape].begin);
  return true;
}

void DynamicShapeSet::replace(std::uint32_t shape, const FlatShape& flat) {
  if (try_replace(shape, flat)) return;
  // The refresh also happens where an allocation fails half way.
  struct Refresh {
    DynamicShapeSet& of;
    ~Refresh() { of.set_ = ShapeSet(of.storage_.arrays(), nullptr); }
  };
  const Refresh refresh{*this};
  const ShapeExtent needed = extent_of(flat);
  ShapeExtent room = needed;
  for_each_part([](std::size_t& part) { part += part / 2; }, room);
  make_place(shape, needed, room);
  storage_.put(shape, flat, places_[shape].begin);
}

/// Parts that have room enough stay where they are.
void DynamicShapeSet::make_place(std::uint32_t shape, const ShapeExtent& needed, const ShapeExtent& room) {
  auto [begin, size] = places_[shape];
  ShapeExtent to_lines = room, grown;
  to_lines.nodes = next_line(room.nodes);
  for_each_part(
      [](std::size_t& more, std::size_t part, std::size_t with_room, std::size_t end, std::size_t& from,
         std::size_t& length) { more = grow(part, with_room, end, from, length); },
      grown, needed, to_lines, end_, begin, size);
  storage_.make_room(end_, grown);
  places_[shape] = {begin, size};
  for_each_part([](std::size_t& end, std::size_t more) { end += more; }, end_, grown);
}

}  // namespace bch
