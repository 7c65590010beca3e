// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/body_set.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "layout/base/aligned_vector.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::uint32_t only_depth = 0;

double extent_of(std::span<const Sphere> spheres) {
  double max_extent = 0;
  for (const Sphere& s : spheres) {
    const double x = double{s.x}, y = double{s.y}, z = double{s.z};
    max_extent = std::max(max_extent, std::sqrt(x * x + y * y + z * z) + double{s.radius});
  }
  return max_extent;
}

void require(std::span<const Sphere> spheres, std::size_t body) {
  const std::string whose = "body set: body " + std::to_string(body);
  require_spheres(spheres, whose);
  const double max_extent = extent_of(spheres);
  if (!(max_extent >= rounding::smallest_extent && max_extent <= rounding::largest_extent))
    throw std::invalid_argument(whose + ": expected an extent of 1e-6 to 1e6 m, found " +
                                shortest(max_extent));
}

/// Writes the record of spheres that are given in the order of their numbers.
void write_record(const BodyLayout& layout, std::span<const Sphere> spheres, float* record) {
  const std::uint32_t slots = layout.slot_count();
  std::vector<float> fields(std::size_t{4} * slots);
  float* const x = fields.data();
  const double max_extent = extent_of(spheres);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const Sphere& s = spheres[layout.sphere_in_slot[std::min(slot, layout.sphere_count - 1)]];
    x[slot] = s.x, x[slots + slot] = s.y, x[2 * slots + slot] = s.z;
    x[3 * slots + slot] = rounding::round_up(double{s.radius} + rounding::sphere_margin * max_extent);
  }
  write_record(layout, {x, x + slots, x + 2 * slots, x + 3 * slots}, record);
}

}  // namespace

struct BodySet::State {
  AlignedVector<float> records;
  std::vector<std::uint64_t> record_begin;
  std::vector<BodyLayout> own_layouts;  ///< which are not moved once bodies have them
  std::vector<const BodyLayout*> layouts;
  std::vector<const std::uint32_t*> sphere_in_slot;
  std::vector<Root> roots;
  std::vector<Heights> heights;
  BodySetView view{};

  explicit State(std::size_t bodies) {
    if (bodies > std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("body set: expected fewer than 2^32 bodies, found " + std::to_string(bodies));
    record_begin.reserve(bodies), layouts.reserve(bodies);
    roots.resize(bodies, Root{0, 0, 0, single_disc});
    heights.resize(bodies);
  }

  void add(const BodyLayout& layout) {
    record_begin.push_back(layouts.empty() ? 0 : record_begin.back() + layouts.back()->record_size());
    layouts.push_back(&layout);
  }

  /// Makes room for all records, and the view.
  void allocate() {
    // Kernels read whole registers, so a line follows.
    records.resize(layouts.empty() ? 0 : record_begin.back() + layouts.back()->record_size() + record_line);
    view.ground.shape_count = static_cast<std::uint32_t>(layouts.size());
    view.ground.level_count = 1;
    view.ground.depths = &only_depth;
    view.ground.roots = roots.data();
    view.ground.heights = heights.data();
    view.records = records.data();
    view.record_begin = record_begin.data();
    for (const BodyLayout* const layout : layouts) sphere_in_slot.push_back(layout->sphere_in_slot.data());
    view.sphere_in_slot = sphere_in_slot.data();
  }

  /// Takes over what the broad phase reads of a record, and makes it larger by what queries accept beyond the spheres.
  void publish(std::uint32_t body) noexcept {
    const BodyHeader& header = header_of(view.record(body));
    const float margin = 2 * static_cast<float>(rounding::sphere_margin) * header.max_extent;
    roots[body] = {header.x, header.y, header.radius + margin, single_disc};
    heights[body] = {header.bottom - margin, header.top + margin};
  }

  void require_body(std::uint32_t body) const {
    if (body >= layouts.size())
      throw std::out_of_range("body set: body " + std::to_string(body) + " of " +
                              std::to_string(layouts.size()));
  }
};

BodySet::BodySet(std::span<const std::vector<Sphere>> bodies)
    : state_(std::make_unique<State>(bodies.size())) {
  const FloatingPointStateGuard floats;
  state_->own_layouts.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    require(bodies[i], i);
    state_->add(state_->own_layouts.emplace_back(body_layout({&bodies[i], 1})));
  }
  state_->allocate();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    ::bch::write_record(*state_->layouts[i], bodies[i], record(i));
    publish(i);
  }
}

BodySet::BodySet(std::vector<BodyLayout> layouts, std::span<const std::uint32_t> layout_of_body)
    : state_(std::make_unique<State>(layout_of_body.size())) {
  state_->own_layouts = std::move(layouts);
  for (const std::uint32_t layout : layout_of_body) state_->add(state_->own_layouts[layout]);
  state_->allocate();
}

BodySet::BodySet(BodySet&&) noexcept = default;
BodySet& BodySet::operator=(BodySet&&) noexcept = default;
BodySet::~BodySet() = default;

std::uint32_t BodySet::body_count() const noexcept {
  return state_->view.ground.shape_count;
}

std::size_t BodySet::bytes() const noexcept {
  constexpr std::size_t other_bytes =
      sizeof(std::uint64_t) + sizeof(Root) + sizeof(Heights) + 2 * sizeof(void*);
  return state_->records.size() * sizeof(float) + body_count() * other_bytes;
}

std::vector<Sphere> BodySet::spheres(std::uint32_t body) const {
  state_->require_body(body);
  const BodyLayout& layout = *state_->layouts[body];
  std::vector<Sphere> spheres(layout.sphere_count);
  for (std::uint32_t slot = 0; slot < layout.sphere_count; ++slot)
    spheres[layout.sphere_in_slot[slot]] = sphere_of(state_->view.record(body), slot);
  return spheres;
}

Heights BodySet::heights(std::uint32_t body) const {
  state_->require_body(body);
  return state_->heights[body];
}

const BodySetView& BodySet::view() const noexcept {
  return state_->view;
}

const BodyLayout& BodySet::layout(std::uint32_t body) const noexcept {
  return *state_->layouts[body];
}

float* BodySet::record(std::uint32_t body) noexcept {
  return state_->records.data() + state_->record_begin[body];
}

void BodySet::publish(std::uint32_t body) noexcept {
  state_->publish(body);
}

}  // namespace bch
