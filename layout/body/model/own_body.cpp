// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/bodies.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/body_layout.hpp"

namespace bch {

using namespace detail;

namespace {

void require_own(std::span<const Sphere> spheres) {
  const auto refuse = [](const std::string& expected, const std::string& found) {
    throw std::invalid_argument("make_body: expected " + expected + ", found " + found);
  };
  if (spheres.empty() || spheres.size() > most_spheres)
    refuse("1 to " + std::to_string(most_spheres) + " spheres", std::to_string(spheres.size()));
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    if (!is_finite(s.x) || !is_finite(s.y) || !is_finite(s.z) || !is_finite(s.radius) || s.radius < 0)
      refuse("finite spheres with radii of at least 0", "(" + shortest(s.x) + ", " + shortest(s.y) + ", " +
                                                            shortest(s.z) + ", radius " + shortest(s.radius) +
                                                            ") as sphere " + std::to_string(i));
  }
}

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
  require_own(spheres);
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
