// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/body/body_contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/body/agent_sphere.hpp"
#include "kernel/body/body_hits.hpp"
#include "kernel/body/near_spheres.hpp"
#include "kernel/body/space_frame.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t contact_pairs_at_once = 256;

bool cylinders_meet(const Cylinder& a, const Cylinder& b, double margin) {
  const double x = b.x - a.x, y = b.y - a.y, radius = a.radius + b.radius + margin;
  return b.bottom - a.top <= margin && a.bottom - b.top <= margin && x * x + y * y <= radius * radius;
}

/// Appends the contacts of a pair that collides. The test of spheres is that of every other query.
void append_contacts(const BodySetView& view, const Agents& agents, Pair pair,
                     std::vector<Crowd::SphereContact>& to) {
  const auto begin = static_cast<std::ptrdiff_t>(to.size());
  const std::uint32_t a = std::min(pair.first, pair.second), b = std::max(pair.first, pair.second);
  const std::uint32_t shape_a = agents.shape[a], shape_b = agents.shape[b];
  const bool is_turned = pair.second < pair.first;
  const AgentPair at(view, agents, a, b);
  const SpaceFrame frame(agents, a, b);
  const float *const record_a = view.record(shape_a), *const record_b = view.record(shape_b);
  const double margin = rounding::bound_margin *
                        (double{header_of(record_a).max_extent} + double{header_of(record_b).max_extent});
  const auto may_touch = [&](const Cylinder& of_a, const Cylinder& of_b) {
    return cylinders_meet(of_a, of_b, margin);
  };
  const auto append = [&](std::uint32_t slot_a, std::uint32_t slot_b, const Sphere& of_a,
                          const Sphere& of_b) {
    if (!spheres_meet<float>({of_a.x, of_a.y, of_a.z, of_a.radius}, {of_b.x, of_b.y, of_b.z, of_b.radius}, 0))
      return;
    const AgentPair::Spheres both = at.spheres(slot_a, slot_b);
    const std::uint32_t number_a = view.number(shape_a, slot_a), number_b = view.number(shape_b, slot_b);
    const auto depth = static_cast<float>(std::max(both.depth(), 0.0));
    to.push_back(is_turned
                     ? Crowd::SphereContact{{number_b, number_a}, both.end_of_b(), both.direction(-1), depth}
                     : Crowd::SphereContact{{number_a, number_b}, both.end_of_a(), both.direction(1), depth});
  };
  NearSpheres(record_a, record_b, frame).visit(may_touch, append);
  std::sort(to.begin() + begin, to.end(),
            [](const Crowd::SphereContact& left, const Crowd::SphereContact& right) {
              const auto [i, j] = left.spheres;
              const auto [k, l] = right.spheres;
              return i != k ? i < k : j < l;
            });
}

}  // namespace

Rows<Crowd::SphereContact> BodyContactRows::find(const BodySet& bodies, const Agents& agents,
                                                 std::span<const Pair> pairs, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen(wanted, "contacts");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  return rows_.collect(pairs.size(), contact_pairs_at_once, [&] {
    return [&](std::size_t begin, std::size_t end, const auto& add) {
      std::uint8_t hits[contact_pairs_at_once];
      find_hits(implementation, view, agents, pairs.subspan(begin, end - begin), hits);
      for (std::size_t i = begin; i < end; ++i)
        if (hits[i - begin] != 0) add(i, [&](auto& to) { append_contacts(view, agents, pairs[i], to); });
    };
  });
}

}  // namespace bch::detail
