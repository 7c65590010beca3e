// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include <bch/import.hpp>

namespace bch::detail {

/// Writes a character and its report as bytes, for another process of the same program.
std::string to_bytes(ImportedCharacter imported);

/// Reads a character from bytes that are not trusted: the result is valid, and takes no more than a small
/// multiple of the bytes' memory.
/// Errors:  throws std::invalid_argument on bytes that to_bytes() does not write.
ImportedCharacter imported_from(std::span<const char> bytes);

}  // namespace bch::detail
