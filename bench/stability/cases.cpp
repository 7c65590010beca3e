// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bench/stability/trial.hpp"

namespace bch::bench {
namespace {

using detail::Random;

using Setups = std::vector<StabilitySetup>;
using Specimens = std::vector<Specimen>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

StabilitySetup named(double value) {
  StabilitySetup setup;
  setup.value = fmt::format("{:g}", value);
  setup.conditioning = value;
  return setup;
}

/// The setups of a family: one for each value, which `change` makes of the usual one.
template <class Change>
Setups varied(std::initializer_list<double> values, Change change) {
  Setups setups;
  for (const double value : values) change(setups.emplace_back(named(value)), value);
  return setups;
}

auto of_extent(double max_extent) {
  return [max_extent](Random& random) { return usual_specimens(random, max_extent); };
}

Setups offset_setups() {
  return varied({0.0, 1.0, 1e2, 1e4, 1e5, 1e6, 1e7, 1e8, 9.9e8, 1.1e9},
                [](StabilitySetup& setup, double offset) {
                  setup.x = offset, setup.y = -offset;
                  setup.outside = offset > 1e9;
                });
}

Setups scale_setups() {
  return varied(
      {9e-7, 1.001e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 0.999e6, 1.1e6},
      [](StabilitySetup& setup, double max_extent) {
        setup.make = of_extent(max_extent);
        setup.outside = max_extent < 1e-6 || max_extent > 1e6;
      });
}

Setups ratio_setups() {
  return varied({1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e9}, [](StabilitySetup& setup, double ratio) {
    setup.make = of_extent(1e5);
    setup.make_other = of_extent(1e5 / ratio);
  });
}

template <double (*step)(double)>
Setups ladder_setups() {
  return varied({-64, -32, -16, -8, -4, -2, -1, 0, 1, 2, 4, 8, 16, 32, 64},
                [](StabilitySetup& setup, double steps) {
                  setup.gap = [=](Random&, double radii, double) { return steps * step(radii); };
                });
}

/// Either way, half of them exactly so much and half a thousandth less at most.
auto about(double heading) {
  return [heading](Random& random) {
    const double part = random.below(2) == 0 ? 1 : 1 - random.uniform(1e-3);
    return (random.below(2) == 0 ? part : -part) * heading;
  };
}

Setups rotation_setups() {
  using std::numbers::pi;
  return varied({1e-20, 1e-10, 1e-7, 1e-3, 1.0, pi / 2, pi, 1e3, 1e6, 1e9, 1.1e9, infinity, not_a_number},
                [](StabilitySetup& setup, double heading) {
                  setup.heading = about(heading);
                  setup.outside = !(heading <= 1e9);
                });
}

Setups slender_setups() {
  return varied({1.0, 10.0, 100.0, 1e3, 1e4}, [](StabilitySetup& setup, double slenderness) {
    setup.make = [slenderness](Random& random) {
      Specimens specimens;
      for (int i = 0; i < 12; ++i)
        specimens.push_back(contour_specimen(ring(random, 24, 0.2, 0.4, 0, 0, slenderness), 0.02));
      return specimens;
    };
  });
}

Setups contour_setups() {
  return varied({3, 10, 100, 1'000, 10'000, 100'000, 1'000'000}, [](StabilitySetup& setup, double count) {
    const auto corners = static_cast<std::uint32_t>(count);
    setup.make = [corners](Random& random) {
      const double rough =
          corners > 100 ? 10.0 / corners : 0.2;  // so that a corner is not longer than the outline
      Specimens specimens;
      for (int i = 0; i < (corners < 10'000 ? 8 : 2); ++i)
        specimens.push_back(contour_specimen(ring(random, corners, 0.4 * (1 - rough), 0.4), 0.02));
      return specimens;
    };
    setup.cost = corners < 100'000 ? 2 : corners / 10'000;
  });
}

Setups height_setups() {
  return varied({0.0, 1.0, 1e2, 1e4, 1e6, 1e8, 9.9e8, 1.1e9}, [](StabilitySetup& setup, double height) {
    setup.make = prism_specimens;
    setup.plan.heights = true;
    setup.placing = Placing::stacked;
    setup.z = height;
    setup.outside = height > 1e9;
  });
}

Setups triangle_setups() {
  constexpr const char* names[] = {"collinear", "duplicate", "folded", "needle"};
  Setups setups(std::size(names));
  for (std::size_t i = 0; i < setups.size(); ++i) {
    setups[i].value = names[i];
    setups[i].make = [i](Random& random) { return soup_specimens(random, static_cast<Soup>(i)); };
  }
  return setups;
}

Setups coincident_setups() {
  return varied({0.0, 1e3, 9.9e8}, [](StabilitySetup& setup, double offset) {
    setup.value = fmt::format("at {:g} m, and one bit beside", offset);
    setup.placing = Placing::coincident;
    setup.x = setup.y = offset;
  });
}

/// A flat contour whose heights are `height`, far below what its length has of resolution.
auto flat(double height) {
  return [height](Random& random) {
    Specimens specimens;
    const auto low = static_cast<float>(height);
    for (int i = 0; i < 8; ++i) {
      const float end = static_cast<float>(0.1 + random.uniform(0.4));
      specimens.push_back(raw_specimen({{-end, low}, {0, -low}, {end, low}, {0, 3 * low}}, 0.05));
    }
    return specimens;
  };
}

auto triangle_of(double corner) {
  return [corner](Random&) {
    Specimens specimens;
    specimens.push_back(raw_specimen({{0, 0}, {static_cast<float>(corner), 0}, {0, 1}}, 0.1));
    return specimens;
  };
}

Setups extreme_setups() {
  Setups setups;
  const auto add = [&](const char* value) -> StabilitySetup& {
    setups.emplace_back().value = value;
    return setups.back();
  };
  add("positions of 1e-310 m").x = 1e-310;
  add("headings of 1e-40 rad").heading = about(1e-40);
  add("headings of 5e-324 rad").heading = about(5e-324);
  add("coordinates of 1e-40 m in a shape").make = flat(1e-40);
  add("coordinates of 1e-45 m in a shape").make = flat(1e-45);
  StabilitySetup& far = add("2e9 m apart");
  far.x = far.y = -1e9, far.apart_x = far.apart_y = 2e9, far.placing = Placing::apart;
  StabilitySetup& large = add("2e9 m apart, an extent of 1e6 m");
  large = far, large.value = "2e9 m apart, an extent of 1e6 m", large.make = of_extent(0.999e6);
  const auto refuse = [&](const char* value) -> StabilitySetup& {
    StabilitySetup& setup = add(value);
    setup.outside = true;
    return setup;
  };
  refuse("a position of 1e300 m").x = 1e300;
  refuse("an infinite position").y = -infinity;
  refuse("a position that is no number").x = not_a_number;
  refuse("a corner at 1e30 m").make = triangle_of(1e30);
  refuse("an infinite corner").make = triangle_of(infinity);
  refuse("a corner that is no number").make = triangle_of(not_a_number);
  refuse("a contour that is a point").make = [](Random&) {
    Specimens specimens;
    specimens.push_back(raw_specimen({{0, 0}, {0, 0}, {0, 0}}, 0.1));
    return specimens;
  };
  return setups;
}

constexpr StabilityFamily families[] = {
    {"offset", "Far from the origin", "distance of the agents from the origin, metres", offset_setups},
    {"scale", "Small and large shapes", "extent of the shapes, metres", scale_setups},
    {"ratio", "A large and a small shape", "ratio of their extents", ratio_setups},
    {"ladder_float", "A ladder of gaps, float", "gap, units in the last place of a float",
     ladder_setups<float_step>},
    {"ladder_double", "A ladder of gaps, double", "gap, units in the last place of a double",
     ladder_setups<double_step>},
    {"rotation", "Tiny, odd and large headings", "heading, radians", rotation_setups},
    {"slender", "Slender shapes", "length by width", slender_setups},
    {"contour", "Outlines of few and many corners", "corners", contour_setups},
    {"heights", "One on top of the other", "height of the ground, metres", height_setups},
    {"triangles", "Triangles without area, in meshes", nullptr, triangle_setups},
    {"coincident", "One shape twice at one place", nullptr, coincident_setups},
    {"extremes", "The ends of the range", nullptr, extreme_setups},
};

}  // namespace

std::span<const StabilityFamily> stability_families() {
  return families;
}

std::vector<StabilityRow> stability_rows(std::uint32_t pairs, std::uint64_t seed) {
  std::vector<std::pair<const char*, StabilitySetup>> work;
  for (const StabilityFamily& family : families)
    for (StabilitySetup& setup : family.setups()) work.emplace_back(family.name, std::move(setup));
  std::vector<StabilityRow> rows(work.size());
  tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t i) {
    rows[i] = run_setup(work[i].first, work[i].second, pairs, seed + i);
  });
  return rows;
}

std::string broken_promise(const StabilityRow& row) {
  const std::string where = row.family + " " + row.value + ": ";
  if (row.outside) return row.refused.empty() ? where + "outside the domain, and answered" : "";
  if (!row.refused.empty()) return where + row.refused;
  if (row.ours.misses > 0) return where + fmt::format("{} misses", row.ours.misses);
  if (row.outline_misses > 0) return where + fmt::format("{} missed outlines", row.outline_misses);
  if (row.ours.gap_per_extent > promised_gap)
    return where + fmt::format("a gap of {} m per metre of extent is a hit", row.ours.gap_per_extent);
  return "";
}

}  // namespace bch::bench
