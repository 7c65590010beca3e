// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_models.hpp"

namespace bch::test {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Cuts triangles into pieces.
class Cutter {
 public:
  Cutter(const Character& character, float longest) : points_(character.vertices), longest_(longest) {
    for (const Corners& triangle : character.triangles) add(triangle, 2);
  }

  std::vector<Vec3> points_;
  std::vector<std::array<std::uint32_t, 2>> cuts;
  std::vector<Corners> pieces;

 private:
  void add(const Corners& piece, int times) {
    std::size_t edge = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (square(piece, i) > square(piece, edge)) edge = i;
    if (times == 0 || !(square(piece, edge) > longest_ * longest_)) return pieces.push_back(piece);
    const std::uint32_t a = piece[edge], b = piece[(edge + 1) % 3], c = piece[(edge + 2) % 3];
    const auto [at, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points_.size()));
    const std::uint32_t middle = at->second;
    if (is_new) {
      cuts.push_back({a, b});
      const Vec3 p = points_[a], q = points_[b];
      points_.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
    }
    add({a, middle, c}, times - 1);
    add({middle, b, c}, times - 1);
  }

  float square(const Corners& piece, std::size_t edge) const {
    const Vec3 &a = points_[piece[edge]], &b = points_[piece[(edge + 1) % 3]];
    const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
  }

  float longest_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

BodyModel plain_model(const Character& character, std::uint32_t spheres, float longest_edge) {
  Cutter cut(character, longest_edge);
  const auto axis = [&](const Corners& piece, std::size_t k) {
    const Vec3& at = cut.points_[piece[0]];
    return k == 0 ? at.x : k == 1 ? at.y : at.z;
  };
  // Halves across x, y and z in turn, until there are as many groups as spheres.
  std::vector<std::pair<std::size_t, std::size_t>> groups = {{0, cut.pieces.size()}};
  for (std::size_t next = 0; groups.size() < spheres; ++next) {
    const auto [begin, end] = groups[next];
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return cut.pieces.begin() + static_cast<std::ptrdiff_t>(i); };
    std::stable_sort(at(begin), at(end), [&](const Corners& a, const Corners& b) {
      return axis(a, next % 3) < axis(b, next % 3);
    });
    groups[next].second = middle;
    groups.emplace_back(middle, end);
  }
  BodyModel model;
  model.character = std::make_shared<Character>(character);
  model.midpoints = cut.cuts;
  model.leaf_size = spheres > 384 ? 8 : 4;
  model.influence_begin.push_back(0), model.corner_begin.push_back(0);
  for (const auto& [begin, end] : groups) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = begin; i < end; ++i)
      corners.insert(corners.end(), cut.pieces[i].begin(), cut.pieces[i].end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    // A corner that is a vertex tells how the sphere moves; vertices have the lowest numbers, but a group may have none.
    const std::uint32_t vertex = !corners.empty() && corners[0] < character.vertices.size() ? corners[0] : 0;
    Vec3 middle{};
    for (const std::uint32_t corner : corners) {
      const auto fraction = 1 / static_cast<float>(corners.size());
      const Vec3& at = cut.points_[corner];
      middle = {middle.x + fraction * at.x, middle.y + fraction * at.y, middle.z + fraction * at.z};
    }
    for (std::uint32_t i = character.influence_begin[vertex]; i < character.influence_begin[vertex + 1]; ++i)
      model.influences.push_back({character.influences[i].bone, character.influences[i].weight, middle});
    model.influence_begin.push_back(static_cast<std::uint32_t>(model.influences.size()));
    model.corners.insert(model.corners.end(), corners.begin(), corners.end());
    model.corner_begin.push_back(static_cast<std::uint32_t>(model.corners.size()));
  }
  for (std::uint32_t i = 0; i < detail::core_spheres; ++i) model.core[i] = i * spheres / detail::core_spheres;
  return model;
}

}  // namespace bch::test
