// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/gltf.hpp"

#include <set>

#include "layout/import/gltf_parts.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

aiMatrix4x4 transform_of(const JsonValue& node) {
  if (const JsonValue matrix = node["matrix"]) return matrix_from(numbers_of<16>(matrix).data());
  aiMatrix4x4 transform, part;
  if (const JsonValue translation = node["translation"])
    transform = transform * aiMatrix4x4::Translation(vector_from(numbers_of<3>(translation).data()), part);
  if (const JsonValue rotation = node["rotation"])
    transform = transform * aiMatrix4x4(quaternion_from(numbers_of<4>(rotation).data()).GetMatrix());
  if (const JsonValue scale = node["scale"])
    transform = transform * aiMatrix4x4::Scaling(vector_from(numbers_of<3>(scale).data()), part);
  return transform;
}

/// Names nodes so that bones and channels, which know their node by its name alone, find theirs.
class UniqueNames {
 public:
  std::string add(const JsonValue& node, std::size_t index) {
    std::string name = node["name"].text().substr(0, longest_name);
    if (name.empty()) name = "nodes[" + std::to_string(index) + "]";
    if (!taken_.insert(name).second) {
      name += " (node " + std::to_string(index) + ")";
      while (!taken_.insert(name).second) name += "'";
    }
    return name;
  }

 private:
  std::set<std::string> taken_;
};

aiNode** add_children(aiNode& node, std::size_t size) {
  if (size == 0) return nullptr;
  node.mChildren = new aiNode* [size] {};
  node.mNumChildren = static_cast<unsigned>(size);
  return node.mChildren;
}

struct Pending {
  JsonValue index;  ///< where the node is named
  aiNode* parent;
  aiNode** place;
};

void push_all(const JsonValue& list, aiNode* parent, aiNode** places, std::vector<Pending>& stack) {
  for (std::size_t i = list.size(); i-- > 0;) stack.push_back({list[i], parent, places + i});
}

/// Reads the nodes depth first, with a stack of our own, because a file chooses its depth.
void read_scene_nodes(GltfReader& reader, const JsonValue& roots) {
  const JsonValue nodes = reader.file.root()["nodes"];
  reader.names.resize(nodes.size());
  reader.nodes.resize(nodes.size());
  aiScene& scene = *reader.result.scene;
  std::vector<Pending> stack;
  if (roots.size() == 1) {
    push_all(roots, nullptr, &scene.mRootNode, stack);
  } else {
    scene.mRootNode = new aiNode("ROOT");
    push_all(roots, scene.mRootNode, add_children(*scene.mRootNode, roots.size()), stack);
  }
  UniqueNames names;
  while (!stack.empty()) {
    const Pending next = stack.back();
    stack.pop_back();
    const JsonValue node = reader.file.named_by(next.index, "nodes");
    const std::size_t index = next.index.integer(nodes.size());
    if (reader.nodes[index] != nullptr)
      next.index.reject("is " + std::to_string(index) + ", a node that has a place in the scene already");
    reader.names[index] = names.add(node, index);
    aiNode* const made = reader.nodes[index] = *next.place = new aiNode(reader.names[index]);
    made->mParent = next.parent;
    made->mTransformation = transform_of(node);
    const JsonValue children = node["children"];
    push_all(children, made, add_children(*made, children.size()), stack);
  }
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (reader.names[n].empty()) reader.names[n] = names.add(nodes[n], n);
}

JsonValue default_scene(GltfReader& reader) {
  const JsonValue root = reader.file.root(), scenes = root["scenes"];
  if (scenes.size() == 0) reject(reader.file.path(), "no scene");
  if (scenes.size() > 1)
    reader.result.notes.push_back("of " + count(scenes.size(), "scene") + " the default one is read");
  return root["scene"] ? reader.file.named_by(root["scene"], "scenes") : scenes[std::size_t{0}];
}

}  // namespace

aiMatrix4x4 matrix_from(const float* columns) {
  aiMatrix4x4 matrix;
  for (unsigned i = 0; i < 16; ++i) matrix[i % 4][i / 4] = columns[i];
  return matrix;
}

void SceneDeleter::operator()(aiScene* scene) const {
  std::vector<aiNode*> left{scene->mRootNode};
  scene->mRootNode = nullptr;
  while (!left.empty()) {
    aiNode* const node = left.back();
    left.pop_back();
    if (node == nullptr) continue;
    left.insert(left.end(), node->mChildren, node->mChildren + node->mNumChildren);
    node->mNumChildren = 0;
    delete node;
  }
  delete scene;
}

GltfScene read_gltf(const std::filesystem::path& file) {
  GltfReader reader{GltfFile(file), {}, {}, {}};
  for (const std::string& name : reader.file.unread_extensions())
    reader.result.notes.push_back("uses the glTF extension '" + one_line(name) +
                                  "', which is not read: what it adds, moves or hides, if anything, is lost");
  reader.result.scene.reset(new aiScene);
  read_scene_nodes(reader, default_scene(reader)["nodes"]);
  read_gltf_meshes(reader);
  read_gltf_animations(reader);
  return std::move(reader.result);
}

}  // namespace bch::detail::importing
