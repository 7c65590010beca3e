// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/simd/lanes.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "tests/support/test.hpp"

namespace bch::detail {
namespace {

/// What holds for any instruction set, compiled for that of BaseLanes, which has instructions of its own instead.
struct PlainLanes : AnyLanes<BaseArch, PlainLanes> {};
using Float = BaseLanes::Float;
using Double = BaseLanes::Double;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

template <class Batch>
std::array<std::uint64_t, 2> bits_of(Batch v) {
  return std::bit_cast<std::array<std::uint64_t, 2>>(v);
}

/// Every two of these stand in one lane, beside others.
std::vector<std::array<Float, 2>> pairs() {
  const float values[] = {0.0f, -0.0f, 1.0f, -1.0f, 2.5f, 0x1p-140f, 0x1p100f, infinity, -infinity, nan};
  std::vector<std::array<Float, 2>> all;
  for (const float a : values)
    for (const float b : values)
      all.push_back({BaseLanes::of<float>(a, b, 3.0f, a), BaseLanes::of<float>(b, a, b, 2.0f)});
  return all;
}

TEST(Lanes, AreTheSameWithInstructionsOfTheirOwn) {
  for (const auto& [a, b] : pairs()) {
    EXPECT_EQ(bits_of(BaseLanes::min(a, b)), bits_of(PlainLanes::min(a, b)));
    EXPECT_EQ(bits_of(BaseLanes::max(a, b)), bits_of(PlainLanes::max(a, b)));
    const auto less = a < b;
    EXPECT_EQ(BaseLanes::bits(less), PlainLanes::bits(less));
    EXPECT_EQ(bits_of(BaseLanes::zero_unless(less, a)), bits_of(PlainLanes::zero_unless(less, a)));
    EXPECT_EQ(bits_of(BaseLanes::min(BaseLanes::nan_where(less, a), b)),
              bits_of(PlainLanes::min(PlainLanes::nan_where(less, a), b)));
    Double wide[2], plain[2];
    BaseLanes::to_double(a, wide), PlainLanes::to_double(a, plain);
    EXPECT_EQ(bits_of(wide[0]), bits_of(plain[0]));
    EXPECT_EQ(bits_of(wide[1]), bits_of(plain[1]));
    float floats[BaseLanes::width];
    BaseLanes::store(floats, a);
    EXPECT_EQ(bits_of(BaseLanes::wide(floats)), bits_of(plain[0]));
    EXPECT_EQ(bits_of(PlainLanes::wide(floats)), bits_of(plain[0]));
    EXPECT_EQ(bits_of(BaseLanes::to_float(wide)), bits_of(PlainLanes::to_float(plain)));
    EXPECT_EQ(BaseLanes::bits(wide[0] < wide[1]), PlainLanes::bits(wide[0] < wide[1]));
    if (BaseLanes::bits(xsimd::isnan(a)) == 0) {
      EXPECT_EQ(BaseLanes::least(a), PlainLanes::least(a));
    }
  }
}

TEST(Lanes, JoinTheirBits) {
  for (const auto& [a, b] : pairs()) {
    const auto bits_a = bits_of(a), bits_b = bits_of(b);
    EXPECT_EQ(bits_of(a | b), (std::array{bits_a[0] | bits_b[0], bits_a[1] | bits_b[1]}));
    const auto less = a < b, more = b <= a;
    const std::uint32_t bits_less = BaseLanes::bits(less), bits_more = BaseLanes::bits(more);
    EXPECT_EQ(BaseLanes::bits(less ^ more), bits_less ^ bits_more);
    EXPECT_EQ(BaseLanes::bits(less | more), bits_less | bits_more);
    EXPECT_EQ(BaseLanes::bits(less & !more), bits_less & ~bits_more);
  }
}

/// As x86 has it, with NaN and with zeros of both signs; other processors have other instructions.
TEST(Lanes, HaveTheSecondAsMinimumAndMaximumWhereNeitherIsLess) {
  for (const auto& [a, b] : pairs()) {
    EXPECT_EQ(bits_of(xsimd::min(a, b)), bits_of(xsimd::select(a < b, a, b)));
    EXPECT_EQ(bits_of(xsimd::max(a, b)), bits_of(xsimd::select(b < a, a, b)));
    Double first[2], second[2];
    BaseLanes::to_double(a, first), BaseLanes::to_double(b, second);
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(bits_of(xsimd::min(first[i], second[i])),
                bits_of(xsimd::select(first[i] < second[i], first[i], second[i])));
      EXPECT_EQ(bits_of(xsimd::max(first[i], second[i])),
                bits_of(xsimd::select(second[i] < first[i], first[i], second[i])));
    }
  }
}

/// xsimd's own of NEON are estimates.
TEST(Lanes, HaveRootsAndQuotientsAsOneLaneHasThem) {
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    float lane[2][4], root[4], quotient[4];
    for (auto& row : lane)
      for (float& each : row) each = static_cast<float>(random.uniform(1e-3, 1e3));
    for (int k = 0; k < 4; ++k) root[k] = std::sqrt(lane[0][k]), quotient[k] = lane[0][k] / lane[1][k];
    const Float a = BaseLanes::load(lane[0]), b = BaseLanes::load(lane[1]);
    EXPECT_EQ(bits_of(xsimd::sqrt(a)), bits_of(BaseLanes::load(root)));
    EXPECT_EQ(bits_of(a / b), bits_of(BaseLanes::load(quotient)));
    Double wide[2], other[2];
    BaseLanes::to_double(a, wide), BaseLanes::to_double(b, other);
    for (int h = 0; h < 2; ++h)
      for (unsigned k = 0; k < 2; ++k) {
        EXPECT_EQ(BaseLanes::lane(xsimd::sqrt(wide[h]), k), std::sqrt(BaseLanes::lane(wide[h], k)));
        EXPECT_EQ(BaseLanes::lane(wide[h] / other[h], k),
                  BaseLanes::lane(wide[h], k) / BaseLanes::lane(other[h], k));
      }
  }
}

/// Bounds that use them leave three quarters of `rough`.
TEST(Lanes, HaveRoughRootsWithinTheirError) {
  test::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(random.uniform(1, 2), static_cast<int>(random.below(252)) - 126);
    const Float v(static_cast<float>(x));
    const double root = std::sqrt(static_cast<double>(BaseLanes::lane(v, 0)));
    for (const Float found : {BaseLanes::approximate_sqrt(v), PlainLanes::approximate_sqrt(v)})
      EXPECT_LE(std::abs(static_cast<double>(BaseLanes::lane(found, 0)) - root),
                0.75 * static_cast<double>(BaseLanes::approximation_error) * root)
          << x;
  }
}

/// The least integer can be converted, and halves go to the even one.
TEST(Lanes, AreConvertedToIntegersWithinTheirRange) {
  const Float v = BaseLanes::of<float>(-0x1p31f, 2.5f, 3.5f, -2.5f);
  std::int32_t integers[4];
  BaseLanes::store(integers, xsimd::to_int(v));
  EXPECT_EQ((std::array{integers[0], integers[1], integers[2], integers[3]}),
            (std::array{std::numeric_limits<std::int32_t>::min(), 2, 3, -2}));
  BaseLanes::store(integers, xsimd::nearbyint_as_int(v));
  EXPECT_EQ((std::array{integers[0], integers[1], integers[2], integers[3]}),
            (std::array{std::numeric_limits<std::int32_t>::min(), 2, 4, -2}));
}

TEST(Lanes, CountAndTakeIntegers) {
  test::Random random(1);
  using Shorts = BaseLanes::Batch<std::int16_t>;
  for (int i = 0; i < 1000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random.below(1 << 16));
    EXPECT_EQ(BaseLanes::count(bits), PlainLanes::count(bits)) << bits;
    std::int16_t shorts[Shorts::size];
    std::int32_t integers[16];
    for (std::int16_t& each : shorts) each = static_cast<std::int16_t>(static_cast<int>(random.below(8)) - 4);
    for (std::int32_t& each : integers) each = static_cast<std::int32_t>(random.below(1 << 30)) - (1 << 29);
    const auto less = BaseLanes::load(shorts) > Shorts(std::int16_t{0});
    EXPECT_EQ(BaseLanes::bits(less), PlainLanes::bits(less));
    const auto below = BaseLanes::load(integers) > BaseLanes::Ints(0);
    EXPECT_EQ(BaseLanes::bits(below), PlainLanes::bits(below));
    const std::uint32_t index[] = {static_cast<std::uint32_t>(random.below(4)),
                                   static_cast<std::uint32_t>(random.below(4))};
    Double field[4], plain[4];
    BaseLanes::load_integers<4>(integers, index, field), PlainLanes::load_integers<4>(integers, index, plain);
    for (int f = 0; f < 4; ++f) EXPECT_EQ(bits_of(field[f]), bits_of(plain[f]));
  }
}

TEST(Lanes, GoWhereTheirNamesSay) {
  const float table[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const std::uint32_t index[] = {3, 0, 2, 1};
  const auto expect = [](Float v, std::array<float, 4> lanes) { EXPECT_EQ(bits_of(v), bits_of(lanes)); };
  expect(BaseLanes::gather(table, index), {3, 0, 2, 1});
  expect(BaseLanes::shuffle<0, 3, 5, 6>(BaseLanes::load(table), BaseLanes::load(table + 4)), {0, 3, 5, 6});
  Float field[4], first, second;
  BaseLanes::load_records<4>(table, index, field);
  expect(field[0], {12, 0, 8, 4});
  expect(field[3], {15, 3, 11, 7});
  BaseLanes::load_pairs([&](std::size_t i) { return table + 2 * index[i]; }, first, second);
  expect(first, {6, 0, 4, 2});
  expect(second, {7, 1, 5, 3});
  Double wide[2];
  BaseLanes::load_pairs([&](std::size_t i) { return table + 2 * index[i]; }, wide);
  expect(BaseLanes::to_float(wide), {6, 0, 7, 1});
  float pair[3] = {0, 0, 9};
  BaseLanes::store_pair(pair, BaseLanes::load(table), 1);
  EXPECT_EQ((std::array{pair[0], pair[1], pair[2]}), (std::array{2.0f, 3.0f, 9.0f}));
  EXPECT_EQ(BaseLanes::lane(BaseLanes::load(table), 2), 2);
}

TEST(Heading, IsWithinItsBoundsEverywhere) {
  test::Random random(7);
  constexpr long double to_float = 0x1p-25L * (1 + 0x1p-7L);
  for (int i = 0; i < 300'000; ++i) {
    const double size = std::exp2(random.uniform(-40, 29.8));
    const double heading = random.below(2) == 0 ? size : -size;
    const detail::Rotation exact = detail::rotation(heading);
    const long double cosine = std::cos(static_cast<long double>(heading)),
                      sine = std::sin(static_cast<long double>(heading));
    ASSERT_LE(std::abs(static_cast<long double>(exact.cosine) - cosine), 2e-10L) << heading;
    ASSERT_LE(std::abs(static_cast<long double>(exact.sine) - sine), 2e-10L) << heading;
    const detail::UnitVector rounded = detail::unit_vector(heading);
    ASSERT_LE(std::abs(static_cast<long double>(rounded.cosine) - cosine), to_float) << heading;
    ASSERT_LE(std::abs(static_cast<long double>(rounded.sine) - sine), to_float) << heading;
  }
}

/// Directions of any length that queries take become unit vectors.
TEST(Heading, DirectionsAreWithinTheirBounds) {
  test::Random random(8);
  double most = 0;
  for (int i = 0; i < 300'000; ++i) {
    const double angle = random.uniform(-4, 4), length = i % 3 == 0   ? 0.999 + 1e-15
                                                         : i % 3 == 1 ? 1.001 - 1e-15
                                                                      : random.uniform(0.999, 1.001);
    const double x = length * std::cos(angle), y = length * std::sin(angle);
    if (!detail::is_unit(x, y)) continue;
    const auto wide_x = static_cast<long double>(x), wide_y = static_cast<long double>(y);
    const long double exact_length = std::sqrt(wide_x * wide_x + wide_y * wide_y);
    const detail::Rotation unit = detail::rotation(Headings::Value{x, y, true});
    const auto off = [&](double part, long double exact) {
      return static_cast<double>(std::abs(static_cast<long double>(part) - exact));
    };
    most = std::max({most, off(unit.cosine, wide_x / exact_length), off(unit.sine, wide_y / exact_length)});
  }
  EXPECT_LE(most, 4e-12);
  EXPECT_GE(most, 3e-12);
  EXPECT_FALSE(detail::is_unit(0.9989, 0));
  EXPECT_FALSE(detail::is_unit(0, 1.0011));
  EXPECT_FALSE(detail::is_unit(0, 0));
  EXPECT_FALSE(detail::is_unit(std::numeric_limits<double>::quiet_NaN(), 1));
}

/// Where nothing is reduced: what the polynomials leave out, and the rounding of doubles.
TEST(Heading, PolynomialsAreWithinTheTermsTheyLeaveOut) {
  for (int i = -1000; i <= 1000; ++i) {
    const double heading = i * std::numbers::pi / 4000;
    const detail::Rotation at = detail::rotation(heading);
    const long double size = std::abs(static_cast<long double>(heading));
    EXPECT_LE(std::abs(at.sine - std::sin(static_cast<long double>(heading))),
              std::pow(size, 13) / 6.2e9L + 3e-16L)
        << heading;
    EXPECT_LE(std::abs(at.cosine - std::cos(static_cast<long double>(heading))),
              std::pow(size, 12) / 4.7e8L + 3e-16L)
        << heading;
  }
}

TEST(Heading, QuarterTurns) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const detail::UnitVector u = detail::unit_vector(quarter * std::numbers::pi / 2);
    const int expected_cosine[] = {1, 0, -1, 0}, expected_sine[] = {0, 1, 0, -1};
    EXPECT_NEAR(u.cosine, expected_cosine[quarter & 3], 1e-14) << quarter;
    EXPECT_NEAR(u.sine, expected_sine[quarter & 3], 1e-14) << quarter;
  }
}

TEST(Rounding, UpIsTheNextFloat) {
  EXPECT_EQ(detail::rounding::round_up(0), 0.0f);
  EXPECT_EQ(detail::rounding::round_up(1), 1.0f);
  EXPECT_EQ(detail::rounding::round_up(1 + 0x1p-40), std::nextafter(1.0f, 2.0f));
  EXPECT_EQ(detail::rounding::round_up(0.1), 0.1f);  // the float is above the double
  EXPECT_EQ(
      detail::rounding::round_up(0.3),
      std::bit_cast<float>(std::bit_cast<std::uint32_t>(0.3f) + (static_cast<double>(0.3f) < 0.3 ? 1u : 0u)));
}

}  // namespace
}  // namespace bch::detail
