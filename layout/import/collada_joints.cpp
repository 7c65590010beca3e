// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <map>
#include <set>

#include "layout/import/collada_text.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

using NodesByName = std::multimap<std::string_view, const XmlElement*>;

/// The joints of skins. assimp searches for a joint among the names and ids of all nodes, then among their sids.
class JointRewriter {
 public:
  explicit JointRewriter(ColladaText& collada) : collada_(collada) {
    const XmlElements scenes = all_of(collada.root(), "visual_scene");
    if (scenes.empty()) return;
    scene_ = scenes.front();
    for (const XmlElement* const instance : all_of(collada.root(), "instance_visual_scene"))
      if (const XmlElement* const named = collada.named_by(instance->attribute("url"))) scene_ = named;
    nodes_ = all_of(*scene_, "node");
    for (const XmlElement* const node : nodes_) {
      by_name_.try_emplace(node->attribute("name"), node);
      by_name_.try_emplace(node->attribute("id"), node);
      by_sid_.try_emplace(node->attribute("sid"), node);
      if (node->attribute("type") == "JOINT") joints_by_name_.emplace(node->attribute("name"), node);
    }
  }

  void rewrite(const XmlElement& controller) {
    const XmlElement* const skin = controller.child("skin");
    const XmlElement* const joints = skin == nullptr ? nullptr : skin->child("joints");
    const XmlElement* const names = joints == nullptr ? nullptr : collada_.source(*joints, "JOINT");
    if (names == nullptr) return;
    if (const XmlElement* const array = names->child("Name_array")) {
      const NodesByName below = below_skeletons(controller.attribute("id"));
      for (const std::string_view joint : words_of(array->content))
        rewrite(joint, below.contains(joint) ? named(below, joint) : named(joints_by_name_, joint));
    }
    if (const XmlElement* const array = names->child("IDREF_array"))
      for (const std::string_view joint : words_of(array->content))
        if (const XmlElement* const node = collada_.with_id(joint)) rewrite(joint, {node});
  }

 private:
  using Nodes = std::set<const XmlElement*>;

  ColladaText& collada_;
  const XmlElement* scene_ = nullptr;
  XmlElements nodes_;
  std::map<std::string_view, const XmlElement*> by_name_,
      by_sid_;  ///< the first of each name, or id, and sid
  NodesByName joints_by_name_;

  static Nodes named(const NodesByName& nodes, std::string_view name) {
    Nodes found;
    const auto [begin, end] = nodes.equal_range(name);
    for (auto node = begin; node != end; ++node) found.insert(node->second);
    return found;
  }

  const XmlElement* taken_for(std::string_view joint) const {
    if (const auto node = by_name_.find(joint); node != by_name_.end()) return node->second;
    const auto node = by_sid_.find(joint);
    return node == by_sid_.end() ? nullptr : node->second;
  }

  /// Returns the nodes by sid that stand below the skeletons of those who use a skin; of all, where they name none.
  NodesByName below_skeletons(std::string_view controller) const {
    XmlElements skeletons;
    for (const XmlElement* const node : nodes_)
      for (const XmlElement& instance : node->children) {
        const std::string_view url = instance.attribute("url");
        if (instance.name != "instance_controller" || !url.starts_with('#') || url.substr(1) != controller)
          continue;
        for (const XmlElement& skeleton : instance.children) {
          const std::vector<std::string_view> names = words_of(skeleton.content);
          if (skeleton.name != "skeleton" || names.size() != 1) continue;
          if (const XmlElement* const named = collada_.named_by(names.front())) skeletons.push_back(named);
        }
      }
    if (skeletons.empty() && scene_ != nullptr) skeletons.push_back(scene_);
    NodesByName below;
    for (const XmlElement* const skeleton : skeletons)
      for (const XmlElement* const node : all_of(*skeleton, "node"))
        below.emplace(node->attribute("sid"), node);
    return below;
  }

  void rewrite(std::string_view joint, const Nodes& nodes) {
    if (nodes.empty()) return;  // which is left to assimp
    const std::string what = "Collada joint '" + std::string(joint) + "'";
    if (nodes.size() > 1) collada_.reject(what + " may be any of " + count(nodes.size(), "node"));
    const XmlElement* const node = *nodes.begin();
    if (taken_for(joint) == node) return;
    const std::string_view id = node->attribute("id");
    if (id.empty() || taken_for(id) != node)
      collada_.reject(what + " cannot be told from another node of its name");
    if (!collada_.replace(joint, std::string(id)))
      collada_.reject(what + " is of skins on different skeletons");
  }
};

}  // namespace

void rewrite_joints(ColladaText& collada) {
  JointRewriter rewriter(collada);
  for (const XmlElement* const controller : all_of(collada.root(), "controller"))
    rewriter.rewrite(*controller);
}

}  // namespace bch::detail::importing
