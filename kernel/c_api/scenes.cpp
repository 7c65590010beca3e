// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include <bch/scene_plan.hpp>

#include "kernel/c_api/arguments.hpp"

using namespace bch;
using namespace bch::c_api;

bch_status bch_local_densities(const double* x, const double* y, size_t count, double radius,
                               double* densities) {
  return guarded([&] {
    const auto to = array_of(densities, count, "densities");
    const std::vector<double> found =
        local_densities(array_of(x, count, "x"), array_of(y, count, "y"), radius);
    std::copy(found.begin(), found.end(), to.begin());
  });
}

bch_status bch_depth_at_density(double people_per_square_metre, uint32_t* depth) {
  return guarded([&] {
    const std::uint32_t found = depth_at_density(people_per_square_metre);
    required(depth, "depth") = found;
  });
}

bch_status bch_standing_slices(uint32_t slabs, float* slices) {
  return guarded([&] {
    const std::vector<float> planes = standing_slices(slabs);
    const auto to = array_of(slices, planes.size(), "slices");
    std::copy(planes.begin(), planes.end(), to.begin());
  });
}
