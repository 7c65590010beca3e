// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/body_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "layout/base/number_class.hpp"
#include "layout/base/space_point.hpp"

namespace bch::detail {
namespace {

// Of bodies of up to two metres, metres.
constexpr double radius_of_flat_skin = 0.025;  ///< about a piece's middle it holds the piece
constexpr double first_radius = 0.3, least_radius = 0.004, max_radius = 0.29;
constexpr double grid_cell = 0.03;
constexpr double least_weight = 0.02;  ///< of a bone; smaller ones are dropped
constexpr int max_shrinks = 40;

SpacePoint cross(const SpacePoint& a, const SpacePoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
using Weights = std::vector<std::pair<std::uint32_t, double>>;  ///< of bones, ascending

/// Adds weights of bones, times a fraction.
void add(Weights& to, const Weights& weights, double fraction) {
  for (const auto& [bone, weight] : weights) {
    const auto at = std::lower_bound(to.begin(), to.end(), std::pair{bone, -1.0});
    if (at != to.end() && at->first == bone)
      at->second += fraction * weight;
    else
      to.insert(at, {bone, fraction * weight});
  }
}

/// A point of the skin, its outward normal and the bones that move it.
struct SkinPoint {
  SpacePoint at, normal;
  Weights weights;
};

/// Finds the points nearest to others: points by cells, which are sorted.
class SkinGrid {
 public:
  SkinGrid(const std::vector<SkinPoint>& points, double cell) : points_(points), cell_(cell) {
    for (std::uint32_t i = 0; i < points.size(); ++i) entries_.push_back({cell_of(points[i].at), i});
    std::sort(entries_.begin(), entries_.end());
    low_ = high_ = entries_.empty() ? GridCell{} : entries_.front().first;
    for (const auto& [at, i] : entries_)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low_[axis] = std::min(low_[axis], at[axis]);
        high_[axis] = std::max(high_[axis], at[axis]);
      }
    extent_ = {high_[0] - low_[0] + 1, high_[1] - low_[1] + 1, high_[2] - low_[2] + 1};
    begin_.assign(static_cast<std::size_t>(extent_[0] * extent_[1] * extent_[2]) + 1, 0);
    std::size_t entry = 0;
    for (std::size_t c = 0; c + 1 < begin_.size(); ++c) {
      begin_[c] = entry;
      while (entry < entries_.size() && index(entries_[entry].first) == c) ++entry;
    }
    begin_.back() = entries_.size();
  }

  /// Returns the point that is nearest to a centre, and nearer than a radius; `none` otherwise. Points at `not_at` do not count.
  std::uint32_t nearest(const SpacePoint& centre, double radius, const SpacePoint& not_at) const {
    std::uint32_t found = none;
    double least = radius * radius;
    const GridCell first = clamped(cell_of(centre - SpacePoint{radius, radius, radius}));
    const GridCell last = clamped(cell_of(centre + SpacePoint{radius, radius, radius}));
    for (std::int64_t x = first[0]; x <= last[0]; ++x)
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        const std::size_t from = index({x, y, first[2]}), to = index({x, y, last[2]});
        for (std::size_t e = begin_[from]; e < begin_[to + 1]; ++e) {
          const SpacePoint& at = points_[entries_[e].second].at;
          const double distance = squared_distance(at, centre);
          if (distance >= least || squared_distance(at, not_at) < 1e-10) continue;
          least = distance, found = entries_[e].second;
        }
      }
    return found;
  }

  static constexpr std::uint32_t none = 0xffffffff;

 private:
  using GridCell = std::array<std::int64_t, 3>;

  GridCell cell_of(const SpacePoint& at) const {
    return {static_cast<std::int64_t>(std::floor(at.x / cell_)),
            static_cast<std::int64_t>(std::floor(at.y / cell_)),
            static_cast<std::int64_t>(std::floor(at.z / cell_))};
  }
  GridCell clamped(GridCell at) const {
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = std::clamp(at[axis], low_[axis], high_[axis]);
    return at;
  }
  std::size_t index(const GridCell& at) const {
    return static_cast<std::size_t>(((at[0] - low_[0]) * extent_[1] + at[1] - low_[1]) * extent_[2] + at[2] -
                                    low_[2]);
  }

  const std::vector<SkinPoint>& points_;
  const double cell_;
  std::vector<std::pair<GridCell, std::uint32_t>> entries_;
  GridCell low_, high_, extent_;
  std::vector<std::size_t> begin_;
};

/// Returns a skin's points and the middles of its pieces. Normals are means, outward by the sign of the volume.
std::vector<SkinPoint> skin_points(const Character& character, const SkinPieces& skin,
                                   std::span<const Vec3> points) {
  std::vector<SkinPoint> all(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) all[i].at = space_point(points[i]);
  const std::size_t vertices = character.vertices.size();
  for (std::size_t v = 0; v < vertices; ++v)
    for (std::uint32_t i = character.influence_begin[v]; i < character.influence_begin[v + 1]; ++i)
      add(all[v].weights, {{character.influences[i].bone, double{character.influences[i].weight}}}, 1);
  for (std::size_t i = 0; i < skin.cuts.size(); ++i)
    for (const std::uint32_t end : skin.cuts[i]) add(all[vertices + i].weights, all[end].weights, 0.5);
  double volume = 0;
  std::vector<SpacePoint> facing;
  for (const auto& [a, b, c] : skin.pieces) {
    const SpacePoint normal = cross(all[b].at - all[a].at, all[c].at - all[a].at);
    volume += dot(all[a].at, normal);
    facing.push_back(normal);
  }
  const double outward = volume < 0 ? -1 : 1;
  for (std::size_t p = 0; p < skin.pieces.size(); ++p) {
    SkinPoint middle{{}, outward * facing[p], {}};
    for (const std::uint32_t corner : skin.pieces[p]) {
      all[corner].normal = all[corner].normal + middle.normal;
      middle.at = middle.at + (1.0 / 3) * all[corner].at;
      add(middle.weights, all[corner].weights, 1.0 / 3);
    }
    all.push_back(middle);
  }
  std::erase_if(all, [](SkinPoint& point) {
    const double length = std::sqrt(dot(point.normal, point.normal));
    if (!(length > 0)) return true;
    point.normal = (1 / length) * point.normal;
    return false;
  });
  return all;
}

/// Maps a point back through an affine map; false where the map has no inverse.
bool map_back(const Affine3d& map, const SpacePoint& to, Vec3& from) {
  const auto& m = map.rows;
  const SpacePoint x{m[0][0], m[1][0], m[2][0]}, y{m[0][1], m[1][1], m[2][1]}, z{m[0][2], m[1][2], m[2][2]};
  const SpacePoint right = to - SpacePoint{m[0][3], m[1][3], m[2][3]};
  const double determinant = dot(x, cross(y, z));
  if (!(std::abs(determinant) > 1e-30)) return false;
  from = {static_cast<float>(dot(right, cross(y, z)) / determinant),
          static_cast<float>(dot(x, cross(right, z)) / determinant),
          static_cast<float>(dot(x, cross(y, right)) / determinant)};
  return is_finite(from.x) && is_finite(from.y) && is_finite(from.z);
}

/// Binds a centre to bones by the mean of two points' weights.
std::vector<SphereInfluence> bind(const SpacePoint& centre, const SkinPoint& p, const SkinPoint& q,
                                  const Skinner& posed) {
  Weights weights;
  add(weights, p.weights, 0.5);
  add(weights, q.weights, 0.5);
  const auto heaviest = std::max_element(weights.begin(), weights.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
  const double limit = std::min(least_weight, heaviest->second);
  std::erase_if(weights, [&](const auto& bone) { return bone.second < limit; });
  double sum = 0;
  for (const auto& bone : weights) sum += bone.second;
  const SpacePoint in_shape = centre + SpacePoint{double{posed.middle().x}, double{posed.middle().y}, 0};
  std::vector<SphereInfluence> influences;
  for (const auto& [bone, weight] : weights) {
    const auto at =
        std::lower_bound(posed.bones().begin(), posed.bones().end(), bone) - posed.bones().begin();
    SphereInfluence influence{bone, static_cast<float>(weight / sum), {}};
    if (!map_back(posed.bone_maps()[static_cast<std::size_t>(at)], in_shape, influence.centre)) return {};
    influences.push_back(influence);
  }
  return influences;
}

}  // namespace

std::vector<BodyCandidate> find_candidates(const Character& character, const SkinPieces& skin,
                                           std::span<const Vec3> points, const Skinner& posed, double scale) {
  const std::vector<SkinPoint> all = skin_points(character, skin, points);
  const SkinGrid grid(all, scale * grid_cell);
  std::vector<BodyCandidate> found;
  for (const SkinPoint& p : all) {
    double radius = scale * first_radius;
    std::uint32_t touched = SkinGrid::none;
    for (int i = 0; i < max_shrinks; ++i) {
      const std::uint32_t inside = grid.nearest(p.at - radius * p.normal, radius * (1 - 1e-6), p.at);
      if (inside == SkinGrid::none) break;
      const SpacePoint offset = p.at - all[inside].at;
      radius = dot(offset, offset) / (2 * dot(p.normal, offset));
      touched = inside;
      if (radius < scale * least_radius) break;
    }
    if (touched == SkinGrid::none || !(radius >= scale * least_radius && radius <= scale * max_radius))
      continue;
    BodyCandidate candidate{bind(p.at - radius * p.normal, p, all[touched], posed), radius};
    if (!candidate.influences.empty()) found.push_back(std::move(candidate));
  }
  if (!found.empty()) return found;
  // A skin that encloses nothing.
  for (const SkinPoint& p : all) found.push_back({bind(p.at, p, p, posed), scale * radius_of_flat_skin});
  std::erase_if(found, [](const BodyCandidate& candidate) { return candidate.influences.empty(); });
  return found;
}

}  // namespace bch::detail
