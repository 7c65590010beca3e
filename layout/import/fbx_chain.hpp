// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "layout/import/fbx_document.hpp"

// Private to the importer: the chain of transforms of FBX's nodes, as its documentation publishes it. A node's transform is
// T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1 in the frame of its parent.

namespace bch::detail::importing {

/// Selects a property of a model that its transform is made of.
enum FbxPart : std::uint8_t {
  lcl_translation,
  lcl_rotation,
  lcl_scaling,
  rotation_offset,
  rotation_pivot,
  pre_rotation,
  post_rotation,
  scaling_offset,
  scaling_pivot,
  geometric_translation,
  geometric_rotation,
  geometric_scaling,
  fbx_parts
};

std::string_view name_of(FbxPart part);
/// Returns the part that a property is; fbx_parts for any other property.
FbxPart part_named(std::string_view property);

/// Represents a node of the scene.
struct FbxModel {
  FbxId id = 0;
  std::string name;
  std::array<Eigen::Vector3d, fbx_parts> parts;  ///< at rest
  std::int64_t rotation_order = 0;
  bool has_orientation = true;  ///< false: the order, PreRotation and PostRotation are not used
  std::int64_t inherit_type = 1;
  const FbxModel* parent = nullptr;
};

/// Holds what moves one part of a model.
struct FbxMotion {
  std::array<const FbxCurve*, 3> curves{};
  Eigen::Vector3d value;  ///< where there is no curve
};
using FbxMotions = std::unordered_map<const FbxModel*, std::array<std::optional<FbxMotion>, fbx_parts>>;

/// Names a time of a clip, or the one just before it, which differs where a value jumps.
struct FbxTime {
  const FbxMotions* motions = nullptr;  ///< none: at rest
  double seconds = 0;
  bool before = false;
};

/// Represents a transform in the parent's frame. Where it is sheared, rotation and scale alone do not describe it.
struct FbxTransform {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  bool sheared = false;
};

/// Computes transforms of a file's models.
class FbxChain {
 public:
  explicit FbxChain(const FbxFile& file) : file_(&file) {}

  /// Returns the transform in the parent's frame such that what FBX inherits otherwise comes out.
  /// Errors:  throws ImportError naming the model where its properties are not read.
  FbxTransform local(const FbxModel& model, const FbxTime& at) const;
  /// Returns where the meshes of a model stand in its frame.
  static Eigen::Affine3d geometric(const FbxModel& model);
  /// Returns the parts that move a model: its own and, where these come in, the scalings of models above it.
  static std::vector<const FbxMotion*> motions_of(const FbxModel& model, const FbxMotions& motions);

 private:
  const FbxFile* file_;

  [[noreturn]] void reject(const FbxModel& model, const std::string& reason) const;
  Eigen::Quaterniond rotation(const FbxModel& model, const FbxTime& at) const;
  /// Sets scale and shear of a transform under a parent whose scale is not inherited as usual.
  void inherit(const FbxModel& model, const FbxTime& at, FbxTransform& transform) const;
  Eigen::Vector3d inherited_scale(const FbxModel& model, const FbxTime& at) const;
};

}  // namespace bch::detail::importing
