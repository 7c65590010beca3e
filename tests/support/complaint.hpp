// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <stdexcept>
#include <string>

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

}  // namespace bch::test
