// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <bch/bodies.hpp>

#include "layout/base/aligned_vector.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/character/skinning.hpp"
#include "layout/character/vertex_blend.hpp"

namespace bch::detail {

/// Poses the spheres of a model: blends vertices and centres, and gives each sphere the radius that holds its corners. Keeps its memory
/// from pose to pose.
class SpherePoser {
 public:
  /// Takes a valid model, see validate(), which has to outlive this; so has `layout`, which is that of the model.
  SpherePoser(const BodyModel& model, const BodyLayout& layout);

  /// Poses all spheres.
  /// Returns: the spheres by slots, valid until the next call.
  /// Errors:  as Skinner::place_bones_of(); throws std::domain_error on a position that is not finite, and on an extent outside 1e-6 to
  ///          1e6 m.
  SphereSlots pose(const Pose& pose);

  /// Returns where a point of the model is in the last pose, by the number that BodyModel::corners have.
  const SpaceRow& point(std::uint32_t number) const noexcept { return points_[row_of(number)]; }

 private:
  /// Centres stand between vertices and cuts.
  std::uint32_t row_of(std::uint32_t point) const noexcept {
    const auto vertices = static_cast<std::uint32_t>(model_.character->vertices.size());
    return point < vertices ? point : point + static_cast<std::uint32_t>(model_.sphere_count());
  }
  void place_points(const Pose& pose);
  void fit_radii();

  const BodyModel& model_;
  const BodyLayout& layout_;
  Skinner skinner_;
  VertexBlend blend_;                                ///< of the vertices, and then of the centres
  AlignedVector<SpaceRow> points_;                   ///< vertices, centres, cuts
  std::vector<std::array<std::uint32_t, 2>> cuts_;   ///< numbers among points_
  std::vector<std::uint32_t> corners_;               ///< numbers among points_, filled up to blocks by sphere
  std::vector<std::uint32_t> corner_end_;            ///< by sphere
  std::uint32_t max_cuts_ = 0;                       ///< that a corner is away from a vertex
  AlignedVector<float> x_, y_, z_, radius_, least_;  ///< by slots, filled up to whole lines
};

}  // namespace bch::detail
