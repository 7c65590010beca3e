// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/body/model/assemble_model.hpp"
#include "layout/body/model/body_candidates.hpp"
#include "layout/body/model/skin_pieces.hpp"
#include "layout/body/model/sphere_choice.hpp"
#include "layout/body/model/sphere_search.hpp"
#include "layout/body/model/training_poses.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr double longest_edge = 0.025;   // metres: a sphere of a forearm holds a triangle of that size
constexpr double usual_size = 2;         // metres, of people
constexpr std::uint32_t chosen_in = 12;  ///< poses

/// Returns by how much lengths have to be larger than those for people: the largest side of the box of all vertices over theirs, or 1.
/// Errors:  throws std::invalid_argument on vertices that are too far away.
double scale_of(const Character& character, std::span<const Vec3> vertices) {
  double size = usual_size;
  for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    double low = 0, high = 0;
    for (const Vec3& vertex : vertices) {
      const double at = double{vertex.*axis};
      if (!(std::abs(at) <= rounding::largest_extent))
        throw std::invalid_argument(
            "character '" + character.name +
            "': expected vertices within 1e6 m of the origin of the rest pose, found one at " + shortest(at) +
            " m");
      low = std::min(low, at), high = std::max(high, at);
    }
    size = std::max(size, high - low);
  }
  return size / usual_size;
}

/// Returns as many poses as the search for better spheres expects: a character without clips has a single one.
std::vector<PoseTime> repeated(std::vector<PoseTime> poses) {
  poses.resize(searched_poses, poses.front());
  return poses;
}

}  // namespace

BodyModel make_body(const Character& character, const BodyOptions& options) {
  const FloatingPointStateGuard floats;
  validate(character);
  if (options.spheres < 1 || options.spheres > max_spheres)
    throw std::invalid_argument("make_body: expected 1 to " + std::to_string(max_spheres) +
                                " spheres, found " + std::to_string(options.spheres));
  const auto advance = [&](double fraction) {
    if (options.progress && !options.progress(fraction))
      throw std::system_error(std::make_error_code(std::errc::operation_canceled), "make_body");
  };
  auto own = std::make_shared<const Character>(character);
  Skinner skinner(*own);
  const auto at_rest = skinner.pose(Pose());
  const double scale = scale_of(*own, at_rest);
  const SkinPieces skin = cut_skin(*own, at_rest, scale * longest_edge);
  const auto candidates = find_candidates(*own, skin, place_points(at_rest, skin.cuts), skinner, scale);
  if (candidates.empty())
    throw std::invalid_argument(
        "character '" + own->name +
        "': expected triangles of some area, moved by bones that have an inverse, found none");
  advance(0.2);
  const TrainingPoses poses(*own, skin, sample_poses(*own, chosen_in));
  const double chosen = options.draft ? 1 : 0.3;
  SphereChoice choice = choose_spheres(skin, candidates, poses, options.spheres, scale,
                                       [&](double fraction) { advance(chosen * (0.2 + 0.8 * fraction)); });
  if (options.draft) return assemble_model(std::move(own), skin, choice, poses);
  choice.spheres.resize(options.spheres, choice.spheres.front());  // the search gives pieces to the others
  const TrainingPoses training(*own, skin, repeated(sample_poses(*own, searched_poses)));
  const SphereChoice better = improve_spheres(
      skin, training, choice, [&](double fraction) { advance(chosen + (1 - chosen) * fraction); });
  BodyModel model = assemble_model(std::move(own), skin, better, training);
  advance(1);
  return model;
}

}  // namespace bch
