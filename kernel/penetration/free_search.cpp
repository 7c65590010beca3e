// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_search.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace bch::detail {
static_assert(FreeIntervals::Simd::width == 4, "leaves have whole registers");

void FreeBound::add(const FreeElement& a, const FreeElement& b) noexcept {
  const float z = b.z - a.z, radius = a.radius + b.radius;
  // Also into the lanes behind it, which belong to the next ones.
  for (std::uint32_t lane = count_; lane < count_ + Simd::width; ++lane)
    x_[lane] = b.x - a.x, y_[lane] = b.y - a.y, left_[lane] = radius * radius - z * z;
  ++count_;
}

float FreeBound::place(float x, float y) const noexcept {
  Float low[registers], high[registers];
  const Float ex(x), ey(y), none(0.0f);
  const std::uint32_t used = (count_ + Simd::width - 1) / Simd::width;
  for (std::uint32_t k = 0; k < used; ++k) {
    const Float dx = Simd::load(x_ + k * Simd::width), dy = Simd::load(y_ + k * Simd::width);
    const Float m = dx * ex + dy * ey, w = dx * ey - dy * ex,
                left = Simd::load(left_ + k * Simd::width) - w * w;
    const Float s = xsimd::sqrt(xsimd::max(left, none));
    low[k] = m - s, high[k] = Simd::select(left > none, m + s, none);
  }
  for (float place = 0;;) {
    Float most(place);
    for (std::uint32_t k = 0; k < used; ++k)
      most = Simd::select(low[k] < most, xsimd::max(most, high[k]), most);
    const float next = FreeIntervals::largest(most);
    if (next == place) return place;
    place = next;
  }
}

template <class Intervals>
void FreeSearch<Intervals>::Rounds::resize(std::size_t count) {
  float** const columns[] = {&x,      &y,     &z,      &radius,     &half_x,      &half_y,
                             &half_z, &along, &across, &half_along, &half_across, &slope};
  memory.resize(std::size(columns) * (count + padding));
  for (std::size_t i = 0; i < std::size(columns); ++i) *columns[i] = memory.data() + i * (count + padding);
}

template <class Intervals>
void FreeSearch<Intervals>::Rounds::set(std::size_t at, const FreeElement& element) {
  x[at] = element.x, y[at] = element.y, z[at] = element.z, radius[at] = element.radius;
  half_x[at] = element.half_x, half_y[at] = element.half_y, half_z[at] = element.half_z;
}

template <class Intervals>
FreeElement FreeSearch<Intervals>::Rounds::element(std::uint32_t i) const {
  return {x[i], y[i], z[i], radius[i], half_x[i], half_y[i], half_z[i]};
}

template <class Intervals>
void FreeSearch<Intervals>::Rounds::turn(float to_x, float to_y, std::uint32_t count, float margin) {
  const Float ex(to_x), ey(to_y);
  for (std::uint32_t i = 0; i < count; i += Simd::width) {
    const Float at_x = Simd::load(&x[i]), at_y = Simd::load(&y[i]);
    Simd::store(&along[i], at_x * ex + at_y * ey);
    Simd::store(&across[i], at_x * ey - at_y * ex);
    if constexpr (!std::is_same_v<Intervals, FreeSpheres>) {
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
          Simd::load(&half_z[i]), Simd::load(&slope[i])};
}

template <class Intervals>
FreeLanes FreeSearch<Intervals>::Rounds::one(std::uint32_t i) const noexcept {
  return {Float(along[i]),      Float(across[i]),      Float(z[i]),      Float(radius[i]),
          Float(half_along[i]), Float(half_across[i]), Float(half_z[i]), Float(slope[i])};
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
void FreeSearch<Intervals>::sample(FreeBound& to) {
  turn(1, 0);
  overlapping_.clear();
  visit(0, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) { overlapping_.push_back({leaf_a, leaf_b}); });
  const std::size_t step = overlapping_.size() / FreeBound::capacity + 1;
  for (std::size_t i = 0; i < overlapping_.size(); i += step)
    add_sample(overlapping_[i].of_a, overlapping_[i].of_b, to);
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
std::uint32_t FreeSearch<Intervals>::list_elements(std::uint32_t leaf_a, std::uint32_t leaf_b, float moved) {
  const Float along(a_.nodes.along[leaf_a] + moved), across(a_.nodes.across[leaf_a]),
      radius(a_.nodes.radius[leaf_a] + node_slack_);
  const std::uint32_t first = b_.first(leaf_b);
  std::uint32_t count = 0;
  for (std::uint32_t j = 0; j < b_.leaf_size; j += Simd::width) {
    const Float m = Simd::load(&b_.elements.along[first + j]) - along,
                w = Simd::load(&b_.elements.across[first + j]) - across,
                r = Simd::load(&b_.elements.radius[first + j]) + radius;
    count += Simd::compress_indices(Simd::bits(m * m + w * w <= r * r), j, &slots_[count]);
  }
  return count;
}

template <class Intervals>
void FreeSearch<Intervals>::add_sample(std::uint32_t leaf_a, std::uint32_t leaf_b, FreeBound& to) {
  const auto &a = a_.elements, &b = b_.elements;
  float deepest = 0;
  std::uint32_t of_a = 0, of_b = 0;
  const std::uint32_t count = list_elements(leaf_a, leaf_b, 0);
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    const std::uint32_t j = b_.first(leaf_b) + slots_[slot];
    for (std::uint32_t i = a_.first(leaf_a); i < a_.first(leaf_a + 1); ++i) {
      const float x = b.x[j] - a.x[i], y = b.y[j] - a.y[i], z = b.z[j] - a.z[i],
                  radius = a.radius[i] + b.radius[j];
      const float left = radius * radius - (x * x + y * y + z * z);
      if (left > deepest) deepest = left, of_a = i, of_b = j;
    }
  }
  if (deepest > 0) to.add(a.element(of_a), b.element(of_b));
}

template <class Intervals>
float FreeSearch<Intervals>::leave(std::uint32_t leaf_a, std::uint32_t leaf_b, float place) {
  const Rounds &a = a_.elements, &b = b_.elements;
  const std::uint32_t first = a_.first(leaf_a), end = a_.first(leaf_a + 1),
                      count = list_elements(leaf_a, leaf_b, place);
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    const std::uint32_t j = b_.first(leaf_b) + slots_[slot];
    const Float along(b.along[j]), across(b.across[j]), radius(b.radius[j] + node_slack_);
    for (std::uint32_t i = first; i < end; i += Simd::width) {
      // Most are apart there, which the discs about them tell sooner.
      const Float m = along - Simd::load(&a.along[i]) - Float(place), w = across - Simd::load(&a.across[i]),
                  r = Simd::load(&a.radius[i]) + radius;
      if (Simd::bits(m * m + w * w <= r * r) != 0) place = leave_lanes(i, j, place);
    }
  }
  return place;
}

template <class Intervals>
float FreeSearch<Intervals>::leave_lanes(std::uint32_t i, std::uint32_t j, float place) const {
  const Intervals of(a_.elements.load(i), b_.elements.one(j), margin_);
  const Simd::Mask holding = of.holding(Float(place));
  if (Simd::bits(holding) == 0) return place;
  return FreeIntervals::largest(Simd::select(holding, of.high, Float(place)));
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
template class FreeSearch<FreeWalls>;

}  // namespace bch::detail
