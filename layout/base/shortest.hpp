// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

namespace bch::detail {

/// Formats a number for a message with the fewest digits that distinguish it from all others of its type, so a number
/// just beyond a limit does not read as the limit.
std::string shortest(double value);
std::string shortest(float value);

}  // namespace bch::detail
