// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "bench/base/random.hpp"
#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/race.hpp"
#include "layout/hierarchy/builder.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t few = 200;
constexpr std::uint32_t agents = 10'000;  ///< of the crowd workload
constexpr float threshold = 0.01f;        ///< metres

struct Row {
  std::uint32_t shapes;
  double most_times;  ///< a pair's time over that of few shapes
};
constexpr Row rows[] = {{5'000, 1.8}, {50'000, 3}};

/// Copies of the scene's outlines, each stretched a little along x and y, on the grid: as different in memory as
/// further poses would be.
std::vector<Shape> stretched(std::span<const Shape> shapes, std::uint32_t count) {
  cli::Random random(17);
  HierarchyBuilder builder;
  std::vector<Shape> copies(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Outline& outline = copies[i].outline;
    outline = shapes[i % shapes.size()].outline;
    const double step = outline.grid_step, x = 0.9 + random.uniform(0.1), y = 0.9 + random.uniform(0.1);
    for (Vec2& p : outline.points)
      p = {static_cast<float>(std::round(x * static_cast<double>(p.x) / step) * step),
           static_cast<float>(std::round(y * static_cast<double>(p.y) / step) * step)};
    builder.contour(outline, threshold, SplitRule::centroid, copies[i].hierarchy);
  }
  return copies;
}

/// The crowd workload of many shapes, every pair of it compared with the reference.
struct ManyShapes {
  ManyShapes(std::span<const Shape> scene, std::uint32_t count) {
    const std::vector<Shape> shapes = stretched(scene, count);
    set = std::make_unique<ShapeSet>(shapes);
    crowd = crowd_pairs(*set, agents);
    hits.resize(crowd.pairs.size());
    answer();
    require_right(
        fmt::format("{} shapes", count), crowd,
        wrong_answers({shapes, {}, Leaves::discs}, crowd.agents(), crowd.pairs, hits, Semantics::boundary));
  }

  void answer() { collide(*set, crowd.agents(), crowd.pairs, hits, disc_query); }
  double bytes_per_shape() const { return static_cast<double>(set->bytes()) / set->shape_count(); }

  std::unique_ptr<ShapeSet> set;
  Workload crowd;
  Hits hits;
};

}  // namespace

void print_shape_count_ratios(Scene& scene, std::uint32_t runs, std::uint32_t most_shapes) {
  ManyShapes base(scene.shapes(), few);
  for (const Row& row : rows) {
    if (row.shapes > most_shapes) continue;
    ManyShapes many(scene.shapes(), row.shapes);
    std::vector<Contender> contenders = {{"few", [&] { base.answer(); }}, {"many", [&] { many.answer(); }}};
    race(contenders, runs, 1);
    const double of_few = contenders[0].nanoseconds / static_cast<double>(base.crowd.pairs.size());
    const double of_many = contenders[1].nanoseconds / static_cast<double>(many.crowd.pairs.size());
    fmt::print(
        "a pair among {} shapes over {}: crowd, {} pairs, {:.0f} bytes a shape: {:.1f} ns over {:.1f}: "
        "{:.2f} x   {}\n",
        cli::grouped(row.shapes), few, cli::grouped(many.crowd.pairs.size()), many.bytes_per_shape(), of_many,
        of_few, of_many / of_few, verdict_at_most(of_many / of_few, row.most_times));
    std::fflush(stdout);
  }
}

}  // namespace bch::bench
