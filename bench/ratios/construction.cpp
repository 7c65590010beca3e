// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <bch/outline.hpp>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/build_stages.hpp"

#ifdef BCH_HAS_CLIPPER
#include <polyclipping/clipper.hpp>
#endif

namespace bch::bench {
namespace {

/// A character, and the stages of its construction.
struct Built {
  Built(const Character& made, std::uint32_t poses, const detail::BuildImplementation& implementation)
      : character(made), stages(character, poses, implementation) {}

  const Character character;
  BuildStages stages;
};

/// Adds NAME/<stage> for all stages. Returns what they share.
auto add_stages(const std::string& name, std::function<std::shared_ptr<Built>()> make,
                const std::map<std::string, double>& counters = {}) {
  const auto built = once(std::move(make));
  for (const BuildStage& stage : build_stages)
    add(fmt::format("{}/{}", name, stage.name), [built, build = stage.build, counters]() -> Contender {
      const auto call = [&stages = built().stages, build] {
        for (std::size_t pose = 0; pose < stages.poses(); ++pose) (stages.*build)(pose);
      };
      return {call, built().stages.poses(), counters};
    });
  return built;
}

#ifdef BCH_HAS_CLIPPER

/// Returns the area of the union of a pose's triangles, seen from above and rounded to steps of a grid.
double union_area(std::span<const Vec2> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
                  double step) {
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

/// The union of all triangles by libpolyclipping. Its holes are the outline's too, so that areas differ by them.
Contender by_clipper(const Built& built) {
  constexpr std::size_t max_poses = 3;  // it takes tens of milliseconds for one
  const std::size_t poses = std::min(max_poses, built.stages.poses());
  const auto area_of = [&built](std::size_t pose) {
    return union_area(built.stages.positions_of(pose), built.character.triangles,
                      built.stages.outline_of(pose).grid_step);
  };
  for (std::size_t pose = 0; pose < poses; ++pose) {
    const double theirs = area_of(pose), ours = area(built.stages.outline_of(pose));
    if (!(theirs <= ours * (1 + 1e-4) && theirs >= 0.9 * ours))
      throw std::runtime_error(fmt::format(
          "pose {}: the outline's area is {} m2, that of libpolyclipping's union {} m2", pose, ours, theirs));
  }
  const auto call = [area_of, poses] {
    for (std::size_t pose = 0; pose < poses; ++pose) area_of(pose);
  };
  return {call, poses};
}

#endif

}  // namespace

void add_construction(Scene& scene) {
  for (std::size_t i = 0; i < scene.characters().size(); ++i)
    for (const detail::BuildImplementation& set : detail::build_implementations()) {
      if (!set.supported()) continue;
      [[maybe_unused]] const auto built =
          add_stages(fmt::format("construction/{}/{}", i, set.name), [&scene, i, &set] {
            return std::make_shared<Built>(scene.characters()[i].character, scene.poses(), set);
          });
#ifdef BCH_HAS_CLIPPER
      if (&set == &detail::best_build_implementation())
        add(fmt::format("construction/{}/clipper", i), [built] { return by_clipper(built()); });
#endif
    }
}

}  // namespace bch::bench
