// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_pair.hpp"

#include "layout/base/rounding.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {

void FreePair::begin(Kind kind, double margin, double reaches) {
  // Nodes are floats, too, and their products.
  const double slack = margin + rounding::bound_margin * reaches;
  const float by = rounding::round_up(margin), node_slack = rounding::round_up(slack + margin);
  kind_ = kind;
  with_search(*this, [&](auto& search) { search.begin(a, b, by, node_slack); });
}

void FreePair::turn(float x, float y) {
  with_search(*this, [&](auto& search) { search.turn(x, y); });
}

float FreePair::next(float place) {
  return with_search(*this, [&](auto& search) { return search.next(place); });
}

float FreePair::after_gap(float place) const {
  return with_search(*this, [&](const auto& search) { return search.after_gap(place); });
}

FreeTouch FreePair::touch(float place) const {
  return with_search(*this, [&](const auto& search) { return search.touch(place); });
}

}  // namespace bch::detail
