// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/clip_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "layout/base/rounding.hpp"
#include "layout/body/posing/model_layout.hpp"

namespace bch::detail {
namespace {

constexpr double wanted_deviation = 0.0004;  ///< metres
constexpr double longest_window = 0.0084;    ///< seconds
/// What positions in float are off by, relative to their size: of skinning (some ten operations deep), and of discs between keys.
constexpr double relative_rounding = 4e-6;

}  // namespace

ClipSamples::ClipSamples(const BodyModel& model, std::uint32_t clip)
    : model_(model),
      clip_(clip),
      bounds_(*model.character, clip),
      layout_(layout_of(model)),
      poser_(model, layout_),
      heights_{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()} {}

void ClipSamples::take(float from, float to) {
  samples_.clear();
  max_extent_ = 0;
  add(from);
  const std::vector<float>& keys = bounds_.key_times();
  while (from < to) {
    const auto key = std::upper_bound(keys.begin(), keys.end(), from);
    const double acceleration = bounds_.acceleration_in_space(from);
    const float limit = key == keys.end() ? to : std::min(to, *key);
    const double left = double{limit} - double{from};
    const double even = std::sqrt(8 * wanted_deviation / std::max(acceleration, 1e-9));
    const double parts = std::ceil(left / std::min(longest_window, even));
    const float after = parts <= 1 ? limit : static_cast<float>(double{from} + left / parts);
    if (!(from < after)) throw std::invalid_argument("animate: vertices move too fast");
    const double seconds = double{after} - double{from}, deviation = acceleration * seconds * seconds / 8;
    add(after);
    for (std::size_t i = samples_.size() - 2; i < samples_.size(); ++i) {
      samples_[i].margin = std::max(samples_[i].margin, deviation);
      take_in(samples_[i], deviation);
    }
    from = after;
  }
  for (Sample& sample : samples_) sample.margin += relative_rounding * max_extent_;
}

void ClipSamples::add(float seconds) {
  Sample& sample = samples_.emplace_back();
  sample.seconds = seconds;
  const SphereSlots spheres = poser_.pose(Pose(clip_, seconds));
  for (std::uint32_t i = 0; i < layout_.sphere_count; ++i)
    sample.spheres.push_back({spheres.x[i], spheres.y[i], spheres.z[i], spheres.radius[i]});
  sample.bottom = std::numeric_limits<double>::infinity(), sample.top = -sample.bottom;
  const auto extent_to = [&](float x, float y, float z) {
    max_extent_ = std::max({max_extent_, double{std::abs(x)}, double{std::abs(y)}, double{std::abs(z)}});
  };
  for (const Sphere& sphere : sample.spheres) extent_to(sphere.x, sphere.y, sphere.z);
  for (const std::uint32_t corner : model_.corners) {
    const SpaceRow& point = poser_.point(corner);
    sample.corners.push_back({double{point.x}, double{point.y}, double{point.z}});
    extent_to(point.x, point.y, point.z);
    sample.bottom = std::min(sample.bottom, double{point.z});
    sample.top = std::max(sample.top, double{point.z});
  }
}

void ClipSamples::take_in(const Sample& sample, double deviation) {
  const double margin = deviation + relative_rounding * std::max(-sample.bottom, sample.top);
  heights_ = {std::min(heights_.bottom, rounding::round_down(sample.bottom - margin)),
              std::max(heights_.top, -rounding::round_down(-sample.top - margin))};
}

double ClipSamples::fraction(std::size_t i, std::size_t first, std::size_t last) const noexcept {
  const double from = samples_[first].seconds, to = samples_[last].seconds;
  return (double{samples_[i].seconds} - from) / (to - from);
}

double ClipSamples::radius(std::size_t i, std::size_t sphere, const SpacePoint& centre) const noexcept {
  const Sample& sample = samples_[i];
  double square = 0;
  for (std::uint32_t c = model_.corner_begin[sphere]; c < model_.corner_begin[sphere + 1]; ++c)
    square = std::max(square, squared_distance(sample.corners[c], centre));
  const double least = model_.least_radius.empty() ? 0 : double{model_.least_radius[sphere]};
  return std::max(std::sqrt(square) + sample.margin, least);
}

}  // namespace bch::detail
