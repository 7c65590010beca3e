// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shape_set_builder.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "layout/shape_set/flat_shape.hpp"
#include "layout/shape_set/shape_storage.hpp"

namespace bch {

using namespace detail;

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

/// Returns whether one of a body's parts has a level that is a single disc, or one that is not.
bool has_level(const FlatBody& body, bool is_single) {
  const auto has = [=](const FlatShape& part) {
    return std::any_of(part.levels.begin(), part.levels.end(),
                       [=](const Bvh8& tree) { return tree.is_single() == is_single; });
  };
  return std::any_of(body.parts.begin(), body.parts.begin() + static_cast<std::ptrdiff_t>(body.part_count),
                     has);
}

}  // namespace

struct DynamicShapeSet::State {
  struct Place {
    ShapeExtent begin, size;
  };

  explicit State(const ShapeSet& start);
  void copy(const ShapeArrays& arrays, std::size_t shapes);
  void require(std::uint32_t shape, const FlatBody& body) const;
  bool try_replace(std::uint32_t shape, const FlatBody& body);
  void replace(std::uint32_t shape, const FlatBody& body);
  void make_place(std::size_t part, const ShapeExtent& needed, const ShapeExtent& room);
  void put(std::uint32_t shape, const FlatBody& body);
  std::size_t first_part(std::uint32_t shape) const { return shape * slabs; }

  ShapeSetPlan plan;
  std::size_t
      slabs;  ///< a shape's parts are numbered from shape * slabs on, whether it has all of them or not
  std::uint32_t shapes;
  ShapeStorage storage;
  std::vector<Place> places;           ///< per part
  ShapeExtent end{.rows = first_row};  ///< of all places
  ShapeSet set;                        ///< stands on storage
};

DynamicShapeSet::State::State(const ShapeSet& start)
    : plan(start.plan()),
      slabs(start.slab_count()),
      shapes(start.shape_count()),
      places(shapes * slabs),
      set(ShapeArrays(), nullptr) {
  copy(start.arrays(), shapes);
  set.refer_to(storage.arrays());
}

/// Shape by shape: they may lie in any order there, and closer to each other than places may.
void DynamicShapeSet::State::copy(const ShapeArrays& arrays, std::size_t count) {
  storage.depths.assign(arrays.depths.begin(), arrays.depths.end());
  storage.slices.assign(arrays.slices.begin(), arrays.slices.end());
  const bool roots_only = arrays.trees.empty();
  ShapeSetPlan stored = plan;
  if (roots_only) {
    stored.depths.back() = 0;
    Place any;
    for_each_part([](std::size_t& part) { part = std::numeric_limits<std::size_t>::max(); }, any.size);
    std::fill(places.begin(), places.end(), any);
  }
  storage.resize(stored, count, places.size());
  for (std::uint32_t shape = 0; shape < count; ++shape) {
    const FlatBody body = flat_body(arrays, shape);
    for (std::size_t k = 0; k < body.part_count && !roots_only; ++k) {
      const ShapeExtent extent = extent_of(body.parts[k]);
      make_place(first_part(shape) + k, extent, extent);
    }
    put(shape, body);
  }
}

void DynamicShapeSet::State::put(std::uint32_t shape, const FlatBody& body) {
  for (std::size_t k = 0; k < body.part_count; ++k)
    storage.put(first_part(shape) + k, body.parts[k], places[first_part(shape) + k].begin);
  storage.put_slabs(shape, first_part(shape), body);
}

void DynamicShapeSet::State::require(std::uint32_t shape, const FlatBody& body) const {
  if (shape >= shapes)
    throw std::out_of_range("dynamic shape set: shape " + std::to_string(shape) + " of " +
                            std::to_string(shapes));
  if (set.roots_only()) {
    if (body.plan.depths != plan.depths || body.plan.slices != plan.slices || has_level(body, false))
      throw std::invalid_argument("dynamic shape set: it has single discs alone, and the shape has more");
  } else if (body.plan != plan) {
    throw std::invalid_argument("dynamic shape set: the shape was made flat with another plan");
  }
}

bool DynamicShapeSet::State::try_replace(std::uint32_t shape, const FlatBody& body) {
  require(shape, body);
  for (std::size_t k = 0; k < body.part_count; ++k) {
    if (!fits(extent_of(body.parts[k]), places[first_part(shape) + k].size)) return false;
  }
  // Else set has to learn of single discs, or a kernel would not look for them.
  if (set.view().rows_in_order && has_level(body, true)) return false;
  put(shape, body);
  return true;
}

void DynamicShapeSet::State::replace(std::uint32_t shape, const FlatBody& body) {
  if (try_replace(shape, body)) return;
  // The refresh also happens where an allocation fails half way.
  struct Refresh {
    State& of;
    ~Refresh() { of.set.refer_to(of.storage.arrays()); }
  };
  const Refresh refresh{*this};
  for (std::size_t k = 0; k < body.part_count; ++k) {
    const ShapeExtent needed = extent_of(body.parts[k]);
    ShapeExtent room = needed;
    for_each_part([](std::size_t& part) { part += part / 2; }, room);
    make_place(first_part(shape) + k, needed, room);
  }
  put(shape, body);
}

/// Parts that have room enough stay where they are.
void DynamicShapeSet::State::make_place(std::size_t part, const ShapeExtent& needed,
                                        const ShapeExtent& room) {
  auto [begin, size] = places[part];
  ShapeExtent to_lines = room, grown;
  to_lines.nodes = next_line(room.nodes);
  for_each_part(
      [](std::size_t& more, std::size_t least, std::size_t with_room, std::size_t behind, std::size_t& from,
         std::size_t& length) { more = grow(least, with_room, behind, from, length); },
      grown, needed, to_lines, end, begin, size);
  storage.make_room(end, grown);
  places[part] = {begin, size};
  for_each_part([](std::size_t& behind, std::size_t more) { behind += more; }, end, grown);
}

DynamicShapeSet::DynamicShapeSet(const ShapeSet& start) : state_(std::make_unique<State>(start)) {}
DynamicShapeSet::DynamicShapeSet(DynamicShapeSet&&) noexcept = default;
DynamicShapeSet& DynamicShapeSet::operator=(DynamicShapeSet&&) noexcept = default;
DynamicShapeSet::~DynamicShapeSet() = default;

const ShapeSet& DynamicShapeSet::set() const noexcept {
  return state_->set;
}

bool DynamicShapeSet::try_replace(std::uint32_t shape, const PreparedShape& by) {
  return state_->try_replace(shape, by.flat());
}

void DynamicShapeSet::replace(std::uint32_t shape, const PreparedShape& by) {
  state_->replace(shape, by.flat());
}

}  // namespace bch
