// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/posing/sphere_poser.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/base/build_implementation.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/posing/posing_loops.hpp"
#include "layout/body/sphere_rounding.hpp"
#include "layout/character/middle.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Float = BaseLanes::Float;

/// Returns the vertices of a model's character, and the centres behind them.
VertexBlend blend_of(const BodyModel& model) {
  std::vector<std::uint32_t> begin = model.character->influence_begin;
  std::vector<PointInfluence> influences = influences_of(*model.character);
  const std::uint32_t of_vertices = begin.back();
  for (const auto& [bone, weight, centre] : model.influences) influences.push_back({bone, weight, centre});
  for (std::size_t s = 1; s < model.influence_begin.size(); ++s)
    begin.push_back(of_vertices + model.influence_begin[s]);
  return {begin, influences};
}

Float midpoint(const SpaceRow& a, const SpaceRow& b) {
  return Float(0.5f) * (Float::load_aligned(&a.x) + Float::load_aligned(&b.x));
}

}  // namespace

SpherePoser::SpherePoser(const BodyModel& model, const BodyLayout& layout)
    : model_(model), layout_(layout), skinner_(*model.character), blend_(blend_of(model)) {
  const auto vertices = static_cast<std::uint32_t>(model.character->vertices.size());
  const auto spheres = static_cast<std::uint32_t>(model.sphere_count());
  points_.resize(vertices + spheres + model.midpoints.size());
  std::vector<std::uint32_t> cuts_above(vertices, 0);  ///< by point
  for (const auto [a, b] : model.midpoints) {
    cuts_.push_back({row_of(a), row_of(b)});
    cuts_above.push_back(1 + std::max(cuts_above[a], cuts_above[b]));
    max_cuts_ = std::max(max_cuts_, cuts_above.back());
  }
  for (std::uint32_t s = 0; s < spheres; ++s) {
    for (std::uint32_t i = model.corner_begin[s]; i < model.corner_begin[s + 1]; ++i)
      corners_.push_back(row_of(model.corners[i]));
    while (model.corner_begin[s] < model.corner_begin[s + 1] && corners_.size() % corner_block != 0)
      corners_.push_back(corners_.back());
    corner_end_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }
  const std::size_t lines = (layout.slot_count() + record_line - 1) / record_line * record_line;
  for (AlignedVector<float>* const field : {&x_, &y_, &z_, &radius_, &least_}) field->resize(lines);
  std::copy(model.least_radius.begin(), model.least_radius.end(), least_.begin());
  for (std::size_t s = spheres; s < lines; ++s) least_[s] = least_[s - 1];
}

void SpherePoser::place_points(const Pose& pose) {
  const std::size_t vertices = model_.character->vertices.size();
  const std::size_t blended = vertices + model_.sphere_count();
  skinner_.place_bones_of(pose);
  const std::span<SpaceRow> all(points_);
  if (const auto bad = blend_.blend(skinner_.bone_maps(), all.first(blended)))
    throw std::domain_error(
        "character '" + model_.character->name + "': posed " +
        (*bad < vertices ? "vertex " + std::to_string(*bad) : "sphere " + std::to_string(*bad - vertices)) +
        " is not finite");
  if (model_.character->root_joint < 0) {
    const Vec2 middle = middle_of(std::span<const SpaceRow>(all.first(vertices)));
    move_by(all.first(blended), {-middle.x, -middle.y});
  }
  SpaceRow* to = points_.data() + blended;
  for (const auto [a, b] : cuts_) midpoint(points_[a], points_[b]).store_aligned(&(to++)->x);
}

/// Sets radii to the distances of the farthest corners, and enlarges them by what was rounded, so that queries miss nothing. With P the
/// extent and u the unit roundoff: a corner is off by
///
///     (cut)       u P sqrt(3)      for each cut above it: a rounding of each coordinate of a mean, and the mean of its ends' errors
///
/// A distance r is off by 4 u r: u for each difference, 3 u of the square and so 1.5 u of the root for squares and sums, and its
/// rounding, 0.5 u, is 3 u, of lengths that are themselves off by less than 2^-20. What is added and multiplied here rounds by less than
/// 3 u of the sum. The extent is that of the enlarged spheres, which is at most 2^-16 larger than P.
void SpherePoser::fit_radii() {
  constexpr float unit = 0x1p-24f;
  constexpr float distance_error = 8 * unit;  // 4 of the distance, 3 of what follows
  const PosingLoops& loops = best_build_implementation().loops.posing;
  const SphereFields fields{x_.data(), y_.data(), z_.data(), radius_.data()};
  const std::uint32_t spheres = layout_.sphere_count;
  loops.measure({spheres, &points_[0].x, &points_[model_.character->vertices.size()].x, corners_.data(),
                 corner_end_.data()},
                fields);
  for (std::size_t s = spheres; s < x_.size(); ++s)
    x_[s] = x_[s - 1], y_[s] = y_[s - 1], z_[s] = z_[s - 1], radius_[s] = radius_[s - 1];
  const float max_extent =
      loops.take_roots(fields, static_cast<std::uint32_t>(x_.size()), least_.data(), distance_error);
  if (!(double{max_extent} >= rounding::smallest_extent && double{max_extent} <= rounding::largest_extent))
    throw std::domain_error("character '" + model_.character->name +
                            "': expected a pose with an extent of 1e-6 to 1e6 m, found " +
                            shortest(max_extent));
  // 1.01 for what the margin itself adds to the extent, and what is rounded here.
  const float margin =
      max_extent *
      static_cast<float>(1.01 * (rounding::sphere_margin + 1.7321 * max_cuts_ * rounding::unit_roundoff));
  for (float& radius : radius_) radius += margin;
}

SphereSlots SpherePoser::pose(const Pose& pose) {
  place_points(pose);
  fit_radii();
  return {x_.data(), y_.data(), z_.data(), radius_.data()};
}

}  // namespace bch::detail
