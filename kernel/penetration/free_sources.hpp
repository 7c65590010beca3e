// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/pairs.hpp>

#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_pair.hpp"
#include "layout/format/shape_set_view.hpp"

// What searches of free places know of the agents of a set. All that a source refers to has to outlive it.

namespace bch::detail {

/// Knows agents with outlines.
class OutlineSource {
 public:
  /// Who is not in space, and has left all segments of another one, may be inside that.
  static constexpr bool is_in_space = false;

  OutlineSource(const ShapeSet& shapes, const Agents& agents, const Implementation& implementation,
                bool exact)
      : shapes_(shapes),
        view_(shapes.view()),
        agents_(agents),
        implementation_(implementation),
        exact_(exact) {}

  const Agents& agents() const { return agents_; }
  /// Returns a distance from an agent's position within which all of it is, metres.
  double max_extent(std::uint32_t agent) const;
  /// Returns whether the heights of two agents meet.
  bool may_meet(Pair pair) const;
  static Heights heights(std::uint32_t) { return {0, 0}; }  ///< of an agent in space
  /// Finds which pairs of agents collide, on the caller's thread. They are the source's, or copies of these.
  void find_hits(const Agents& agents, std::span<const Pair> pairs, std::uint8_t* hits) const;
  /// Begins the search for a pair, in the frame of its first agent.
  void begin(FreePair& search, Pair pair) const;
  /// Begins the search for an agent and the walls that search.b has. Their segments are off by so much.
  void begin_walls(FreePair& search, std::uint32_t agent, double slack) const;
  /// Returns how far the first agent of a pair has to move along a direction until a line separates the two.
  float leave_all(const Agents& agents, Pair pair, double x, double y) const;

 private:
  bool has_segments(std::uint32_t agent) const;
  /// Returns whether some leaf has too many segments, so that its disc counts.
  bool has_wide_leaves(std::uint32_t agent) const;

  const ShapeSet& shapes_;
  const ShapeSetView& view_;
  const Agents& agents_;
  const Implementation& implementation_;
  bool exact_;
};

/// Knows agents with bodies of spheres, as OutlineSource does.
class SphereSource {
 public:
  static constexpr bool is_in_space = true;

  SphereSource(const BodySetView& bodies, const Agents& agents, const Implementation& implementation)
      : bodies_(bodies), agents_(agents), implementation_(implementation) {}

  const Agents& agents() const { return agents_; }
  double max_extent(std::uint32_t agent) const;
  bool may_meet(Pair) const { return true; }
  Heights heights(std::uint32_t agent) const;
  void find_hits(const Agents& agents, std::span<const Pair> pairs, std::uint8_t* hits) const;
  void begin(FreePair& search, Pair pair) const;
  void begin_walls(FreePair& search, std::uint32_t agent, double slack) const;
  static float leave_all(const Agents&, Pair, double, double) { return 0; }

 private:
  const float* record(std::uint32_t agent) const { return bodies_.record(agents_.shape[agent]); }

  const BodySetView& bodies_;
  const Agents& agents_;
  const Implementation& implementation_;
};

}  // namespace bch::detail
