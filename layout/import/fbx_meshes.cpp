// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "layout/import/fbx.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr double bind_rounding = 1e-3;  // assimp inverts in float
/// What rounding may add to a weight of 1.
constexpr float max_of_one = 1.001f;

/// What binds vertices to one bone.
struct Cluster {
  const FbxModel* bone = nullptr;  ///< none where the scene has no node of it
  std::string name;                ///< of the bone, as assimp knows it
  std::optional<Eigen::Affine3d> mesh_to_bone;
  std::string mode;
};

std::optional<Eigen::Affine3d> map_from(const std::vector<double>& columns) {
  if (columns.size() != 16) return std::nullopt;
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 4; ++column) map(row, column) = columns[4 * column + row];
  return map;
}

bool is_identity(const Eigen::Affine3d& map) {
  return agree(map, Eigen::Affine3d::Identity(), 1e-9);
}

class MeshCorrector {
 public:
  MeshCorrector(FbxScene& file, aiScene& scene) : file_(file), scene_(scene) {}

  void correct(const FbxModel& model) {
    aiNode& node = *file_.node_of.at(&model);
    const Eigen::Affine3d geometric = FbxChain::geometric(model);
    std::vector<unsigned> rigid;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      const unsigned index = node.mMeshes[m];
      aiMesh* const mesh = index < scene_.mNumMeshes ? scene_.mMeshes[index] : nullptr;
      if (mesh == nullptr || mesh->mNumBones == 0)
        rigid.push_back(index);
      else if (seen_.insert(mesh).second)
        bind(*mesh, model, geometric);
    }
    if (!rigid.empty() && !is_identity(geometric)) move_below(node, rigid, geometric);
  }

 private:
  FbxScene& file_;
  aiScene& scene_;
  std::set<const aiMesh*> seen_;

  [[noreturn]] void reject(const FbxModel& model, const std::string& reason) const {
    file_.document.file().reject("FBX mesh of node '" + model.name + "' " + reason);
  }

  /// Gives the meshes to a node of their own, as nodes below this one do not stand where its meshes do.
  static void move_below(aiNode& node, const std::vector<unsigned>& meshes,
                         const Eigen::Affine3d& geometric) {
    aiNode* const child = new aiNode(to_string(node.mName).substr(0, 900) + " (geometry)");
    child->mTransformation = FbxScene::matrix_of(geometric);
    child->mNumMeshes = static_cast<unsigned>(meshes.size());
    child->mMeshes = new unsigned[meshes.size()];
    std::copy(meshes.begin(), meshes.end(), child->mMeshes);
    const auto end = std::remove_if(node.mMeshes, node.mMeshes + node.mNumMeshes, [&](unsigned index) {
      return std::find(meshes.begin(), meshes.end(), index) != meshes.end();
    });
    node.mNumMeshes = static_cast<unsigned>(end - node.mMeshes);
    node.addChildren(1, const_cast<aiNode**>(&child));
  }

  std::vector<Cluster> clusters_of(const FbxModel& model) const {
    const FbxDocument& document = file_.document;
    std::vector<FbxId> skins;
    for (const FbxId geometry : document.below(model.id, "Geometry", "Mesh"))
      for (const FbxId skin : document.below(geometry, "Deformer", "Skin")) skins.push_back(skin);
    if (skins.size() != 1) reject(model, "has " + count(skins.size(), "skin") + ", where one is read");
    std::vector<Cluster> clusters;
    std::set<std::string> names;
    for (const FbxId id : document.below(skins.front(), "Deformer", "Cluster")) {
      const FbxRecord& record = *document.object(id);
      const std::vector<FbxId> bones = document.below(id, "Model");
      if (bones.empty()) continue;
      Cluster cluster;
      if (const auto bone = file_.by_id.find(bones.front()); bone != file_.by_id.end())
        cluster.bone = bone->second;
      cluster.name = FbxDocument::name_of(*document.object(bones.front())).substr(0, 1023);
      cluster.mesh_to_bone = map_from(document.file().numbers(record, "Transform"));
      if (const auto link = map_from(document.file().numbers(record, "TransformLink"));
          link && !cluster.mesh_to_bone)
        cluster.mesh_to_bone = link->inverse() * rest(model);
      if (const FbxRecord* const mode = record.child("Mode")) cluster.mode = mode->text(0);
      if (!names.insert(cluster.name).second)
        reject(model, "has two bones named '" + cluster.name + "', whose weights cannot be told apart");
      clusters.push_back(std::move(cluster));
    }
    return clusters;
  }

  Eigen::Affine3d rest(const FbxModel& model) const {
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    for (const FbxModel* m = &model; m != nullptr; m = m->parent) map = file_.chain.local(*m, {}).map * map;
    return map;
  }

  /// assimp makes a bone of a cluster, in their order, and none of some.
  void bind(aiMesh& mesh, const FbxModel& model, const Eigen::Affine3d& geometric) {
    disown_repeated(mesh);
    const std::vector<Cluster> clusters = clusters_of(model);
    auto next = clusters.begin();
    bool is_sum = true;
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      aiBone* const bone = mesh.mBones == nullptr ? nullptr : mesh.mBones[b];
      if (bone == nullptr) return;  // which is refused where meshes are read
      const std::string name = to_string(bone->mName);
      next = std::find_if(next, clusters.end(), [&](const Cluster& cluster) { return cluster.name == name; });
      if (next == clusters.end())
        reject(model, "has a bone '" + name + "' that no cluster of the file names");
      const Cluster& cluster = *next++;
      if (cluster.bone != nullptr) bone->mName = file_.node_of.at(cluster.bone)->mName;
      if (cluster.mesh_to_bone) {
        const Eigen::Affine3d map = *cluster.mesh_to_bone * geometric;
        if (!agree(FbxScene::map_of(bone->mOffsetMatrix), map, bind_rounding))
          bone->mOffsetMatrix = FbxScene::matrix_of(map);
      }
      is_sum = is_sum && (cluster.mode.empty() || cluster.mode == "Normalize");
      if (cluster.mode == "Additive" && bone->mNumWeights > 0)
        reject(model, "adds what its bone '" + cluster.name +
                          "' does to the rest (link mode Additive), which is not read");
    }
    if (is_sum) normalise(mesh);
  }

  /// Of two clusters whose bones share a name, assimp makes one bone and lists it twice, so that it would be deleted twice.
  static void disown_repeated(aiMesh& mesh) {
    std::set<const aiBone*> listed;
    for (unsigned b = 0; b < mesh.mNumBones && mesh.mBones != nullptr; ++b)
      if (!listed.insert(mesh.mBones[b]).second) mesh.mBones[b] = nullptr;
  }

  /// Weights are fractions of their sum, such as percents.
  static void normalise(aiMesh& mesh) {
    std::vector<double> sums(mesh.mNumVertices);
    bool beyond = false;
    const auto for_each = [&](const auto& act) {
      for (unsigned b = 0; b < mesh.mNumBones; ++b)
        for (unsigned w = 0; w < mesh.mBones[b]->mNumWeights; ++w)
          if (aiVertexWeight& weight = mesh.mBones[b]->mWeights[w]; weight.mVertexId < mesh.mNumVertices)
            act(weight.mWeight, sums[weight.mVertexId]);
    };
    for_each([&](float weight, double& sum) {
      sum += static_cast<double>(weight);
      beyond = beyond || weight > max_of_one;
    });
    if (!beyond) return;
    for_each([](float& weight, double sum) {
      if (sum > 0) weight = static_cast<float>(static_cast<double>(weight) / sum);
    });
  }
};

/// Tells by how many percent a channel of a blend shape is on, at most, at rest and in all clips.
double largest_percent(const FbxDocument& document, FbxId channel) {
  const FbxRecord& record = *document.object(channel);
  const FbxRecord* const stated = record.child("DeformPercent");
  double most = std::abs(document.number(record, "DeformPercent", stated == nullptr ? 0 : stated->number(0)));
  for (const auto& [node, property] : document.bound_to(channel)) {
    const FbxRecord* const curve_node = document.object(node);
    if (property != "DeformPercent" || curve_node == nullptr || curve_node->name != "AnimationCurveNode")
      continue;
    most = std::max(most, std::abs(document.number(*curve_node, "d|DeformPercent", 0)));
    for (const auto& [id, axis] : document.curves_of(node))
      for (const double value : document.file().numbers(*document.object(id), "KeyValueFloat"))
        most = std::max(most, std::abs(value));
  }
  return most;
}

void refuse_blend_shapes(const FbxDocument& document) {
  for (const FbxId channel : document.all("Deformer", "BlendShapeChannel")) {
    if (document.below(channel, "Geometry", "Shape").empty() || document.bindings_of(channel).empty())
      continue;
    if (!(largest_percent(document, channel) == 0))
      document.file().reject("FBX blend shape '" + FbxDocument::name_of(*document.object(channel)) +
                             "' moves vertices, which is not read (only a DeformPercent of 0 is)");
  }
}

}  // namespace

void correct_fbx_meshes(FbxScene& file, aiScene& scene) {
  refuse_blend_shapes(file.document);
  MeshCorrector corrector(file, scene);
  for (const FbxModel& model : file.models) corrector.correct(model);
}

}  // namespace bch::detail::importing
