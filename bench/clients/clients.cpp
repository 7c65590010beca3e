// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>
#include <bch/crowd.hpp>

#include "bench/clients/simulators.hpp"

// Puts bodies behind two simulators of discs. People on a circle walk to its other side.

namespace {

using namespace bch::clients;

constexpr std::size_t count = 60;
constexpr double circle = 5.5, frame_seconds = 0.05;  // metres, s
constexpr int frames = 240;

std::vector<bch::BodyModel> pedestrians() {
  std::vector<bch::BodyModel> models;
  models.push_back(bch::default_body(bch::default_pedestrian(bch::Sex::female, 1.66)));
  models.push_back(bch::default_body(bch::default_pedestrian(bch::Sex::male, 1.79)));
  return models;
}

People people_on_circle() {
  People people;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / count;
    people.at.push_back(std::polar(circle + 0.1 * static_cast<double>(i % 7), turn));
    people.velocity.emplace_back(), people.goal.push_back(-people.at.back());
  }
  return people;
}

/// Holds the bodies of people, each in the stride that belongs to its speed.
class Bodies {
 public:
  Bodies()
      : models_(pedestrians()),
        model_(count),
        stride_(count),
        x_(count),
        y_(count),
        heading_(count),
        body_(count) {
    std::iota(body_.begin(), body_.end(), 0);
    for (std::size_t i = 0; i < count; ++i)
      model_[i] = i % 2, stride_[i] = std::fmod(0.618 * static_cast<double>(i), 1);
    live_ = bch::LiveBodies(models_, model_);
  }

  void pose(const People& people) {
    std::vector<bch::Pose> poses;
    for (std::size_t i = 0; i < count; ++i) {
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
  /// Moves people until nobody overlaps anybody. Returns how many pairs are left.
  std::size_t resolve(People& people) {
    const auto resolved = crowd_.resolve(live_.set(), {body_, x_, y_, heading_}, {});
    for (std::size_t i = 0; i < count; ++i) people.at[i] = {resolved.x[i], resolved.y[i]};
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

void run(const char* name, void (*steer)(People&, double), bool resolves) {
  People people = people_on_circle();
  Bodies bodies;
  std::size_t overlaps = 0;
  double simulating = 0, posing = 0, checking = 0, way = 0;
  for (int frame = 0; frame < frames; ++frame) {
    simulating += timed([&] {
      steer(people, frame_seconds);
      for (std::size_t i = 0; i < count; ++i) people.at[i] += frame_seconds * people.velocity[i];
    });
    posing += timed([&] { bodies.pose(people); });
    checking += timed([&] { overlaps += resolves ? bodies.resolve(people) : bodies.overlaps(); });
  }
  for (std::size_t i = 0; i < count; ++i) way += std::abs(people.goal[i] - people.at[i]) / count;
  std::printf(
      "%s, %s: %zu overlaps in %d frames, %.2f m from the goals; ms a frame: simulator %.2f, poses %.2f, "
      "bodies %.2f\n",
      name, resolves ? "bodies moved apart" : "discs alone", overlaps, frames, way, simulating / frames,
      posing / frames, checking / frames);
}

}  // namespace

int main() {
  for (const bool resolves : {false, true}) {
    run("orca", steer_by_orca, resolves);
    run("social forces", steer_by_social_forces, resolves);
  }
}
