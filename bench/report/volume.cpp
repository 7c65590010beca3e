// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <bch/scene_plan.hpp>

#include "bench/base/disc_union_area.hpp"
#include "bench/report/subjects.hpp"
#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"

// Represented volume: figure 7 and table 1 of the paper, in its own terms; and what cuts over the outline
// cover. All shapes are cylinders over the ground, so that their volumes are to each other as their areas are.

namespace bch::report {
namespace {

constexpr std::uint32_t volume_depths[] = {0, 3, 6, 9, all_depths};
/// The page takes the built-in man and woman for the paper's two, and the bulky man for its man once more.
constexpr const char *man = "default:male", *bulky_man = "default:bulky";

/// Returns whether the triangles enclose a volume: each edge is passed one way as often as the other.
bool is_closed(std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
      balance;  // of passes from the lower to the higher index
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

/// Returns the volume inside a closed mesh whose triangles run counter-clockwise seen from outside, cubic
/// metres. A region inside two parts of the mesh counts twice.
double enclosed_volume(std::span<const Vec3> positions,
                       std::span<const std::array<std::uint32_t, 3>> triangles) {
  double volume = 0;  // of the tetrahedra that triangles make with the origin
  for (const auto& [a, b, c] : triangles) {
    const auto at = [&](std::uint32_t i) -> Eigen::Vector3d {
      return detail::to_eigen(positions[i]).cast<double>();
    };
    volume += at(a).dot(at(b).cross(at(c)));
  }
  return volume / 6;
}

/// The area of a pose's single cylinder.
double cylinder_of(const Shape& shape) {
  const double radius = static_cast<double>(shape.hierarchy.nodes[0].disc.radius);
  return std::numbers::pi * radius * radius;
}

std::string name_of_character(Run& run, std::size_t shape) {
  return cli::file_name(run.scene.characters()[run.scene.sources()[shape].character]);
}

/// Adds, of each pose, the single cylinder, the area of the leaf discs over all projected triangles, and the volume of the mesh.
void add_paper_volumes(const cli::LoadedCharacter& loaded, std::span<const ShapeSource> poses, Table& table) {
  const Character& character = loaded.character;
  detail::Skinner skinner(character);
  const bool closed = is_closed(character.triangles);
  std::vector<std::vector<Vec2>> from_above;
  std::vector<double> volumes, leaves(poses.size());
  for (const ShapeSource& pose : poses) {
    const auto positions = skinner.pose(pose.at);
    auto& points = from_above.emplace_back();
    for (const Vec3& p : positions) points.push_back({p.x, p.y});
    volumes.push_back(closed ? enclosed_volume(positions, character.triangles) : unknown);
  }
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
    const Hierarchy hierarchy = projected_hierarchy(from_above[i], character.triangles);
    leaves[i] = cli::union_area(cli::discs_of(hierarchy, all_depths));
  });
  for (std::size_t i = 0; i < poses.size(); ++i)
    table.add({cli::file_name(loaded), i, static_cast<double>(loaded.report.height),
               static_cast<double>(detail::smallest_enclosing_disc(from_above[i]).radius), leaves[i],
               volumes[i]});
}

void measure_paper_volumes(Run& run) {
  Table table({"character", "pose", "height (m)", "radius (m)", "leaf discs (m2)", "mesh volume (m3)"});
  const auto& characters = run.scene.characters();
  for (std::uint32_t c = 0; c < characters.size(); ++c) {
    std::vector<ShapeSource> poses;
    std::ranges::copy_if(run.scene.sources(), std::back_inserter(poses),
                         [&](const ShapeSource& source) { return source.character == c; });
    add_paper_volumes(characters[c], poses, table);
  }
  const auto is = [&](const char* source) {
    return std::ranges::count(characters, source, &cli::LoadedCharacter::source) > 0;
  };
  if (is(man) && !is(bulky_man)) {
    const std::vector<cli::LoadedCharacter> bulky = {cli::load_character(bulky_man, {})};
    add_paper_volumes(bulky[0], cli::list_random_shapes(bulky, run.sizes().poses, run.seed()), table);
  }
  run.write("volume_paper", table);
}

/// What is covered with the inside of the outline, and by discs alone.
struct Areas {
  double covered, discs;
};

/// Adds the areas of every shape as shares of the pose's single cylinder.
template <class AreasOf>
void add_areas(Run& run, const std::string& structure, AreasOf areas_of, Table& table) {
  const std::vector<Shape>& shapes = run.scene.shapes();
  std::vector<Areas> areas(shapes.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) { areas[i] = areas_of(shapes[i]); });
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double cylinder = cylinder_of(shapes[i]);
    table.add(
        {name_of_character(run, i), structure, i, areas[i].covered / cylinder, areas[i].discs / cylinder});
  }
}

Areas areas_of_cut(const Shape& shape, std::uint32_t depth) {
  const std::vector<Disc> discs = cli::discs_of(shape.hierarchy, depth);
  return {cli::covered_area(shape.outline, discs), cli::union_area(discs)};
}

}  // namespace

void run_volume(Run& run) {
  measure_paper_volumes(run);
  Table table({"character", "structure", "shape", "normalised volume", "discs alone"});
  for (const std::uint32_t depth : volume_depths)
    add_areas(
        run, cut_name(depth), [depth](const Shape& shape) { return areas_of_cut(shape, depth); }, table);
  add_areas(
      run, "outline",
      [](const Shape& shape) {
        return Areas{area(shape.outline), unknown};
      },
      table);
  run.write("volume", table);
}

}  // namespace bch::report
