// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/capsule_test.hpp"

namespace bch::baselines {

extern CollideCapsules collide_capsules_base;
void collide_capsules_base(const CapsulePair* pairs, std::size_t count, std::uint8_t* hits) {
  collide_all(pairs, count, hits);
}

}  // namespace bch::baselines
