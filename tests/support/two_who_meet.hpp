// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <string>

namespace bch::test {

/// Two people who walk through each other in 4 s, and a third who is never near them.
inline std::string two_who_meet() {
  std::string text = "# framerate: 25\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < 100; ++k)
    text += fmt::format("7 {0} {1:.3f} 0 1.8\n5 {0} {2:.3f} 0.1 1.7\n12 {0} 3 {3:.3f} 1.6\n", k,
                        -2.4 + 0.048 * k, 2.4 - 0.048 * k, 5 + 0.04 * k);
  return text;
}

}  // namespace bch::test
