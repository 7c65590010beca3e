// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/build_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "baselines/welzl.hpp"

namespace bch::bench {
namespace {

constexpr float threshold = 0.01f;  ///< metres
constexpr std::uint32_t depths[] = {0, 3, 6, all_depths};

/// Keeps what was computed.
template <class Value>
void use(const Value& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

void solve_by_welzl(const detail::DiscSets& sets) noexcept {
  static thread_local Welzl welzl;
  for (std::size_t i = 0; i < sets.count; ++i) {
    const std::span points(sets.points + sets.sets[i].begin, sets.points + sets.sets[i].end);
    const Welzl::Circle circle = welzl(points);
    const Vec2 centre{static_cast<float>(circle.x), static_cast<float>(circle.y)};
    double square = 0;
    for (const Vec2 p : points) {
      const double x = static_cast<double>(p.x) - static_cast<double>(centre.x),
                   y = static_cast<double>(p.y) - static_cast<double>(centre.y);
      square = std::max(square, x * x + y * y);
    }
    sets.discs[i] = {centre, square};
  }
}

const detail::BuildImplementation& by_welzl() {
  static const detail::BuildLoops loops = [] {
    detail::BuildLoops best = detail::best_build_implementation().loops;
    best.solve_discs = solve_by_welzl;
    return best;
  }();
  static const detail::BuildImplementation row{{"welzl", detail::everywhere}, loops};
  return row;
}

void require(bool right, std::string_view stage, std::size_t pose) {
  if (!right)
    throw std::runtime_error(
        fmt::format("construction: stage {} makes something else of pose {}", stage, pose));
}

bool same(const Outline& a, const Outline& b) {
  return a.points == b.points && a.contour_begin == b.contour_begin;
}

bool same(const Disc& a, const Disc& b, float tolerance) {
  return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance &&
         std::abs(a.radius - b.radius) <= tolerance;
}

bool same(const Hierarchy& a, const Hierarchy& b, float tolerance) {
  return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [=](const HierarchyNode& x, const HierarchyNode& y) {
                      return x.second_child == y.second_child && same(x.disc, y.disc, tolerance);
                    });
}

bool same(const detail::Interior& a, const detail::Interior& b) {
  return a.x == b.x && a.y == b.y && a.radius == b.radius && a.extreme_x == b.extreme_x &&
         a.extreme_y == b.extreme_y;
}

/// Returns whether a tree's discs are those of the cut, padding aside.
bool holds_cut(const detail::Bvh8& tree, const Hierarchy& hierarchy, std::uint32_t depth) {
  const std::vector<std::uint32_t> nodes = cut(hierarchy, depth);
  if (nodes.size() > tree.x.size()) return false;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!same({tree.x[i], tree.y[i], tree.radius[i]}, hierarchy.nodes[nodes[i]].disc, 0)) return false;
  return true;
}

/// Returns another instruction set's, where the processor has two.
const detail::BuildImplementation& other_than(const detail::BuildImplementation& implementation) {
  const detail::BuildImplementation& last = detail::build_implementations().back();
  return &last == &implementation ? detail::best_build_implementation() : last;
}

}  // namespace

BuildStages::BuildStages(const Character& character, std::uint32_t poses,
                         const detail::BuildImplementation& implementation)
    : BuildStages(Unchecked{}, character, poses, implementation) {
  const BuildStages other(Unchecked{}, character, poses, other_than(implementation));
  for (std::size_t pose = 0; pose < times_.size(); ++pose) check(pose, other);
}

BuildStages::BuildStages(Unchecked, const Character& character, std::uint32_t poses,
                         const detail::BuildImplementation& implementation)
    : times_(sample_poses(character, poses)),
      skinner_(character),
      outline_builder_(character.triangles, character.vertices.size(), character.vertices, implementation),
      hierarchy_builder_(implementation),
      welzl_builder_(by_welzl()),
      interior_builder_(implementation) {
  for (std::size_t pose = 0; pose < times_.size(); ++pose) {
    const auto positions = skinner_.ground_pose(times_[pose]);
    positions_.emplace_back(positions.begin(), positions.end());
    outline(pose);
    outlines_.push_back(outline_);
    hierarchy(pose);
    hierarchies_.push_back(hierarchy_);
    interior(pose);
    interiors_.push_back(interior_);
  }
}

void BuildStages::check(std::size_t pose, const BuildStages& other) {
  const auto is_as_alone = [&] {
    return same(outline_, outlines_[pose]) && same(hierarchy_, hierarchies_[pose], 0) &&
           holds_cut(tree_, hierarchies_[pose], depths[std::size(depths) - 1]);
  };
  require(same(other.outlines_[pose], outlines_[pose]), "outline", pose);
  require(same(other.hierarchies_[pose], hierarchies_[pose], 0), "hierarchy", pose);
  require(same(other.interiors_[pose], interiors_[pose]), "interior", pose);
  hierarchy_welzl(pose);
  require(same(hierarchy_, hierarchies_[pose], 1e-6f), "hierarchy_welzl", pose);
  levels(pose);
  require(holds_cut(tree_, hierarchies_[pose], depths[std::size(depths) - 1]), "levels", pose);
  this->pose(pose);
  require(is_as_alone(), "pose", pose);
  all(pose);
  require(is_as_alone() && same(interior_, interiors_[pose]), "all", pose);
}

void BuildStages::skin(std::size_t pose) {
  use(skinner_.ground_pose(times_[pose]));
}

void BuildStages::outline(std::size_t pose) {
  outline_builder_.build(positions_[pose], outline_);
}

void BuildStages::hierarchy(std::size_t pose) {
  hierarchy_builder_.contour(outlines_[pose], threshold, SplitRule::centroid, hierarchy_);
}

void BuildStages::hierarchy_welzl(std::size_t pose) {
  welzl_builder_.contour(outlines_[pose], threshold, SplitRule::centroid, hierarchy_);
}

void BuildStages::levels(std::size_t pose) {
  flatten(hierarchies_[pose], true);
}

void BuildStages::interior(std::size_t pose) {
  look_inside(outlines_[pose], hierarchies_[pose].reach);
}

void BuildStages::pose(std::size_t pose) {
  make_hierarchy(pose);
  flatten(hierarchy_, false);
}

void BuildStages::all(std::size_t pose) {
  make_hierarchy(pose);
  look_inside(outline_, hierarchy_.reach);
  flatten(hierarchy_, true);
}

void BuildStages::make_hierarchy(std::size_t pose) {
  outline_builder_.build(skinner_.ground_pose(times_[pose]), outline_);
  hierarchy_builder_.contour(outline_, threshold, SplitRule::centroid, hierarchy_);
}

void BuildStages::look_inside(const Outline& outline, double reach) {
  interior_ = interior_builder_.build(outline, reach);
  profile_ = profile(outline, interior_, reach);
  use(profile_);
}

void BuildStages::flatten(const Hierarchy& hierarchy, bool culling) {
  flattener_.begin(hierarchy);
  for (const std::uint32_t depth : depths) {
    flattener_.flatten(depth, tree_);
    use(tree_);
    if (!culling || tree_.is_single()) continue;
    outer_ = flattener_.outer(profile_);
    use(outer_);
  }
  if (!culling) return;
  supports_ = flattener_.supports();
  use(supports_);
}

}  // namespace bch::bench
