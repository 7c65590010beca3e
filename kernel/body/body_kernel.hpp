// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/body/body_arguments.hpp"
#include "kernel/body/sphere_test.hpp"
#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/placements.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {

/// Implements the pair query of bodies of spheres: a pair collides if some sphere of one overlaps some sphere of the other.
template <class Simd>
class BodyKernel {
 public:
  static void run(const BodyArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    BodyKernel kernel(arguments);
    for (; begin < end; begin += chunk_size) {
      kernel.at_.place(arguments.pairs, begin, end);
      for (std::uint32_t k = 0; k < kernel.at_.size; ++k)
        arguments.pairs.codes[begin + k] = kernel.collide(k) ? 1 : 0;
    }
  }

 private:
  explicit BodyKernel(const BodyArguments& arguments) noexcept : in_(arguments) {}

  float rise(std::uint32_t pair) const noexcept {
    const AgentColumn& z = in_.pairs.agent_z;
    if (z.first == nullptr) return 0;
    return static_cast<float>(AgentColumns<Simd>::number(z, at_.agent_b(pair)) -
                              AgentColumns<Simd>::number(z, at_.agent_a(pair)));
  }

  bool collide(std::uint32_t pair) const noexcept {
    const float* const a = in_.bodies->record(at_.shape_a[pair]);
    const float* const b = in_.bodies->record(at_.shape_b[pair]);
    const SpaceTransformOf<float> b_in_a{at_.transform(pair), rise(pair)};
    const auto& header_a = *reinterpret_cast<const BodyHeader*>(a);
    const auto& header_b = *reinterpret_cast<const BodyHeader*>(b);
    for (std::uint32_t j = 0; j < header_b.leaf_count * header_b.leaf_size; ++j) {
      const SpheresOf<float> sphere = placed(b_in_a, sphere_in(b, header_b, j));
      for (std::uint32_t i = 0; i < header_a.leaf_count * header_a.leaf_size; ++i)
        if (spheres_overlap(sphere_in(a, header_a, i), sphere)) return true;
    }
    return false;
  }

  static SpheresOf<float> sphere_in(const float* record, const BodyHeader& header,
                                    std::uint32_t slot) noexcept {
    const std::uint32_t size = header.leaf_size;
    const float* const at =
        record + record_nodes + 5 * header.node_stride + 4 * (slot / size) * size + slot % size;
    return {at[0], at[size], at[2 * size], at[3 * size]};
  }

  const BodyArguments& in_;
  Placements<Simd> at_;
};

}  // namespace bch::detail
