// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stiff_world.hpp"

#include <algorithm>
#include <cmath>

#include <bch/characters.hpp>
#include <bch/poses.hpp>

#include "layout/base/heading.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch::bench {
namespace {

constexpr float wall_length = 10, wall_thickness = 0.4f;

Shape wall() {
  const float x = wall_length / 2, y = wall_thickness / 2;
  Outline outline;
  outline.points = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  outline.contour_begin.push_back(4);
  return {outline, contour_hierarchy(outline, 0.02f)};
}

ShapeSet make_shapes() {
  std::vector<Shape> shapes;
  for (const Character& character : {default_male(), default_female()}) {
    PoseShaper shaper(character);
    for (const PoseTime& time : sample_poses(character, people_shapes / 2))
      shapes.push_back(shaper.shape(time));
  }
  shapes.push_back(wall());
  return ShapeSet(shapes, {.depths = {std::begin(stiff_depths), std::end(stiff_depths)}});
}

/// Returns the centre of the single disc of an agent's shape, in the world.
Ground root_centre(const Agents& agents, std::uint32_t agent) {
  const detail::CutDiscs root =
      detail::cut_discs(stiff_shapes().view(), agents.shape[agent] * stiff_shapes().level_count());
  const double x = static_cast<double>(root.x[0]), y = static_cast<double>(root.y[0]);
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  return {agents.x[agent] + (turn.cosine * x - turn.sine * y),
          agents.y[agent] + (turn.sine * x + turn.cosine * y)};
}

/// A person's single disc has its centre where it stands in every direction; a wall has it on its axis, as near as can be.
Ground core(const Agents& agents, std::uint32_t agent, Ground near) {
  if (agents.shape[agent] < people_shapes) return root_centre(agents, agent);
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  const double most = static_cast<double>(wall_length - wall_thickness) / 2;
  const double along = std::clamp(
      (near.x - agents.x[agent]) * turn.cosine + (near.y - agents.y[agent]) * turn.sine, -most, most);
  return {agents.x[agent] + along * turn.cosine, agents.y[agent] + along * turn.sine};
}

/// From the second to the first: the way that the first has to go.
Vec2 line_of_centres(const Agents& agents, Pair pair) {
  const Ground a = core(agents, pair.first, {}), b = core(agents, pair.second, a);
  const double x = a.x - b.x, y = a.y - b.y;
  if (x == 0 && y == 0) return {1, 0};
  return {static_cast<float>(x), static_cast<float>(y)};
}

}  // namespace

const ShapeSet& stiff_shapes() {
  static const ShapeSet shapes = make_shapes();
  return shapes;
}

std::span<const Pair> Depths::pairs(const Agents& agents) {
  if (measure_ != DepthMeasure::penetration) {
    // Discs of cuts may overlap where root discs do not. Any margin makes the candidates know that.
    constexpr double margin = 1e-3;
    return finder_.candidates(stiff_shapes(), agents, {.margin = margin}).span();
  }
  return finder_.collisions(stiff_shapes(), agents).span();
}

std::span<const Penetration> Depths::of(const Agents& agents, std::span<const Pair> pairs) {
  constexpr std::uint32_t directions = 32;
  found_.resize(pairs.size());
  switch (measure_) {
    case DepthMeasure::penetration:
      penetration(stiff_shapes(), agents, pairs, directions, found_);
      break;
    case DepthMeasure::discs:
      measure_discs(agents, pairs);
      break;
    case DepthMeasure::centres:
      lines_.clear();
      for (const Pair pair : pairs) lines_.push_back(line_of_centres(agents, pair));
      penetration_along(stiff_shapes(), agents, pairs, lines_, found_);
  }
  return found_;
}

void Depths::measure_discs(const Agents& agents, std::span<const Pair> pairs) {
  distance_.resize(pairs.size()), direction_.resize(pairs.size());
  clearance(stiff_shapes(), agents, pairs, {.distance = distance_, .direction = direction_},
            {.max_distance = 0, .overlap = Overlap::deepest});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [x, y] = direction_[i];  // to the second agent
    found_[i] = {std::max(-distance_[i], 0.0f), -static_cast<double>(x), -static_cast<double>(y)};
  }
}

void StiffWorld::add_person(std::uint32_t shape, std::uint8_t level, Ground at, double heading,
                            Ground velocity) {
  shape_.push_back(shape), level_.push_back(level), heading_.push_back(heading);
  x_.push_back(at.x), y_.push_back(at.y);
  velocity_.push_back(velocity);
}

void StiffWorld::add_wall(Ground at, double heading) {
  shape_.push_back(wall_of_10_m), level_.push_back(finest_level), heading_.push_back(heading);
  x_.push_back(at.x), y_.push_back(at.y);
}

void StiffWorld::press(Pair pair, const Penetration& by) {
  if (pair.first >= people()) return;  // walls do not push each other
  const double depth = static_cast<double>(by.depth), x = by.x, y = by.y;
  deepest_ = std::max(deepest_, depth);
  const bool wall = pair.second >= people();
  const Ground v = velocity_[pair.first], w = wall ? Ground{} : velocity_[pair.second];
  const double sliding = (w.x - v.x) * -y + (w.y - v.y) * x;
  const double along = stiff::stiffness * depth, across = free_ ? 0 : stiff::friction * depth * sliding;
  const Ground force{along * x - across * y, along * y + across * x};
  force_[pair.first].x += force.x, force_[pair.first].y += force.y;
  if (!wall) force_[pair.second].x -= force.x, force_[pair.second].y -= force.y;
}

void StiffWorld::step(double seconds, std::span<const Ground> goal) {
  force_.assign(people(), {});
  deepest_ = 0;
  const auto pairs = depths_.pairs(agents());
  const auto depths = depths_.of(agents(), pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) press(pairs[i], depths[i]);
  for (std::size_t i = 0; i < people(); ++i) {
    Ground& v = velocity_[i];
    Ground pull;
    if (!free_)
      pull = {(stiff::wanted_speed * goal[i].x - v.x) / stiff::relaxation,
              (stiff::wanted_speed * goal[i].y - v.y) / stiff::relaxation};
    v.x += seconds * (force_[i].x / stiff::mass + pull.x);
    v.y += seconds * (force_[i].y / stiff::mass + pull.y);
    x_[i] += seconds * v.x;
    y_[i] += seconds * v.y;
  }
}

double StiffWorld::fastest() const {
  double most = 0;
  for (const Ground v : velocity_) most = std::max(most, v.x * v.x + v.y * v.y);
  return std::sqrt(most);
}

double StiffWorld::mean_square() const {
  double sum = 0;
  for (const Ground v : velocity_) sum += v.x * v.x + v.y * v.y;
  return sum / static_cast<double>(people());
}

}  // namespace bch::bench
