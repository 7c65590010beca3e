// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/query.hpp>
#include <bch/shape_set.hpp>

#include "baselines/clearance_reference.hpp"
#include "baselines/contact_reference.hpp"
#include "baselines/segment_clearance.hpp"
#include "baselines/slab_bodies.hpp"
#include "baselines/time_of_impact_reference.hpp"

namespace bch::test {

/// Sorts contacts by their first disc, then by their second.
void sort_contacts(std::vector<DiscPair>& contacts);

/// Returns the same contact of the pair in the other order.
DiscPair exchanged(const DiscPair& discs);

/// What the scalar references say of pairs of bodies, part by part. The agent of the lower index is A, as everywhere; then pairs
/// are turned as they were asked about.
class PartReferences {
 public:
  /// Keeps the shapes and the set, which is of them.
  PartReferences(std::span<const Shape> shapes, const ShapeSetPlan& plan, const ShapeSet& set);

  /// Returns the clearance with Overlap::deepest.
  baselines::Clearance clearance(const Agents& agents, Pair pair, double max_distance);
  /// Returns whether some discs of two parts collide, or an outline holds another.
  bool collide(const Agents& agents, Pair pair) const {
    return bodies_.collide(agents, pair, baselines::Method::depth_first);
  }
  /// Returns the distance with exact leaves, metres.
  float exact_clearance(const Agents& agents, Pair pair, double max_distance);
  bool within(const Agents& agents, Pair pair, double distance);
  float time(const Agents& agents, Pair pair, double x, double y);
  std::vector<DiscPair> contacts(const Agents& agents, Pair pair, Leaves leaves);

  struct Depth {
    float depth;   ///< the largest of the parts, each with its own slack
    double slack;  ///< by which all of them together may have more
  };
  /// Returns the depth along a direction of the first agent.
  Depth depth(const Agents& agents, Pair pair, Vec2 along);

  bool may_meet(const Agents& agents, Pair pair) const { return !bodies_.part_pairs(agents, pair).empty(); }

 private:
  /// Returns where the discs of an agent's slab begin. Bodies that are not cut have theirs once.
  std::uint32_t first_disc(const Agents& agents, std::uint32_t agent, std::uint32_t slab) const;

  std::span<const Shape> shapes_;
  const ShapeSet& set_;
  std::size_t levels_;
  baselines::SlabBodies bodies_, exact_bodies_;
  baselines::ClearanceReference nearest_;
  baselines::SegmentClearance outlines_;
  baselines::TimeOfImpactReference first_;
  baselines::CutLists cuts_;
  baselines::LeafSegments segments_;
};

}  // namespace bch::test
