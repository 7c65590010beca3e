// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/body/body_contacts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "kernel/body/agent_sphere.hpp"
#include "kernel/body/body_arguments.hpp"
#include "kernel/body/space_frame.hpp"
#include "kernel/runtime/kernels.hpp"
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

/// Visits all spheres of two bodies that meet: of each body, the leaves that may touch the other one's whole, and then the spheres of those
/// leaves that may touch each other. The test of spheres is that of every other query.
class MeetingSpheres {
 public:
  MeetingSpheres(const float* a, const float* b, const SpaceFrame& frame)
      : a_(a),
        b_(b),
        frame_(frame),
        margin_(rounding::bound_margin * (double{header_of(a).reach} + double{header_of(b).reach})) {}

  template <class Visit>
  void visit(const Visit& use) {
    const Cylinder whole_a = whole_of(a_), whole_b = frame_.placed(whole_of(b_));
    std::uint32_t count = 0;
    for (std::uint32_t j = 0; j < header_of(b_).leaf_count; ++j) {
      nodes_[count] = frame_.placed(node_of(b_, j)), leaves_[count] = j;
      count += cylinders_meet(whole_a, nodes_[count], margin_);
    }
    for (std::uint32_t i = 0; i < header_of(a_).leaf_count; ++i) {
      const Cylinder node = node_of(a_, i);
      if (!cylinders_meet(node, whole_b, margin_)) continue;
      for (std::uint32_t k = 0; k < count; ++k)
        if (cylinders_meet(node, nodes_[k], margin_)) visit_leaves(i, leaves_[k], use);
    }
  }

 private:
  template <class Visit>
  void visit_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, const Visit& use) const {
    const BodyHeader &of_a = header_of(a_), &of_b = header_of(b_);
    const std::uint32_t begin_a = leaf_a * of_a.leaf_size, begin_b = leaf_b * of_b.leaf_size;
    const std::uint32_t end_a = std::min(begin_a + of_a.leaf_size, of_a.sphere_count),
                        end_b = std::min(begin_b + of_b.leaf_size, of_b.sphere_count);
    for (std::uint32_t j = begin_b; j < end_b; ++j) {
      const Sphere b = frame_.placed(sphere_of(b_, j));
      for (std::uint32_t i = begin_a; i < end_a; ++i) {
        const Sphere a = sphere_of(a_, i);
        if (spheres_meet<float>({a.x, a.y, a.z, a.radius}, {b.x, b.y, b.z, b.radius}, 0)) use(i, j);
      }
    }
  }

  const float *a_, *b_;
  const SpaceFrame& frame_;
  const double margin_;
  std::array<Cylinder, most_spheres / 4> nodes_;  ///< of B, placed
  std::array<std::uint32_t, most_spheres / 4> leaves_;
};

/// Appends the contacts of a pair that collides.
void append_contacts(const BodySetView& view, const Agents& agents, Pair pair,
                     std::vector<Crowd::SphereContact>& to) {
  const auto begin = static_cast<std::ptrdiff_t>(to.size());
  const std::uint32_t a = std::min(pair.first, pair.second), b = std::max(pair.first, pair.second);
  const std::uint32_t shape_a = agents.shape[a], shape_b = agents.shape[b];
  const bool is_turned = pair.second < pair.first;
  const AgentPair at(view, agents, a, b);
  const SpaceFrame frame(agents, a, b);
  MeetingSpheres(view.record(shape_a), view.record(shape_b), frame)
      .visit([&](std::uint32_t slot_a, std::uint32_t slot_b) {
        const AgentPair::Spheres both = at.spheres(slot_a, slot_b);
        const std::uint32_t of_a = view.number(shape_a, slot_a), of_b = view.number(shape_b, slot_b);
        const auto depth = static_cast<float>(std::max(both.depth(), 0.0));
        to.push_back(is_turned
                         ? Crowd::SphereContact{{of_b, of_a}, both.end_of_b(), both.direction(-1), depth}
                         : Crowd::SphereContact{{of_a, of_b}, both.end_of_a(), both.direction(1), depth});
      });
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
      BodyArguments arguments{arguments_for(view.ground, agents, pairs.subspan(begin, end - begin)), &view};
      arguments.pairs.codes = hits;
      implementation.kernels->run_bodies(arguments, 0, end - begin);
      for (std::size_t i = begin; i < end; ++i)
        if (hits[i - begin] != 0) add(i, [&](auto& to) { append_contacts(view, agents, pairs[i], to); });
    };
  });
}

}  // namespace bch::detail
