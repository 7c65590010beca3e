// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch {

/// A point or vector of the ground plane, metres.
struct Vec2 {
  float x = 0;
  float y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

/// A closed disc on the ground: a vertical cylinder of infinite height seen from above.
struct Disc {
  float x = 0;
  float y = 0;
  float radius = 0;
  friend bool operator==(const Disc&, const Disc&) = default;
};

}  // namespace bch
