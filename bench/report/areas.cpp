// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/areas.hpp"

#include <oneapi/tbb/parallel_for.h>

#include "bench/report/coverage.hpp"

namespace bch::report {

std::vector<Disc> discs_of(const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<Disc> discs;
  for (const std::uint32_t node : cut(hierarchy, depth)) discs.push_back(hierarchy.nodes[node].disc);
  return discs;
}

std::vector<double> excess_areas(std::span<const Shape> shapes, std::uint32_t depth) {
  std::vector<double> per_cent(shapes.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) {
    const Coverage area = rasterise(shapes[i].outline, discs_of(shapes[i].hierarchy, depth));
    per_cent[i] = 100 * (area.filled / area.outline - 1);
  });
  return per_cent;
}

}  // namespace bch::report
