// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Geometry>

#include <bch/geometry.hpp>

// Private: Eigen, in which sources compute, and the one way between its types and the plain ones of public headers.

namespace bch::detail {

inline Eigen::Vector3f to_eigen(const Vec3& v) {
  return {v.x, v.y, v.z};
}
inline Eigen::Quaternionf to_eigen(const Quaternion& q) {
  return Eigen::Quaternionf(Eigen::Map<const Eigen::Quaternionf>(&q.x));
}
inline Eigen::Affine3f to_eigen(const Affine3& map) {
  Eigen::Affine3f result = Eigen::Affine3f::Identity();
  result.affine() = Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(map.rows[0]);
  return result;
}

inline Vec3 vec3(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}
inline Quaternion quaternion(const Eigen::Quaternionf& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
inline Affine3 affine3(const Eigen::Affine3f& map) {
  Affine3 result;
  Eigen::Map<Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(result.rows[0]) = map.affine();
  return result;
}

inline Affine3 translation(const Eigen::Vector3f& by) {
  return affine3(Eigen::Affine3f(Eigen::Translation3f(by)));
}

/// Returns the numbers of a value, for what is done to each of them alone.
inline Eigen::Vector3f coefficients(const Vec3& v) {
  return to_eigen(v);
}
inline Eigen::Vector4f coefficients(const Quaternion& q) {
  return to_eigen(q).coeffs();
}

}  // namespace bch::detail
