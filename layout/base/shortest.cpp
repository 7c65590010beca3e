// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/shortest.hpp"

#include <charconv>

namespace bch::detail {
namespace {

template <class Value>
std::string digits_of(Value value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace

std::string shortest(double value) {
  return digits_of(value);
}

std::string shortest(float value) {
  return digits_of(value);
}

}  // namespace bch::detail
