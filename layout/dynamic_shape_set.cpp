// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/dynamic_shape_set.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace bch {
namespace {

bool fits(const ShapeExtent& part, const ShapeExtent& whole) {
  return part.nodes <= whole.nodes && part.rows <= whole.rows && part.contours <= whole.contours &&
         part.points <= whole.points;
}

/// For what outgrew its place.
std::size_t with_room(std::size_t needed, std::size_t had) {
  return needed <= had ? had : needed + needed / 2;
}

bool has_more_than_a_disc(const FlatShape& flat) {
  return std::any_of(flat.levels.begin(), flat.levels.end(),
                     [](const WideTree& tree) { return !tree.is_single; });
}

bool has_single_disc(const FlatShape& flat) {
  return std::any_of(flat.levels.begin(), flat.levels.end(),
                     [](const WideTree& tree) { return tree.is_single; });
}

}  // namespace

DynamicShapeSet::DynamicShapeSet(const ShapeSet& start)
    : plan_(start.plan()), storage_(copy_of(start.arrays())), set_(storage_.arrays(), nullptr) {
  places_.resize(set_.shape_count());
  find_places();
}

/// In a set that was built, or passed validate(), shapes lie one behind the other.
void DynamicShapeSet::find_places() {
  if (set_.roots_only()) {
    constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
    std::fill(places_.begin(), places_.end(), Place{{}, {any, any, any, any}});
    return;
  }
  end_ = {next_line(storage_.nodes.size() - block_floats), first_row, storage_.contours.size(),
          storage_.points.size()};
  for (const Root& root : storage_.roots) end_.rows += root.row >= first_row;
  ShapeExtent end = end_;
  for (std::uint32_t shape = set_.shape_count(); shape-- > 0; end = places_[shape].begin)
    places_[shape] = place_of(shape, end);
}

/// From where a place ends.
DynamicShapeSet::Place DynamicShapeSet::place_of(std::uint32_t shape, const ShapeExtent& end) const {
  const std::size_t levels = storage_.depths.size();
  ShapeExtent begin = end;
  begin.nodes = next_line(storage_.trees[shape * levels].top & ~leaf_window);
  for (std::size_t k = 0; k < levels; ++k) begin.rows -= storage_.roots[shape * levels + k].row >= first_row;
  if (plan_.solid) {
    begin.contours = storage_.shape_contours[shape].begin;
    if (begin.contours < end.contours) begin.points = storage_.contours[begin.contours].begin;
  }
  const std::size_t nodes = end.nodes > begin.nodes ? end.nodes - begin.nodes : 0;
  return {begin, {nodes, end.rows - begin.rows, end.contours - begin.contours, end.points - begin.points}};
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
  require(shape, flat);
  // Also where an allocation fails half way.
  struct Refresh {
    DynamicShapeSet& of;
    ~Refresh() { of.set_ = ShapeSet(of.storage_.arrays(), nullptr); }
  };
  const Refresh refresh{*this};
  const ShapeExtent size = extent_of(flat);
  if (!fits(size, places_[shape].size)) move(shape, size);
  storage_.put(shape, flat, places_[shape].begin);
}

void DynamicShapeSet::move(std::uint32_t shape, const ShapeExtent& size) {
  const ShapeExtent& had = places_[shape].size;
  const ShapeExtent room{next_line(with_room(size.nodes, had.nodes)), 1,
                         with_room(size.contours, had.contours), with_room(size.points, had.points)};
  storage_.make_room(end_, room);
  places_[shape] = {end_, room};
  end_ = {end_.nodes + room.nodes, end_.rows + room.rows, end_.contours + room.contours,
          end_.points + room.points};
}

}  // namespace bch
