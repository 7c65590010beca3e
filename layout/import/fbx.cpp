// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/fbx.hpp"

#include <algorithm>
#include <set>

#include "layout/base/number_class.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr double rounding = 1e-4;  // assimp computes in float

/// Names nodes by what is theirs alone. Bones come first, as clips of other files find them by name.
void make_names_unique(FbxScene& file) {
  std::set<FbxId> bones;
  for (const FbxId cluster : file.document.all("Deformer", "Cluster"))
    for (const FbxId bone : file.document.below(cluster, "Model")) bones.insert(bone);
  std::set<std::string> taken;
  for (const bool bone : {true, false})
    for (std::size_t m = 0; m < file.models.size(); ++m) {
      const FbxModel& model = file.models[m];
      if (bones.contains(model.id) != bone) continue;
      std::string name = model.name;
      if (!taken.insert(name).second) {
        name = name.substr(0, 900) + " (node " + std::to_string(m) + ")";
        while (!taken.insert(name).second) name += "'";
      }
      file.node_of.at(&model)->mName.Set(name);
    }
}

void correct_nodes(FbxScene& file) {
  for (const FbxModel& model : file.models) {
    aiMatrix4x4& matrix = file.node_of.at(&model)->mTransformation;
    const Eigen::Affine3d local = file.chain.local(model, {}).map;
    if (!agree(FbxScene::map_of(matrix), local, rounding)) matrix = FbxScene::matrix_of(local);
  }
}

}  // namespace

FbxScene::FbxScene(const std::filesystem::path& path, const aiScene& scene)
    : document(path), chain(document.file()) {
  std::vector<const FbxModel*> left;
  place_children(*scene.mRootNode, nullptr, left);
  while (!left.empty()) {
    const FbxModel* const model = left.back();
    left.pop_back();
    place_children(*node_of.at(model), model, left);
  }
}

/// assimp leaves out what it cannot read, and keeps the order of what it reads.
void FbxScene::place_children(const aiNode& node, const FbxModel* parent,
                              std::vector<const FbxModel*>& left) {
  const std::vector<FbxId> ids = document.below(parent == nullptr ? 0 : parent->id, "Model");
  auto next = ids.begin();
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    aiNode* const child = node.mChildren[c];
    const std::string name = to_string(child->mName);
    const auto is_child = [&](FbxId id) {
      return FbxDocument::name_of(*document.object(id)).substr(0, 1023) == name;
    };
    next = std::find_if(next, ids.end(), is_child);
    if (next == ids.end()) document.file().reject("FBX node '" + name + "' is none of the file's");
    FbxModel& model = models.emplace_back(read_model(*next++));
    model.name = name;
    model.parent = parent;
    if (!by_id.try_emplace(model.id, &model).second)
      document.file().reject("FBX node '" + name + "' hangs on several nodes, which is not read");
    node_of[&model] = child;
    left.push_back(&model);
  }
}

FbxModel FbxScene::read_model(FbxId id) const {
  const FbxRecord& record = *document.object(id);
  FbxModel model;
  model.id = id;
  for (std::size_t p = 0; p < fbx_parts; ++p) {
    const bool scales = p == lcl_scaling || p == geometric_scaling;
    const Eigen::Vector3d usual = scales ? Eigen::Vector3d::Ones() : Eigen::Vector3d::Zero();
    model.parts[p] = document.property(record, name_of(static_cast<FbxPart>(p))).value_or(usual);
  }
  const auto whole = [&](std::string_view name, std::int64_t otherwise) {
    const double number = document.number(record, name, static_cast<double>(otherwise));
    return is_finite(number) ? static_cast<std::int64_t>(std::clamp(number, -1.0, 100.0)) : -1;
  };
  model.rotation_order = whole("RotationOrder", 0);
  model.inherit_type = whole("InheritType", 1);
  model.has_orientation = whole("RotationActive", 1) != 0 && whole("RotationSpaceForLimitOnly", 0) == 0;
  return model;
}

aiMatrix4x4 FbxScene::matrix_of(const Eigen::Affine3d& map) {
  aiMatrix4x4 matrix;
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 4; ++column)
      matrix[row][column] = static_cast<float>(map(row, column));
  return matrix;
}

Eigen::Affine3d FbxScene::map_of(const aiMatrix4x4& matrix) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 4; ++column)
      map(row, column) = static_cast<double>(matrix[row][column]);
  return map;
}

bool agree(const Eigen::Affine3d& a, const Eigen::Affine3d& b, double tolerance) {
  const double linear = std::max(1.0, b.linear().cwiseAbs().maxCoeff());
  return (a.linear() - b.linear()).cwiseAbs().maxCoeff() <= tolerance * linear &&
         (a.translation() - b.translation()).norm() <= tolerance * (1 + b.translation().norm());
}

std::vector<std::string> correct_fbx(const std::filesystem::path& file, aiScene& scene) {
  FbxScene fbx(file, scene);
  make_names_unique(fbx);
  correct_nodes(fbx);
  correct_fbx_meshes(fbx, scene);
  correct_fbx_clips(fbx, scene);
  return std::move(fbx.notes);
}

}  // namespace bch::detail::importing
