// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/subjects.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

#include "baselines/obb_tree.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/workload/scene.hpp"

namespace bch::report {
namespace {

constexpr std::size_t counted_pairs = 2'000;
constexpr double shortest_run = 1e7;  ///< nanoseconds

constexpr Contender all_contenders[] = {
    {"single cylinder", "single"},
    {"fixed cylinder 0.25 m", "fixed"},
    {"fixed cylinder 0.40 m", "fixed", false, 0.4f},
    {"BCH outline", "reference", true},
    {"BCH outline unverified", "paper_descent", true},
    {"BCH outline by centre", "reference", true, 0, true},
    {"BCH projected", "bch_projected", true},
    {"OBB outline", "obb_contour", true},
    {"OBB projected", "obb_projected", true},
    {"OBB full mesh", "obb_full", true},
    {"OBB outline in 2D", "obb_contour_2d", true},
    {"FCL OBB outline", "fcl_obb_contour"},
    {"FCL OBBRSS outline", "fcl_obbrss_contour"},
    {"FCL OBB full mesh", "fcl_obb_full"},
    {"FCL OBBRSS full mesh", "fcl_obbrss_full"},
};

MeanTests mean_tests(const baselines::Structure& structure, const bench::Workload& workload,
                     std::uint32_t max_depth) {
  baselines::TestCounts counts;
  const std::size_t pairs = std::min(counted_pairs, workload.pairs.size());
  for (std::size_t i = 0; i < pairs; ++i)
    structure.query(workload.agents(), workload.pairs[i], max_depth, counts);
  const auto each = [&](std::uint64_t tests) {
    return static_cast<double>(tests) / static_cast<double>(pairs);
  };
  return {each(counts.nodes), each(counts.leaves)};
}

/// Returns how long a call takes on one thread, nanoseconds: the thread's own time.
double time_run(const std::function<void()>& call) {
  tbb::task_arena arena(1);
  const bench::Stopwatch watch(1);
  std::uint32_t calls = 0;
  do {
    arena.execute(call);
    ++calls;
  } while (watch.nanoseconds() < shortest_run);
  return watch.nanoseconds() / calls;
}

template <class Items, class Size>
TreeSize mean_size(const Items& items, Size size) {
  TreeSize mean{0, 0};
  for (const auto& item : items) {
    const TreeSize one = size(item);
    mean.nodes += one.nodes / static_cast<double>(items.size());
    mean.height += one.height / static_cast<double>(items.size());
  }
  return mean;
}

TreeSize size_of(const Hierarchy& hierarchy) {
  return {static_cast<double>(hierarchy.nodes.size()), static_cast<double>(detail::height(hierarchy))};
}

TreeSize size_of_projected(const baselines::Body& body) {
  std::vector<Vec2> vertices;
  for (const Vec3& p : body.positions) vertices.push_back({p.x, p.y});
  return size_of(detail::projected_hierarchy(vertices, body.triangles));
}

TreeSize size_of_boxes(std::string_view kind, const baselines::Body& body) {
  const baselines::ObbTree tree = baselines::build_obb_tree(
      kind.starts_with("obb_contour") ? baselines::contour_facets(body.shape.outline)
      : kind == "obb_projected"       ? baselines::projected_facets(body.positions, body.triangles)
                                      : baselines::triangle_facets(body.positions, body.triangles));
  return {static_cast<double>(tree.nodes.size()), static_cast<double>(tree.height)};
}

}  // namespace

std::string cut_name(std::uint32_t depth) {
  return depth == 0 ? "single cylinder" : "BCH outline to depth " + cli::depth_name(depth);
}

TreeSize tree_size(std::span<const Shape> shapes) {
  return mean_size(shapes, [](const Shape& shape) { return size_of(shape.hierarchy); });
}

TreeSize tree_size(const Contender& contender, std::span<const baselines::Body> bodies) {
  const std::string_view kind = contender.kind;
  if (contender.is_disc()) return {1, 0};
  if (kind == "bch_projected") return mean_size(bodies, size_of_projected);
  if (kind.starts_with("obb_"))
    return mean_size(bodies, [&](const baselines::Body& body) { return size_of_boxes(kind, body); });
  if (kind != "reference") return {};
  return tree_size(shapes_of(contender.centre ? with_hierarchies(bodies, 0.01f, detail::SplitRule::centre)
                                              : std::vector<baselines::Body>(bodies.begin(), bodies.end())));
}

Subject subject_of(std::string_view name, const baselines::Structure& structure, std::uint32_t max_depth) {
  return {std::string(name), max_depth,
          [&structure, max_depth](const Agents& agents, std::span<const Pair> pairs,
                                  std::span<std::uint8_t> hits) {
            structure.query(agents, pairs, hits, max_depth);
          },
          [&structure, max_depth](const bench::Workload& workload) {
            return mean_tests(structure, workload, max_depth);
          }};
}

Subject subject_of(std::string_view name, const ShapeSet& set, const detail::AllOptions& query,
                   std::uint32_t depth) {
  return {std::string(name),
          depth,
          [&set, query](const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits) {
            collide(set, agents, pairs, hits, query);
          },
          [](const bench::Workload&) { return MeanTests{}; },
          "solid",
          query.leaves == Leaves::segments ? "double" : "single"};
}

Subject subject_of(std::string_view name, const BodySet& set) {
  return {std::string(name), all_depths,
          [&set](const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits) {
            collide(set, agents, pairs, hits);
          },
          [](const bench::Workload&) { return MeanTests{}; }, "solid"};
}

bench::Hits answers(const Subject& subject, const bench::Workload& workload) {
  bench::Hits hits(workload.pairs.size());
  subject.answer(workload.agents(), workload.pairs, hits);
  return hits;
}

void SubjectTables::add(std::span<const Subject> subjects, const std::string& of) {
  subjects_ = subjects, first_ = count_;
  for (const Subject& s : subjects)
    subjects_table_.add({count_++, of, s.structure, cli::depth_name(s.depth), s.semantics, s.arithmetic,
                         s.size.nodes, s.size.height, s.bytes});
}

void SubjectTables::count_pairs(const bench::Workload& workload) {
  has_pairs_ = true;
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    const bench::Hits hits = answers(subjects_[i], workload);
    const MeanTests tests = subjects_[i].tests(workload);
    pairs_.add(
        {first_ + i, workload.name, hits.size(), std::ranges::count(hits, 1), tests.nodes, tests.leaves});
  }
}

void SubjectTables::time_pairs(const bench::Workload& workload) {
  count_pairs(workload);
  bench::Hits hits(workload.pairs.size());  // counting has warmed caches
  for (std::uint32_t run = 0; run < run_.sizes().runs; ++run)
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      const double taken = time_run([&] { subjects_[i].answer(workload.agents(), workload.pairs, hits); });
      times_.add({first_ + i, workload.name, run, taken / static_cast<double>(hits.size())});
    }
}

std::vector<std::vector<double>> SubjectTables::slide(const SlideCases& cases,
                                                      const baselines::PairDistances& distances) {
  has_slides_ = true;
  std::vector<std::vector<double>> all;
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    const std::vector<double>& places = all.emplace_back(cases.contacts(subjects_[i].answer));
    const std::vector<double> apart = cases.distances(distances, places);
    for (std::size_t k = 0; k < places.size(); ++k) slides_.add({first_ + i, k, places[k], apart[k]});
  }
  return all;
}

void SubjectTables::write(const std::string& name) const {
  run_.write(name, subjects_table_);
  if (has_pairs_) run_.write(name + "_pairs", pairs_), run_.write(name + "_times", times_);
  if (has_slides_) run_.write(name + "_slides", slides_);
}

std::vector<Contender> contenders() {
  std::vector<Contender> here;
  std::ranges::copy_if(all_contenders, std::back_inserter(here),
                       [](const Contender& one) { return bench::has_kind(one.kind); });
  return here;
}

const baselines::Structure& Structures::of(const Contender& contender) {
  const auto found = made_.find(contender.name);
  if (found != made_.end()) return *found->second;
  if (contender.centre && centre_bodies_.empty())
    centre_bodies_ = with_hierarchies(scene_.bodies(), 0.01f, detail::SplitRule::centre);
  const std::span<const baselines::Body> bodies = contender.centre ? centre_bodies_ : scene_.bodies();
  auto made = baselines::kind(contender.kind).build(bodies, {.fixed_radius = contender.fixed_radius});
  return *made_.emplace(contender.name, std::move(made)).first->second;
}

const baselines::Structure& Structures::of(std::string_view name) {
  const auto* const found = std::ranges::find(all_contenders, name, &Contender::name);
  if (found == std::end(all_contenders))
    throw std::invalid_argument("no contender '" + std::string(name) + "'");
  return of(*found);
}

void Structures::require_right(const Contender& contender, const bench::Workload& workload,
                               std::uint32_t max_depth) {
  const bench::Hits hits = answers(subject_of(contender.name, of(contender), max_depth), workload);
  std::string wrong;
  if (contender.centre) {
    const ShapeSet set(shapes_of(centre_bodies_), {{max_depth}});
    if (hits != answers(subject_of(kernel_name, set), workload))
      wrong = "a kernel over the same discs says otherwise";
  } else {
    wrong = bench::wrong_structure(scene_, workload, baselines::kind(contender.kind), hits, max_depth);
  }
  bench::require_right(contender.name, workload, wrong);
}

std::vector<baselines::Body> with_hierarchies(std::span<const baselines::Body> bodies, float threshold,
                                              detail::SplitRule rule) {
  std::vector<baselines::Body> others(bodies.begin(), bodies.end());
  for (baselines::Body& body : others)
    body.shape.hierarchy = contour_hierarchy(body.shape.outline, threshold, rule);
  return others;
}

std::vector<Shape> shapes_of(std::span<const baselines::Body> bodies) {
  std::vector<Shape> shapes;
  for (const baselines::Body& body : bodies) shapes.push_back(body.shape);
  return shapes;
}

std::vector<Shape> with_fixed_cylinders(std::span<const Shape> shapes, float radius) {
  std::vector<Shape> fixed(shapes.begin(), shapes.end());
  for (Shape& shape : fixed) shape.hierarchy = detail::fixed_cylinder(radius);
  return fixed;
}

}  // namespace bch::report
