// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <bch/bodies.hpp>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/body_record.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr double weight_slack = 1e-3;  ///< of the sum of a sphere's weights

[[noreturn]] void refuse(const std::string& expected, const std::string& found) {
  throw std::invalid_argument("body model: expected " + expected + ", found " + found);
}

void require_offsets(std::span<const std::uint32_t> begin, std::size_t count, std::size_t end,
                     const char* name) {
  if (begin.size() != count + 1 || begin.front() != 0 || begin.back() != end ||
      !std::is_sorted(begin.begin(), begin.end()))
    refuse(std::to_string(count + 1) + " ascending offsets from 0 to " + std::to_string(end) + " in " + name,
           "others");
}

void require_influences(const BodyModel& model) {
  for (std::size_t s = 0; s < model.sphere_count(); ++s) {
    const std::string place = " of sphere " + std::to_string(s);
    double sum = 0;
    for (std::uint32_t i = model.influence_begin[s]; i < model.influence_begin[s + 1]; ++i) {
      const auto& [bone, weight, centre] = model.influences[i];
      if (bone >= model.character->bones.size())
        refuse("one of " + std::to_string(model.character->bones.size()) + " bones",
               std::to_string(bone) + place);
      if (!(weight > 0 && weight <= 1)) refuse("weights above 0 and up to 1", shortest(weight) + place);
      if (!is_finite(centre.x) || !is_finite(centre.y) || !is_finite(centre.z))
        refuse("finite centres", "another one" + place);
      sum += double{weight};
    }
    if (!(std::abs(sum - 1) <= weight_slack)) refuse("weights with a sum of 1", shortest(sum) + place);
  }
}

/// Finds, for each triangle, whether it or all parts that cuts make of it have their corners in one sphere. Which of its edges is cut
/// first has to be tried, so that a model made in bad faith would take for ever: work and depth are limited.
class Covering {
 public:
  explicit Covering(const BodyModel& model)
      : spheres_(points(model)),
        left_(max_work * (points(model) + model.character->triangles.size() + model.corners.size())) {
    for (std::uint32_t s = 0; s < model.sphere_count(); ++s)
      for (std::uint32_t i = model.corner_begin[s]; i < model.corner_begin[s + 1]; ++i)
        spheres_[model.corners[i]].push_back(s);
    const auto vertices = static_cast<std::uint32_t>(model.character->vertices.size());
    for (std::uint32_t i = 0; i < model.midpoints.size(); ++i)
      middle_.try_emplace(std::minmax(model.midpoints[i][0], model.midpoints[i][1]), vertices + i);
  }

  bool contains(const std::array<std::uint32_t, 3>& corners, int halvings = 0) {
    const auto [a, b, c] = corners;
    const std::size_t work = 1 + spheres_[a].size();
    if (work > left_) refuse("midpoints whose order is found soon", "none that was");
    left_ -= work;
    for (const std::uint32_t s : spheres_[a])
      if (has(b, s) && has(c, s)) return true;
    if (halvings == max_halvings) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k], to = corners[(k + 1) % 3], other = corners[(k + 2) % 3];
      const auto found = middle_.find(std::minmax(from, to));
      if (found != middle_.end() && contains({from, found->second, other}, halvings + 1) &&
          contains({found->second, to, other}, halvings + 1))
        return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t max_work = 64;  ///< times the size of a model; make_body()'s take 4
  static constexpr int max_halvings = 64;

  static std::size_t points(const BodyModel& model) {
    return model.character->vertices.size() + model.midpoints.size();
  }
  bool has(std::uint32_t point, std::uint32_t sphere) const {
    return std::binary_search(spheres_[point].begin(), spheres_[point].end(), sphere);
  }

  std::vector<std::vector<std::uint32_t>> spheres_;                          ///< by point, ascending
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_;  ///< by ends
  std::size_t left_;                                                         ///< of the work
};

void require_corners(const BodyModel& model) {
  const std::size_t vertices = model.character->vertices.size();
  for (std::size_t i = 0; i < model.midpoints.size(); ++i)
    for (const std::uint32_t end : model.midpoints[i])
      if (end >= vertices + i)
        refuse("midpoints of earlier points", std::to_string(end) + " in midpoint " + std::to_string(i));
  for (std::size_t s = 0; s < model.sphere_count(); ++s)
    for (std::uint32_t i = model.corner_begin[s]; i < model.corner_begin[s + 1]; ++i) {
      if (model.corners[i] >= vertices + model.midpoints.size() ||
          (i > model.corner_begin[s] && model.corners[i] <= model.corners[i - 1]))
        refuse("ascending corners of sphere " + std::to_string(s) + " below " +
                   std::to_string(vertices + model.midpoints.size()),
               std::to_string(model.corners[i]));
    }
  Covering covering(model);
  for (std::size_t t = 0; t < model.character->triangles.size(); ++t)
    if (!covering.contains(model.character->triangles[t]))
      refuse("spheres that hold all triangles", "triangle " + std::to_string(t) + " outside");
}

}  // namespace

void validate(const BodyModel& model) {
  if (model.character == nullptr) refuse("a character", "none");
  validate(*model.character);
  const std::size_t spheres = model.sphere_count();
  if (spheres < 1 || spheres > max_spheres)
    refuse("1 to " + std::to_string(max_spheres) + " spheres", std::to_string(spheres));
  require_offsets(model.influence_begin, spheres, model.influences.size(), "influence_begin");
  require_offsets(model.corner_begin, spheres, model.corners.size(), "corner_begin");
  if (model.leaf_size != 4 && model.leaf_size != 8)
    refuse("leaves of 4 or 8 spheres", std::to_string(model.leaf_size));
  if (!model.least_radius.empty() && model.least_radius.size() != spheres)
    refuse(std::to_string(spheres) + " least radii or none", std::to_string(model.least_radius.size()));
  for (const float radius : model.least_radius)
    if (!(radius >= 0 && is_finite(radius))) refuse("least radii of at least 0", shortest(radius));
  for (const std::uint32_t sphere : model.core)
    if (sphere >= spheres) refuse("core spheres below " + std::to_string(spheres), std::to_string(sphere));
  require_influences(model);
  require_corners(model);
}

}  // namespace bch
