// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"
#include "layout/base/random.hpp"
#include "layout/hierarchy/builder.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t few_shapes = 200;
constexpr std::uint32_t agents = 10'000;  ///< of the crowd workload

struct CountRow {
  std::uint32_t shapes;
  double most_times;  ///< a pair's time over that of few_shapes shapes
};
constexpr CountRow count_rows[] = {{5'000, 1.8}, {50'000, 3}};

/// Copies of the scene's outlines, each stretched a little along x and y, on the grid: as different in memory as
/// further poses would be.
std::vector<Shape> stretched(std::span<const Shape> shapes, std::uint32_t count) {
  detail::Random random(17);
  detail::HierarchyBuilder builder;
  std::vector<Shape> copies(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Outline& outline = copies[i].outline;
    outline = shapes[i % shapes.size()].outline;
    const double step = outline.grid_step, x = 0.9 + random.uniform(0.1), y = 0.9 + random.uniform(0.1);
    for (Vec2& p : outline.points)
      p = {static_cast<float>(std::round(x * static_cast<double>(p.x) / step) * step),
           static_cast<float>(std::round(y * static_cast<double>(p.y) / step) * step)};
    builder.contour(outline, leaf_threshold, SplitRule::centroid, copies[i].hierarchy);
  }
  return copies;
}

/// The crowd workload of many shapes, every pair of it compared with the reference.
Contender among_shapes(Scene& scene, std::uint32_t count) {
  const std::vector<Shape> shapes = stretched(scene.shapes(), count);
  const auto set = std::make_shared<const ShapeSet>(shapes);
  const auto crowd = std::make_shared<const Workload>(crowd_pairs(*set, agents));
  const auto hits = std::make_shared<Hits>(crowd->pairs.size());
  const auto call = [set, crowd, hits] { collide(*set, crowd->agents(), crowd->pairs, *hits, disc_query); };
  call();
  require_right(
      fmt::format("{} shapes", count), *crowd,
      wrong_answers({shapes, {}, Leaves::discs}, crowd->agents(), crowd->pairs, *hits, Semantics::boundary));
  return {call, hits->size(), {{"bytes_per_shape", static_cast<double>(set->bytes()) / set->shape_count()}}};
}

std::string shapes_name(std::uint32_t shapes) {
  return fmt::format("shapes/{}", shapes);
}

void print_shape_counts(const Results& results) {
  const double of_few = results.at(shapes_name(few_shapes)).nanoseconds;
  for (const CountRow& row : count_rows) {
    const auto found = results.find(shapes_name(row.shapes));
    if (found == results.end()) continue;
    const auto& [of_many, pairs, counters] = found->second;
    fmt::print(
        "a pair among {} shapes over {}: crowd, {} pairs, {:.0f} bytes a shape: {:.1f} ns over {:.1f}: "
        "{:.2f} x   {}\n",
        cli::grouped(row.shapes), few_shapes, cli::grouped(pairs), counters.at("bytes_per_shape"), of_many,
        of_few, of_many / of_few, verdict_at_most(of_many / of_few, row.most_times));
  }
}

}  // namespace

std::vector<Table> shape_count_tables(Suite& suite, Scene& scene, std::uint32_t most) {
  for (const std::uint32_t shapes : {few_shapes, count_rows[0].shapes, count_rows[1].shapes})
    if (shapes <= most)
      suite.add(shapes_name(shapes), [&scene, shapes] { return among_shapes(scene, shapes); });
  return {{"shapes", "^shapes/", print_shape_counts}};
}

}  // namespace bch::bench
