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
#include "layout/hierarchy/paper_hierarchies.hpp"

// Represented volume: figure 7 and table 1 of the paper, in its own terms. All shapes are cylinders over the ground, so that their volumes are to each other as their areas are.

namespace bch::report {
namespace {

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

/// Adds, of each pose, the single cylinder, the area of the leaf discs over all projected triangles, and the volume of the mesh.
void add_paper_volumes(const cli::LoadedCharacter& loaded, std::span<const PoseId> poses, Table& table) {
  const Character& character = loaded.character;
  detail::Skinner skinner(character);
  const bool closed = is_closed(character.triangles);
  std::vector<std::vector<Vec2>> from_above;
  std::vector<double> volumes, leaves(poses.size());
  for (const PoseId& pose : poses) {
    const auto positions = skinner.pose(pose.at);
    auto& points = from_above.emplace_back();
    for (const Vec3& p : positions) points.push_back({p.x, p.y});
    volumes.push_back(closed ? enclosed_volume(positions, character.triangles) : unknown);
  }
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
    const Hierarchy hierarchy = detail::projected_hierarchy(from_above[i], character.triangles);
    leaves[i] = cli::union_area(cli::discs_of(hierarchy, all_depths));
  });
  for (std::size_t i = 0; i < poses.size(); ++i)
    table.add({cli::file_name(loaded), i, static_cast<double>(loaded.report.height),
               static_cast<double>(detail::smallest_enclosing_disc(from_above[i]).radius), leaves[i],
               volumes[i]});
}

}  // namespace

void run_volume(Run& run) {
  Table table({"character", "pose", "height (m)", "radius (m)", "leaf discs (m2)", "mesh volume (m3)"});
  const auto& characters = run.scene.characters();
  for (std::uint32_t c = 0; c < characters.size(); ++c) {
    std::vector<PoseId> poses;
    std::ranges::copy_if(run.scene.sources(), std::back_inserter(poses),
                         [&](const PoseId& source) { return source.character == c; });
    add_paper_volumes(characters[c], poses, table);
  }
  const auto is = [&](const char* source) {
    return std::ranges::count(characters, source, &cli::LoadedCharacter::source) > 0;
  };
  if (is(man) && !is(bulky_man)) {
    const std::vector<cli::LoadedCharacter> bulky = {cli::load_character(bulky_man, {})};
    add_paper_volumes(bulky[0], cli::list_random_shapes(bulky, run.sizes().poses, run.seed()), table);
  }
  run.write("volume", table);
}

}  // namespace bch::report
