// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>

#include "baselines/exact_tests.hpp"
#include "baselines/expansion.hpp"

// The filters' error bounds are those of Shewchuk 1997, section 4.3 (ccwerrboundA, o3derrboundA).

namespace bch::baselines {
namespace {

constexpr double epsilon = 0x1p-53;
constexpr double bound_2d = (3 + 16 * epsilon) * epsilon;
constexpr double bound_3d = (7 + 56 * epsilon) * epsilon;

int exact_orientation(const Point2& a, const Point2& b, const Point2& c) noexcept {
  Expansion determinant = Expansion::difference(a.x, c.x) * Expansion::difference(b.y, c.y);
  determinant.subtract(Expansion::difference(a.y, c.y) * Expansion::difference(b.x, c.x));
  return determinant.sign();
}

struct Difference {
  Expansion x, y, z;
};

Difference difference(const Point3& p, const Point3& q) noexcept {
  return {Expansion::difference(p.x, q.x), Expansion::difference(p.y, q.y), Expansion::difference(p.z, q.z)};
}

int exact_orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) noexcept {
  const Difference u = difference(b, a), v = difference(c, a), w = difference(d, a);
  const auto minor = [](const Expansion& p, const Expansion& q, const Expansion& r, const Expansion& s) {
    Expansion result = p * q;
    result.subtract(r * s);
    return result;
  };
  Expansion determinant = minor(u.y, v.z, u.z, v.y) * w.x;
  determinant.add(minor(u.z, v.x, u.x, v.z) * w.y);
  determinant.add(minor(u.x, v.y, u.y, v.x) * w.z);
  return determinant.sign();
}

}  // namespace

int orientation(const Point2& a, const Point2& b, const Point2& c) noexcept {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = bound_2d * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return exact_orientation(a, b, c);
}

int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) noexcept {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double wx = d.x - a.x, wy = d.y - a.y, wz = d.z - a.z;
  const double uy_vz = uy * vz, uz_vy = uz * vy, uz_vx = uz * vx, ux_vz = ux * vz, ux_vy = ux * vy,
               uy_vx = uy * vx;
  const double determinant = (uy_vz - uz_vy) * wx + (uz_vx - ux_vz) * wy + (ux_vy - uy_vx) * wz;
  const double bound = bound_3d * ((std::abs(uy_vz) + std::abs(uz_vy)) * std::abs(wx) +
                                   (std::abs(uz_vx) + std::abs(ux_vz)) * std::abs(wy) +
                                   (std::abs(ux_vy) + std::abs(uy_vx)) * std::abs(wz));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return exact_orientation(a, b, c, d);
}

}  // namespace bch::baselines
