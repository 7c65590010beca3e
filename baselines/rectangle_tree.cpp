// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/rectangle_tree.hpp"

#include <algorithm>
#include <stdexcept>

namespace bch::baselines {
namespace {

RectangleNode flatten(const ObbNode& box) {
  // The covariance of points at z = 0 has an eigenvector along z, and the solver returns it exactly.
  int first = -1, second = -1;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(box.axis[k][2]) > 0.5f) continue;
    (first < 0 ? first : second) = k;
    if (box.axis[k][2] != 0) throw std::logic_error("rectangle tree: a box that is not upright");
  }
  return {box.axis[first][0],
          box.axis[first][1],
          {box.centre[0], box.centre[1]},
          {box.half[first], box.half[second]},
          box.link};
}

}  // namespace

RectangleTree::RectangleTree(const ObbTree& flat) : height(flat.height) {
  nodes.resize(flat.nodes.size());
  std::transform(flat.nodes.begin(), flat.nodes.end(), nodes.begin(), flatten);
  for (const Facet& facet : flat.facets)
    facets.push_back({{facet[0].x(), facet[0].y()}, {facet[1].x(), facet[1].y()}});
}

}  // namespace bch::baselines
