// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <memory>
#include <vector>

#include <bch/bodies.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/body/body_layout.hpp"

namespace bch {

using namespace detail;

namespace {

/// Returns a character of one bone, whose mesh is the point in the middle of a sphere.
Character point_on_a_bone(const Sphere& sphere) {
  Character character;
  character.name = "spheres";
  character.joints = {Joint{"root", -1, {}}};
  character.bones = {Bone{}};
  character.vertices = {{sphere.x, sphere.y, sphere.z}};
  character.influence_begin = {0, 1};
  character.influences = {{0, 1}};
  character.triangles = {{0, 0, 0}};
  character.root_joint = 0;
  return character;
}

}  // namespace

BodyModel make_body(std::span<const Sphere> spheres) {
  const FloatingPointStateGuard floats;
  require_spheres(spheres, "make_body");
  const std::vector<Sphere> given(spheres.begin(), spheres.end());
  const BodyLayout layout = body_layout({&given, 1});
  BodyModel model;
  model.leaf_size = layout.leaf_size, model.core = layout.core;
  model.influence_begin.push_back(0);
  for (const std::uint32_t number : layout.sphere_in_slot) {
    const Sphere& s = given[number];
    model.influences.push_back({0, 1, {s.x, s.y, s.z}});
    model.influence_begin.push_back(static_cast<std::uint32_t>(model.influences.size()));
    model.least_radius.push_back(s.radius);
  }
  // The first sphere holds the mesh.
  model.character = std::make_shared<const Character>(point_on_a_bone(given[layout.sphere_in_slot[0]]));
  model.corners = {0};
  model.corner_begin.assign(given.size() + 1, 1);
  model.corner_begin[0] = 0;
  return model;
}

}  // namespace bch
