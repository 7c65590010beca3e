// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cassert>

namespace bch::baselines {

/// Represents a real number as the exact sum of doubles that do not overlap, the smallest first, none of them
/// zero. Exact while nothing overflows or underflows. Slow; for what a filter cannot decide.
/// Source: J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", Discrete & Computational Geometry 18, 1997: theorem 7 (sum of two doubles), theorems 17 and
/// 18 (their product, after Dekker and Veltkamp), theorem 10 (growing an expansion).
class Expansion {
 public:
  Expansion() = default;

  /// Returns a - b exactly.
  static Expansion difference(double a, double b) noexcept {
    Expansion result;
    result.add(a);
    result.add(-b);
    return result;
  }

  void add(double value) noexcept {
    double sum = value;
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const double term = terms_[i], whole = sum + term, part = whole - sum;
      const double rest = (sum - (whole - part)) + (term - part);
      if (rest != 0) terms_[kept++] = rest;
      sum = whole;
    }
    if (sum != 0) terms_[kept++] = sum;
    count_ = kept;
    assert(count_ <= capacity);
  }

  void add(const Expansion& other) noexcept {
    for (int i = 0; i < other.count_; ++i) add(other.terms_[i]);
  }
  void subtract(const Expansion& other) noexcept {
    for (int i = 0; i < other.count_; ++i) add(-other.terms_[i]);
  }

  friend Expansion operator*(const Expansion& a, const Expansion& b) noexcept {
    Expansion product;
    for (int i = 0; i < a.count_; ++i)
      for (int j = 0; j < b.count_; ++j) {
        const double x = a.terms_[i], y = b.terms_[j], whole = x * y;
        const auto [x_high, x_low] = split(x);
        const auto [y_high, y_low] = split(y);
        product.add(((x_high * y_high - whole) + x_high * y_low + x_low * y_high) + x_low * y_low);
        product.add(whole);
      }
    return product;
  }

  int sign() const noexcept { return count_ == 0 ? 0 : terms_[count_ - 1] > 0 ? 1 : -1; }

 private:
  struct Halves {
    double high, low;
  };
  static Halves split(double x) noexcept {
    const double shifted = 0x1.0000002p27 * x, high = shifted - (shifted - x);
    return {high, x - high};
  }

  /// The most doubles of a sum: those of six products of three differences, 6 x 2 x (2 x (2 x 2 x 2)), and
  /// one while adding.
  static constexpr int capacity = 193;
  int count_ = 0;
  double terms_[capacity];
};

}  // namespace bch::baselines
