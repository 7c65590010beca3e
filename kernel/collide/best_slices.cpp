// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/collide.hpp>

#include "layout/base/planes.hpp"
#include "layout/base/random.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::uint32_t sample = 4000;  ///< pairs of bodies
constexpr std::uint64_t seed = 26;

/// The slabs of two bodies that overlap, from the lower of the two to the higher: a plane between them parts these.
struct Span {
  std::uint32_t low, high;
};
/// What keeps two bodies apart that no slab of both holds: planes in all of these.
using Spans = std::vector<Span>;

bool is_cut(Span span, std::span<const std::uint32_t> chosen) {
  return std::any_of(chosen.begin(), chosen.end(),
                     [&](std::uint32_t plane) { return span.low <= plane && plane < span.high; });
}

std::size_t cleared(std::span<const Spans> pairs, std::span<const std::uint32_t> chosen) {
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [&](const Spans& spans) {
    return std::all_of(spans.begin(), spans.end(), [&](Span span) { return is_cut(span, chosen); });
  }));
}

/// Puts the plane into a place of `chosen` that clears most.
void choose(std::span<const Spans> pairs, std::size_t planes, std::size_t place,
            std::vector<std::uint32_t>& chosen) {
  std::uint32_t best = chosen[place];
  std::size_t most = cleared(pairs, chosen);
  for (std::uint32_t plane = 0; plane < planes; ++plane) {
    chosen[place] = plane;
    if (const std::size_t clears = cleared(pairs, chosen); clears > most) most = clears, best = plane;
  }
  chosen[place] = best;
}

/// Takes out planes without which the others clear as much.
void remove_idle(std::span<const Spans> pairs, std::vector<std::uint32_t>& chosen) {
  for (std::size_t i = chosen.size(); i-- > 0;) {
    std::vector<std::uint32_t> others = chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (cleared(pairs, others) == cleared(pairs, chosen)) chosen = std::move(others);
  }
}

/// Bodies slab by slab, each slab as a shape of its own.
class Sample {
 public:
  Sample(std::span<const Shape> bodies, std::size_t slabs) : slabs_(slabs), bodies_(bodies.size()) {
    std::vector<Shape> parts;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].slabs.size() != slabs)
        throw std::invalid_argument("best slices: body " + std::to_string(i) + " has " +
                                    std::to_string(bodies[i].slabs.size()) + " slabs, not " +
                                    std::to_string(slabs));
      for (const Shape& slab : bodies[i].slabs) {
        part_.push_back(slab.hierarchy.nodes.empty() ? none : static_cast<std::uint32_t>(parts.size()));
        if (slab.hierarchy.nodes.empty()) continue;
        parts.push_back(slab);
        reach_ = std::max(reach_, slab.hierarchy.reach);
      }
    }
    set_.emplace(parts);
  }

  /// Places two bodies at random. Returns where slabs of theirs overlap; nothing where they do not, or in the same slab.
  Spans draw(Random& random) {
    const auto any_body = [&] { return static_cast<std::uint32_t>(random.next() % bodies_); };
    const std::uint32_t a = any_body(), b = any_body();
    const double angle = random.uniform(2 * std::numbers::pi),
                 distance = 2 * reach_ * std::sqrt(random.uniform(1));
    const double x = distance * std::cos(angle), y = distance * std::sin(angle);
    const double turn_a = random.uniform(2 * std::numbers::pi), turn_b = random.uniform(2 * std::numbers::pi);
    shape_.clear(), x_.clear(), y_.clear(), heading_.clear(), pairs_.clear(), spans_.clear();
    const auto add = [&](std::uint32_t body, double at_x, double at_y, double heading) {
      for (std::size_t slab = 0; slab < slabs_; ++slab) {
        const std::uint32_t part = part_[body * slabs_ + slab];
        shape_.push_back(part == none ? 0 : part), x_.push_back(at_x), y_.push_back(at_y),
            heading_.push_back(heading);
      }
    };
    add(a, 0, 0, turn_a), add(b, x, y, turn_b);
    for (std::uint32_t i = 0; i < slabs_; ++i)
      for (std::uint32_t j = 0; j < slabs_; ++j)
        if (part_[a * slabs_ + i] != none && part_[b * slabs_ + j] != none) {
          pairs_.push_back({i, static_cast<std::uint32_t>(slabs_ + j)});
          spans_.push_back({std::min(i, j), std::max(i, j)});
        }
    hits_.resize(pairs_.size());
    collide(*set_, {shape_, x_, y_, heading_}, pairs_, hits_);
    Spans found;
    for (std::size_t k = 0; k < hits_.size(); ++k) {
      if (hits_[k] == 0) continue;
      if (spans_[k].low == spans_[k].high) return {};
      found.push_back(spans_[k]);
    }
    return found;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  std::size_t slabs_, bodies_;
  std::vector<std::uint32_t> part_;
  double reach_ = 0;
  std::optional<ShapeSet> set_;
  std::vector<std::uint32_t> shape_;
  std::vector<double> x_, y_, heading_;
  std::vector<Pair> pairs_;
  Spans spans_;
  std::vector<std::uint8_t> hits_;
};

}  // namespace

std::vector<float> best_slices(std::span<const Shape> bodies, std::span<const float> planes,
                               std::uint32_t slabs) {
  require_planes(planes);
  if (bodies.empty()) throw std::invalid_argument("best slices: no bodies");
  if (slabs == 0) throw std::invalid_argument("best slices: no slabs");
  if (slabs > planes.size()) return {planes.begin(), planes.end()};
  Sample from(bodies, planes.size() + 1);
  Random random(seed);
  std::vector<Spans> pairs;
  for (std::uint32_t i = 0; i < sample; ++i)
    if (Spans spans = from.draw(random); !spans.empty()) pairs.push_back(std::move(spans));

  std::vector<std::uint32_t> chosen;
  while (chosen.size() + 1 < slabs) {
    chosen.push_back(static_cast<std::uint32_t>(planes.size() / 2));
    choose(pairs, planes.size(), chosen.size() - 1, chosen);
  }
  for (std::size_t before = 0, now = cleared(pairs, chosen) + 1; now > before;
       now = cleared(pairs, chosen) + 1) {
    before = now;
    for (std::size_t place = 0; place < chosen.size(); ++place) choose(pairs, planes.size(), place, chosen);
  }
  remove_idle(pairs, chosen);
  std::sort(chosen.begin(), chosen.end());
  std::vector<float> best;
  best.reserve(chosen.size());
  for (const std::uint32_t plane : chosen) best.push_back(planes[plane]);
  return best;
}

}  // namespace bch
