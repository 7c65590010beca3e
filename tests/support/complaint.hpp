// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include "tests/support/standard.hpp"

namespace bch::test {

/// Returns the message of a call that throws an Exception; "accepted" where it throws nothing.
template <class Exception = std::invalid_argument, class Call>
std::string complaint(Call call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "accepted";
}

/// Returns whether a text has a part, and both where it has not.
inline testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess() << text;
  return testing::AssertionFailure() << "no '" << part << "' in: " << text;
}

}  // namespace bch::test
