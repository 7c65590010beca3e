// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

// Plain types and pointers only: what is compiled for several instruction sets shares no function.

namespace bch::baselines {

constexpr std::uint32_t capsule_lanes = 8;
constexpr std::uint32_t max_capsules = 32;  // as many as a mask has bits
constexpr std::uint32_t whole_box = 8;      // floats

/// Orders the fields of posed capsules, each of them an array of whole lanes, behind a box about the whole ragdoll (its low corner, its
/// high corner, two numbers without meaning): one end, the vector to the other end, the radius, and a box about the capsule. Lanes behind the
/// last capsule repeat it.
struct Field {
  enum : std::uint32_t {
    end_x,
    end_y,
    end_z,
    along_x,
    along_y,
    along_z,
    radius,
    low_x,
    low_y,
    low_z,
    high_x,
    high_y,
    high_z,
    count
  };
};

/// Holds a pair whose second ragdoll stands in the first one's frame as the placement says.
struct CapsulePair {
  const float *a, *b;              ///< fields
  std::uint32_t count_a, count_b;  ///< capsules
  float cosine, sine, x, y, z;
};

using CollideCapsules = void(const CapsulePair* pairs, std::size_t count, std::uint8_t* hits);

}  // namespace bch::baselines
