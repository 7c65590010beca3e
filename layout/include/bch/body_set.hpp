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
/// The number of spheres of a body that queries test first, as most collisions involve them.
constexpr std::uint32_t core_spheres = 16;
}  // namespace bch::detail

namespace bch {

/// Holds bodies of spheres for batch queries, each as one record of a fixed size.
/// Agents name bodies by their numbers (Agents::shape) and stand at any height (Agents::z). An object that
/// was moved from can only be assigned to or destroyed.
class BodySet {
 public:
  /// Represents the points within a radius of a segment in space, metres. (bch::Capsule is one on the
  /// ground.)
  struct Capsule {
    Vec3 a, b;
    float radius = 0;
  };

  /// Makes bodies of given spheres, in metres, in the frames of their agents.
  /// Queries number spheres as they are given.
  /// Errors:  throws std::invalid_argument, naming the body, on no spheres or more than 4096, on a sphere
  ///          that is not finite or has a negative radius, and on a reach outside 1e-6 to 1e6 m;
  ///          std::length_error beyond 2^32 bodies.
  explicit BodySet(std::span<const std::vector<Sphere>> bodies);
  BodySet(BodySet&&) noexcept;
  BodySet& operator=(BodySet&&) noexcept;
  ~BodySet();

  std::uint32_t body_count() const noexcept;
  std::size_t bytes() const noexcept;
  /// Returns the spheres of a body as queries use them, with the rounding margin.
  /// Errors:  throws std::out_of_range on an index out of range.
  std::vector<Sphere> spheres(std::uint32_t body) const;
  /// Returns the heights of a body above its agent's ground, metres. Errors: as spheres().
  Heights heights(std::uint32_t body) const;

  // For the library's own parts, which alone know these types.
  /// Allocates the records of bodies, of which number i has layout layout_of_body[i].
  /// Records have to be written before they are read.
  BodySet(std::vector<detail::BodyLayout> layouts, std::span<const std::uint32_t> layout_of_body);
  const detail::BodySetView& view() const noexcept;
  const detail::BodyLayout& layout(std::uint32_t body) const noexcept;
  /// Returns where the record of a body is written. Threads may write different bodies at once.
  float* record(std::uint32_t body) noexcept;
  /// Copies what the broad phase reads of a record that was written.
  void publish(std::uint32_t body) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns spheres that cover capsules, such as those of a ragdoll: one row of spheres per capsule.
/// They protrude from the capsules by at most `error`.
/// Units:   metres, all; the error is more than 1e-6 of a capsule's reach.
/// Errors:  throws std::invalid_argument on no capsules; naming the capsule, on a negative radius, on a reach
///          outside 1e-6 to 1e6 m, and on an error that is too small, or takes more than 4096 spheres.
std::vector<Sphere> spheres_from_capsules(std::span<const BodySet::Capsule> capsules, float error = 0.005f);

/// Returns spheres that cover upright prisms over polygons: a cart or a box among people.
/// They protrude by at most `error`; all lengths are metres.
/// Cost:    milliseconds. A box of 0.6 x 0.4 x 1 m takes 104 spheres at the default error of 5 cm, 556 at 2
///          cm.
/// Errors:  throws std::invalid_argument as outline_from_polygons() does, on heights that do not ascend or
///          are not within +-1e6 m, and, naming the polygon, on an error that is not above 0 or takes more
///          than 4096 spheres.
std::vector<Sphere> spheres_from_polygons(std::span<const std::vector<Vec2>> polygons, const Heights& heights,
                                          float error = 0.05f);

}  // namespace bch
