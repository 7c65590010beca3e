// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/scene_export.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <memory>
#include <set>
#include <stdexcept>

#include "layout/character/eigen.hpp"

namespace bch {
namespace {

aiVector3D to_ai(const Vec3& v) {
  return {v.x, v.y, v.z};
}
aiQuaternion to_ai(const Quaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

aiMatrix4x4 to_ai(const Affine3& t) {
  const auto& [x, y, z] = t.rows;
  return {x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3], z[0], z[1], z[2], z[3], 0, 0, 0, 1};
}

/// assimp's structures own plain arrays.
template <class Out, class In, class Convert>
void fill(Out*& array, unsigned& size, const std::vector<In>& items, Convert convert) {
  size = static_cast<unsigned>(items.size());
  array = size == 0 ? nullptr : new Out[items.size()];
  for (std::size_t i = 0; i < items.size(); ++i) array[i] = convert(items[i]);
}

template <class Value, class Blend>
Value value_at(const std::vector<Key<Value>>& keys, float time, const std::type_identity_t<Value>& rest,
               Blend blend) {
  if (keys.empty()) return rest;
  std::size_t after = 0;
  while (after < keys.size() && keys[after].time <= time) ++after;
  if (after == 0) return keys.front().value;
  if (after == keys.size()) return keys.back().value;
  const Key<Value>& before = keys[after - 1];
  return blend(before.value, keys[after].value, (time - before.time) / (keys[after].time - before.time));
}

struct SceneBuilder {
  const Character& character;
  std::unique_ptr<aiScene> scene = std::make_unique<aiScene>();
  std::vector<aiNode*> node_of_joint = {};

  static void adopt(aiNode* parent, const std::vector<aiNode*>& children) {
    if (children.empty()) return;
    std::vector<aiNode*> all(parent->mChildren, parent->mChildren + parent->mNumChildren);
    all.insert(all.end(), children.begin(), children.end());
    for (aiNode* child : children) child->mParent = parent;
    delete[] parent->mChildren;
    fill(parent->mChildren, parent->mNumChildren, all, [](aiNode* node) { return node; });
  }

  void add_nodes() {
    Eigen::Affine3f z_up_to_y_up = Eigen::Affine3f::Identity();
    z_up_to_y_up.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    scene->mRootNode = new aiNode("scene root");
    scene->mRootNode->mTransformation =
        to_ai(detail::affine3(z_up_to_y_up * detail::to_eigen(character.to_ground)));
    auto* mesh_node = new aiNode("mesh node");
    mesh_node->mNumMeshes = 1;
    mesh_node->mMeshes = new unsigned[1]{0};
    adopt(scene->mRootNode, {mesh_node});
    for (const Joint& joint : character.joints) {
      auto* node = new aiNode(joint.name);
      node->mTransformation = to_ai(joint.rest);
      adopt(joint.parent < 0 ? scene->mRootNode : node_of_joint[static_cast<std::size_t>(joint.parent)],
            {node});
      node_of_joint.push_back(node);
    }
  }

  /// Files have one bind matrix a joint and mesh: a second bone of a joint gets a node of its own, which
  /// moves as the joint does.
  std::string name_of_bone(std::size_t bone, std::set<std::uint32_t>& taken) {
    const std::uint32_t joint = character.bones[bone].joint;
    if (taken.insert(joint).second) return character.joints[joint].name;
    auto* node = new aiNode(character.joints[joint].name + " of bone " + std::to_string(bone));
    adopt(node_of_joint[joint], {node});
    return node->mName.C_Str();
  }

  void add_mesh() {
    auto* mesh = new aiMesh;
    scene->mNumMeshes = 1;
    scene->mMeshes = new aiMesh* [1] { mesh };
    scene->mNumMaterials = 1;
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
    mesh->mName = "mesh";
    mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    fill(mesh->mVertices, mesh->mNumVertices, character.vertices, [](const Vec3& v) { return to_ai(v); });
    fill(mesh->mFaces, mesh->mNumFaces, character.triangles,
         [](const std::array<std::uint32_t, 3>& triangle) {
           aiFace face;
           face.mNumIndices = 3;
           face.mIndices = new unsigned[3]{triangle[0], triangle[1], triangle[2]};
           return face;
         });
    add_bones(*mesh);
  }

  void add_bones(aiMesh& mesh) {
    std::vector<std::vector<aiVertexWeight>> weights(character.bones.size());
    for (std::uint32_t v = 0; v < character.vertices.size(); ++v)
      for (std::uint32_t i = character.influence_begin[v]; i < character.influence_begin[v + 1]; ++i)
        weights[character.influences[i].bone].push_back({v, character.influences[i].weight});
    std::set<std::uint32_t> taken;
    std::vector<aiBone*> bones;
    for (std::size_t b = 0; b < character.bones.size(); ++b) {
      bones.push_back(new aiBone);
      bones[b]->mName = name_of_bone(b, taken);
      bones[b]->mOffsetMatrix = to_ai(character.bones[b].inverse_bind);
      fill(bones[b]->mWeights, bones[b]->mNumWeights, weights[b], [](const aiVertexWeight& w) { return w; });
    }
    fill(mesh.mBones, mesh.mNumBones, bones, [](aiBone* bone) { return bone; });
  }

  /// Keys of all three kinds at all times that one of them has: with anything less assimp's Collada
  /// exporter refers to sources that it does not write. Values between old keys are the interpolated ones, so
  /// the motion stays the same.
  aiNodeAnim* make_channel(const Channel& channel, double ticks_per_second) const {
    const Joint& joint = character.joints[channel.joint];
    Eigen::Matrix3f turn;
    Eigen::Matrix3f stretch;
    const Eigen::Affine3f rest = detail::to_eigen(joint.rest);
    rest.computeRotationScaling(&turn, &stretch);
    std::set<float> times;
    for (const auto& key : channel.positions) times.insert(key.time);
    for (const auto& key : channel.rotations) times.insert(key.time);
    for (const auto& key : channel.scales) times.insert(key.time);

    const auto blend = [](const Vec3& x, const Vec3& y, float t) {
      return detail::vec3(detail::to_eigen(x) + t * (detail::to_eigen(y) - detail::to_eigen(x)));
    };
    const auto blend_turns = [](const Quaternion& x, const Quaternion& y, float t) {
      return detail::quaternion(detail::to_eigen(x).slerp(t, detail::to_eigen(y)));
    };
    std::vector<aiVectorKey> positions, scales;
    std::vector<aiQuatKey> rotations;
    for (const float time : times) {
      const double ticks = static_cast<double>(time) * ticks_per_second;
      positions.emplace_back(
          ticks, to_ai(value_at(channel.positions, time, detail::vec3(rest.translation()), blend)));
      rotations.emplace_back(
          ticks, to_ai(value_at(channel.rotations, time, detail::quaternion(Eigen::Quaternionf(turn)),
                                blend_turns)));
      scales.emplace_back(ticks,
                          to_ai(value_at(channel.scales, time, detail::vec3(stretch.diagonal()), blend)));
    }
    auto* out = new aiNodeAnim;
    out->mNodeName = joint.name;
    fill(out->mPositionKeys, out->mNumPositionKeys, positions, [](const aiVectorKey& key) { return key; });
    fill(out->mRotationKeys, out->mNumRotationKeys, rotations, [](const aiQuatKey& key) { return key; });
    fill(out->mScalingKeys, out->mNumScalingKeys, scales, [](const aiVectorKey& key) { return key; });
    return out;
  }

  void add_clips(double ticks_per_second) {
    fill(scene->mAnimations, scene->mNumAnimations, character.clips, [&](const Clip& clip) {
      auto* animation = new aiAnimation;
      animation->mName = clip.name;
      animation->mTicksPerSecond = ticks_per_second;
      animation->mDuration = static_cast<double>(clip.seconds) * ticks_per_second;
      fill(animation->mChannels, animation->mNumChannels, clip.channels,
           [&](const Channel& channel) { return make_channel(channel, ticks_per_second); });
      return animation;
    });
  }
};

}  // namespace

void write_with_assimp(const Character& character, const std::filesystem::path& file) {
  struct Format {
    const char* extension;
    const char* name;
    double ticks_per_second;  // Collada's exporter writes ticks where seconds are due
  };
  constexpr Format formats[] = {{".glb", "glb2", 1000}, {".gltf", "gltf2", 1000}, {".dae", "collada", 1}};
  for (const Format& format : formats) {
    if (file.extension() != format.extension) continue;
    SceneBuilder builder{character};
    builder.add_nodes();
    builder.add_mesh();
    builder.add_clips(format.ticks_per_second);
    Assimp::Exporter exporter;
    if (exporter.Export(builder.scene.get(), format.name, file.string()) != aiReturn_SUCCESS)
      throw std::runtime_error(file.string() + ": " + exporter.GetErrorString());
    return;
  }
  throw std::runtime_error(file.string() + ": not a format that is written faithfully");
}

}  // namespace bch
