// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_search.hpp"

#include <algorithm>

#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;
using Float = Simd::Float;
static_assert(Simd::width == 4, "leaves have whole registers");

/// Holds spheres side by side, as FreeSearch has them.
struct Spheres {
  Float along, across, z, radius;
};

template <class Rounds>
Spheres load(const Rounds& from, std::uint32_t i) noexcept {
  return {Simd::load(&from.along[i]), Simd::load(&from.across[i]), Simd::load(&from.z[i]),
          Simd::load(&from.radius[i])};
}

/// Holds the places at which spheres overlap, in the lanes where they do so anywhere.
struct Intervals {
  Float low, high;
  Simd::Mask are_some;

  Intervals(const Spheres& a, const Spheres& b) noexcept : are_some(false) {
    const Float m = b.along - a.along, w = b.across - a.across, z = b.z - a.z, radius = a.radius + b.radius;
    const Float left = radius * radius - (w * w + z * z);
    const Float s = xsimd::sqrt(xsimd::max(left, Float(0.0f)));
    low = m - s, high = m + s, are_some = left > Float(0.0f);
  }
  Simd::Mask holding(Float place) const noexcept { return are_some & (low < place) & (place < high); }
};

float largest(Float values) noexcept {
  return -Simd::least(-values);
}

}  // namespace

template <std::uint32_t most>
void FreeSearch::Rounds<most>::turn(float to_x, float to_y, std::uint32_t count) {
  const Float ex(to_x), ey(to_y);
  for (std::uint32_t i = 0; i < count; i += Simd::width) {
    const Float at_x = Simd::load(&x[i]), at_y = Simd::load(&y[i]);
    Simd::store(&along[i], at_x * ex + at_y * ey);
    Simd::store(&across[i], at_x * ey - at_y * ex);
  }
}

template <class Placed>
void FreeSearch::Body::take(const float* record, const Placed& placed, float grown) {
  leaves = header_of(record).leaf_count, leaf_size = header_of(record).leaf_size;
  for (std::uint32_t i = 0; i <= leaves; ++i) {
    const Cylinder node = placed(i < leaves ? node_of(record, i) : whole_of(record));
    nodes.x[i] = static_cast<float>(node.x), nodes.y[i] = static_cast<float>(node.y);
    nodes.radius[i] = static_cast<float>(node.radius);
    nodes.z[i] = static_cast<float>(node.bottom), top[i] = static_cast<float>(node.top);
  }
  for (std::uint32_t slot = 0; slot < first(leaves); ++slot) {
    const Sphere sphere = placed(sphere_of(record, slot));
    spheres.x[slot] = sphere.x, spheres.y[slot] = sphere.y, spheres.z[slot] = sphere.z;
    spheres.radius[slot] = sphere.radius + grown;
  }
}

void FreeSearch::Body::turn(float x, float y) {
  nodes.turn(x, y, leaves + 1);
  spheres.turn(x, y, first(leaves));
}

void FreeSearch::begin(const float* a, const float* b, const SpaceFrame& frame) {
  const double reaches = double{header_of(a).reach} + double{header_of(b).reach};
  // Nodes in float, their products, and what spheres grow by.
  node_slack_ = rounding::round_up((rounding::bound_margin + 2 * slack) * reaches);
  const auto unmoved = [](const auto& of_a) { return of_a; };
  const auto placed = [&](const auto& of_b) { return frame.placed(of_b); };
  a_.take(a, unmoved, rounding::round_up(slack * reaches));
  b_.take(b, placed, 0);
  turn(1, 0);
  overlapping_.clear();
  visit(0, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) { overlapping_.push_back({leaf_a, leaf_b}); });
  samples_ = 0;
  const std::size_t step = overlapping_.size() / max_samples + 1;
  for (std::size_t i = 0; i < overlapping_.size(); i += step)
    keep_sample(overlapping_[i].of_a, overlapping_[i].of_b);
}

void FreeSearch::turn(float x, float y) {
  a_.turn(x, y);
  b_.turn(x, y);
}

std::uint32_t FreeSearch::list(const Body& of, const Body& other, std::uint32_t node, float moved,
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

template <class Use>
void FreeSearch::visit(float moved, const Use& use) {
  const std::uint32_t rows = list(a_, b_, b_.leaves, -moved, leaves_a_.data());
  for (std::uint32_t i = 0; i < rows; ++i) {
    const std::uint32_t columns = list(b_, a_, leaves_a_[i], moved, leaves_b_.data());
    for (std::uint32_t j = 0; j < columns; ++j) use(leaves_a_[i], leaves_b_[j]);
  }
}

template <class Use>
void FreeSearch::visit_spheres(std::uint32_t leaf_a, std::uint32_t leaf_b, float moved,
                               const Use& use) const {
  const Float along(a_.nodes.along[leaf_a] + moved), across(a_.nodes.across[leaf_a]),
      radius(a_.nodes.radius[leaf_a] + node_slack_);
  std::array<std::uint16_t, 8 + Simd::width> slots;
  std::uint32_t count = 0;
  for (std::uint32_t j = b_.first(leaf_b); j < b_.first(leaf_b + 1); j += Simd::width) {
    const Spheres b = load(b_.spheres, j);
    const Float m = b.along - along, w = b.across - across, r = b.radius + radius;
    count += Simd::compress_indices(Simd::bits(m * m + w * w <= r * r), j, &slots[count]);
  }
  for (std::uint32_t i = 0; i < count; ++i) use(slots[i]);
}

void FreeSearch::keep_sample(std::uint32_t leaf_a, std::uint32_t leaf_b) {
  const auto &a = a_.spheres, &b = b_.spheres;
  float deepest = 0;
  std::uint32_t of_a = 0, of_b = 0;
  visit_spheres(leaf_a, leaf_b, 0, [&](std::uint32_t j) {
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
      to.x[lane] = from.x[i], to.y[lane] = from.y[i], to.z[lane] = from.z[i],
      to.radius[lane] = from.radius[i];
  };
  copy(sample_a_, a, of_a);
  copy(sample_b_, b, of_b);
  ++samples_;
}

float FreeSearch::bound(float x, float y) {
  sample_a_.turn(x, y, samples_);
  sample_b_.turn(x, y, samples_);
  Float most(0.0f);
  for (std::uint32_t i = 0; i < samples_; i += Simd::width) {
    const Intervals of(load(sample_a_, i), load(sample_b_, i));
    most = Simd::select(of.holding(Float(0.0f)), xsimd::max(most, of.high), most);
  }
  return largest(most);
}

float FreeSearch::leave(std::uint32_t leaf_a, std::uint32_t leaf_b, float place) const {
  visit_spheres(leaf_a, leaf_b, place, [&](std::uint32_t j) {
    const Spheres b{Float(b_.spheres.along[j]), Float(b_.spheres.across[j]), Float(b_.spheres.z[j]),
                    Float(b_.spheres.radius[j])};
    for (std::uint32_t i = a_.first(leaf_a); i < a_.first(leaf_a + 1); i += Simd::width) {
      const Intervals of(load(a_.spheres, i), b);
      const Simd::Mask holding = of.holding(Float(place));
      if (Simd::bits(holding) != 0) place = largest(Simd::select(holding, of.high, Float(place)));
    }
  });
  return place;
}

float FreeSearch::next(float place) {
  visit(place, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) { place = leave(leaf_a, leaf_b, place); });
  return place;
}

}  // namespace bch::detail
