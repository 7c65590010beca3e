// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/clearance_reference.hpp"
#include "baselines/reference.hpp"
#include "baselines/segment_clearance.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "tests/support/query_answers.hpp"

namespace bch::test {

/// The scalar references of all queries.
class BruteForce {
 public:
  /// Takes shapes and a plan as a ShapeSet does. The shapes must outlive this.
  BruteForce(std::span<const Shape> shapes, const ShapeSetPlan& plan);

  /// Returns the answers, of every disc of one cut against every one of the other. Nearest points, and directions and discs of exact
  /// leaves, are those of the best implementation.
  std::vector<PairAnswers> answers(const ShapeSet& set, const Questions& questions);

  baselines::Reference collisions, collisions_of_discs;
  baselines::ClearanceReference clearances;
  baselines::SegmentClearance segment_clearances;
  baselines::TimeOfImpactReference times;
  baselines::CutLists cuts;
  baselines::LeafSegments segments;
};

}  // namespace bch::test
