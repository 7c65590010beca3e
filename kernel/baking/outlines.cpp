// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/outline_builder.hpp>

#include "kernel/runtime/progress_report.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/number_class.hpp"
#include "layout/character/skinning.hpp"
#include "layout/outline/mesh_outliner.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t poses_a_task = 8;

/// Calls make(i, own) for every pose, with what new_own() returns for each thread, and names the pose where that throws.
template <class NewOwn, class Make>
std::vector<Outline> make_all(std::size_t count, const OutlineOptions& options, const NewOwn& new_own,
                              const Make& make) {
  std::vector<Outline> outlines(count);
  ProgressReport progress(options.progress, count);
  Spares<decltype(new_own())> spares;
  without_tasks_from_outside([&] {
    for_ranges(count, poses_a_task, [&](std::size_t begin, std::size_t end) {
      const FloatingPointStateGuard floats;
      const auto own = spares.borrow(new_own);
      for (std::size_t i = begin; i < end; ++i) try {
          outlines[i] = make(i, *own);
          progress.part_done();
        } catch (const std::logic_error& error) {
          throw std::invalid_argument("pose " + std::to_string(i) + ": " + error.what());
        }
    });
  });
  progress.all_done();
  return outlines;
}

/// Returns the first pose of a mesh, which tells what vertices are near each other. A number that is not finite becomes 0: the pose itself
/// refuses it. So does each height where heights do not count.
std::vector<Vec3> bind_pose(std::span<const Vec3> vertices, const OutlineOptions& options) {
  const bool is_flat = is_infinite(options.between.bottom) && is_infinite(options.between.top);
  const auto number = [](float value) { return is_finite(value) ? value : 0; };
  std::vector<Vec3> bind;
  bind.reserve(vertices.size());
  for (const auto& [x, y, z] : vertices) bind.push_back({number(x), number(y), is_flat ? 0 : number(z)});
  return bind;
}

}  // namespace

std::vector<Outline> outlines(std::span<const Vec3> positions, std::size_t vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              const OutlineOptions& options) {
  if (vertices == 0 || positions.size() % vertices != 0)
    throw std::invalid_argument("outlines: expected " + std::to_string(vertices) +
                                " positions for each pose, found " + std::to_string(positions.size()));
  const std::vector<Vec3> bind = bind_pose(positions.first(vertices), options);
  const MeshOutliner checked(triangles, bind, options);  // so that what is wrong with the mesh names no pose
  return make_all(
      positions.size() / vertices, options, [&] { return MeshOutliner(triangles, bind, options); },
      [&](std::size_t i, MeshOutliner& by) { return by.outline(positions.subspan(i * vertices, vertices)); });
}

std::vector<Outline> outlines(const Character& character, std::span<const PoseTime> poses,
                              const OutlineOptions& options) {
  struct Own {
    Skinner skinner;
    MeshOutliner by;
  };
  validate(character);
  return make_all(
      poses.size(), options,
      [&] {
        return Own{Skinner(character), MeshOutliner(character.triangles, character.vertices, options)};
      },
      [&](std::size_t i, Own& own) { return own.by.outline(own.skinner.pose(poses[i])); });
}

Outline outline(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
                const OutlineOptions& options) {
  return MeshOutliner(triangles, bind_pose(positions, options), options).outline(positions);
}

Outline outline(const Character& character, PoseTime at, const OutlineOptions& options) {
  return std::move(outlines(character, {&at, 1}, options).front());
}

}  // namespace bch
