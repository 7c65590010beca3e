// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <string_view>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>
#include <bch/crowd.hpp>

#include "bench/clients/simulators.hpp"

// Puts bodies behind two simulators of discs. People on a circle walk to its other side; with the argument "streams", two streams of people
// meet on a square without borders.

namespace {

using namespace bch::clients;

constexpr double frame_seconds = 0.05;

std::vector<bch::BodyModel> pedestrians() {
  std::vector<bch::BodyModel> models;
  models.push_back(bch::default_body(bch::default_pedestrian(bch::Sex::female, 1.66)));
  models.push_back(bch::default_body(bch::default_pedestrian(bch::Sex::male, 1.79)));
  return models;
}

void add(People& people, Plane at, Plane goal, double radius) {
  people.at.push_back(at), people.goal.push_back(goal);
  people.velocity.emplace_back(), people.radius.push_back(radius);
}

People people_on_circle() {
  constexpr std::size_t count = 60;
  constexpr double circle = 5.5;  // metres
  People people;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / count;
    const Plane at = std::polar(circle + 0.1 * static_cast<double>(i % 7), turn);
    add(people, at, -at, usual_radius);
  }
  return people;
}

/// Every second person walks along +x, the others along -x, for ever. `density`: people per square metre.
People two_streams(double density, double radius) {
  constexpr std::size_t rows = 14;
  People people;
  people.period = std::sqrt(rows * rows / density);
  for (std::size_t i = 0; i < rows * rows; ++i) {
    const double moved = 0.3 * std::fmod(0.618 * static_cast<double>(i), 1);
    const Plane cell(static_cast<double>(i % rows) + moved, static_cast<double>(i / rows) + moved);
    const Plane at = people.period / rows * cell;
    add(people, at, at + Plane((i + i / rows) % 2 == 0 ? 1000 : -1000, 0), radius);
  }
  return people;
}

/// Holds the bodies of people, each in the stride that belongs to its speed.
class Bodies {
 public:
  explicit Bodies(const People& people)
      : models_(pedestrians()),
        model_(people.size()),
        stride_(people.size()),
        x_(people.size()),
        y_(people.size()),
        heading_(people.size()),
        body_(people.size()),
        crowd_(bch::CrowdOptions{.period = {people.period, people.period}}) {
    std::iota(body_.begin(), body_.end(), 0);
    for (std::size_t i = 0; i < people.size(); ++i)
      model_[i] = i % 2, stride_[i] = std::fmod(0.618 * static_cast<double>(i), 1);
    live_ = bch::LiveBodies(models_, model_);
  }

  void pose(const People& people) {
    std::vector<bch::Pose> poses;
    for (std::size_t i = 0; i < people.size(); ++i) {
      const double speed = std::abs(people.velocity[i]);
      const auto clip = static_cast<std::uint32_t>(std::lround(speed / 0.03));
      const auto length = static_cast<double>(models_[model_[i]].character->clips[clip].seconds);
      stride_[i] = std::fmod(stride_[i] + frame_seconds / length, 1);
      poses.emplace_back(clip, static_cast<float>(stride_[i] * length));
      if (speed > 0.15) heading_[i] = std::arg(people.velocity[i]);
      x_[i] = people.at[i].real(), y_[i] = people.at[i].imag();
    }
    live_.pose(poses);
  }
  /// Returns how many pairs overlap.
  std::size_t overlaps() { return crowd_.collisions(live_.set(), {body_, x_, y_, heading_}).size(); }
  /// Gives people discs that stand for their bodies among their neighbours.
  void set_radii(People& people) {
    const bch::Agents agents{body_, x_, y_, heading_};
    const bch::BodyClearanceOptions options{.max_distance = 0.7, .overlap = bch::Overlap::deepest};
    people.radius = crowd_.clearances(live_.set(), agents, options).disc_radii(agents, usual_radius);
  }
  /// Moves people until nobody overlaps anybody. Returns how many pairs are left.
  std::size_t resolve(People& people) {
    const auto resolved = crowd_.resolve(live_.set(), {body_, x_, y_, heading_}, {});
    for (std::size_t i = 0; i < people.size(); ++i) people.at[i] = {resolved.x[i], resolved.y[i]};
    return resolved.left.size();
  }

 private:
  std::vector<bch::BodyModel> models_;
  std::vector<std::uint32_t> model_;
  std::vector<double> stride_, x_, y_, heading_;
  std::vector<std::uint32_t> body_;
  bch::LiveBodies live_{{}, {}};
  bch::Crowd crowd_;
};

/// Calls a function. Returns the milliseconds that it took.
template <class Work>
double timed(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

enum class Coupling : std::uint8_t { none, radii, resolve };
constexpr const char* name_of[] = {"discs alone", "radii from clearances", "bodies moved apart"};

/// Returns how far people are from their goals, metres, in the mean.
double distance_left(const People& people) {
  double sum = 0;
  for (std::size_t i = 0; i < people.size(); ++i) sum += std::abs(people.goal[i] - people.at[i]);
  return sum / static_cast<double>(people.size());
}

void run(const char* name, void (*steer)(People&, double), Coupling coupling, People people, int frames) {
  Bodies bodies(people);
  const double distance = distance_left(people);
  std::size_t overlaps = 0;
  double simulating = 0, posing = 0, checking = 0;
  for (int frame = 0; frame < frames; ++frame) {
    simulating += timed([&] {
      steer(people, frame_seconds);
      for (std::size_t i = 0; i < people.size(); ++i) people.at[i] += frame_seconds * people.velocity[i];
    });
    posing += timed([&] { bodies.pose(people); });
    checking += timed([&] {
      overlaps += coupling == Coupling::resolve ? bodies.resolve(people) : bodies.overlaps();
      if (coupling == Coupling::radii) bodies.set_radii(people);
    });
  }
  std::printf(
      "%s, %s: %zu overlaps in %d frames, %.2f m/s towards the goals; ms a frame: simulator %.2f, poses "
      "%.2f, bodies %.2f\n",
      name, name_of[static_cast<int>(coupling)], overlaps, frames,
      (distance - distance_left(people)) / (frames * frame_seconds), simulating / frames, posing / frames,
      checking / frames);
}

void run_streams() {
  for (const double density : {1.0, 2.0}) {
    std::printf("%.0f people per square metre\n", density);
    for (const double radius : {0.2, 0.25, 0.3, 0.35}) {
      std::printf("radius %.2f m: ", radius);
      run("orca", steer_by_orca, Coupling::none, two_streams(density, radius), 600);
    }
    run("orca", steer_by_orca, Coupling::radii, two_streams(density, usual_radius), 600);
  }
}

}  // namespace

int main(int count, const char* const* words) {
  if (count > 1 && std::string_view(words[1]) == "streams") return run_streams(), 0;
  for (const Coupling coupling : {Coupling::none, Coupling::radii, Coupling::resolve}) {
    run("orca", steer_by_orca, coupling, people_on_circle(), 240);
    run("social forces", steer_by_social_forces, coupling, people_on_circle(), 240);
  }
}
