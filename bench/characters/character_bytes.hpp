// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include "layout/import/import.hpp"

namespace bch::cli {

/// A character and its report as bytes, for another process of the same program.
std::string to_bytes(ImportedCharacter imported);

/// Trusts nothing: what comes out is valid, and takes no more than a small multiple of the bytes' memory.
/// Errors:  throws std::invalid_argument on bytes that to_bytes() does not write.
ImportedCharacter imported_from(std::span<const char> bytes);

}  // namespace bch::cli
