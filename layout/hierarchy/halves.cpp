// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/halves.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "layout/base/rounding.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;
/// Both coordinates side by side.
using Point = Simd::Double;

Point widened(Vec2 p) {
  return Simd::of<double>(static_cast<double>(p.x), static_cast<double>(p.y));
}

double larger_square(Point a, Point b) {
  const Point aa = a * a, bb = b * b, sums = xsimd::zip_lo(aa, bb) + xsimd::zip_hi(aa, bb);
  return std::max(Simd::lane(sums, 0), Simd::lane(sums, 1));
}

/// Writes the nodes of a piece, by its ends, that is still to be halved so often; the first one is `number` of all.
template <int halvings>
void write_piece(Point a, Point b, const OutwardRadii& radii, Hierarchy::Node* node, std::uint32_t number) {
  const Point exact = Point(0.5) * (a + b);
  const Simd::Float rounded = Simd::to_float({exact, exact});
  Point middle[2];
  Simd::to_double(rounded, middle);
  Simd::store_pair(&node->disc, rounded, 0);
  radii.write(larger_square(a - middle[0], b - middle[0]), *node);
  if constexpr (halvings == 0) {
    node->second_child = 0;
  } else {
    constexpr std::uint32_t second = EvenHalves::nodes(halvings - 1) + 1;
    node->second_child = number + second;
    write_piece<halvings - 1>(a, middle[0], radii, node + 1, number + 1);
    write_piece<halvings - 1>(middle[0], b, radii, node + second, number + second);
  }
}

/// The slack for halving by length, in units of u times the extent. After three halvings a midpoint is off by
/// 2.34 u (rounding.hpp), and so is a piece's end, which is at most 2 sqrt(2) u, so that a length is off by
/// 5.7 u. A length in float is off by 2.5 u of at most 2.83 times the extent, and the limits, where lengths
/// come near them, by 2.9 u. Of a piece that is surely long 8 u remain, so that its midpoint is neither end,
/// which takes 2.9 u.
constexpr double piece_end = 2 * rounding::terms::root_2, float_length = 2.5 * 2.83, limits = 2.9,
                 remains = 8;
static_assert(piece_end >= rounding::terms::halved(EvenHalves::max_halvings) && remains >= piece_end);
constexpr double slack_in_u = 24;
static_assert(slack_in_u >= 2 * piece_end + float_length + limits + remains);

}  // namespace

void EvenHalves::begin(double longest, double max_extent) {
  const double slack = slack_in_u * rounding::unit_roundoff * max_extent;
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

void EvenHalves::write_halvings(const float* lengths, std::uint8_t* halvings) const {
  std::int32_t times[4];  // in words, so that the loop fills registers
  for (std::size_t i = 0; i < 4; ++i) {
    std::int32_t sure = 0, possible = 0;
    for (std::size_t k = 0; k < surely_long_.size(); ++k)
      sure += lengths[i] > surely_long_[k], possible += lengths[i] > surely_short_[k];
    times[i] = sure == possible ? sure : uneven;
  }
  for (std::size_t i = 0; i < 4; ++i) halvings[i] = static_cast<std::uint8_t>(times[i]);
}

void EvenHalves::write(const std::vector<Hierarchy::Primitive>& segments, const OutwardRadii& radii,
                       std::vector<Hierarchy::Node>& nodes) const {
  const auto write_all = [&]<int halvings>() {
    for (const auto [node, source] : segments_[halvings])
      write_piece<halvings>(widened(segments[source].a), widened(segments[source].b), radii, &nodes[node],
                            node);
  };
  [&]<int... halvings>(std::integer_sequence<int, halvings...>) {
    (write_all.template operator()<halvings>(), ...);
  }
  (std::make_integer_sequence<int, max_halvings + 1>());
}

}  // namespace bch::detail
