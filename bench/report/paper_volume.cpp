// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/paper_volume.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numbers>

#include "bench/base/disc_union_area.hpp"
#include "bench/report/coverage.hpp"
#include "bench/report/mesh_volume.hpp"
#include "bench/report/statistics.hpp"
#include "layout/character/skinning.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"

namespace bch::report {
namespace {

constexpr const char* man = "default:male";
constexpr const char* woman = "default:female";
constexpr const char* bulky_man = "default:bulky";
constexpr const char* radius_name = "cylinder radius (m)";
constexpr const char* cylinder_name = "cylinder over mesh volume";
constexpr const char* leaves_name = "BCH over mesh volume";
constexpr const char* mesh_name = "mesh volume (m3)";

/// A row of the paper's table 1, or what its text says of the mesh volume.
struct PaperRow {
  bool of_woman;
  std::string_view quantity;
  double mean, median, deviation;
};
constexpr PaperRow paper_rows[] = {
    {true, radius_name, 0.34, 0.31, 0.05},  {true, cylinder_name, 11.09, 9.50, 3.55},
    {true, leaves_name, 4.61, 4.27, 0.76},  {true, mesh_name, empty_cell, empty_cell, 0.01},
    {false, radius_name, 0.42, 0.40, 0.05}, {false, cylinder_name, 7.70, 6.99, 1.75},
    {false, leaves_name, 3.57, 3.34, 0.51}, {false, mesh_name, empty_cell, empty_cell, 0.01},
};

/// The page takes the built-in man and woman for the paper's two, and the bulky man for its man once more.
PaperRow paper_row(const std::string& source, std::string_view quantity) {
  for (const PaperRow& row : paper_rows)
    if (row.quantity == quantity && (row.of_woman ? source == woman : source == man || source == bulky_man))
      return row;
  return {false, quantity, empty_cell, empty_cell, empty_cell};
}

/// The volumes of one character, an entry a pose.
struct Volumes {
  std::vector<double> radius, mesh;  ///< metres; cubic metres, of a closed mesh
  std::vector<double> leaves;        ///< square metres that the leaf discs over all projected triangles cover
};

Volumes volumes_of(const Character& character, std::span<const ShapeSource> poses) {
  detail::Skinner skinner(character);
  const bool closed = is_closed(character.triangles);
  Volumes volumes;
  std::vector<std::vector<Vec2>> from_above;
  for (const ShapeSource& pose : poses) {
    const auto positions = skinner.pose(pose.at);
    auto& points = from_above.emplace_back();
    for (const Vec3& p : positions) points.push_back({p.x, p.y});
    volumes.radius.push_back(static_cast<double>(detail::smallest_enclosing_disc(points).radius));
    volumes.mesh.push_back(closed ? enclosed_volume(positions, character.triangles) : empty_cell);
  }
  volumes.leaves.resize(poses.size());
  tbb::parallel_for(std::size_t{0}, from_above.size(), [&](std::size_t i) {
    const Hierarchy hierarchy = projected_hierarchy(from_above[i], character.triangles);
    volumes.leaves[i] = rasterise({}, cli::discs_of(hierarchy, all_depths)).discs;
  });
  return volumes;
}

void add_paper_rows(Run& run, const cli::LoadedCharacter& loaded, std::span<const ShapeSource> poses,
                    Table& table) {
  Volumes volumes = volumes_of(loaded.character, poses);
  const double mesh = estimate(volumes.mesh, run.seed()).mean;
  const double height_per_mesh = static_cast<double>(loaded.report.height) / mesh;
  std::vector<double> cylinders;
  for (const double radius : volumes.radius)
    cylinders.push_back(std::numbers::pi * radius * radius * height_per_mesh);
  for (double& leaves : volumes.leaves) leaves *= height_per_mesh;
  const auto add = [&](std::string_view quantity, const std::vector<double>& values) {
    const PaperRow paper = paper_row(loaded.source, quantity);
    const Estimate ours = estimate(values, run.seed());
    table.add({cli::file_name(loaded), quantity, paper.mean, ours.mean, paper.median,
               quartiles(values).median, paper.deviation, ours.deviation, ours.low, ours.high,
               values.size()});
  };
  add(radius_name, volumes.radius);
  add(cylinder_name, cylinders);
  add(leaves_name, volumes.leaves);
  add(mesh_name, volumes.mesh);
}

}  // namespace

void measure_paper_volumes(Run& run) {
  Table table({"character", "quantity", "paper (mean)", "mean", "paper (median)", "median",
               "paper (deviation)", "standard deviation", "mean (95 % low)", "mean (95 % high)", "poses"});
  const auto& characters = run.scene().characters();
  for (std::uint32_t c = 0; c < characters.size(); ++c) {
    std::vector<ShapeSource> poses;
    std::copy_if(run.scene().sources().begin(), run.scene().sources().end(), std::back_inserter(poses),
                 [&](const ShapeSource& source) { return source.character == c; });
    add_paper_rows(run, characters[c], poses, table);
  }
  const auto is = [&](const char* source) {
    return std::any_of(characters.begin(), characters.end(),
                       [&](const auto& c) { return c.source == source; });
  };
  if (is(man) && !is(bulky_man)) {
    const std::vector<cli::LoadedCharacter> bulky = {cli::load_character(bulky_man, {})};
    add_paper_rows(run, bulky[0], cli::list_random_shapes(bulky, run.sizes().poses, run.seed()), table);
  }
  run.write("volume_paper", table);
}

}  // namespace bch::report
