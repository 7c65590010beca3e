// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/tangent_discs.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace bch::detail {
namespace {

/// Lengths of the edges that end at each corner, and their sum.
double edge_lengths(std::span<const float> x, std::span<const float> y, std::vector<float>& length) {
  const std::size_t n = x.size();
  length.resize(n);
  const auto between = [&](std::size_t i, std::size_t j) {
    const float dx = x[j] - x[i], dy = y[j] - y[i];
    return std::sqrt(dx * dx + dy * dy);
  };
  length[0] = between(n - 1, 0);
  for (std::size_t i = 1; i < n; ++i) length[i] = between(i - 1, i);
  double sum = 0;
  for (const float l : length) sum += static_cast<double>(l);
  return sum;
}

/// Holds off the radius 1 / 0 of a touch that has no point on its inner side.
constexpr float smallest_curvature = 0x1p-6f;

}  // namespace

/// Finds first the edge of each sample, then all samples in a straight loop, because the number of samples on
/// an edge cannot be predicted.
void ContourSamples::take(std::span<const float> x, std::span<const float> y) {
  const double step = edge_lengths(x, y, length_) / count;
  assert(step > 0);
  std::array<std::uint32_t, count + 1>
      edge{};  // the last that begins before a sample and after the one before it
  begin_.resize(length_.size());
  double end = 0;
  for (std::uint32_t i = 0; i < length_.size(); ++i) {
    edge[std::min(static_cast<std::uint32_t>(std::floor(end / step + 0.5)), count)] = i;
    begin_[i] = end;
    end += static_cast<double>(length_[i]);
  }
  std::uint32_t at = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    at = std::max(at, edge[k]);
    const std::size_t before = (at == 0 ? length_.size() : at) - 1;
    const float dx = x[at] - x[before], dy = y[at] - y[before], one_over_length = 1 / length_[at];
    const float along = static_cast<float>((k + 0.5) * step - begin_[at]) * one_over_length;
    x_[k] = x[before] + along * dx;
    y_[k] = y[before] + along * dy;
    touches_.normal_x[k / 2] = -dy * one_over_length;
    touches_.normal_y[k / 2] = dx * one_over_length;
  }
  // A pair of samples shares a touch: the second one's place and normal.
  for (std::uint32_t k = 0; k < max_touches; ++k)
    touches_.x[k] = x_[2 * k + 1], touches_.y[k] = y_[2 * k + 1];
  touches_.count = max_touches;
}

void ContourSamples::largest_discs(const InteriorLoops& loops, const Touches& touches,
                                   const ContourPoints& corners, CandidateDiscs& discs) const {
  const TouchLanes lanes{touches.x.data(), touches.y.data(), touches.normal_x.data(), touches.normal_y.data(),
                         touches.count};
  alignas(64) std::array<float, max_touches> half_curvature;
  half_curvature.fill(0.5f * smallest_curvature);
  loops.keep_out({x_.data(), y_.data(), count}, lanes, half_curvature.data());
  loops.keep_out(corners, lanes, half_curvature.data());
  discs.count = touches.count;
  for (std::uint32_t k = 0; k < touches.count; ++k) {
    const float radius = 0.5f / half_curvature[k];
    discs.radius[k] = radius;
    discs.x[k] = touches.x[k] + radius * touches.normal_x[k];
    discs.y[k] = touches.y[k] + radius * touches.normal_y[k];
  }
}

}  // namespace bch::detail
