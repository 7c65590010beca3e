// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {
struct BodyLayout;
struct BodySetView;
/// The number of spheres per body that queries test first, because most collisions involve them.
constexpr std::uint32_t core_spheres = 16;
}  // namespace bch::detail

namespace bch {

/// Holds bodies of spheres for batch queries, each as one record of a fixed size.
/// Agents name bodies by index (Agents::shape) and stand at any height (Agents::z). A moved-from object can
/// only be assigned to or destroyed.
class BodySet {
 public:
  /// Represents the points within a radius of a segment in space, metres.
  /// (bch::Capsule lies on the ground plane.)
  struct Capsule {
    Vec3 a, b;
    float radius = 0;
  };

  /// Makes bodies of spheres, in metres, relative to their agents.
  /// Queries number the spheres of a body in the given order.
  /// Errors:  throws std::invalid_argument, naming the body, if it has no spheres or more than 4096, if a
  ///          sphere is not finite or has a negative radius, and if the extent is outside 1e-6 to 1e6 m;
  ///          std::length_error beyond 2^32 bodies.
  explicit BodySet(std::span<const std::vector<Sphere>> bodies);
  BodySet(BodySet&&) noexcept;
  BodySet& operator=(BodySet&&) noexcept;
  ~BodySet();

  std::uint32_t body_count() const noexcept;
  std::size_t bytes() const noexcept;
  /// Returns the spheres of a body as queries use them: enlarged by the rounding margin.
  /// Errors:  throws std::out_of_range if the index is out of range.
  std::vector<Sphere> spheres(std::uint32_t body) const;
  /// Returns the interval of heights of a body above its agent's ground, metres.
  /// Errors:  as spheres().
  Heights heights(std::uint32_t body) const;

  // Internal, for the library's own code; the types in namespace detail are not public.
  /// Allocates one record per body; body i has layout layouts[layout_of_body[i]].
  /// Each record must be written before it is read.
  BodySet(std::vector<detail::BodyLayout> layouts, std::span<const std::uint32_t> layout_of_body);
  const detail::BodySetView& view() const noexcept;
  const detail::BodyLayout& layout(std::uint32_t body) const noexcept;
  /// Returns the record of a body, for writing. Threads may write different bodies at the same time.
  float* record(std::uint32_t body) noexcept;
  /// Copies, from a written record, what the broad phase reads.
  void publish(std::uint32_t body) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns spheres that cover capsules, such as those of a ragdoll: one row of spheres per capsule.
/// The spheres protrude from the capsules by at most `error`.
/// Units:   metres; `error` must exceed 1e-6 of each capsule's extent.
/// Errors:  throws std::invalid_argument if there are no capsules, a radius is negative, an extent is outside
///          1e-6 to 1e6 m, or `error` is too small or needs more than 4096 spheres (naming the capsule).
std::vector<Sphere> spheres_from_capsules(std::span<const BodySet::Capsule> capsules, float error = 0.005f);

/// Returns spheres that cover upright prisms over polygons: a cart or a box among people.
/// The spheres protrude from the prisms by at most `error`; all lengths are metres.
/// Cost:    milliseconds. A box of 0.6 x 0.4 x 1 m needs 104 spheres at the default error of 5 cm, 556 at 2
///          cm.
/// Errors:  throws std::invalid_argument as outline_from_polygons() does, if the heights do not ascend or are
///          not within +-1e6 m, and, naming the polygon, if the error is not above 0 or needs more than 4096
///          spheres.
std::vector<Sphere> spheres_from_polygons(std::span<const std::vector<Vec2>> polygons, const Heights& heights,
                                          float error = 0.05f);

}  // namespace bch
