// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/default_characters.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/tree_size.hpp"
#include "bench/workload/build_stages.hpp"
#include "bench/workload/mesh_detail.hpp"

// Does an OBB tree over the full mesh get slower with the mesh? The paper suspects so.

namespace bch::report {
namespace {

constexpr std::size_t few_triangles = 716;  // a quarter of the man's

struct Measured {
  double build_tree = 0, build_hierarchy = 0;  // microseconds a pose
  Quartiles tree[2]{}, kernel[2]{}, plain[2]{};
  MeanTests tree_tests[2]{}, plain_tests[2]{};
  TreeSize tree_size{}, plain_size{};
};

/// Poses, their bodies, and pairs of them; the meshes decide which collide.
class Detailed {
 public:
  Detailed(const Character& character, std::uint32_t poses) {
    detail::Skinner skinner(character);
    PoseShaper shaper(character);
    for (const PoseTime& at : sample_poses(character, poses)) {
      const auto positions = skinner.pose(at);
      const bench::Stopwatch watch(1);
      const Shape& shape = shaper.shape(at);
      hierarchy_.push_back(watch.nanoseconds() / 1000);
      bodies_.push_back({{positions.begin(), positions.end()}, character.triangles, shape});
    }
    const bench::Stopwatch watch(1);
    tree_ = baselines::kind("obb_full").build(bodies_, {});
    tree_microseconds_ = watch.nanoseconds() / 1000 / static_cast<double>(bodies_.size());
    plain_ = baselines::kind("reference").build(bodies_, {});
    for (const baselines::Body& body : bodies_) shapes_.push_back(body.shape);
  }

  Measured measure(std::uint32_t pairs, std::uint32_t runs) const {
    Measured measured{tree_microseconds_, quartiles(hierarchy_).median};
    measured.tree_size = tree_size({.name = "OBB full mesh", .kind = "obb_full"}, bodies_);
    measured.plain_size = tree_size(shapes_);
    const ShapeSet set(shapes_);
    const auto roots = baselines::kind("single").build(bodies_, {});
    for (const bool colliding : {true, false}) {
      const bench::Workload workload =
          bench::random_pairs(colliding ? "colliding" : "near_miss", colliding ? 31 : 32, shapes_, pairs,
                              [&](const Agents& agents, Pair pair) {
                                return roots->query(agents, pair) && tree_->query(agents, pair) == colliding;
                              });
      const Subject subjects[] = {subject_of(*tree_), subject_of(set), subject_of(*plain_)};
      require_same(subjects[1], subjects[2], workload);
      const std::vector<Quartiles> taken = times(subjects, workload, runs);
      const int i = colliding ? 0 : 1;
      measured.tree[i] = taken[0], measured.kernel[i] = taken[1], measured.plain[i] = taken[2];
      measured.tree_tests[i] = subjects[0].tests(workload),
      measured.plain_tests[i] = subjects[2].tests(workload);
    }
    return measured;
  }

 private:
  std::vector<baselines::Body> bodies_;
  std::vector<Shape> shapes_;
  std::unique_ptr<baselines::Structure> tree_, plain_;
  std::vector<double> hierarchy_;
  double tree_microseconds_ = 0;
};

void run_mesh_detail(Run& run) {
  Table table({"triangles", "structure", "build (us)", "colliding (ns/pair)", "colliding (25 %)",
               "colliding (75 %)", "near miss (ns/pair)", "near miss (25 %)", "near miss (75 %)",
               "nodes a shape", "height", "colliding, node tests", "near miss, node tests"});
  const Character man = default_male();
  const Character characters[] = {bench::coarser(man, few_triangles), man, bench::with_relief(man, 1),
                                  bench::with_relief(man, 2)};
  double done = 0;
  for (const Character& character : characters) {
    const Detailed detailed(character, std::min(run.sizes().poses, most_costly_poses));
    const Measured measured = detailed.measure(run.sizes().pairs / 4, run.sizes().runs);
    constexpr MeanTests not_counted[2];
    const auto add = [&](std::string_view name, double build, const Quartiles(&taken)[2],
                         const TreeSize& size, const MeanTests(&tests)[2]) {
      table.add({character.triangles.size(), name, build, taken[0].median, taken[0].low, taken[0].high,
                 taken[1].median, taken[1].low, taken[1].high, size.nodes, size.height, tests[0].nodes,
                 tests[1].nodes});
    };
    add("OBB full mesh", measured.build_tree, measured.tree, measured.tree_size, measured.tree_tests);
    add(kernel_name, measured.build_hierarchy, measured.kernel, measured.plain_size, not_counted);
    add("BCH outline", measured.build_hierarchy, measured.plain, measured.plain_size, measured.plain_tests);
    run.done(++done / static_cast<double>(std::size(characters)));
  }
  run.write("mesh_detail", table);
}

}  // namespace

const Experiment mesh_detail_experiment{"mesh_detail", "Mesh detail", 60, false, run_mesh_detail};

}  // namespace bch::report
