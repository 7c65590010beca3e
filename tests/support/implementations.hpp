// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// Returns the implementations that this processor runs.
inline std::vector<std::reference_wrapper<const Implementation>> supported() {
  std::vector<std::reference_wrapper<const Implementation>> found;
  for (const Implementation& each : implementations())
    if (each.supported()) found.emplace_back(each);
  return found;
}

}  // namespace bch::test
