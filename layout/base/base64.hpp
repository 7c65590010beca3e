// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bch::detail {

/// Returns how many characters that many bytes take in base64.
constexpr std::size_t base64_size(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// Writes bytes in base64 (RFC 4648, section 4).
std::string to_base64(std::string_view bytes);

/// Reads what base64 says; the equals signs at its end may lack.
/// Errors:  throws std::invalid_argument on a character that is no digit, naming its place.
std::string from_base64(std::string_view text);

}  // namespace bch::detail
