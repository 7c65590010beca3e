// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr const char* names[fbx_parts] = {"Lcl Translation",      "Lcl Rotation",      "Lcl Scaling",
                                          "RotationOffset",       "RotationPivot",     "PreRotation",
                                          "PostRotation",         "ScalingOffset",     "ScalingPivot",
                                          "GeometricTranslation", "GeometricRotation", "GeometricScaling"};

constexpr std::int64_t child_first = 0, usual = 1, no_parent_scale = 2;  // kinds of inheritance

constexpr double same = 1e-5;  // relative

bool is_uniform(const Vector3d& scale) {
  return (scale.array() - scale.x()).abs().maxCoeff() <= same * std::abs(scale.x());
}

Vector3d value(const FbxModel& model, FbxPart part, const FbxTime& at) {
  if (at.motions == nullptr) return model.parts[part];
  const auto found = at.motions->find(&model);
  if (found == at.motions->end() || !found->second[part]) return model.parts[part];
  const FbxMotion& motion = *found->second[part];
  Vector3d result = motion.value;
  for (int axis = 0; axis < 3; ++axis)
    if (const FbxCurve* const curve = motion.curves[static_cast<std::size_t>(axis)])
      result[axis] = curve->at(at.seconds, at.before);
  return result;
}

/// Returns a rotation from angles in degrees about x, y and z, in one of FBX's orders: XYZ turns about x first.
Quaterniond rotation_from(const Vector3d& degrees, std::size_t order) {
  constexpr int axes[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
  Quaterniond rotation = Quaterniond::Identity();
  for (const int axis : axes[order])
    rotation = Quaterniond(Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, Vector3d::Unit(axis))) *
               rotation;
  return rotation;
}

}  // namespace

std::string_view name_of(FbxPart part) {
  return names[part];
}

FbxPart part_named(std::string_view property) {
  return static_cast<FbxPart>(std::find(std::begin(names), std::end(names), property) - std::begin(names));
}

void FbxChain::reject(const FbxModel& model, const std::string& reason) const {
  file_->reject("FBX node '" + model.name + "' " + reason);
}

Quaterniond FbxChain::rotation(const FbxModel& model, const FbxTime& at) const {
  const Vector3d angles = value(model, lcl_rotation, at);
  if (!model.has_orientation) return rotation_from(angles, 0);
  std::int64_t order = model.rotation_order;
  if (angles.isZero(0)) order = 0;
  if (order < 0 || order > 5)
    reject(model, "has the rotation order " + std::to_string(order) + ", which is not read (0 to 5 are)");
  return rotation_from(value(model, pre_rotation, at), 0) *
         rotation_from(angles, static_cast<std::size_t>(order)) *
         rotation_from(value(model, post_rotation, at), 0).conjugate();
}

FbxTransform FbxChain::local(const FbxModel& model, const FbxTime& at) const {
  const auto part = [&](FbxPart p) { return value(model, p, at); };
  FbxTransform result;
  result.rotation = rotation(model, at);
  result.scale = part(lcl_scaling);
  const Vector3d pivot = part(scaling_pivot), turned_about = part(rotation_pivot);
  result.position =
      part(lcl_translation) + part(rotation_offset) + turned_about +
      result.rotation * (part(scaling_offset) + pivot - result.scale.cwiseProduct(pivot) - turned_about);
  result.map.linear() = result.rotation.toRotationMatrix() * result.scale.asDiagonal();
  if (model.inherit_type != usual && model.parent != nullptr) inherit(model, at, result);
  result.map.translation() = result.position;
  return result;
}

void FbxChain::inherit(const FbxModel& model, const FbxTime& at, FbxTransform& transform) const {
  if (model.inherit_type != child_first && model.inherit_type != no_parent_scale)
    reject(model, "has the InheritType " + std::to_string(model.inherit_type) + ", which is none of 0, 1, 2");
  const Vector3d above = inherited_scale(*model.parent, at);
  if (model.inherit_type == no_parent_scale) {
    const Vector3d scale_above = value(*model.parent, lcl_scaling, at);
    if ((scale_above.array() == 0).any())
      reject(model, "does not inherit the scale of its parent, which is 0");
    transform.scale = transform.scale.cwiseQuotient(scale_above);
  }
  transform.map.linear() = transform.rotation.toRotationMatrix() * transform.scale.asDiagonal();
  if (is_uniform(above)) return;
  if ((above.array() == 0).any()) reject(model, "inherits a scale of 0");
  for (const FbxModel* m = model.parent; m->parent != nullptr; m = m->parent)
    if (m->inherit_type == usual && !is_uniform(inherited_scale(*m->parent, at)) &&
        !rotation(*m, at).isApprox(Quaterniond::Identity(), same))
      reject(model, "has an InheritType other than 1 below a parent that is sheared, which is not read");
  transform.map.linear() = above.cwiseInverse().asDiagonal() * transform.rotation.toRotationMatrix() *
                           above.asDiagonal() * transform.scale.asDiagonal();
  const Eigen::Matrix3d plain = transform.rotation.toRotationMatrix() * transform.scale.asDiagonal();
  transform.sheared = !plain.isApprox(transform.map.linear(), same);
}

/// The product of the scales that a node's children inherit, along the axes of each.
Vector3d FbxChain::inherited_scale(const FbxModel& model, const FbxTime& at) const {
  Vector3d scale = Vector3d::Ones();
  bool inherits = true;
  for (const FbxModel* m = &model; m != nullptr; m = m->parent) {
    if (inherits) scale = scale.cwiseProduct(value(*m, lcl_scaling, at));
    inherits = m->inherit_type != no_parent_scale;
  }
  return scale;
}

Eigen::Affine3d FbxChain::geometric(const FbxModel& model) {
  Eigen::Affine3d map(Eigen::Translation3d(model.parts[geometric_translation]));
  map.linear() = rotation_from(model.parts[geometric_rotation], 0).toRotationMatrix() *
                 model.parts[geometric_scaling].asDiagonal();
  return map;
}

std::vector<const FbxMotion*> FbxChain::motions_of(const FbxModel& model, const FbxMotions& motions) {
  std::vector<const FbxMotion*> list;
  for (const FbxModel* m = &model; m != nullptr; m = model.inherit_type == usual ? nullptr : m->parent)
    if (const auto found = motions.find(m); found != motions.end())
      for (std::size_t part = 0; part < fbx_parts; ++part)
        if (found->second[part] && (m == &model || part == lcl_scaling))
          list.push_back(&*found->second[part]);
  return list;
}

}  // namespace bch::detail::importing
