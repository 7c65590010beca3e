// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stiff_contact.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/base/text.hpp"
#include "bench/stability/stiff_world.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

using detail::Random;

using std::numbers::pi;
constexpr DepthMeasure measures[] = {DepthMeasure::penetration, DepthMeasure::discs, DepthMeasure::centres};
constexpr double tried_steps[] = {2e-3,  3e-3,  4e-3,  6e-3,  8e-3,  10e-3, 12e-3, 16e-3,
                                  20e-3, 24e-3, 28e-3, 32e-3, 36e-3, 40e-3, 48e-3};

/// What is tried of a scene: its agents, where they want to go, and when it ends.
struct Scenario {
  StiffWorld world;
  std::vector<Ground> goal;
  double seconds;
  StiffScene scene;

  void aim() {
    for (std::size_t i = 0; i < goal.size() && scene == StiffScene::two; ++i) goal[i] = towards_middle(i);
    if (scene == StiffScene::door) aim_at_door();
  }
  /// So that there is a place of rest.
  Ground towards_middle(std::size_t i) const {
    const Ground at = world.position(i);
    const double length = std::sqrt(at.x * at.x + at.y * at.y);
    return {-at.x / length, -at.y / length};
  }
  /// Aims everybody at the middle of the door, and straight on behind it.
  void aim_at_door() {
    for (std::size_t i = 0; i < goal.size(); ++i) {
      const Ground at = world.position(i);
      const double x = 0.2 - at.x, y = -at.y, length = std::sqrt(x * x + y * y);
      goal[i] = x > 0.1 ? Ground{x / length, y / length} : Ground{1, 0};
    }
  }
  void step(double seconds_of_step) {
    aim();
    world.step(seconds_of_step, goal);
  }
};

Scenario make(StiffScene scene, DepthMeasure measure, std::uint8_t level, const StiffOptions& options) {
  Scenario made{StiffWorld(measure), {}, options.seconds, scene};
  Random random(7);
  const auto person = [&](Ground at, double heading, Ground goal) {
    made.world.add_person(random.below(people_shapes), level, at, heading, {});
    made.goal.push_back(goal);
  };
  switch (scene) {
    case StiffScene::two:
      person({-0.5, 0.02}, 0.1, {1, 0});
      person({0.5, -0.02}, pi - 0.2, {-1, 0});
      break;
    case StiffScene::row:
      for (int i = 0; i < 20; ++i) person({-0.6 - 0.8 * i, 0}, random.between(-0.3, 0.3), {1, 0});
      made.world.add_wall({0.2, 0}, pi / 2);
      for (const double x : {-5.0, -15.0})
        for (const double y : {-0.7, 0.7}) made.world.add_wall({x, y}, 0);
      made.seconds *= 3;  // until the last one has arrived
      break;
    case StiffScene::door:
      for (std::uint32_t i = 0; i < options.people; ++i)
        person({-0.8 - 0.9 * (i / 14), 0.9 * (i % 14) - 5.85}, random.between(-0.5, 0.5), {1, 0});
      made.world.add_wall({0.2, 5.6}, pi / 2);
      made.world.add_wall({0.2, -5.6}, pi / 2);
  }
  return made;
}

/// Returns whether no agent becomes faster than twice the wanted speed once the first second is over.
bool stable(Scenario scenario, double step) {
  constexpr double too_fast = 2 * stiff::wanted_speed;
  for (double time = 0; time < scenario.seconds; time += step) {
    scenario.step(step);
    if (time > 1 && !(scenario.world.fastest() <= too_fast)) return false;
  }
  return true;
}

double largest_stable_step(StiffScene scene, DepthMeasure measure, std::uint8_t level,
                           const StiffOptions& options) {
  double largest = 0;
  for (const double step : tried_steps) {
    if (!stable(make(scene, measure, level, options), step)) break;
    largest = step;
  }
  return largest;
}

/// Over the last second of a long press: how speeds vary about their mean over a tenth of a second.
double jitter(StiffScene scene, DepthMeasure measure, std::uint8_t level, const StiffOptions& options) {
  constexpr double step = 1e-3;
  constexpr int window = 100, windows = 10;
  Scenario scenario = make(scene, measure, level, options);
  const StiffWorld& world = scenario.world;
  for (double time = 0; time < scenario.seconds - 1; time += step) scenario.step(step);
  double variance = 0;
  for (int i = 0; i < windows; ++i) {
    std::vector<Ground> sum(world.people());
    double squares = 0;
    for (int k = 0; k < window; ++k) {
      scenario.step(step);
      squares += world.mean_square() / window;
      for (std::size_t p = 0; p < sum.size(); ++p)
        sum[p].x += world.velocity(p).x / window, sum[p].y += world.velocity(p).y / window;
    }
    for (const Ground mean : sum)
      squares -= (mean.x * mean.x + mean.y * mean.y) / static_cast<double>(sum.size());
    variance += std::max(squares, 0.0) / windows;
  }
  return std::sqrt(variance);
}

/// 2 / omega: two masses on a spring, a chain of them, a triangular lattice.
double spring_bound(StiffScene scene) {
  const double springs = scene == StiffScene::two ? 2 : scene == StiffScene::row ? 4 : 6;
  return 2 / std::sqrt(springs * stiff::stiffness / stiff::mass);
}

const char* name_of(StiffScene scene) {
  return scene == StiffScene::two ? "two agents" : scene == StiffScene::row ? "a row at a wall" : "a door";
}

/// What one bounce did; no contact: no onset.
struct Bounce {
  double onset = 0, energy = 0;
};

Bounce bounce(DepthMeasure measure, std::uint8_t level, Random& random) {
  constexpr double step = 1e-3, half_speed = 0.5;
  StiffWorld world(measure, true);
  const double aside = random.between(-0.15, 0.15);
  for (const double side : {-1.0, 1.0}) {
    const double heading = random.uniform(2 * pi);
    world.add_person(random.below(people_shapes), level, {0.7 * side, -aside * side}, heading,
                     {-half_speed * side, 0});
  }
  const double before = world.mean_square();
  Bounce found;
  int free_steps = 0;
  for (int i = 0; i < 10'000 && free_steps < 500; ++i) {
    world.step(step, {});
    const bool touching = world.deepest() > 0;
    if (touching && found.onset == 0) found.onset = world.deepest();
    free_steps = touching || found.onset == 0 ? 0 : free_steps + 1;
    if (found.onset == 0 && i > 1500) break;  // they pass
  }
  found.energy = (world.mean_square() - before) / before;
  return found;
}

BounceRow bounces(DepthMeasure measure, std::uint8_t level, const StiffOptions& options) {
  BounceRow row{cli::depth_name(stiff_depths[level]), measure};
  Random random(11);
  for (std::uint32_t i = 0; i < options.bounces; ++i) {
    const Bounce one = bounce(measure, level, random);
    if (one.onset == 0) continue;
    ++row.bounces;
    row.onset += one.onset, row.energy += std::abs(one.energy);
    row.largest_onset = std::max(row.largest_onset, one.onset);
    row.most_energy = std::max(row.most_energy, one.energy);
  }
  row.onset /= row.bounces, row.energy /= row.bounces;
  return row;
}

/// One way of an agent over another, a tenth of a millimetre a step.
void slide(SlideRow& row, std::uint8_t level, Random& random) {
  constexpr double step = 1e-4;
  const std::uint32_t shape[] = {random.below(people_shapes), random.below(people_shapes)};
  const std::uint8_t levels[] = {level, level};
  const double heading[] = {random.uniform(2 * pi), random.uniform(2 * pi)};
  const double angle = random.uniform(2 * pi), away = random.between(0.1, 0.5);
  const double along_x = std::cos(angle), along_y = std::sin(angle);
  Depths depths(row.measure);
  Penetration last{-1, 0, 0};
  for (int i = 0; i < 2000; ++i) {
    const double at = (i - 1000) * step;
    const double x[] = {0, away * -along_y + at * along_x}, y[] = {0, away * along_x + at * along_y};
    const Agents agents{shape, x, y, heading, levels};
    const auto pairs = depths.pairs(agents);
    const Penetration now = pairs.empty() ? Penetration{-1, 0, 0} : depths.of(agents, pairs)[0];
    if (now.depth >= 0 && last.depth >= 0) {
      const double jump = std::abs(static_cast<double>(now.depth) - static_cast<double>(last.depth));
      row.jump = std::max(row.jump, jump);
      row.change = std::max(row.change, jump / step);
      const double turn =
          std::atan2(std::abs(last.x * now.y - last.y * now.x), last.x * now.x + last.y * now.y);
      if (now.depth > 0 && last.depth > 0) row.turn = std::max(row.turn, turn);
    }
    last = now;
  }
}

SlideRow slides(DepthMeasure measure, std::uint8_t level, const StiffOptions& options) {
  SlideRow row{cli::depth_name(stiff_depths[level]), measure};
  Random random(13);
  for (std::uint32_t i = 0; i < options.slides; ++i) slide(row, level, random);
  return row;
}

StiffReport combination(DepthMeasure measure, std::uint8_t level, const StiffOptions& options) {
  StiffReport report;
  for (const StiffScene scene : {StiffScene::two, StiffScene::row, StiffScene::door}) {
    if (scene == StiffScene::door && options.people == 0) continue;
    const bool rest = scene != StiffScene::door;
    report.rows.push_back({name_of(scene), cli::depth_name(stiff_depths[level]), measure, spring_bound(scene),
                           largest_stable_step(scene, measure, level, options),
                           rest ? jitter(scene, measure, level, options) : 0});
  }
  report.bounces.push_back(bounces(measure, level, options));
  report.slides.push_back(slides(measure, level, options));
  return report;
}

}  // namespace

std::string name_of(DepthMeasure measure) {
  return measure == DepthMeasure::penetration ? "penetration"
         : measure == DepthMeasure::discs     ? "deepest discs"
                                              : "line of centres";
}

StiffReport stiff_contact(const StiffOptions& options) {
  constexpr std::size_t levels = finest_level + 1, combinations = std::size(measures) * levels;
  std::vector<StiffReport> parts(combinations);
  tbb::parallel_for(std::size_t{0}, combinations, [&](std::size_t i) {
    parts[i] = combination(measures[i / levels], static_cast<std::uint8_t>(i % levels), options);
  });
  StiffReport report;
  for (const StiffReport& part : parts) {
    report.rows.insert(report.rows.end(), part.rows.begin(), part.rows.end());
    report.bounces.push_back(part.bounces.front());
    report.slides.push_back(part.slides.front());
  }
  return report;
}

}  // namespace bch::bench
