// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "baselines/obb_tree.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/eigen.hpp"

namespace bch::baselines {
namespace {

constexpr std::size_t max_facets = std::size_t{1} << 22;

/// A facet on its way down, with the integrals of 1, p and p p^T over its area or length.
struct Item {
  Facet facet;
  Eigen::Vector3d centroid;
  double weight;
  Eigen::Matrix3d second;
};

/// Integrals over a triangle: (area / 12) (9 m m^T + a a^T + b b^T + c c^T) with its centroid m (Gottschalk
/// 1996); over a segment: (length / 6) ((a + b)(a + b)^T + a a^T + b b^T).
Item make_item(const Facet& facet) {
  const Eigen::Vector3d a = facet[0].cast<double>(), b = facet[1].cast<double>(), c = facet[2].cast<double>();
  Item item{facet, {}, 0, {}};
  if (facet[1] == facet[2]) {
    item.centroid = 0.5 * (a + b);
    item.weight = (b - a).norm();
    item.second = ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose()) / 6;
  } else {
    item.centroid = (a + b + c) / 3;
    item.weight = 0.5 * (b - a).cross(c - a).norm();
    item.second = (9 * item.centroid * item.centroid.transpose() + a * a.transpose() + b * b.transpose() +
                   c * c.transpose()) /
                  12;
  }
  return item;
}

/// Weighted moments; of the facets' number if they have no extent.
struct Moments {
  double weight = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Moments moments(std::span<const Item> items) {
  const bool flat = std::all_of(items.begin(), items.end(), [](const Item& i) { return !(i.weight > 0); });
  Moments sum;
  for (const Item& item : items) {
    const double weight = flat ? 1 : item.weight;
    sum.weight += weight;
    sum.mean += weight * item.centroid;
    sum.covariance += weight * item.second;
  }
  sum.mean /= sum.weight;
  sum.covariance = sum.covariance / sum.weight - sum.mean * sum.mean.transpose();
  return sum;
}

/// The frame of a lone facet: its longest edge, its normal, and what completes them. Columns are axes.
std::optional<Eigen::Matrix3d> facet_frame(const Facet& facet) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero(), normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d edge = (facet[(i + 1) % 3] - facet[i]).cast<double>();
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  if (!(longest.norm() > 0)) return std::nullopt;
  longest.normalize();
  normal = (facet[1] - facet[0]).cast<double>().cross((facet[2] - facet[0]).cast<double>());
  normal -= longest.dot(normal) * longest;
  if (!(normal.norm() > 0x1p-30 * (facet[1] - facet[0]).cast<double>().norm()))
    normal = longest.unitOrthogonal();
  normal.normalize();
  Eigen::Matrix3d frame;
  frame << longest, normal.cross(longest), normal;
  return frame;
}

Eigen::Matrix3d frame_of(std::span<const Item> items, const Moments& all) {
  if (items.size() == 1)
    if (const auto frame = facet_frame(items[0].facet)) return *frame;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(all.covariance).eigenvectors();
}

/// The box along a frame, its axes by descending extent.
ObbNode box_along(const Eigen::Matrix3d& frame, std::span<const Item> items, double margin) {
  const Eigen::Matrix3f axes = frame.cast<float>();
  const auto for_each_corner = [&](auto visit) {
    for (const Item& item : items)
      for (const Eigen::Vector3f& p : item.facet) visit(Eigen::Vector3d(p.cast<double>()));
  };
  const Eigen::Matrix3d stored = axes.cast<double>();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
  for_each_corner([&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d along = stored.transpose() * p;
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  });
  const Eigen::Vector3f centre = (frame * (0.5 * (low + high))).cast<float>();
  const Eigen::Vector3d middle = stored.transpose() * centre.cast<double>();
  const Eigen::Vector3d half = (high - middle).cwiseMax(middle - low);

  std::array<Eigen::Index, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return half[i] > half[j]; });
  ObbNode node{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (Eigen::Index x = 0; x < 3; ++x) node.axis[k][x] = axes(x, order[k]);
    node.centre[k] = centre[static_cast<Eigen::Index>(k)];
    node.half[k] = detail::rounding::round_up(half[order[k]] * (1 + 0x1p-40) + margin);
  }
  return node;
}

/// Reorders the items so that neither side is empty; returns the size of the first.
std::size_t divide(std::span<Item> items, const ObbNode& box, const Eigen::Vector3d& mean) {
  for (const auto& axis_of : box.axis) {
    const Eigen::Vector3d axis(static_cast<double>(axis_of[0]), static_cast<double>(axis_of[1]),
                               static_cast<double>(axis_of[2]));
    const double plane = axis.dot(mean);
    const auto middle = std::stable_partition(
        items.begin(), items.end(), [&](const Item& item) { return axis.dot(item.centroid) < plane; });
    if (middle != items.begin() && middle != items.end())
      return static_cast<std::size_t>(middle - items.begin());
  }
  return items.size() / 2;
}

double checked_extent(std::span<const Facet> facets) {
  if (facets.empty()) throw std::invalid_argument("box tree: no facets");
  if (facets.size() > max_facets)
    throw std::length_error("box tree: " + std::to_string(facets.size()) + " facets, more than 2^22");
  double max_extent = 0;
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (const Eigen::Vector3f& p : facets[i]) {
      if (!p.allFinite())
        throw std::invalid_argument("box tree: facet " + std::to_string(i) + " is not finite");
      max_extent = std::max(max_extent, p.cast<double>().norm());
    }
  if (max_extent < detail::rounding::smallest_extent || max_extent > detail::rounding::largest_extent)
    throw std::invalid_argument("box tree: expected an extent of 1e-6 to 1e6 m, found " +
                                detail::shortest(max_extent));
  return max_extent;
}

/// A node still to be made: a range of items, and the node whose second child it is, if it is one.
struct Open {
  std::size_t begin, end;
  std::uint32_t depth;
  std::optional<std::uint32_t> second_child_of;
};

}  // namespace

ObbTree build_obb_tree(std::vector<Facet> facets) {
  const double margin = box_margin * checked_extent(facets);
  std::vector<Item> all;
  all.reserve(facets.size());
  for (const Facet& facet : facets) all.push_back(make_item(facet));

  ObbTree tree;
  tree.nodes.reserve(2 * facets.size() - 1);
  tree.facets = std::move(facets);
  std::vector<Open> open = {{0, all.size(), 0, {}}};
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    const std::span<Item> items = std::span(all).subspan(at.begin, at.end - at.begin);
    const auto index = static_cast<std::uint32_t>(tree.nodes.size());
    if (at.second_child_of) tree.nodes[*at.second_child_of].link = index;
    const Moments total = moments(items);
    ObbNode& node = tree.nodes.emplace_back(box_along(frame_of(items, total), items, margin));
    tree.height = std::max(tree.height, at.depth);
    if (items.size() == 1) {
      node.link = static_cast<std::uint32_t>(at.begin) | ObbNode::leaf_bit;
      tree.facets[at.begin] = items[0].facet;
      continue;
    }
    const std::size_t middle = at.begin + divide(items, node, total.mean);
    open.push_back({middle, at.end, at.depth + 1, index});
    open.push_back({at.begin, middle, at.depth + 1, {}});
  }
  return tree;
}

std::vector<Facet> triangle_facets(std::span<const Vec3> positions,
                                   std::span<const std::array<std::uint32_t, 3>> triangles) {
  if (triangles.empty()) throw std::invalid_argument("no triangles");
  std::vector<Facet> facets;
  facets.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t vertex : triangles[t])
      if (vertex >= positions.size())
        throw std::invalid_argument("triangle " + std::to_string(t) + " names vertex " +
                                    std::to_string(vertex) + " of " + std::to_string(positions.size()));
    const auto& [a, b, c] = triangles[t];
    facets.push_back(
        {detail::to_eigen(positions[a]), detail::to_eigen(positions[b]), detail::to_eigen(positions[c])});
  }
  return facets;
}

}  // namespace bch::baselines
