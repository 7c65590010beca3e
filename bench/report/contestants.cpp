// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/contestants.hpp"

#include <stdexcept>

#include "bench/report/subject.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/contender.hpp"

namespace bch::report {
namespace {

constexpr Contestant all[] = {
    {"single cylinder", "single"},
    {"fixed cylinder 0.25 m", "fixed", false, 0.25f, false, false},
    {"fixed cylinder 0.40 m", "fixed", false, 0.4f, false, false},
    {"BCH outline", "reference", false, 0, true},
    {"BCH outline unverified", "paper_descent", false, 0, true},
    {"BCH outline by centre", "reference", true, 0, true},
    {"BCH projected", "bch_projected", false, 0, true},
    {"OBB outline", "obb_contour", false, 0, true},
    {"OBB projected", "obb_projected", false, 0, true},
    {"OBB full mesh", "obb_full", false, 0, true, false},
    {"OBB outline in 2D", "obb_contour_2d", false, 0, true},
    {"FCL OBB outline", "fcl_obb_contour"},
    {"FCL OBBRSS outline", "fcl_obbrss_contour"},
    {"FCL OBB full mesh", "fcl_obb_full", false, 0, false, false},
    {"FCL OBBRSS full mesh", "fcl_obbrss_full", false, 0, false, false},
};

}  // namespace

std::vector<Contestant> contestants() {
  std::vector<Contestant> here;
  for (const Contestant& one : all)
    if (bench::has_kind(one.kind)) here.push_back(one);
  return here;
}

const baselines::Structure& Contestants::structure(const Contestant& contestant) {
  const auto found = made_.find(contestant.name);
  if (found != made_.end()) return *found->second;
  if (contestant.centre && centre_bodies_.empty())
    centre_bodies_ = with_hierarchies(scene_.bodies(), 0.01f, SplitRule::centre);
  const std::span<const baselines::Body> bodies = contestant.centre ? centre_bodies_ : scene_.bodies();
  auto made = baselines::kind(contestant.kind).build(bodies, {.fixed_radius = contestant.fixed_radius});
  return *made_.emplace(contestant.name, std::move(made)).first->second;
}

const baselines::Structure& Contestants::structure(std::string_view name) {
  for (const Contestant& one : all)
    if (one.name == name) return structure(one);
  throw std::invalid_argument("no contestant '" + std::string(name) + "'");
}

void Contestants::require_right(const Contestant& contestant, const bench::Workload& workload,
                                std::uint32_t max_depth) {
  bench::Hits hits(workload.pairs.size());
  structure(contestant).query(workload.agents(), workload.pairs, hits, max_depth);
  std::string wrong;
  if (contestant.centre) {
    std::vector<Shape> shapes;
    for (const baselines::Body& body : centre_bodies_) shapes.push_back(body.shape);
    const ShapeSet set(shapes, {{max_depth}});
    if (hits != answers(subject_of(set), workload)) wrong = "a kernel over the same discs says otherwise";
  } else {
    wrong = bench::wrong_structure(scene_, workload, baselines::kind(contestant.kind), hits, max_depth);
  }
  bench::require_right(std::string(contestant.name), workload, wrong);
}

std::vector<baselines::Body> with_hierarchies(std::span<const baselines::Body> bodies, float threshold,
                                              SplitRule rule) {
  std::vector<baselines::Body> others(bodies.begin(), bodies.end());
  for (baselines::Body& body : others)
    body.shape.hierarchy = contour_hierarchy(body.shape.outline, threshold, rule);
  return others;
}

std::vector<Shape> with_fixed_cylinders(std::span<const Shape> shapes, float radius) {
  std::vector<Shape> fixed(shapes.begin(), shapes.end());
  for (Shape& shape : fixed) shape.hierarchy = fixed_cylinder(radius);
  return fixed;
}

}  // namespace bch::report
