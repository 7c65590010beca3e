// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <limits>

namespace bch {

// The extent of a body is the largest distance of its points from the origin of its frame, in metres.

/// Represents a point or vector of the ground plane, in metres.
struct Vec2 {
  float x = 0;
  float y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

/// Represents a point or vector of space, in metres; z is up.
struct Vec3 {
  float x = 0;
  float y = 0;
  float z = 0;
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Represents a rotation as a unit quaternion, or a tangent of a curve of rotations.
struct Quaternion {
  float x = 0;
  float y = 0;
  float z = 0;
  float w = 1;
  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// Represents an affine map, row-major: a 3 x 3 linear part, and the translation in column 3.
/// It maps a point to rows * (x, y, z, 1).
struct Affine3 {
  float rows[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  friend bool operator==(const Affine3&, const Affine3&) = default;
};

/// Represents a disc on the ground, boundary included: a vertical cylinder of infinite height, seen from
/// above.
struct Disc {
  float x = 0;
  float y = 0;
  float radius = 0;
  friend bool operator==(const Disc&, const Disc&) = default;
};

/// Represents a ball, in metres.
struct Sphere {
  float x = 0;
  float y = 0;
  float z = 0;
  float radius = 0;
  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// Holds the range of heights of a body or of a part of a body; all heights by default.
/// Units:   metres above the ground that its agent stands on.
struct Heights {
  float bottom = -std::numeric_limits<float>::infinity();
  float top = std::numeric_limits<float>::infinity();
  friend bool operator==(const Heights&, const Heights&) = default;
};

}  // namespace bch
