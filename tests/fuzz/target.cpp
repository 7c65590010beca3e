// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/fuzz/target.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  GTEST_FLAG_SET(throw_on_failure, true);  // which nobody catches
  return 0;
}

namespace bch::fuzz {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace bch::fuzz
