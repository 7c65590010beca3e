// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/animated_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "layout/base/rounding.hpp"
#include "layout/hierarchy/disc_box.hpp"

namespace bch::detail {
namespace {

double length(double x, double y, double z) noexcept {
  return std::sqrt(x * x + y * y + z * z);
}

double distance(const Sphere& a, const Sphere& b) noexcept {
  return length(double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z});
}

/// Returns a disc as a sphere: without a height, its centre is at 0 like all others.
Sphere sphere_of(const AnimatedChunk& chunk, std::size_t i) {
  const Disc& disc = chunk.keys[i];
  return {disc.x, disc.y, chunk.z.empty() ? 0 : chunk.z[i], disc.radius};
}

/// Returns the least power of two in which a tree over the discs of a chunk has numbers of 16 bits: the box of all discs is at most 92000
/// steps wide, so that the disc about it has a radius below 65100 of them; that of spheres 75600, so that it is below 65500.
double step_for(const AnimatedChunk& chunk) {
  double centre = 0, edge = 0;
  for (std::size_t i = 0; i < chunk.keys.size(); ++i) {
    const Sphere s = sphere_of(chunk, i);
    const double largest = double{std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)})};
    centre = std::max(centre, largest), edge = std::max(edge, largest + double{s.radius});
  }
  int exponent = 0;
  const double half = chunk.z.empty() ? 46000 : 37800;
  const bool is_power = std::frexp(std::max({centre / 32767, edge / half, 0x1p-60}), &exponent) == 0.5;
  return std::ldexp(1.0, is_power ? exponent - 1 : exponent);
}

/// Returns a sphere in steps, each number an integer, that holds a sphere.
Sphere rounded(const Sphere& s, double step) {
  const double x = std::round(double{s.x} / step), y = std::round(double{s.y} / step),
               z = std::round(double{s.z} / step);
  const double away = length(double{s.x} / step - x, double{s.y} / step - y, double{s.z} / step - z);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
          static_cast<float>(std::ceil((double{s.radius} / step + away) * (away > 0 ? 1 + 0x1p-48 : 1)))};
}

/// Holds the smallest box with sides along the axes that holds discs, or spheres.
struct SphereBox {
  bool in_space;
  double low[3] = {HUGE_VAL, HUGE_VAL, 0}, high[3] = {-HUGE_VAL, -HUGE_VAL, 0};

  explicit SphereBox(bool of_spheres) noexcept : in_space(of_spheres) {
    if (in_space) low[2] = HUGE_VAL, high[2] = -HUGE_VAL;
  }
  void add(const Sphere& s) noexcept {
    const double at[] = {s.x, s.y, s.z}, r = s.radius;
    for (int axis = 0; axis < (in_space ? 3 : 2); ++axis)
      low[axis] = std::min(low[axis], at[axis] - r), high[axis] = std::max(high[axis], at[axis] + r);
  }
  double middle(int axis) const noexcept { return (low[axis] + high[axis]) / 2; }
  double size() const noexcept { return length(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
};

/// Where a range of discs falls into two, and what that costs: the sizes of both parts, times their discs.
struct Split {
  std::vector<std::uint32_t> order;
  std::size_t first = 0;
  double cost = HUGE_VAL;
};

std::size_t quotient_up(std::size_t number, std::size_t divisor) {
  return (number + divisor - 1) / divisor;
}

/// In steps.
class Builder {
 public:
  explicit Builder(const AnimatedChunk& chunk) : chunk_(chunk) {
    tree_.times = chunk.times;
    tree_.step = step_for(chunk);
    tree_.in_space = !chunk.z.empty();
    tree_.leaf_of_disc.resize(chunk.disc_count);
    discs_.reserve(chunk.keys.size());
    for (std::size_t i = 0; i < chunk.keys.size(); ++i)
      discs_.push_back(rounded(sphere_of(chunk, i), tree_.step));
    const std::size_t keys = chunk.times.size(), sample_count = std::min<std::size_t>(keys, max_keys);
    for (std::size_t i = 0; i < sample_count; ++i)
      sampled_keys_.push_back(i * (keys - 1) / (sample_count - 1));
  }

  AnimatedTreeChunk build() {
    std::vector<std::uint32_t> all(chunk_.disc_count);
    std::iota(all.begin(), all.end(), 0u);
    std::size_t most = 1;  // below a node of the level
    while (most < all.size()) most *= animated_width;
    std::vector<std::vector<std::uint32_t>> level = {std::move(all)};
    for (; most > 1; most /= animated_width) level = divide(std::move(level), most / animated_width);
    for (const std::vector<std::uint32_t>& leaf : level) {
      tree_.leaf_of_disc[leaf[0]] = static_cast<std::uint16_t>(discs_of_node_.size());
      discs_of_node_.push_back(leaf);
    }
    tree_.child_begin.push_back(static_cast<std::uint16_t>(discs_of_node_.size()));
    place_discs();
    find_speed();
    return std::move(tree_);
  }

 private:
  static constexpr std::size_t max_keys = 8;  ///< that a split examines

  const Sphere& disc(std::size_t key, std::uint32_t i) const { return discs_[key * chunk_.disc_count + i]; }

  /// Keeps what the nodes of a level hold, and returns those of the next one, each of which holds so many discs at most.
  std::vector<std::vector<std::uint32_t>> divide(std::vector<std::vector<std::uint32_t>> level,
                                                 std::size_t most) {
    std::vector<std::vector<std::uint32_t>> below;
    const std::size_t end = discs_of_node_.size() + level.size();
    for (std::vector<std::uint32_t>& discs : level) {
      tree_.child_begin.push_back(static_cast<std::uint16_t>(end + below.size()));
      discs_of_node_.push_back(discs);
      const std::size_t parts = parts_of(discs.size(), most);
      divide_into(parts, most, std::move(discs), below);
    }
    return below;
  }

  /// Returns into how many children a node falls: about as many as those below it do.
  static std::size_t parts_of(std::size_t discs, std::size_t most) {
    constexpr std::size_t discs_of_last = 7;  // a child left free, where they fall apart unevenly
    std::size_t parts = 1;
    if (most == 1) return discs;
    if (most == animated_width)
      return std::min<std::size_t>(quotient_up(discs, discs_of_last), animated_width);
    while (parts * parts * discs_of_last < discs) ++parts;
    return std::clamp<std::size_t>(parts, quotient_up(discs, most), animated_width);
  }

  void divide_into(std::size_t parts, std::size_t most, std::vector<std::uint32_t> discs,
                   std::vector<std::vector<std::uint32_t>>& below) const {
    if (parts == 1 || discs.size() == 1) return below.push_back(std::move(discs));
    const Split split = best_split(discs, parts, most);
    const std::size_t count = split.order.size(), first = split.first;
    const std::size_t parts_of_first =
        std::clamp((parts * first + count / 2) / count, std::max<std::size_t>(1, quotient_up(first, most)),
                   parts - quotient_up(count - first, most));
    const auto middle = split.order.begin() + static_cast<std::ptrdiff_t>(first);
    divide_into(parts_of_first, most, {split.order.begin(), middle}, below);
    divide_into(parts - parts_of_first, most, {middle, split.order.end()}, below);
  }

  /// Returns a small disc that holds discs: its centre goes from the middle of their box towards the farthest one, by less and less
  /// (Badoiu, Clarkson 2003).
  Sphere disc_about(std::size_t key, std::span<const std::uint32_t> discs) const {
    if (discs.size() == 1) return disc(key, discs[0]);
    SphereBox box(tree_.in_space);
    for (const std::uint32_t i : discs) box.add(disc(key, i));
    double x = box.middle(0), y = box.middle(1), z = box.middle(2), least = HUGE_VAL;
    Sphere best;
    for (int step = 4; step < 16; ++step) {
      const Sphere centre{static_cast<float>(std::round(x)), static_cast<float>(std::round(y)),
                          static_cast<float>(std::round(z)), 0};
      double radius = 0, away = 0;
      const Sphere* farthest = nullptr;
      for (const std::uint32_t i : discs) {
        const Sphere& each = disc(key, i);
        const double to_centre = distance(each, centre), to_edge = to_centre + double{each.radius};
        if (to_edge <= radius && farthest != nullptr) continue;
        radius = to_edge, away = to_centre, farthest = &each;
      }
      if (radius < least) least = radius, best = centre;
      if (away == 0) break;
      // As far as the farthest point of that disc draws it, towards which its centre lies.
      const double fraction = radius / away / step;
      x += (double{farthest->x} - x) * fraction, y += (double{farthest->y} - y) * fraction;
      z += (double{farthest->z} - z) * fraction;
    }
    best.radius = static_cast<float>(std::ceil(least * (1 + 0x1p-48)));
    return best;
  }

  /// Splits discs in their order, or sorted along an axis.
  Split best_split(std::span<const std::uint32_t> discs, std::size_t parts, std::size_t most) const {
    Split best;
    try_order({discs.begin(), discs.end()}, parts, most, best);
    for (float Sphere::*const axis : {&Sphere::x, &Sphere::y, &Sphere::z}) {
      if (axis == &Sphere::z && !tree_.in_space) continue;
      std::vector<std::uint32_t> order(discs.begin(), discs.end());
      std::vector<double> along(chunk_.disc_count, 0.0);
      for (const std::uint32_t i : discs)
        for (const std::size_t key : sampled_keys_) along[i] += double{disc(key, i).*axis};
      std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return along[a] != along[b] ? along[a] < along[b] : a < b;
      });
      try_order(std::move(order), parts, most, best);
    }
    return best;
  }

  /// Each part of a split must have room in some of the nodes that there will be.
  void try_order(std::vector<std::uint32_t> order, std::size_t parts, std::size_t most, Split& best) const {
    const std::size_t count = order.size();
    std::vector<double> cost(count, 0.0);  // of a split before each
    for (const std::size_t key : sampled_keys_) {
      SphereBox first(tree_.in_space), rest = first;
      for (std::size_t i = 1; i < count; ++i) {
        first.add(disc(key, order[i - 1])), rest.add(disc(key, order[count - i]));
        cost[i] += first.size() * static_cast<double>(i);
        cost[count - i] += rest.size() * static_cast<double>(i);
      }
    }
    std::size_t least = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (quotient_up(i, most) + quotient_up(count - i, most) <= parts &&
          (least == 0 || cost[i] < cost[least]))
        least = i;
    if (cost[least] < best.cost) best = {std::move(order), least, cost[least]};
  }

  void place_discs() {
    const std::size_t keys = chunk_.times.size(), nodes = discs_of_node_.size(),
                      fields = tree_.in_space ? 4 : 3;
    tree_.numbers.resize(fields * keys * nodes + animated_width);
    for (std::size_t key = 0; key < keys; ++key)
      for (std::size_t i = 0; i < nodes; ++i) {
        const Sphere disc = disc_about(key, discs_of_node_[i]);
        std::uint16_t* const x = tree_.numbers.data() + fields * key * nodes + i;
        const auto as_bits = [](float steps) {
          return static_cast<std::uint16_t>(static_cast<std::int16_t>(steps));
        };
        x[0] = as_bits(disc.x), x[nodes] = as_bits(disc.y);
        x[2 * nodes] = static_cast<std::uint16_t>(disc.radius);
        if (tree_.in_space) x[3 * nodes] = as_bits(disc.z);
      }
  }

  void find_speed() {
    for (std::size_t key = 1; key < chunk_.times.size(); ++key)
      for (std::uint32_t i = 0; i < tree_.nodes(); ++i) {
        const Disc from = tree_.disc(key - 1, i), to = tree_.disc(key, i);
        const double distance = detail::length(double{to.x} - double{from.x}, double{to.y} - double{from.y});
        tree_.speed = std::max(tree_.speed, rounding::round_up(distance * (1 + 0x1p-40) /
                                                               (tree_.times[key] - tree_.times[key - 1])));
      }
  }

  const AnimatedChunk& chunk_;
  AnimatedTreeChunk tree_;
  std::vector<Sphere> discs_;  ///< those of the keys
  std::vector<std::size_t> sampled_keys_;
  std::vector<std::vector<std::uint32_t>> discs_of_node_;  ///< per node: its discs
};

}  // namespace

AnimatedTreeChunk animated_tree_chunk(const AnimatedChunk& chunk) {
  return Builder(chunk).build();
}

KeyPlace key_place(const AnimatedTree& tree, double seconds) noexcept {
  const auto& chunks = tree.chunks;
  const auto begun = [&](const AnimatedTreeChunk& chunk) { return chunk.times.front() <= seconds; };
  const auto next = std::partition_point(chunks.begin() + 1, chunks.end(), begun);
  const std::vector<double>& times = next[-1].times;
  const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, seconds);
  const double from = after[-1], to = *after;
  return {static_cast<std::size_t>(next - chunks.begin() - 1),
          static_cast<std::size_t>(after - times.begin() - 1),
          std::clamp((seconds - from) / (to - from), 0.0, 1.0)};
}

double time_in_clip(const AnimatedTree& tree, double seconds) noexcept {
  if (!tree.loops) return seconds;
  return seconds - std::floor((seconds - tree.begin()) / tree.length()) * tree.length();
}

}  // namespace bch::detail
