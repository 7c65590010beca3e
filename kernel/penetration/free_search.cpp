// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_search.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace bch::detail {
namespace {

using Float = FreeIntervals::Float;
static_assert(FreeIntervals::Simd::width == 4, "leaves have whole registers");

float largest(Float values) noexcept {
  return -FreeIntervals::Simd::least(-values);
}

/// Returns what all lanes hold.
float lane_of(Float all) noexcept {
  return FreeIntervals::Simd::least(all);
}

Float clamped(Float value, Float limit) noexcept {
  return xsimd::min(xsimd::max(value, -limit), limit);
}

/// Widens an interval by the part of a side of a parallelogram that lies in the strip. The middle of the side is at (m, w).
[[gnu::always_inline]] inline void add_side(FreeIntervals& to, const FreeLanes& side, Float m, Float w,
                                            Float margin) noexcept {
  using Simd = FreeIntervals::Simd;
  const Float first_w = w - side.half_across, last_w = w + side.half_across;
  const Float first = m - side.half_along + (clamped(first_w, margin) - first_w) * side.slope,
              last = m + side.half_along + (clamped(last_w, margin) - last_w) * side.slope;
  const auto inside = (xsimd::min(first_w, last_w) <= margin) & (-margin <= xsimd::max(first_w, last_w));
  to.low = Simd::select(inside, xsimd::min(to.low, xsimd::min(first, last)), to.low);
  to.high = Simd::select(inside, xsimd::max(to.high, xsimd::max(first, last)), to.high);
}

}  // namespace

FreeSpheres::FreeSpheres(const FreeLanes& a, const FreeLanes& b, float) noexcept {
  const Float m = b.along - a.along, w = b.across - a.across, z = b.z - a.z, radius = a.radius + b.radius;
  const Float left = radius * radius - (w * w + z * z);
  const Float s = xsimd::sqrt(xsimd::max(left, Float(0.0f)));
  low = m - s, high = m + s, are_some = left > Float(0.0f);
}

FreeSegments::FreeSegments(const FreeLanes& a, const FreeLanes& b, float by) noexcept {
  const Float m = b.along - a.along, w = b.across - a.across, margin(by);
  low = Float(__builtin_inff()), high = Float(-__builtin_inff()), are_some = Simd::Mask(true);
  add_side(*this, a, m - b.half_along, w - b.half_across, margin);
  add_side(*this, a, m + b.half_along, w + b.half_across, margin);
  add_side(*this, b, m - a.half_along, w - a.half_across, margin);
  add_side(*this, b, m + a.half_along, w + a.half_across, margin);
  low = low - margin, high = high + margin;
}

FreeTouch FreeSpheres::touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept {
  const float radius = lane_of(a.radius) - margin;
  const FreeTouch::Vector centre{lane_of(a.along), lane_of(a.across), lane_of(a.z)};
  const float x = centre.along + end - lane_of(b.along), y = centre.across - lane_of(b.across),
              z = centre.up - lane_of(b.z), length = std::sqrt(x * x + y * y + z * z);
  const FreeTouch::Vector normal{x / length, y / length, z / length};
  return {{centre.along - radius * normal.along, centre.across - radius * normal.across,
           centre.up - radius * normal.up},
          normal};
}

FreeTouch FreeSegments::touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept {
  FreeTouch touch;
  float most = -1;
  const Float m = b.along - a.along - Float(end), w = b.across - a.across;
  // The end of the other segment is at (along, across) from A, and at (m, w) from the middle of the side.
  const auto compare_side = [&](const FreeLanes& side, Float to_m, Float to_w, Float along, Float across) {
    FreeIntervals part;
    part.low = Float(__builtin_inff()), part.high = -part.low;
    add_side(part, side, to_m, to_w, Float(margin));
    const float x = lane_of(side.half_along), y = lane_of(side.half_across),
                length = std::sqrt(x * x + y * y);
    if (!(largest(part.high) >= -4 * margin && std::abs(y) > most * length)) return;
    most = std::abs(y) / length;
    touch = {{lane_of(along), lane_of(across)}, {most, std::copysign(x / length, x * y > 0 ? -1.0f : 1.0f)}};
  };
  for (const Float sign : {Float(-1.0f), Float(1.0f)}) {
    const Float to_b_along = sign * b.half_along, to_b_across = sign * b.half_across;
    compare_side(a, m + to_b_along, w + to_b_across, b.along + to_b_along - Float(end),
                 b.across + to_b_across);
    const Float to_a_along = sign * a.half_along, to_a_across = sign * a.half_across;
    compare_side(b, m - to_a_along, w - to_a_across, a.along + to_a_along, a.across + to_a_across);
  }
  return touch;
}

template <class Intervals>
void FreeSearch<Intervals>::Rounds::resize(std::size_t count) {
  for (std::vector<float>* each :
       {&x, &y, &z, &radius, &half_x, &half_y, &along, &across, &half_along, &half_across, &slope})
    each->resize(count + padding);
}

template <class Intervals>
void FreeSearch<Intervals>::Rounds::set(std::size_t at, const FreeElement& element) {
  x[at] = element.x, y[at] = element.y, z[at] = element.z, radius[at] = element.radius;
  half_x[at] = element.half_x, half_y[at] = element.half_y;
}

template <class Intervals>
void FreeSearch<Intervals>::Rounds::turn(float to_x, float to_y, std::uint32_t count, float margin) {
  const Float ex(to_x), ey(to_y);
  for (std::uint32_t i = 0; i < count; i += Simd::width) {
    const Float at_x = Simd::load(&x[i]), at_y = Simd::load(&y[i]);
    Simd::store(&along[i], at_x * ex + at_y * ey);
    Simd::store(&across[i], at_x * ey - at_y * ex);
    if constexpr (std::is_same_v<Intervals, FreeSegments>) {
      const Float to_end_x = Simd::load(&half_x[i]), to_end_y = Simd::load(&half_y[i]);
      const Float a = to_end_x * ex + to_end_y * ey, w = to_end_x * ey - to_end_y * ex;
      Simd::store(&half_along[i], a);
      Simd::store(&half_across[i], w);
      Simd::store(&slope[i], Simd::select(xsimd::abs(w) > Float(margin), a / w, Float(0.0f)));
    }
  }
}

template <class Intervals>
FreeLanes FreeSearch<Intervals>::Rounds::load(std::uint32_t i) const noexcept {
  return {Simd::load(&along[i]),  Simd::load(&across[i]),     Simd::load(&z[i]),
          Simd::load(&radius[i]), Simd::load(&half_along[i]), Simd::load(&half_across[i]),
          Simd::load(&slope[i])};
}

template <class Intervals>
FreeLanes FreeSearch<Intervals>::Rounds::one(std::uint32_t i) const noexcept {
  return {Float(along[i]),      Float(across[i]),      Float(z[i]),    Float(radius[i]),
          Float(half_along[i]), Float(half_across[i]), Float(slope[i])};
}

template <class Intervals>
void FreeSearch<Intervals>::Body::take(const FreeBody& body, float grown) {
  leaf_size = body.leaf_size, leaves = static_cast<std::uint32_t>(body.elements.size()) / leaf_size;
  elements.resize(body.elements.size()), nodes.resize(body.nodes.size()),
      top.resize(body.nodes.size() + padding);
  for (std::size_t i = 0; i < body.elements.size(); ++i) {
    elements.set(i, body.elements[i]);
    elements.radius[i] += grown;
  }
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    const Cylinder& node = body.nodes[i];
    nodes.set(i, {static_cast<float>(node.x), static_cast<float>(node.y), static_cast<float>(node.bottom),
                  static_cast<float>(node.radius)});
    top[i] = static_cast<float>(node.top);
  }
}

template <class Intervals>
void FreeSearch<Intervals>::Body::turn(float x, float y, float margin) {
  nodes.turn(x, y, leaves + 1, margin);
  elements.turn(x, y, first(leaves), margin);
}

template <class Intervals>
void FreeSearch<Intervals>::begin(const FreeBody& a, const FreeBody& b, float margin, float slack) {
  margin_ = margin, node_slack_ = slack;
  a_.take(a, margin);
  b_.take(b, 0);
  leaves_a_.resize(a_.leaves + padding), leaves_b_.resize(b_.leaves + padding);
  slots_.resize(b_.leaf_size + padding);
}

template <class Intervals>
void FreeSearch<Intervals>::sample() {
  sample_a_.resize(max_samples), sample_b_.resize(max_samples);
  turn(1, 0);
  overlapping_.clear();
  visit(0, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) { overlapping_.push_back({leaf_a, leaf_b}); });
  samples_ = 0;
  const std::size_t step = overlapping_.size() / max_samples + 1;
  for (std::size_t i = 0; i < overlapping_.size(); i += step)
    keep_sample(overlapping_[i].of_a, overlapping_[i].of_b);
}

template <class Intervals>
void FreeSearch<Intervals>::turn(float x, float y) {
  a_.turn(x, y, margin_);
  b_.turn(x, y, margin_);
}

template <class Intervals>
std::uint32_t FreeSearch<Intervals>::list(const Body& of, const Body& other, std::uint32_t node, float moved,
                                          std::uint16_t* leaves) const {
  const Float along(other.nodes.along[node] + moved), across(other.nodes.across[node]),
      radius(other.nodes.radius[node] + node_slack_), bottom(other.nodes.z[node] - node_slack_),
      top(other.top[node] + node_slack_);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < of.leaves; i += Simd::width) {
    const Float m = Simd::load(&of.nodes.along[i]) - along, w = Simd::load(&of.nodes.across[i]) - across,
                r = Simd::load(&of.nodes.radius[i]) + radius;
    const Simd::Mask near =
        (m * m + w * w <= r * r) & (Simd::load(&of.nodes.z[i]) <= top) & (bottom <= Simd::load(&of.top[i]));
    count += Simd::compress_indices(Simd::bits(near), i, leaves + count);
  }
  while (count != 0 && leaves[count - 1] >= of.leaves) --count;
  return count;
}

template <class Intervals>
template <class Use>
void FreeSearch<Intervals>::visit(float moved, const Use& use) {
  const std::uint32_t rows = list(a_, b_, b_.leaves, -moved, leaves_a_.data());
  for (std::uint32_t i = 0; i < rows; ++i) {
    const std::uint32_t columns = list(b_, a_, leaves_a_[i], moved, leaves_b_.data());
    for (std::uint32_t j = 0; j < columns; ++j) use(leaves_a_[i], leaves_b_[j]);
  }
}

template <class Intervals>
template <class Use>
void FreeSearch<Intervals>::visit_elements(std::uint32_t leaf_a, std::uint32_t leaf_b, float moved,
                                           const Use& use) {
  const Float along(a_.nodes.along[leaf_a] + moved), across(a_.nodes.across[leaf_a]),
      radius(a_.nodes.radius[leaf_a] + node_slack_);
  const std::uint32_t first = b_.first(leaf_b);
  std::uint32_t count = 0;
  for (std::uint32_t j = 0; j < b_.leaf_size; j += Simd::width) {
    const FreeLanes b = b_.elements.load(first + j);
    const Float m = b.along - along, w = b.across - across, r = b.radius + radius;
    count += Simd::compress_indices(Simd::bits(m * m + w * w <= r * r), j, &slots_[count]);
  }
  for (std::uint32_t i = 0; i < count; ++i) use(first + slots_[i]);
}

template <class Intervals>
void FreeSearch<Intervals>::keep_sample(std::uint32_t leaf_a, std::uint32_t leaf_b) {
  const auto &a = a_.elements, &b = b_.elements;
  float deepest = 0;
  std::uint32_t of_a = 0, of_b = 0;
  visit_elements(leaf_a, leaf_b, 0, [&](std::uint32_t j) {
    for (std::uint32_t i = a_.first(leaf_a); i < a_.first(leaf_a + 1); ++i) {
      const float x = b.x[j] - a.x[i], y = b.y[j] - a.y[i], z = b.z[j] - a.z[i],
                  radius = a.radius[i] + b.radius[j];
      const float left = radius * radius - (x * x + y * y + z * z);
      if (left > deepest) deepest = left, of_a = i, of_b = j;
    }
  });
  if (deepest == 0) return;
  const auto copy = [at = samples_](auto& to, const auto& from, std::uint32_t i) {
    // Also into the lanes behind it, which belong to the next ones.
    for (std::uint32_t lane = at; lane < at + Simd::width; ++lane)
      to.set(lane, {from.x[i], from.y[i], from.z[i], from.radius[i], from.half_x[i], from.half_y[i]});
  };
  copy(sample_a_, a, of_a);
  copy(sample_b_, b, of_b);
  ++samples_;
}

template <class Intervals>
float FreeSearch<Intervals>::bound(float x, float y) {
  sample_a_.turn(x, y, samples_, margin_);
  sample_b_.turn(x, y, samples_, margin_);
  Float most(0.0f);
  for (std::uint32_t i = 0; i < samples_; i += Simd::width) {
    const Intervals of(sample_a_.load(i), sample_b_.load(i), margin_);
    most = Simd::select(of.holding(Float(0.0f)), xsimd::max(most, of.high), most);
  }
  return largest(most);
}

template <class Intervals>
float FreeSearch<Intervals>::leave(std::uint32_t leaf_a, std::uint32_t leaf_b, float place) {
  visit_elements(leaf_a, leaf_b, place, [&](std::uint32_t j) {
    const FreeLanes b = b_.elements.one(j);
    for (std::uint32_t i = a_.first(leaf_a); i < a_.first(leaf_a + 1); i += Simd::width) {
      const FreeLanes a = a_.elements.load(i);
      if constexpr (std::is_same_v<Intervals, FreeSegments>) {
        // Most are apart there, which the discs about them tell sooner.
        const Float m = b.along - a.along - Float(place), w = b.across - a.across,
                    r = a.radius + b.radius + Float(node_slack_);
        if (Simd::bits(m * m + w * w <= r * r) == 0) continue;
      }
      const Intervals of(a, b, margin_);
      const Simd::Mask holding = of.holding(Float(place));
      if (Simd::bits(holding) != 0) place = largest(Simd::select(holding, of.high, Float(place)));
    }
  });
  return place;
}

template <class Intervals>
float FreeSearch<Intervals>::next(float place) {
  visit(place, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) { place = leave(leaf_a, leaf_b, place); });
  return place;
}

template <class Intervals>
float FreeSearch<Intervals>::after_gap(float place) const {
  float begin = __builtin_inff(), end = place;
  visit_intervals([&](float m, float, float radius) { return m + radius >= place; },
                  [&](std::uint32_t, std::uint32_t, float low, float high) {
                    if (low >= place && low < begin) begin = low, end = high;
                  });
  return end;
}

template <class Intervals>
FreeTouch FreeSearch<Intervals>::touch(float place) const {
  float end = -__builtin_inff();
  std::uint32_t of_a = 0, of_b = 0;
  const auto keep_last = [&](std::uint32_t i, std::uint32_t j, float, float high) {
    if (high <= place && high > end) end = high, of_a = i, of_b = j;
  };
  const auto is_near = [&](float m, float w, float radius) {
    return (m - place) * (m - place) + w * w <= radius * radius;
  };
  visit_intervals(is_near, keep_last);
  // Most places are the end of an interval, of elements that are near there.
  if (end != place)
    visit_intervals([&](float m, float, float radius) { return m - radius <= place && m + radius >= end; },
                    keep_last);
  if (end == -__builtin_inff()) return {};
  return Intervals::touch(a_.elements.one(of_a), b_.elements.one(of_b), end, margin_);
}

template <class Intervals>
template <class MayCount, class Use>
void FreeSearch<Intervals>::visit_intervals(const MayCount& may_count, const Use& use) const {
  const auto visit_row = [&](std::uint32_t first, std::uint32_t j) {
    const FreeLanes b = b_.elements.one(j);
    for (std::uint32_t i = first; i < first + a_.leaf_size; i += Simd::width) {
      const Intervals of(a_.elements.load(i), b, margin_);
      float low[Simd::width], high[Simd::width];
      Simd::store(low, of.low);
      Simd::store(high, Simd::select(of.are_some, of.high, Float(-__builtin_inff())));
      for (std::uint32_t lane = 0; lane < Simd::width; ++lane)
        if (low[lane] <= high[lane]) use(i + lane, j, low[lane], high[lane]);
    }
  };
  const Rounds &a = a_.nodes, &b = b_.nodes;
  for (std::uint32_t i = 0; i < a_.leaves; ++i)
    for (std::uint32_t k = 0; k < b_.leaves; ++k) {
      const float radius = a.radius[i] + b.radius[k] + node_slack_, w = b.across[k] - a.across[i],
                  m = b.along[k] - a.along[i];
      if (w > radius || -w > radius || !may_count(m, w, radius)) continue;
      for (std::uint32_t j = b_.first(k); j < b_.first(k + 1); ++j) visit_row(a_.first(i), j);
    }
}

template class FreeSearch<FreeSpheres>;
template class FreeSearch<FreeSegments>;

}  // namespace bch::detail
