// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bch::detail {

/// Returns the number of characters of `bytes` bytes in base64.
constexpr std::size_t base64_size(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// Encodes bytes in base64 (RFC 4648, section 4).
std::string to_base64(std::string_view bytes);

/// Decodes base64. The equals signs at the end may be missing.
/// Errors:  throws std::invalid_argument naming the position of a character that is not a digit.
std::string from_base64(std::string_view text);

}  // namespace bch::detail
