// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <bch/scene_plan.hpp>

#include "bench/base/disc_union_area.hpp"
#include "bench/report/coverage.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/paper_volume.hpp"
#include "bench/report/subject.hpp"
#include "layout/base/planes.hpp"

// Represented volume: figure 7 and table 1 of the paper, and what cuts over the outline cover. All shapes are cylinders over
// the ground, so that their volumes are to each other as their areas are.

namespace bch::report {
namespace {

constexpr std::uint32_t volume_depths[] = {0, 3, 6, 9, all_depths};

struct Areas {
  double discs, filled, outline;  ///< rasterised, square metres
  double exact_discs, exact_outline;
};

Areas areas_of(const Shape& shape, std::uint32_t depth) {
  const std::vector<Disc> discs = cli::discs_of(shape.hierarchy, depth);
  const Coverage grid = rasterise(shape.outline, discs);
  return {grid.discs, grid.filled, grid.outline, cli::union_area(discs), area(shape.outline)};
}

/// Adds the volumes of a character at a depth, normalised by the volume of the single cylinder of the same
/// pose.
void add_depth(Run& run, const std::string& character, std::span<const Shape> shapes, std::uint32_t depth,
               Table& table, Table& poses) {
  std::vector<Areas> all(shapes.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(),
                    [&](std::size_t i) { all[i] = areas_of(shapes[i], depth); });
  std::vector<double> normalised, exact, apart;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double radius = static_cast<double>(shapes[i].hierarchy.nodes[0].disc.radius);
    const double cylinder = std::numbers::pi * radius * radius;
    normalised.push_back(all[i].filled / cylinder);
    exact.push_back(all[i].exact_discs / cylinder);
    apart.push_back(100 * std::abs(all[i].discs / all[i].exact_discs - 1));
    poses.add({character, cut_name(depth), i, radius, all[i].filled, all[i].discs, all[i].exact_discs,
               all[i].outline, all[i].exact_outline});
  }
  const Estimate filled = estimate(normalised, run.seed()), discs = estimate(exact, run.seed());
  table.add({character, cut_name(depth), filled.mean, filled.low, filled.high, quartiles(normalised).median,
             filled.deviation, discs.mean, discs.deviation, quartiles(apart).median, quartiles(apart).high});
}

void add_outline(Run& run, const std::string& character, std::span<const Shape> shapes, Table& table) {
  std::vector<double> normalised, apart;
  for (const Shape& shape : shapes) {
    const double radius = static_cast<double>(shape.hierarchy.nodes[0].disc.radius),
                 exact = area(shape.outline);
    normalised.push_back(exact / (std::numbers::pi * radius * radius));
    apart.push_back(100 * std::abs(rasterise(shape.outline, {}).outline / exact - 1));
  }
  const Estimate exact = estimate(normalised, run.seed());
  table.add({character, "outline", exact.mean, exact.low, exact.high, quartiles(normalised).median,
             exact.deviation, exact.mean, exact.deviation, quartiles(apart).median, quartiles(apart).high});
}

/// Adds the volumes of slabs, each as high as it is: those of their outlines, which exact leaves represent.
void add_volume_of_slabs(Run& run, const std::string& character, std::span<const Shape> whole,
                         std::size_t begin, std::uint32_t slabs, Table& table) {
  const std::vector<float> planes = standing_slices(slabs);
  std::vector<double> normalised;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Shape& shape = run.scene().shapes_in_slabs(slabs)[begin + i];
    const auto height = [](const Heights& heights) {
      return static_cast<double>(heights.top) - static_cast<double>(heights.bottom);
    };
    double volume = 0;
    for (std::size_t j = 0; j < shape.slabs.size(); ++j)
      if (shape.slabs[j].outline.contours() > 0)
        volume += area(shape.slabs[j].outline) * height(detail::heights_of_slab(shape.heights, planes, j));
    const double radius = static_cast<double>(whole[i].hierarchy.nodes[0].disc.radius);
    normalised.push_back(volume / (std::numbers::pi * radius * radius * height(shape.heights)));
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Estimate exact = estimate(normalised, run.seed());
  table.add({character, slabs_name(slabs, Leaves::segments), exact.mean, exact.low, exact.high,
             quartiles(normalised).median, exact.deviation, none, none, none, none});
}

void run_volume(Run& run) {
  measure_paper_volumes(run);
  Table table({"character", "structure", "normalised volume", "95 % low", "95 % high", "median",
               "standard deviation", "discs alone, exact", "deviation of that",
               "raster off exact, median (%)", "raster off exact, upper quartile (%)"});
  Table poses({"character", "structure", "pose", "radius (m)", "filled, raster (m2)", "discs, raster (m2)",
               "discs, exact (m2)", "outline, raster (m2)", "outline, exact (m2)"});
  const std::span<const Shape> shapes = run.scene().shapes();
  for (std::uint32_t c = 0, begin = 0; c < run.scene().characters().size(); ++c) {
    const auto& character = run.scene().characters()[c];
    std::uint32_t end = begin;
    while (end < shapes.size() && run.scene().sources()[end].character == c) ++end;
    const auto of_one = shapes.subspan(begin, end - begin);
    for (const std::uint32_t depth : volume_depths)
      add_depth(run, cli::file_name(character), of_one, depth, table, poses);
    add_outline(run, cli::file_name(character), of_one, table);
    for (const std::uint32_t slabs : compared_slabs)
      add_volume_of_slabs(run, cli::file_name(character), of_one, begin, slabs, table);
    begin = end;
    run.done(static_cast<double>(c + 1) / static_cast<double>(run.scene().characters().size()));
  }
  run.write("volume", table);
  run.write("volume_poses", poses);
}

}  // namespace

const Experiment volume_experiment{"volume", "Represented volume", 30, false, run_volume};

}  // namespace bch::report
