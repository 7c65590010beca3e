// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <utility>

#include <bch/outline_builder.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shape_set_builder.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/statistics.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/tree_size.hpp"
#include "bench/report/words.hpp"
#include "bench/workload/build_stages.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"

// Construction time: figure 3, left, of the paper.

namespace bch::report {
namespace {

constexpr int repeats = 3;

/// Microseconds that something takes with each pose: the median of a few times, so that one interruption does not count.
template <class Build>
std::vector<double> time_each(std::size_t poses, Build build) {
  std::vector<double> microseconds;
  for (std::size_t pose = 0; pose < poses; ++pose) {
    std::vector<double> taken;
    for (int i = 0; i < repeats; ++i) {
      const bench::Stopwatch watch(1);
      build(pose);
      taken.push_back(watch.nanoseconds() / 1000);
    }
    microseconds.push_back(quartiles(taken).median);
  }
  return microseconds;
}

void add(Table& table, std::string_view structure, std::string_view from,
         const std::vector<double>& microseconds) {
  const Quartiles spread = quartiles(microseconds);
  table.add({structure, from, spread.median, spread.low, spread.high, microseconds.size()});
}

/// Adds a row with the size of the structure's trees.
void add(Table& table, std::string_view structure, std::string_view from,
         const std::vector<double>& microseconds, const TreeSize& size) {
  const Quartiles spread = quartiles(microseconds);
  table.add({structure, from, spread.median, spread.low, spread.high, microseconds.size(), size.nodes,
             size.height});
}

/// The disc around a pose's vertices: what a single cylinder takes without an outline.
std::vector<double> time_single(const std::vector<baselines::Body>& bodies) {
  std::vector<Vec2> points;
  float sum = 0;
  return time_each(bodies.size(), [&](std::size_t i) {
    points.clear();
    for (const Vec3& p : bodies[i].positions) points.push_back({p.x, p.y});
    sum += detail::smallest_enclosing_disc(points).centre.x;
    __asm__ volatile("" : : "g"(&sum) : "memory");  // the disc is needed
  });
}

std::vector<double> time_hierarchies(const std::vector<baselines::Body>& bodies, SplitRule rule) {
  detail::HierarchyBuilder builder;
  Hierarchy hierarchy;
  return time_each(bodies.size(),
                   [&](std::size_t i) { builder.contour(bodies[i].shape.outline, 0.01f, rule, hierarchy); });
}

/// A hierarchy over an outline is timed by its builder, which makes nothing besides.
std::vector<double> time_structure(const Contestant& contestant, const std::vector<baselines::Body>& bodies) {
  if (contestant.kind == "single") return time_single(bodies);
  if (contestant.kind == "reference")
    return time_hierarchies(bodies, contestant.centre ? SplitRule::centre : SplitRule::centroid);
  const baselines::Kind& kind = baselines::kind(contestant.kind);
  const baselines::BuildOptions options{.fixed_radius = contestant.fixed_radius};
  return time_each(bodies.size(),
                   [&](std::size_t i) { kind.build(std::span(bodies).subspan(i, 1), options); });
}

std::string_view made_from(const Contestant& contestant) {
  if (contestant.kind == "single") return "vertices";
  if (contestant.kind == "fixed") return "nothing";
  const bool outlined =
      contestant.kind == "reference" || baselines::kind(contestant.kind).exact == baselines::Truth::outline;
  return outlined ? "outline" : "triangles";
}

void add_structures(Run& run, Table& table) {
  const auto& bodies = run.scene().bodies();
  for (const Contestant& contestant : contestants())
    if (contestant.kind != "paper_descent")  // the same tree as the reference's
      add(table, contestant.name, made_from(contestant), time_structure(contestant, bodies),
          tree_size(contestant, bodies));
}

/// Makes flat shapes of a character's posed vertices, whole or in slabs: all that a set stores of a pose.
class FlatShapes {
 public:
  FlatShapes(const Character& character, std::uint32_t slabs)
      : plan_{.slices = standing_slices(slabs)},
        outline_builder_(character.triangles, character.vertices.size(), character.vertices),
        outlines_(slabs),
        prepared_(plan_) {
    if (slabs > 1) shape_.slabs.resize(slabs);
  }

  void build(std::span<const Vec3> positions) {
    shape_.heights = outline_builder_.build(positions, plan_.slices, outlines_);
    const std::span<Shape> parts = shape_.slabs.empty() ? std::span(&shape_, 1) : std::span(shape_.slabs);
    for (std::size_t i = 0; i < parts.size(); ++i) make_part(outlines_[i], parts[i]);
    prepared_.prepare(shape_, 0);
  }

 private:
  void make_part(Outline& outline, Shape& part) {
    std::swap(outline, part.outline);
    if (part.outline.contours() == 0) return part.hierarchy.nodes.clear();
    hierarchy_builder_.contour(part.outline, 0.01f, SplitRule::centroid, part.hierarchy);
    hierarchy_builder_.add_primitives(part.hierarchy);
  }

  ShapeSetPlan plan_;
  OutlineBuilder outline_builder_;
  detail::HierarchyBuilder hierarchy_builder_;
  std::vector<Outline> outlines_;
  Shape shape_;
  PreparedShape prepared_;
};

/// Adds a whole body and bodies in slabs, each all the way from vertices to a flat shape.
void add_flat_shapes(Run& run, Table& table) {
  const auto& bodies = run.scene().bodies();
  const auto add_row = [&](std::string_view name, std::uint32_t slabs, std::span<const Shape> shapes) {
    std::vector<FlatShapes> characters;
    for (const auto& loaded : run.scene().characters()) characters.emplace_back(loaded.character, slabs);
    const auto build = [&](std::size_t i) {
      characters[run.scene().sources()[i].character].build(bodies[i].positions);
    };
    add(table, name, "vertices", time_each(bodies.size(), build), tree_size(shapes));
  };
  add_row("BCH whole body", 1, run.scene().shapes());
  for (const std::uint32_t slabs : compared_slabs)
    add_row(slabs_name(slabs, Leaves::segments), slabs, run.scene().shapes_in_slabs(slabs));
}

/// Adds the stages of construction, over all characters.
void add_stages(Run& run, Table& table) {
  std::vector<bench::BuildStages> characters;
  for (const auto& loaded : run.scene().characters())
    characters.emplace_back(loaded.character, run.sizes().poses, bch::detail::best_build_implementation());
  for (const bench::BuildStage& stage : bench::build_stages) {
    if (stage.build == &bench::BuildStages::hierarchy_welzl) continue;  // a peer, not a stage of ours
    std::vector<double> all;
    for (bench::BuildStages& build : characters) {
      const auto times = time_each(build.poses(), [&](std::size_t i) { (build.*stage.build)(i); });
      all.insert(all.end(), times.begin(), times.end());
    }
    add(table, stage.name, "the stage before", all);
  }
}

void run_construction(Run& run) {
  Table table({"structure", "made from", "median (us)", "lower quartile (us)", "upper quartile (us)", "poses",
               "nodes a shape", "height"});
  add_structures(run, table);
  add_flat_shapes(run, table);
  run.write("construction", table);
  run.done(0.8);
  Table stages({"stage", "made from", "median (us)", "lower quartile (us)", "upper quartile (us)", "poses"});
  add_stages(run, stages);
  run.write("construction_stages", stages);
}

/// From posed vertices on.
double hierarchy_us(const Results& results) {
  return stage_us(results, "outline") + stage_us(results, "hierarchy");
}

}  // namespace

double build_us(const Results& results, std::string_view structure) {
  return results("construction").number({{"structure", structure}}, "median (us)");
}

double stage_us(const Results& results, std::string_view stage) {
  return results("construction_stages").number({{"stage", stage}}, "median (us)");
}

const Experiment construction_experiment{
    "construction",
    "Construction time",
    20,
    false,
    run_construction,
    {{"outline and hierarchy",
      [](const Results& results, std::string_view) { return brief(hierarchy_us(results)); }},
     {"full mesh over hierarchy",
      [](const Results& results, std::string_view) {
        return brief(build_us(results, "OBB full mesh") / hierarchy_us(results));
      }},
     {"boxes with their outline",
      [](const Results& results, std::string_view) {
        return brief(build_us(results, "OBB outline") + stage_us(results, "outline"));
      }},
     {"poses in a frame",
      [](const Results& results, std::string_view) { return brief(1e6 / 60 / stage_us(results, "all")); }}}};

}  // namespace bch::report
