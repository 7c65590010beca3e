// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/clipper_union.hpp"

#include <cmath>
#include <polyclipping/clipper.hpp>
#include <utility>

namespace bch::bench {

const bool has_clipper = true;

double clipper_union_area(std::span<const Vec2> positions,
                          std::span<const std::array<std::uint32_t, 3>> triangles, double step) {
  using namespace ClipperLib;
  Clipper clipper;
  for (const auto& triangle : triangles) {
    Path path;
    for (const std::uint32_t v : triangle) {
      const auto steps = [step](float metres) {
        return static_cast<cInt>(std::nearbyint(static_cast<double>(metres) / step));
      };
      path.emplace_back(steps(positions[v].x), steps(positions[v].y));
    }
    if (!Orientation(path)) std::swap(path[0], path[1]);
    clipper.AddPath(path, ptSubject, true);
  }
  Paths paths;
  clipper.Execute(ctUnion, paths, pftNonZero, pftNonZero);
  double area = 0;
  for (const Path& path : paths) area += Area(path);
  return area * step * step;
}

}  // namespace bch::bench
