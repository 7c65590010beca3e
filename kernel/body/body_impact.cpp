// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <limits>

#include <bch/pairs.hpp>

#include "kernel/body/body_hits.hpp"
#include "kernel/body/near_spheres.hpp"
#include "kernel/body/space_frame.hpp"
#include "kernel/body/sphere_impact.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/heading.hpp"

namespace bch {

using namespace detail;

namespace {

/// Finds the first contact of two bodies that do not collide.
class FirstImpact {
 public:
  FirstImpact(const float* a, const float* b, const SpaceFrame& frame, const SpacePoint& displacement)
      : spheres_(a, b, frame), displacement_(displacement) {
    slack_ = 0x1p-16 * (double{header_of(a).max_extent} + double{header_of(b).max_extent} + frame.distance());
  }

  float time() {
    spheres_.visit([&](const Cylinder& a,
                       const Cylinder& b) { return !is_late(bound_of_contact(a, b, displacement_, slack_)); },
                   [&](std::uint32_t, std::uint32_t, const Sphere& a, const Sphere& b) { compare(a, b); });
    return is_found_ ? static_cast<float>(best_) : std::numeric_limits<float>::infinity();
  }

 private:
  /// Returns whether no time above a bound counts.
  bool is_late(double bound) const { return bound * (1 - 0x1p-18) > best_; }

  void compare(const Sphere& a, const Sphere& b) {
    const SpacePoint between{double{b.x - a.x}, double{b.y - a.y}, double{b.z - a.z}};
    const double time = time_of_contact(between, displacement_, double{a.radius + b.radius});
    if (time <= best_) best_ = time, is_found_ = true;
  }

  NearSpheres spheres_;
  SpacePoint displacement_;
  double slack_, best_ = 1;
  bool is_found_ = false;
};

constexpr std::size_t impacts_at_once = 256;

}  // namespace

void time_of_impact(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_valid({"time_of_impact", "pair", pairs.size()}, displacements, times.size());
  const Implementation& implementation = chosen(wanted, "time_of_impact");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  for_pair_ranges(pairs.size(), impacts_at_once, [&](std::size_t begin, std::size_t size) {
    std::uint8_t hits[impacts_at_once];
    find_hits(implementation, view, agents, pairs.subspan(begin, size), hits);
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = begin + k;
      times[i] = 0;
      if (hits[k] != 0) continue;
      const auto [a, b] = std::minmax(pairs[i].first, pairs[i].second);
      const double sign = pairs[i].second < pairs[i].first ? -1 : 1;
      const SpaceFrame frame(agents, a, b);
      const SpacePoint displacement = frame.way(sign * displacements.x[i], sign * displacements.y[i],
                                                displacements.z.empty() ? 0 : sign * displacements.z[i]);
      times[i] =
          FirstImpact(view.record(agents.shape[a]), view.record(agents.shape[b]), frame, displacement).time();
    }
  });
}

}  // namespace bch
