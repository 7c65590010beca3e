// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/sphere_descent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bch::detail {
namespace {

using Ball = SphereFit::Ball;

constexpr std::uint64_t slides_seed = 54;
constexpr double widest_lateral = 0.5;  // metres
constexpr float max_leverage = 4;       // of a contact: by how much later it is where a front is 1 less far
constexpr float kept_gradient = 0.9f, kept_square = 0.99f;

}  // namespace

float scale_of(const double (&rows)[3][4]) {
  double sum = 0;
  for (const auto& row : rows)
    for (int k = 0; k < 3; ++k) sum += row[k] * row[k];
  return static_cast<float>(std::sqrt(sum / 3));
}

SphereDescent::SphereDescent(SphereFit& fit)
    : blame(fit.balls.size(), 0), contacts(fit.balls.size(), 0), fit_(fit), random_(slides_seed) {
  for (const Ball& ball : fit.balls) descents_.emplace_back(ball.influences.size());
}

void SphereDescent::round(float length) {
  blame.assign(fit_.balls.size(), 0);
  contacts.assign(fit_.balls.size(), 0);
  for (int i = 0; i < steps_a_round; ++i) step(length);
}

/// Makes slides, and moves the spheres that met first.
void SphereDescent::step(float length) {
  std::array<std::vector<Sphere>, SphereFit::poses> bodies;
  for (std::size_t pose = 0; pose < SphereFit::poses; ++pose)
    for (const Ball& ball : fit_.balls)
      bodies[pose].push_back({ball.x[pose], ball.y[pose], ball.z[pose], ball.radius[pose]});
  gradients_.clear();
  for (std::size_t s = 0; s < fit_.balls.size(); ++s)
    gradients_.emplace_back(fit_.balls[s].influences.size());
  std::vector<std::uint8_t> is_met(fit_.balls.size(), 0);
  for (int i = 0; i < slides_a_round / steps_a_round; ++i) {
    const std::uint32_t a = random_.below(SphereFit::poses);
    const std::uint32_t b = (a + 1 + random_.below(SphereFit::poses - 1)) % SphereFit::poses;
    const Rotation turn_a = rotation(random_.between(0, 2 * std::numbers::pi));
    const Rotation turn_b = rotation(random_.between(0, 2 * std::numbers::pi));
    const auto lateral = static_cast<float>(random_.between(-widest_lateral, widest_lateral));
    first_.place(bodies[a], turn_a, 0, 1);
    second_.place(bodies[b], turn_b, lateral, -1);
    const auto contact = first_contact(first_, second_);
    if (!contact) continue;
    const float leverage = std::min(max_leverage, 1 / std::max(contact->normal[0], 0.01f));
    note(contact->first, a, turn_a, contact->normal, 1, leverage);
    note(contact->second, b, turn_b, contact->normal, -1, leverage);
    is_met[contact->first] = is_met[contact->second] = 1;
  }
  for (std::size_t s = 0; s < fit_.balls.size(); ++s)
    if (is_met[s] != 0) descend(s, length);
}

/// Notes the part of one of the spheres in a contact.
void SphereDescent::note(std::uint32_t sphere, std::size_t pose, const Rotation& turn,
                         const float (&normal)[3], float sign, float leverage) {
  const Ball& ball = fit_.balls[sphere];
  const auto cosine = static_cast<float>(turn.cosine), sine = static_cast<float>(turn.sine);
  const Space outward = {sign * (cosine * normal[0] + sine * normal[1]),
                         sign * (cosine * normal[1] - sine * normal[0]), sign * normal[2]};
  const Space corner = fit_.at(ball.farthest[pose], pose);
  const float radius = std::max(ball.radius[pose], 1e-6f);
  const Space direction = {(corner[0] - ball.x[pose]) / radius, (corner[1] - ball.y[pose]) / radius,
                           (corner[2] - ball.z[pose]) / radius};
  contacts[sphere] += leverage;
  blame[sphere] += leverage * (1 - dot_of(outward, direction));
  for (std::size_t i = 0; i < ball.influences.size(); ++i) {
    const auto& rows = fit_.training().map(pose, ball.influences[i].bone).rows;
    const float scaled_weight = leverage * ball.influences[i].weight / scale_of(rows);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t row = 0; row < 3; ++row)
        gradients_[sphere][i][k] +=
            scaled_weight * static_cast<float>(rows[row][k]) * (outward[row] - direction[row]);
  }
}

void SphereDescent::descend(std::size_t sphere, float length) {
  Ball& ball = fit_.balls[sphere];
  for (std::size_t i = 0; i < ball.influences.size(); ++i) {
    const Space& gradient = gradients_[sphere][i];
    Descent& descent = descents_[sphere][i];
    descent.square = kept_square * descent.square + (1 - kept_square) * dot_of(gradient, gradient);
    const float step = length / (std::sqrt(descent.square) + 1e-9f) /
                       scale_of(fit_.training().map(0, ball.influences[i].bone).rows);
    float* const centre[3] = {&ball.influences[i].centre.x, &ball.influences[i].centre.y,
                              &ball.influences[i].centre.z};
    for (std::size_t k = 0; k < 3; ++k) {
      descent.mean[k] = kept_gradient * descent.mean[k] + (1 - kept_gradient) * gradient[k];
      *centre[k] -= step * descent.mean[k];
    }
  }
  fit_.place(ball);
  fit_.refit(ball);
}

}  // namespace bch::detail
