// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <bch/contacts.hpp>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/contender.hpp"
#include "bench/workload/scene.hpp"
#include "layout/base/heading.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t bodies = 150;
constexpr double pressed_density = 5;  ///< a square metre
constexpr double most_step_us = 10, needed_over_loop = 20;

/// Five discs across a body: the trunk, the shoulders and the arms.
constexpr Disc five_discs[] = {
    {0, 0, 0.12f}, {0, 0.12f, 0.1f}, {0, -0.12f, 0.1f}, {0, 0.2f, 0.07f}, {0, -0.2f, 0.07f}};

/// Two bodies and their discs.
struct Touch {
  Pair bodies;
  DiscPair discs;
};

/// A crowd for a mechanical model, whose bodies are of discs.
struct Bodies {
  ShapeSet set{std::vector<Shape>(1, shape_from_discs(five_discs))};
  cli::Crowd crowd = cli::place_crowd(bodies, pressed_density, 1, crowd_seed);
  ContactFinder finder;
  std::vector<Vec2> centres;
  std::vector<Touch> touches;

  CrowdContacts find() { return finder.find_all(set, crowd.agents()); }

  /// What a model without a library does: places all discs, then compares those of all pairs of bodies.
  void loop() {
    const Agents agents = crowd.agents();
    centres.clear(), touches.clear();
    for (std::uint32_t i = 0; i < bodies; ++i) {
      const auto [c, s] = detail::rotation(agents.heading[i]);
      for (const Disc& disc : five_discs) {
        const double x = disc.x, y = disc.y;
        centres.push_back({static_cast<float>(agents.x[i] + c * x - s * y),
                           static_cast<float>(agents.y[i] + s * x + c * y)});
      }
    }
    constexpr std::uint32_t discs = std::size(five_discs);
    for (std::uint32_t a = 0; a < bodies; ++a)
      for (std::uint32_t b = a + 1; b < bodies; ++b)
        for (std::uint32_t i = 0; i < discs; ++i)
          for (std::uint32_t j = 0; j < discs; ++j) {
            const Vec2 p = centres[a * discs + i], q = centres[b * discs + j];
            const float x = q.x - p.x, y = q.y - p.y, sum = five_discs[i].radius + five_discs[j].radius;
            if (x * x + y * y <= sum * sum) touches.push_back({{a, b}, {i, j}});
          }
  }

  /// Compares what both find: a list sorted in the same way, but for discs that just touch.
  void require_same() {
    loop();
    std::vector<Touch> found;
    const CrowdContacts all = find();
    for (std::size_t k = 0; k < all.pairs.size(); ++k)
      for (const DiscPair& discs : all.contacts[k]) found.push_back({all.pairs[k], discs});
    const auto key = [](const Touch& touch) {
      return std::array{touch.bodies.first, touch.bodies.second, touch.discs.first, touch.discs.second};
    };
    const auto is_before = [&](const Touch& a, const Touch& b) { return key(a) < key(b); };
    std::sort(found.begin(), found.end(), is_before);
    std::vector<Touch> missing;
    std::set_difference(touches.begin(), touches.end(), found.begin(), found.end(),
                        std::back_inserter(missing), is_before);
    if (!missing.empty() || found.size() > touches.size() + 2)
      throw std::runtime_error(
          fmt::format("bodies: {} contacts where a loop finds {}", found.size(), touches.size()));
  }
};

void print_bodies(const Results& results) {
  const Timing &own = results.at("bodies/find_all"), &loop = results.at("bodies/loop");
  const auto microseconds = [](const Timing& of) {
    return of.nanoseconds * static_cast<double>(of.items) / 1e3;
  };
  const double step = microseconds(own);
  fmt::print("contacts of {} bodies of five discs, {:g} a square metre: {:.0f} contacts\n", own.items,
             pressed_density, own.counters.at("contacts"));
  fmt::print("  {:32}{:8.1f} us a step   {}\n", "find_all()", step, verdict_at_most(step, most_step_us));
  fmt::print("  {:32}{:8.1f} us, {:.1f} x   {}\n", "a loop over all pairs and discs", microseconds(loop),
             loop.nanoseconds / own.nanoseconds,
             verdict(loop.nanoseconds / own.nanoseconds, needed_over_loop));
}

}  // namespace

std::vector<Table> body_tables(Suite& suite) {
  const Shared<Bodies> shared([] { return std::make_shared<Bodies>(); });
  suite.add("bodies/find_all", [shared]() -> Contender {
    const std::shared_ptr<Bodies> all = shared.get();
    all->require_same();
    const auto contacts = static_cast<double>(all->find().contacts.values.size());
    return {[all] { all->find(); }, bodies, {{"contacts", contacts}}};
  });
  suite.add("bodies/loop", [shared]() -> Contender {
    const std::shared_ptr<Bodies> all = shared.get();
    return {[all] { all->loop(); }, bodies};
  });
  return {{"bodies", "^bodies/", print_bodies}};
}

}  // namespace bch::bench
