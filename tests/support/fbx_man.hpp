// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "tests/support/fbx_text.hpp"

// A man of three joints, whom tests of FBX move.

namespace bch {

inline const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.7, 0}, {0, 0, 0.5}};

/// A skeleton of three joints, a skin on two of them, a rigid mesh on the third, and one that marks the origin.
inline FbxText man() {
  FbxText fbx;
  fbx.nodes = {{"Armature", "Null", -1}, {"Hips", "LimbNode", 0}, {"Spine", "LimbNode", 1},
               {"Hat", "Mesh", 2},       {"Tip", "Mesh", 3},      {"Body", "Mesh", -1},
               {"Mark", "Mesh", -1}};
  fbx.nodes[1].vectors["Lcl Translation"] = {0, 0.9, 0};
  fbx.nodes[2].vectors["Lcl Translation"] = {0.1, 0.4, 0};
  fbx.nodes[3].vectors["Lcl Translation"] = {0, 0.3, 0.2};
  fbx.nodes[4].vectors["Lcl Translation"] = {0.1, 0.1, 0};
  fbx.meshes = {{3, corners}, {4, corners}, {6, {{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 3, 2}}}};
  fbx.meshes.push_back({5,
                        {{0, 0.2, 0}, {0.4, 0.8, 0}, {0, 1.5, 0.1}, {0, 0.8, 0.6}},
                        {{1, {0, 1}, {1, 0.25}}, {2, {1, 2, 3}, {0.75, 1, 1}}}});
  fbx.bind(fbx.meshes.back());
  fbx.stop = 1;
  return fbx;
}

/// Turns the spine by all three angles, and moves and scales it.
inline void move_spine(FbxText& fbx) {
  fbx.curves = {
      {2, "Lcl Rotation", 0, {0, 0.5, 1}, {0, 40, -20}}, {2, "Lcl Rotation", 1, {0, 1}, {10, 70}},
      {2, "Lcl Rotation", 2, {0.25, 1}, {-30, 50}},      {2, "Lcl Translation", 1, {0, 1}, {0.4, 0.6}},
      {2, "Lcl Scaling", 0, {0, 1}, {1, 1.5}},           {1, "Lcl Rotation", 1, {0, 1}, {0, 60}}};
}

}  // namespace bch
