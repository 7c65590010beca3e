// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

#include "baselines/counts.hpp"

/// Declares one interface over all structures that answer "do these two collide?", for benchmarks,
/// experiments and tests: build a kind over bodies, then ask it about the very agents and pairs that
/// bch::collide() takes.
namespace bch::baselines {

/// Holds a character in a pose, in every form that some structure is built from.
struct Body {
  std::vector<Vec3> positions;                          ///< as Skinner::pose() gives them
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< the character's
  Shape shape;                                          ///< outline and contour hierarchy
};

/// Selects what a structure answers exactly at all depths, touching included.
enum class Truth : std::uint8_t {
  none,        ///< an approximation of its own
  mesh,        ///< the triangles have a point in common, in space
  outline,     ///< the outlines have a point in common, on the ground
  projection,  ///< the triangles seen from above have a point in common
};

struct BuildOptions {
  float fixed_radius = 0.25f;       ///< metres, of the kind "fixed": half of a person's shoulders
  bool projected_triangles = true;  ///< the kind "bch_projected" tests triangles; else leaf discs alone
};

/// Represents many shapes in one search structure. It is immutable, so any number of threads may ask it.
/// Agents:  agents.shape indexes the bodies it was built from; agents.level is not read, as every query says
///          how deep it goes. agents.z is read by structures over triangles in space and by ragdolls.
/// Depth:   a node at depth max_depth counts as a leaf, and there the overlap of the volumes is the answer:
///          the paper's maximum recursion depth for cylinders, the analogue for boxes. all_depths: no limit.
/// Order:   the answer does not depend on the order within a pair.
class Structure {
 public:
  virtual ~Structure() = default;

  /// Answers each pair: 1 where the two collide, else 0. An agent paired with itself collides.
  /// Shapes: hits.size() == pairs.size(). Errors: throws std::invalid_argument, before hits is touched, on
  /// sizes that differ, an index out of range, a position or heading that is not finite or beyond the limits
  /// of rounding.hpp, naming the pair or agent and the value.
  void query(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
             std::uint32_t max_depth = all_depths) const;

  /// Returns the answer for one pair, unchecked: what the other form promises to check is a precondition.
  virtual bool query(const Agents& agents, Pair pair, std::uint32_t max_depth = all_depths) const = 0;

  /// Returns the same, and adds to the counts.
  virtual bool query(const Agents& agents, Pair pair, std::uint32_t max_depth, TestCounts& counts) const = 0;

  /// Returns the memory of one shape: nodes and what leaves hold.
  virtual std::size_t bytes(std::uint32_t shape) const = 0;

  virtual std::uint32_t shape_count() const = 0;

 private:
  virtual void answer(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
                      std::uint32_t max_depth) const = 0;
};

struct Kind {
  std::string_view name;
  std::string_view summary;
  Truth exact;                 ///< what the answer at all depths equals
  bool never_misses_outlines;  ///< at every depth, true wherever the outlines have a point in common
  bool has_depth;              ///< max_depth counts
  /// Builds the structure over bodies. Errors: throws std::invalid_argument naming the body and the value: no
  /// triangles, an index out of range, a coordinate that is not finite or beyond the limits of rounding.hpp,
  /// an outline or hierarchy without points or nodes where the kind needs one; a radius that is not positive.
  std::unique_ptr<Structure> (*build)(std::span<const Body> bodies, const BuildOptions& options);
};

/// Returns every kind that this build has, in the order of reports:
///   reference        the paper's contour hierarchy and descent, scalar, whose hits are verified; whether outlines cross
///   reference_segments  the same with exact leaves; also whether an outline contains the other: what collide() answers
///   paper_descent    the first one as the paper has it: the first leaf discs that it finds are the answer
///   single           the root disc of each contour hierarchy
///   fixed            one disc for every pose, around the agent's position
///   bch_projected    hierarchy of discs over all triangles seen from above
///   obb_full         tree of oriented boxes over the triangles
///   obb_contour      the same over the outline's segments
///   obb_contour_2d   rectangles instead of boxes over the outline's segments
///   obb_projected    boxes over all triangles seen from above
///   fcl_obb_full, fcl_obbrss_full, fcl_obb_contour, fcl_obb_segments, fcl_obbrss_contour
///                    the Flexible Collision Library's trees over triangles, over outlines as walls, or as one upright triangle a segment
std::span<const Kind> kinds();

/// Returns the kind of a name. Errors: throws std::invalid_argument naming the kinds that there are.
const Kind& kind(std::string_view name);

}  // namespace bch::baselines
