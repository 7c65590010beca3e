// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <bch/bodies.hpp>

#include "layout/base/space_point.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/body/posing/sphere_poser.hpp"
#include "layout/character/motion_bounds.hpp"

namespace bch::detail {

/// Holds a body at times of a clip that are so close that its corners move all but straight between them.
///
/// Between two samples no channel passes a key, so that a vertex with an acceleration of at most A leaves the chord of its places at both
/// by at most A h^2 / 8, with h the time between them (see MotionBounds); so does the middle of an edge, a mean of vertices. A sphere whose
/// centre and radius are linear in time holds a corner all the time between if at both samples it holds the corner with that much room:
/// the distance of two points that move straight on is convex in time.
class ClipSamples {
 public:
  /// Represents the body at a time.
  struct Sample {
    float seconds;
    std::vector<Sphere> spheres;
    std::vector<SpacePoint> corners;  ///< as BodyModel::corners
    double bottom, top;               ///< of corners
    double margin = 0;  ///< by which corners may leave their chords on either side, and are rounded
  };

  /// Takes a valid model, which has to outlive this.
  /// Errors:  throws std::invalid_argument as MotionBounds does.
  ClipSamples(const BodyModel& model, std::uint32_t clip);

  /// Takes samples from one time to another, which are the first and the last.
  /// Errors:  throws std::invalid_argument where vertices move too fast for that.
  void take(float from, float to);

  std::size_t size() const noexcept { return samples_.size(); }
  const Sample& operator[](std::size_t i) const noexcept { return samples_[i]; }
  /// Returns the largest coordinate of a corner or a centre, metres.
  double max_extent() const noexcept { return max_extent_; }
  /// Returns the heights of the triangles from the beginning of the first samples that were taken to the end of the last ones, rounded outward.
  const Heights& heights() const noexcept { return heights_; }
  /// Returns the fraction of the time between two other samples that has gone by at one.
  double fraction(std::size_t i, std::size_t first, std::size_t last) const noexcept;
  /// Returns the radius of a sphere that holds its corners about a centre from the sample before to the one after.
  double radius(std::size_t i, std::size_t sphere, const SpacePoint& centre) const noexcept;

 private:
  void add(float seconds);
  void take_in(const Sample& sample, double deviation);

  const BodyModel& model_;
  std::uint32_t clip_;
  MotionBounds bounds_;
  const BodyLayout layout_;
  SpherePoser poser_;
  std::vector<Sample> samples_;
  double max_extent_ = 0;
  Heights heights_;
};

}  // namespace bch::detail
