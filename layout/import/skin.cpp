// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/base/shortest.hpp"

#include "layout/import/mesh.hpp"

namespace bch::detail::importing {
namespace {

/// Float cannot tell a sum from one without such a weight.
constexpr double smallest_weight = 1e-7;
constexpr double sum_tolerance = 1e-3;
/// What rounding may add to a weight of 1.
constexpr float largest_weight = 1.001f;

bool carries_weight(const aiBone& bone) {
  for (unsigned w = 0; w < bone.mNumWeights && bone.mWeights != nullptr; ++w)
    if (bone.mWeights[w].mWeight != 0) return true;  // NaN too, so that it is found and reported
  return false;
}

/// Appends the weights of one bone to the vertices' lists.
void read_bone(const SceneFile& file, const NodeList& nodes, const aiBone& bone, const std::string& mesh_name,
               BoneTable& bones, InfluenceLists& lists) {
  const std::string name = "bone '" + to_string(bone.mName) + "' of " + mesh_name;
  const auto node = nodes.by_name.find(to_string(bone.mName));
  if (!carries_weight(bone)) {
    // Kept where it makes sense, as exporters write out whole skeletons; damage in it changes nothing.
    const bool sound =
        node != nodes.by_name.end() && Eigen::Map<const Eigen::Matrix4f>(&bone.mOffsetMatrix.a1).allFinite();
    if (sound) bones.add(node->second, read_matrix(file, bone.mOffsetMatrix, name));
    return;
  }
  if (node == nodes.by_name.end()) file.reject(name + " is no node of the scene");
  const std::uint32_t index = bones.add(node->second, read_matrix(file, bone.mOffsetMatrix, name));
  for (unsigned w = 0; w < bone.mNumWeights; ++w) {
    const auto [vertex, weight] = bone.mWeights[w];
    if (vertex >= lists.size())
      file.reject(name + " names vertex " + std::to_string(vertex) + " of " + std::to_string(lists.size()));
    if (!(weight >= 0 && weight <= largest_weight))
      file.reject(name + " gives vertex " + std::to_string(vertex) + " the weight " + shortest(weight) +
                  ", which is not within 0 and 1");
    if (weight > 0) lists[vertex].push_back({index, weight});
  }
}

/// Orders by bone, adds up what a bone gives in several entries, and makes the sum one.
/// Returns: the sum before.
double normalise(std::vector<Influence>& list) {
  std::sort(list.begin(), list.end(), [](const Influence& a, const Influence& b) {
    return a.bone != b.bone ? a.bone < b.bone : a.weight < b.weight;
  });
  double sum = 0;
  for (const Influence& influence : list) sum += static_cast<double>(influence.weight);

  std::vector<Influence> merged;
  for (std::size_t i = 0; i < list.size();) {
    const std::uint32_t bone = list[i].bone;
    double weight = 0;
    for (; i < list.size() && list[i].bone == bone; ++i) weight += static_cast<double>(list[i].weight);
    if (weight / sum >= smallest_weight) merged.push_back({bone, static_cast<float>(weight / sum)});
  }
  list = std::move(merged);
  return sum;
}

/// Gives each vertex without influences those of the nearest vertex that has some, by a sweep along x.
void fill_gaps(const aiMesh& mesh, InfluenceLists& lists) {
  std::vector<unsigned> weighted;
  for (unsigned v = 0; v < lists.size(); ++v)
    if (!lists[v].empty()) weighted.push_back(v);
  const auto before = [&](unsigned a, unsigned b) { return mesh.mVertices[a].x < mesh.mVertices[b].x; };
  std::stable_sort(weighted.begin(), weighted.end(), before);

  const InfluenceLists given = lists;
  for (unsigned v = 0; v < lists.size(); ++v) {
    if (!given[v].empty()) continue;
    const aiVector3D& position = mesh.mVertices[v];
    float best = std::numeric_limits<float>::infinity();
    unsigned nearest = weighted.front();
    // Returns whether a vertex further along x may still be nearer.
    const auto consider = [&](unsigned candidate) {
      const aiVector3D offset = mesh.mVertices[candidate] - position;
      if (offset.x * offset.x > best) return false;
      const float distance = offset.SquareLength();
      if (distance < best) {
        best = distance;
        nearest = candidate;
      }
      return true;
    };
    const auto middle = std::lower_bound(weighted.begin(), weighted.end(), v, before);
    for (auto i = middle; i != weighted.end() && consider(*i); ++i) {
    }
    for (auto i = middle; i != weighted.begin() && consider(*(i - 1)); --i) {
    }
    lists[v] = given[nearest];
  }
}

}  // namespace

InfluenceLists read_influences(const SceneFile& file, const NodeList& nodes, const aiMesh& mesh,
                               const std::string& mesh_name, BoneTable& bones, ImportReport& report) {
  InfluenceLists lists(mesh.mNumVertices);
  if (mesh.mBones == nullptr) file.reject(mesh_name + " has no bones where it says so");
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone* bone = mesh.mBones[b];
    if (bone == nullptr || (bone->mNumWeights > 0 && bone->mWeights == nullptr))
      file.reject("bone " + std::to_string(b) + " of " + mesh_name + " is missing");
    read_bone(file, nodes, *bone, mesh_name, bones, lists);
    note_if_shared(nodes, to_string(bone->mName), report);
  }

  std::size_t gaps = 0;
  std::size_t normalised = 0;
  for (std::vector<Influence>& list : lists) {
    if (list.empty())
      ++gaps;
    else if (std::abs(normalise(list) - 1) > sum_tolerance)
      ++normalised;
  }
  if (gaps == lists.size()) file.reject(mesh_name + " has bones but zero weights");
  if (normalised > 0)
    report.notes.push_back("the weights of " + count(normalised, "vertex", "vertices") + " of " + mesh_name +
                           " did not sum to 1 and were normalised");
  if (gaps > 0) {
    fill_gaps(mesh, lists);
    report.notes.push_back(count(gaps, "vertex", "vertices") + " of " + mesh_name +
                           " without weights took those of the nearest that has some");
  }
  return lists;
}

}  // namespace bch::detail::importing
