// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/sphere_fit.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail {

SphereFit::SphereFit(const SkinPieces& skin, const TrainingPoses& training, const SphereChoice& choice)
    : balls(choice.spheres.size()),
      owner(choice.owner),
      skin_(&skin),
      training_(&training),
      tracks_(training.points(0).size()),
      seen_(tracks_.size(), 0) {
  for (std::size_t pose = 0; pose < poses; ++pose)
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const SpacePoint& at = training.points(pose)[i];
      tracks_[i].x[pose] = static_cast<float>(at.x);
      tracks_[i].y[pose] = static_cast<float>(at.y);
      tracks_[i].z[pose] = static_cast<float>(at.z);
    }
  for (std::uint32_t p = 0; p < owner.size(); ++p) balls[owner[p]].pieces.push_back(p);
  for (std::size_t s = 0; s < balls.size(); ++s) {
    balls[s].influences = choice.spheres[s];
    place(balls[s]);
    refit(balls[s]);
  }
}

void SphereFit::place(Ball& ball) const {
  for (std::size_t pose = 0; pose < poses; ++pose) {
    const SpacePoint at = training_->centre(pose, ball.influences);
    ball.x[pose] = static_cast<float>(at.x);
    ball.y[pose] = static_cast<float>(at.y);
    ball.z[pose] = static_cast<float>(at.z);
  }
}

void SphereFit::measure(const Ball& ball, std::uint32_t point, PerPose& squared) const {
  const Track& track = tracks_[point];
  for (std::size_t pose = 0; pose < poses; ++pose) {
    const float x = track.x[pose] - ball.x[pose], y = track.y[pose] - ball.y[pose],
                z = track.z[pose] - ball.z[pose];
    squared[pose] = x * x + y * y + z * z;
  }
}

void SphereFit::refit(Ball& ball) {
  ++refits_;
  ball.squared_radius.fill(0);
  ball.farthest.fill(ball.pieces.empty() ? 0 : corners(ball.pieces.front())[0]);
  for (const std::uint32_t piece : ball.pieces)
    for (const std::uint32_t corner : corners(piece)) {
      if (seen_[corner] == refits_) continue;
      seen_[corner] = refits_;
      PerPose squared;
      measure(ball, corner, squared);
      for (std::size_t pose = 0; pose < poses; ++pose) {
        ball.farthest[pose] = squared[pose] > ball.squared_radius[pose] ? corner : ball.farthest[pose];
        ball.squared_radius[pose] = std::max(squared[pose], ball.squared_radius[pose]);
      }
    }
  for (std::size_t pose = 0; pose < poses; ++pose) ball.radius[pose] = std::sqrt(ball.squared_radius[pose]);
}

bool SphereFit::contains(const Ball& ball, std::uint32_t piece) const {
  for (const std::uint32_t corner : corners(piece)) {
    PerPose squared;
    measure(ball, corner, squared);
    for (std::size_t pose = 0; pose < poses; ++pose)
      if (squared[pose] > ball.squared_radius[pose]) return false;
  }
  return true;
}

float SphereFit::growth(const Ball& ball, const Corners& triangle) const {
  PerPose most = ball.squared_radius;
  for (const std::uint32_t corner : triangle) {
    PerPose squared;
    measure(ball, corner, squared);
    for (std::size_t pose = 0; pose < poses; ++pose) most[pose] = std::max(most[pose], squared[pose]);
  }
  float sum = 0;
  for (std::size_t pose = 0; pose < poses; ++pose) sum += std::sqrt(most[pose]) - ball.radius[pose];
  return sum / static_cast<float>(poses);
}

void SphereFit::grow(Ball& ball, const Corners& triangle) const {
  for (const std::uint32_t corner : triangle) {
    PerPose squared;
    measure(ball, corner, squared);
    for (std::size_t pose = 0; pose < poses; ++pose) {
      if (squared[pose] <= ball.squared_radius[pose]) continue;
      ball.squared_radius[pose] = squared[pose];
      ball.radius[pose] = std::sqrt(squared[pose]);
      ball.farthest[pose] = corner;
    }
  }
}

void SphereFit::hand_over(std::uint32_t piece, std::uint32_t to) {
  std::erase(balls[owner[piece]].pieces, piece);
  balls[to].pieces.push_back(piece);
  owner[piece] = to;
}

std::array<float, 3> SphereFit::at(std::uint32_t point, std::size_t pose) const {
  const Track& track = tracks_[point];
  return {track.x[pose], track.y[pose], track.z[pose]};
}

SphereChoice SphereFit::choice() const {
  SphereChoice chosen;
  chosen.owner = owner;
  for (const Ball& ball : balls) chosen.spheres.push_back(ball.influences);
  return chosen;
}

}  // namespace bch::detail
