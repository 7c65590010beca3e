// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// What an importer may hand over: every scene becomes a valid character that can be posed, or is refused with
// an ImportError of one line.

#include <assimp/scene.h>

#include <stdexcept>
#include <string>

#include "layout/character/skinning.hpp"
#include "layout/import/scene.hpp"
#include "tests/fuzz/target.hpp"

namespace bch::fuzz {
namespace {

constexpr float step = 0x1p-10f;

aiString name_of(Bytes& bytes) {
  return aiString(std::string(1, static_cast<char>('a' + bytes.below(6))));
}

aiVector3D vector_of(Bytes& bytes) {
  const float x = bytes.number(step), y = bytes.number(step), z = bytes.number(step);
  return {x, y, z};
}

aiMatrix4x4 matrix_of(Bytes& bytes) {
  aiMatrix4x4 matrix;
  const std::uint32_t kind = bytes.below(8);
  if (kind < 4) return matrix;
  if (kind < 7) return aiMatrix4x4::Translation(vector_of(bytes), matrix);
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column) matrix[row][column] = bytes.number(step);
  return matrix;
}

/// An array as assimp's destructors expect it. `declared` may be left without an array behind it.
template <class Element, class Fill>
Element* array_of(Bytes& bytes, unsigned& declared, unsigned most, Fill fill) {
  declared = bytes.below(most + 1);
  if (declared == 0 || bytes.below(32) == 31) return nullptr;
  auto* const elements = new Element[declared]{};
  for (unsigned i = 0; i < declared; ++i) fill(elements[i]);
  return elements;
}

void fill_node(Bytes& bytes, aiNode& node, unsigned depth) {
  node.mName = name_of(bytes);
  node.mTransformation = matrix_of(bytes);
  node.mMeshes =
      array_of<unsigned>(bytes, node.mNumMeshes, 3, [&](unsigned& mesh) { mesh = bytes.below(4); });
  if (depth == 4) return;
  node.mChildren = array_of<aiNode*>(bytes, node.mNumChildren, 3, [&](aiNode*& child) {
    if (bytes.below(32) == 31) return;
    child = new aiNode;
    child->mParent = &node;
    fill_node(bytes, *child, depth + 1);
  });
}

aiBone* bone_of(Bytes& bytes) {
  auto* const bone = new aiBone;
  bone->mName = name_of(bytes);
  bone->mOffsetMatrix = matrix_of(bytes);
  bone->mWeights = array_of<aiVertexWeight>(bytes, bone->mNumWeights, 12, [&](aiVertexWeight& weight) {
    weight.mVertexId = bytes.below(20);
    weight.mWeight = bytes.number(0x1p-8f);
  });
  return bone;
}

aiMesh* mesh_of(Bytes& bytes) {
  auto* const mesh = new aiMesh;
  mesh->mName = name_of(bytes);
  mesh->mVertices = array_of<aiVector3D>(bytes, mesh->mNumVertices, 16,
                                         [&](aiVector3D& vertex) { vertex = vector_of(bytes); });
  mesh->mFaces = array_of<aiFace>(bytes, mesh->mNumFaces, 16, [&](aiFace& face) {
    const bool odd = bytes.below(16) == 15;
    face.mNumIndices = odd ? bytes.below(6) : 3;
    face.mIndices = new unsigned[face.mNumIndices + 1];
    for (unsigned i = 0; i < face.mNumIndices; ++i) face.mIndices[i] = bytes.below(17);
  });
  mesh->mBones = array_of<aiBone*>(bytes, mesh->mNumBones, 4, [&](aiBone*& bone) {
    if (bytes.below(32) < 31) bone = bone_of(bytes);
  });
  return mesh;
}

/// Times in ascending order, mostly.
double time_of(Bytes& bytes, double& last) {
  return bytes.below(16) == 15 ? bytes.take<double>() : last += bytes.below(4);
}

template <class AiKey>
AiKey* keys_of(Bytes& bytes, unsigned& count) {
  double last = 0;
  return array_of<AiKey>(bytes, count, 5, [&](AiKey& key) {
    key.mTime = time_of(bytes, last);
    if constexpr (std::is_same_v<AiKey, aiQuatKey>) {
      const float w = bytes.number(0x1p-14f);
      const aiVector3D v = vector_of(bytes);
      key.mValue = aiQuaternion(w, v.x, v.y, v.z);
    } else {
      key.mValue = vector_of(bytes);
    }
  });
}

aiAnimation* animation_of(Bytes& bytes) {
  auto* const animation = new aiAnimation;
  animation->mName = name_of(bytes);
  animation->mDuration = bytes.number(0x1p-8f);
  animation->mTicksPerSecond = bytes.number(0x1p-8f);
  animation->mChannels = array_of<aiNodeAnim*>(bytes, animation->mNumChannels, 4, [&](aiNodeAnim*& channel) {
    if (bytes.below(32) == 31) return;
    channel = new aiNodeAnim;
    channel->mNodeName = name_of(bytes);
    channel->mPositionKeys = keys_of<aiVectorKey>(bytes, channel->mNumPositionKeys);
    channel->mRotationKeys = keys_of<aiQuatKey>(bytes, channel->mNumRotationKeys);
    channel->mScalingKeys = keys_of<aiVectorKey>(bytes, channel->mNumScalingKeys);
  });
  return animation;
}

void fill(Bytes& bytes, aiScene& scene) {
  if (bytes.below(4) == 0) {
    scene.mMetaData = aiMetadata::Alloc(3);
    scene.mMetaData->Set(0, "UpAxis", static_cast<std::int32_t>(bytes.below(5)) - 1);
    scene.mMetaData->Set(1, "UpAxisSign", static_cast<std::int32_t>(bytes.below(3)) - 1);
    scene.mMetaData->Set(2, "UnitScaleFactor", bytes.number(step));
  }
  scene.mRootNode = new aiNode;
  fill_node(bytes, *scene.mRootNode, 0);
  scene.mMeshes = array_of<aiMesh*>(bytes, scene.mNumMeshes, 3, [&](aiMesh*& mesh) {
    if (bytes.below(32) < 31) mesh = mesh_of(bytes);
  });
  scene.mAnimations = array_of<aiAnimation*>(bytes, scene.mNumAnimations, 2, [&](aiAnimation*& animation) {
    if (bytes.below(32) < 31) animation = animation_of(bytes);
  });
}

/// assimp's destructors follow counts where there is no array, and lists with gaps.
void make_destructible(aiScene& scene) {
  const auto settle = [](auto* list, unsigned& count) {
    if (list == nullptr) count = 0;
  };
  settle(scene.mMeshes, scene.mNumMeshes);
  settle(scene.mAnimations, scene.mNumAnimations);
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    if (aiMesh* mesh = scene.mMeshes[m]) settle(mesh->mBones, mesh->mNumBones);
  for (unsigned a = 0; a < scene.mNumAnimations; ++a)
    if (aiAnimation* animation = scene.mAnimations[a]) settle(animation->mChannels, animation->mNumChannels);
}

void check(const Character& character) {
  validate(character);
  detail::Skinner skinner(character);
  for (const PoseTime& time : sample_poses(character, 3))
    for (const Vec3& position : skinner.pose(time))
      require(detail::to_eigen(position).allFinite(), "poses are finite");
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch;
  constexpr const char* readers[] = {"Autodesk FBX Importer", "glTF2 Importer", "Wavefront Object Importer"};
  fuzz::Bytes bytes(data, size);
  const char* const reader = readers[bytes.below(3)];
  aiScene scene;
  fuzz::fill(bytes, scene);
  try {
    fuzz::check(
        detail::importing::character_of(detail::importing::SceneFile("file", scene, reader), {}).character);
  } catch (const ImportError& error) {
    fuzz::require(std::string(error.what()).find('\n') == std::string::npos, "errors are one line");
  } catch (const std::invalid_argument&) {  // validate(), of which import_character() makes an ImportError
  }
  fuzz::make_destructible(scene);
  return 0;
}
