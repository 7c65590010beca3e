// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/bytes.hpp"

// What libFuzzer calls. A fault ends the program: a failed expectation of GoogleTest, too.

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace bch::fuzz {

/// Ends the program, saying what is wrong, where it does not hold.
void require(bool holds, const char* what);

}  // namespace bch::fuzz
