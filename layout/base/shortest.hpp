// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

namespace bch::detail {

/// Returns a number for a message, in the fewest digits that tell it from all others of its type: one just beyond a limit does not
/// read as the limit.
std::string shortest(double value);
std::string shortest(float value);

}  // namespace bch::detail
