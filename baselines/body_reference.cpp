// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/body_reference.hpp"

#include <algorithm>

#include "baselines/placement.hpp"

namespace bch::baselines {

BodyReference::BodyReference(const BodySet& bodies) {
  for (std::uint32_t body = 0; body < bodies.body_count(); ++body) spheres_.push_back(bodies.spheres(body));
}

std::vector<Sphere> BodyReference::placed(const Agents& agents, Pair pair) const {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const FloatPlacement place = float_placement(agents, pair);
  const float rise = agents.z.empty() ? 0 : static_cast<float>(agents.z[b] - agents.z[a]);
  std::vector<Sphere> spheres = spheres_[agents.shape[b]];
  for (Sphere& s : spheres)
    s = {place.x + (place.cosine * s.x - place.sine * s.y), place.y + (place.sine * s.x + place.cosine * s.y),
         rise + s.z, s.radius};
  return spheres;
}

bool BodyReference::collide(const Agents& agents, Pair pair) const {
  const std::vector<Sphere> other = placed(agents, pair);
  for (const Sphere& a : spheres_[agents.shape[std::min(pair.first, pair.second)]])
    for (const Sphere& b : other) {
      const float x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, radii = a.radius + b.radius;
      if ((x * x + y * y) + z * z <= radii * radii) return true;
    }
  return false;
}

}  // namespace bch::baselines
