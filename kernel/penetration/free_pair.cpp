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
  switch (kind) {
    case Kind::spheres:
      return spheres_.begin(a, b, by, node_slack);
    case Kind::segments:
      return segments_.begin(a, b, by, node_slack);
    case Kind::walls:
      return walls_.begin(a, b, by, node_slack);
  }
}

void FreePair::turn(float x, float y) {
  switch (kind_) {
    case Kind::spheres:
      return spheres_.turn(x, y);
    case Kind::segments:
      return segments_.turn(x, y);
    case Kind::walls:
      return walls_.turn(x, y);
  }
}

float FreePair::next(float place) {
  switch (kind_) {
    case Kind::spheres:
      return spheres_.next(place);
    case Kind::segments:
      return segments_.next(place);
    case Kind::walls:
      return walls_.next(place);
  }
  return place;
}

float FreePair::after_gap(float place) const {
  switch (kind_) {
    case Kind::spheres:
      return spheres_.after_gap(place);
    case Kind::segments:
      return segments_.after_gap(place);
    case Kind::walls:
      return walls_.after_gap(place);
  }
  return place;
}

FreeTouch FreePair::touch(float place) const {
  switch (kind_) {
    case Kind::spheres:
      return spheres_.touch(place);
    case Kind::segments:
      return segments_.touch(place);
    case Kind::walls:
      return walls_.touch(place);
  }
  return {};
}

}  // namespace bch::detail
