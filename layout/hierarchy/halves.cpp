// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/halves.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

using Float = BaseLanes::Float;

struct Point {
  double x, y;

  Point(Vec2 p) : x(static_cast<double>(p.x)), y(static_cast<double>(p.y)) {}
};

double square_distance(Point a, Point b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

/// Writes the nodes of a piece, by its ends, that is still to be halved so often; the first one is `number` of all.
template <int halvings>
void write_piece(Point a, Point b, const OutwardRadii& radii, HierarchyNode* node, std::uint32_t number) {
  const Vec2 middle{static_cast<float>(0.5 * (a.x + b.x)), static_cast<float>(0.5 * (a.y + b.y))};
  node->disc.x = middle.x, node->disc.y = middle.y;
  radii.write(std::max(square_distance(a, middle), square_distance(b, middle)), *node);
  if constexpr (halvings == 0) {
    node->second_child = 0;
  } else {
    constexpr std::uint32_t second = EvenHalves::nodes(halvings - 1) + 1;
    node->second_child = number + second;
    write_piece<halvings - 1>(a, middle, radii, node + 1, number + 1);
    write_piece<halvings - 1>(middle, b, radii, node + second, number + second);
  }
}

/// The slack for halving by length, in units of u times the reach. After three halvings a midpoint is off by
/// 2.34 u (rounding.hpp), and so is a piece's end, which is at most 2 sqrt(2) u, so that a length is off by
/// 5.7 u. A length in float is off by 2.5 u of at most 2.83 times the reach, and the limits, where lengths
/// come near them, by 2.9 u. Of a piece that is surely long 8 u remain, so that its midpoint is neither end,
/// which takes 2.9 u.
constexpr double piece_end = 2 * rounding::terms::root_2, float_length = 2.5 * 2.83, limits = 2.9,
                 remains = 8;
static_assert(piece_end >= rounding::terms::halved(EvenHalves::most_halvings) && remains >= piece_end);
constexpr double slack_in_u = 24;
static_assert(slack_in_u >= 2 * piece_end + float_length + limits + remains);

}  // namespace

void EvenHalves::begin(double longest, double reach) {
  const double slack = slack_in_u * rounding::unit_roundoff * reach;
  for (std::size_t k = 0; k < surely_long_.size(); ++k) {
    const double pieces = 1 << k;
    const auto limit = [&](double length) {
      return static_cast<float>(std::min(pieces * length, double{std::numeric_limits<float>::max()}));
    };
    surely_short_[k] = limit(longest - slack);
    surely_long_[k] = limit(longest + slack);
  }
  for (auto& of_a_kind : segments_) of_a_kind.clear();
}

void EvenHalves::write_halvings(Float lengths, std::uint8_t* halvings) const {
  Float sure(0.0f), possible(0.0f);
  for (std::size_t k = 0; k < surely_long_.size(); ++k)
    sure = sure + Float(Float(surely_long_[k]) < lengths),
    possible = possible + Float(Float(surely_short_[k]) < lengths);
  std::int32_t four[BaseLanes::width];
  BaseLanes::store(four, xsimd::to_int(xsimd::select(sure == possible, sure, Float(uneven))));
  for (const std::int32_t each : four) *halvings++ = static_cast<std::uint8_t>(each);
}

void EvenHalves::write(const std::vector<Primitive>& segments, const OutwardRadii& radii,
                       std::vector<HierarchyNode>& nodes) const {
  const auto write_all = [&]<int halvings>() {
    for (const auto [node, source] : segments_[halvings])
      write_piece<halvings>(segments[source].a, segments[source].b, radii, &nodes[node], node);
  };
  [&]<int... halvings>(std::integer_sequence<int, halvings...>) {
    (write_all.template operator()<halvings>(), ...);
  }
  (std::make_integer_sequence<int, most_halvings + 1>());
}

}  // namespace bch::detail
