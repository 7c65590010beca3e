// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx_channel.hpp"

#include <algorithm>

namespace bch::detail::importing {
namespace {

FbxTransform transform_from(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation,
                            const Eigen::Vector3d& scale) {
  FbxTransform result{Eigen::Affine3d(Eigen::Translation3d(position)), position, rotation, scale, false};
  result.map.linear() = rotation.toRotationMatrix() * scale.asDiagonal();
  return result;
}

Eigen::Vector3d value_in(const aiVectorKey& key) {
  return {static_cast<double>(key.mValue.x), static_cast<double>(key.mValue.y),
          static_cast<double>(key.mValue.z)};
}
Eigen::Quaterniond value_in(const aiQuatKey& key) {
  return {static_cast<double>(key.mValue.w), static_cast<double>(key.mValue.x),
          static_cast<double>(key.mValue.y), static_cast<double>(key.mValue.z)};
}

Eigen::Vector3d mixed(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double fraction) {
  return a + fraction * (b - a);
}
Eigen::Quaterniond mixed(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double fraction) {
  return a.slerp(fraction, b);
}

/// Returns what a list of keys says at a time in ticks; `otherwise` without any.
template <class Key, class Value>
Value value_at(const Key* keys, unsigned size, double ticks, const Value& otherwise) {
  if (size == 0 || keys == nullptr) return otherwise;
  const Key* const after =
      std::partition_point(keys, keys + size, [&](const Key& key) { return key.mTime <= ticks; });
  if (after == keys) return value_in(*keys);
  const Key& before = *(after - 1);
  if (after == keys + size) return value_in(before);
  return mixed(value_in(before), value_in(*after), (ticks - before.mTime) / (after->mTime - before.mTime));
}

template <class AiKey>
AiKey* copied(const std::vector<AiKey>& keys) {
  AiKey* const copy = new AiKey[keys.size()];
  std::copy(keys.begin(), keys.end(), copy);
  return copy;
}

}  // namespace

FbxTransform blend(const FbxTransform& a, const FbxTransform& b, double fraction) {
  return transform_from(mixed(a.position, b.position, fraction), mixed(a.rotation, b.rotation, fraction),
                        mixed(a.scale, b.scale, fraction));
}

FbxTransform shown_by(const aiNodeAnim& channel, double ticks, const FbxTransform& rest) {
  return transform_from(value_at(channel.mPositionKeys, channel.mNumPositionKeys, ticks, rest.position),
                        value_at(channel.mRotationKeys, channel.mNumRotationKeys, ticks, rest.rotation),
                        value_at(channel.mScalingKeys, channel.mNumScalingKeys, ticks, rest.scale));
}

void ChannelMaker::add(double ticks, const FbxTransform& pose) {
  if (pose.sheared) file_.reject(place_ + " shears it, which is not read");
  const auto as_float = [](double number) { return static_cast<float>(number); };
  const Eigen::Vector3f position = pose.position.cast<float>(), scale = pose.scale.cast<float>();
  const Eigen::Quaterniond& q = pose.rotation;
  positions_.emplace_back(ticks, aiVector3D(position.x(), position.y(), position.z()));
  rotations_.emplace_back(ticks,
                          aiQuaternion(as_float(q.w()), as_float(q.x()), as_float(q.y()), as_float(q.z())));
  scales_.emplace_back(ticks, aiVector3D(scale.x(), scale.y(), scale.z()));
}

std::unique_ptr<aiNodeAnim> ChannelMaker::channel() const {
  auto made = std::make_unique<aiNodeAnim>();
  made->mNumPositionKeys = made->mNumRotationKeys = made->mNumScalingKeys =
      static_cast<unsigned>(positions_.size());
  made->mPositionKeys = copied(positions_);
  made->mRotationKeys = copied(rotations_);
  made->mScalingKeys = copied(scales_);
  return made;
}

}  // namespace bch::detail::importing
