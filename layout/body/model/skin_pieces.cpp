// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/skin_pieces.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "layout/base/space_point.hpp"

namespace bch::detail {
namespace {

/// A triangle is halved so often at most, whatever its size: 2^12 pieces.
constexpr std::uint32_t max_halvings = 12;

class Cutter {
 public:
  Cutter(std::span<const Vec3> vertices, double longest_edge)
      : points_(vertices.begin(), vertices.end()),
        vertices_(static_cast<std::uint32_t>(vertices.size())),
        longest_(longest_edge * longest_edge) {}

  std::uint32_t add(std::array<std::uint32_t, 3> corners, std::uint32_t halvings) {
    const auto node = static_cast<std::uint32_t>(skin.nodes.size());
    skin.nodes.push_back({corners});
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length =
          squared_distance(space_point(points_[corners[i]]), space_point(points_[corners[(i + 1) % 3]]));
      if (length > most) longest = i, most = length;
    }
    if (most <= longest_ || halvings == max_halvings) {
      skin.nodes[node].piece = static_cast<std::uint32_t>(skin.pieces.size());
      skin.pieces.push_back(corners);
      return node;
    }
    const std::uint32_t a = corners[longest], b = corners[(longest + 1) % 3], c = corners[(longest + 2) % 3];
    const std::uint32_t middle = middle_of(a, b);
    const std::uint32_t first = add({a, middle, c}, halvings + 1);
    const std::uint32_t second = add({middle, b, c}, halvings + 1);
    skin.nodes[node].children = {first, second};
    return node;
  }

  SkinPieces skin;

 private:
  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    const std::pair ends = std::minmax(a, b);
    const auto [found, is_new] =
        middles_.try_emplace(ends, vertices_ + static_cast<std::uint32_t>(skin.cuts.size()));
    if (is_new) {
      skin.cuts.push_back({ends.first, ends.second});
      points_.push_back(middle_of_ends(points_[ends.first], points_[ends.second]));
    }
    return found->second;
  }

  std::vector<Vec3> points_;
  std::uint32_t vertices_;
  double longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

SkinPieces cut_skin(const Character& character, std::span<const Vec3> vertices, double longest_edge) {
  Cutter cutter(vertices, longest_edge);
  for (const auto& triangle : character.triangles) cutter.skin.roots.push_back(cutter.add(triangle, 0));
  return std::move(cutter.skin);
}

std::vector<Vec3> place_points(std::span<const Vec3> vertices,
                               std::span<const std::array<std::uint32_t, 2>> cuts) {
  std::vector<Vec3> points(vertices.begin(), vertices.end());
  points.reserve(vertices.size() + cuts.size());
  for (const auto [a, b] : cuts) points.push_back(middle_of_ends(points[a], points[b]));
  return points;
}

}  // namespace bch::detail
