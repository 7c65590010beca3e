// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/body/placed_bodies.hpp"
#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/arguments.hpp"
#include "kernel/simd/relative_transforms.hpp"

namespace bch::detail {

/// Holds what the kernel of bodies of spheres reads and writes: plain pointers only, as Arguments.
struct BodyArguments {
  Arguments pairs;  ///< agents, pairs and states; its shapes are the discs of the bodies
  const BodySetView* bodies;
};

/// Returns the bodies of a pair of a packet.
template <class Simd>
[[gnu::always_inline]] inline PlacedBodies placed_bodies(const BodyArguments& in,
                                                         const RelativeTransforms<Simd>& transforms,
                                                         std::uint32_t pair) noexcept {
  const AgentColumn& z = in.pairs.agent_z;
  const float dz = z.first == nullptr
                       ? 0
                       : static_cast<float>(AgentColumns<Simd>::number(z, transforms.agent_b(pair)) -
                                            AgentColumns<Simd>::number(z, transforms.agent_a(pair)));
  return {in.bodies->record(transforms.shape_a[pair]),
          in.bodies->record(transforms.shape_b[pair]),
          {transforms.transform(pair), dz}};
}

}  // namespace bch::detail
