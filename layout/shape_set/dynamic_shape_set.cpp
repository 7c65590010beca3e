// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shapes.hpp>

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
  for_each_part([&](std::size_t needed, std::size_t capacity) { all &= needed <= capacity; }, part, whole);
  return all;
}

/// One part of a shape, which gets a new place behind all others where it outgrew its own.
/// Returns: how far that makes the end move.
std::size_t grow(std::size_t needed, std::size_t capacity, std::size_t end, std::size_t& begin,
                 std::size_t& size) {
  if (needed <= size) return 0;
  begin = end;
  size = capacity;
  return capacity;
}

/// Returns whether a body has a level that is a single disc, or one that is not.
bool has_level(const FlatBody& body, bool is_single) {
  return std::any_of(body.shape.levels.begin(), body.shape.levels.end(),
                     [=](const Bvh8& tree) { return tree.is_single() == is_single; });
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
  void make_place(std::uint32_t shape, const ShapeExtent& needed, const ShapeExtent& capacity);

  ShapeSetPlan plan;
  std::uint32_t shapes;
  ShapeStorage storage;
  std::vector<Place> places;           ///< per shape
  ShapeExtent end{.rows = first_row};  ///< of all places
  ShapeSet set;                        ///< stands on storage
};

DynamicShapeSet::State::State(const ShapeSet& start)
    : plan(start.plan()), shapes(start.shape_count()), places(shapes), set(ShapeArrays(), nullptr) {
  copy(start.arrays(), shapes);
  set.rebind(storage.arrays());
}

/// Shape by shape: they may lie in any order there, and closer to each other than places may.
void DynamicShapeSet::State::copy(const ShapeArrays& arrays, std::size_t count) {
  storage.depths.assign(arrays.depths.begin(), arrays.depths.end());
  const bool roots_only = arrays.trees.empty();
  ShapeSetPlan stored = plan;
  if (roots_only) {
    stored.depths.back() = 0;
    Place any;
    for_each_part([](std::size_t& part) { part = std::numeric_limits<std::size_t>::max(); }, any.size);
    std::fill(places.begin(), places.end(), any);
  }
  storage.resize(stored, count);
  for (std::uint32_t shape = 0; shape < count; ++shape) {
    const FlatBody body = flat_body(arrays, shape);
    const ShapeExtent extent = extent_of(body.shape);
    if (!roots_only) make_place(shape, extent, extent);
    storage.store(shape, body, places[shape].begin);
  }
}

void DynamicShapeSet::State::require(std::uint32_t shape, const FlatBody& body) const {
  if (shape >= shapes)
    throw std::out_of_range("dynamic shape set: shape " + std::to_string(shape) + " of " +
                            std::to_string(shapes));
  if (set.roots_only()) {
    if (body.plan.depths != plan.depths || has_level(body, false))
      throw std::invalid_argument("dynamic shape set: it has single discs alone, and the shape has more");
  } else if (body.plan != plan) {
    throw std::invalid_argument("dynamic shape set: the shape was made flat with another plan");
  }
}

bool DynamicShapeSet::State::try_replace(std::uint32_t shape, const FlatBody& body) {
  require(shape, body);
  if (!fits(extent_of(body.shape), places[shape].size)) return false;
  // Else set has to learn of single discs, or a kernel would not search for them.
  if (set.view().rows_follow_roots && has_level(body, true)) return false;
  storage.store(shape, body, places[shape].begin);
  return true;
}

void DynamicShapeSet::State::replace(std::uint32_t shape, const FlatBody& body) {
  if (try_replace(shape, body)) return;
  // The refresh also happens where an allocation fails half way.
  struct Refresh {
    State& of;
    ~Refresh() { of.set.rebind(of.storage.arrays()); }
  };
  const Refresh refresh{*this};
  const ShapeExtent needed = extent_of(body.shape);
  ShapeExtent capacity = needed;
  for_each_part([](std::size_t& part) { part += part / 2; }, capacity);
  make_place(shape, needed, capacity);
  storage.store(shape, body, places[shape].begin);
}

/// Parts that have room enough stay where they are.
void DynamicShapeSet::State::make_place(std::uint32_t shape, const ShapeExtent& needed,
                                        const ShapeExtent& capacity) {
  auto [begin, size] = places[shape];
  ShapeExtent to_lines = capacity, grown;
  to_lines.nodes = next_line(capacity.nodes);
  for_each_part(
      [](std::size_t& more, std::size_t least, std::size_t with_growth, std::size_t behind, std::size_t& from,
         std::size_t& length) { more = grow(least, with_growth, behind, from, length); },
      grown, needed, to_lines, end, begin, size);
  storage.allocate(end, grown);
  places[shape] = {begin, size};
  for_each_part([](std::size_t& behind, std::size_t more) { behind += more; }, end, grown);
}

DynamicShapeSet::DynamicShapeSet(const ShapeSet& start) : state_(std::make_unique<State>(start)) {}
DynamicShapeSet::DynamicShapeSet(DynamicShapeSet&&) noexcept = default;
DynamicShapeSet& DynamicShapeSet::operator=(DynamicShapeSet&&) noexcept = default;
DynamicShapeSet::~DynamicShapeSet() = default;

const ShapeSet& DynamicShapeSet::set() const noexcept {
  return state_->set;
}

bool DynamicShapeSet::try_replace(std::uint32_t shape, const BuiltShape& by) {
  return state_->try_replace(shape, by.flat());
}

void DynamicShapeSet::replace(std::uint32_t shape, const BuiltShape& by) {
  state_->replace(shape, by.flat());
}

}  // namespace bch
