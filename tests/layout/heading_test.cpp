// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/heading.hpp"

#include "layout/base/rounding.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

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
}  // namespace bch
