// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <bch/crowd.hpp>

#include "bench/ratios/ratios.hpp"
#include "layout/base/heading.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t body_count = 150;
constexpr double pressed_density = 5;  ///< a square metre

/// Five discs across a body: the trunk, the shoulders and the arms.
constexpr Disc five_discs[] = {
    {0, 0, 0.12f}, {0, 0.12f, 0.1f}, {0, -0.12f, 0.1f}, {0, 0.2f, 0.07f}, {0, -0.2f, 0.07f}};

/// The numbers of two bodies, and of a disc of each.
using Touch = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

/// A crowd for a mechanical model, whose bodies are of discs.
struct Bodies {
  ShapeSet set{std::vector<Shape>(1, shape_from_discs(five_discs))};
  cli::Crowd crowd = cli::place_crowd(body_count, pressed_density, 1, crowd_seed);
  bch::Crowd finder;
  std::vector<Vec2> centres;
  std::vector<Touch> touches;

  bch::Crowd::Contacts find() { return finder.contacts(set, crowd.agents()); }

  /// What a model without a library does: places all discs, then compares those of all pairs of bodies.
  void loop() {
    const Agents agents = crowd.agents();
    centres.clear(), touches.clear();
    for (std::uint32_t i = 0; i < body_count; ++i) {
      const auto [c, s] = detail::rotation(agents.heading[i]);
      for (const Disc& disc : five_discs) {
        const double x = disc.x, y = disc.y;
        centres.push_back({static_cast<float>(agents.x[i] + c * x - s * y),
                           static_cast<float>(agents.y[i] + s * x + c * y)});
      }
    }
    constexpr std::uint32_t discs = std::size(five_discs);
    for (std::uint32_t a = 0; a < body_count; ++a)
      for (std::uint32_t b = a + 1; b < body_count; ++b)
        for (std::uint32_t i = 0; i < discs; ++i)
          for (std::uint32_t j = 0; j < discs; ++j) {
            const Vec2 p = centres[a * discs + i], q = centres[b * discs + j];
            const float x = q.x - p.x, y = q.y - p.y, sum = five_discs[i].radius + five_discs[j].radius;
            if (x * x + y * y <= sum * sum) touches.emplace_back(a, b, i, j);
          }
  }

  /// Compares what both find: the same, but for discs that just touch.
  void require_same() {
    loop();
    std::vector<Touch> found, missing;
    const bch::Crowd::Contacts all = find();
    for (std::size_t k = 0; k < all.pairs.size(); ++k)
      for (const auto& [first, second] : all.contacts[k])
        found.emplace_back(all.pairs[k].first, all.pairs[k].second, first, second);
    std::ranges::sort(found);
    std::ranges::set_difference(touches, found, std::back_inserter(missing));
    if (!missing.empty() || found.size() > touches.size() + 2)
      throw std::runtime_error(
          fmt::format("bodies: {} contacts where a loop finds {}", found.size(), touches.size()));
  }
};

}  // namespace

void add_bodies() {
  const auto shared = once([] { return std::make_shared<Bodies>(); });
  add("bodies/contacts", [shared]() -> Contender {
    Bodies& all = shared();
    all.require_same();
    return {[&all] { all.find(); }, 1, {{"contacts", static_cast<double>(all.touches.size())}}};
  });
  add("bodies/loop", [shared]() -> Contender { return {[&all = shared()] { all.loop(); }}; });
}

}  // namespace bch::bench
