// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

namespace bch::cli {

/// Runs a program. What it throws becomes a line on standard error, or one for each bad file, and an ExitCode.
/// Standard streams that the caller closed stay unusable, but no file or pipe takes their numbers.
/// Returns: the exit code.
int run_main(const char* program, const std::function<int()>& run);

}  // namespace bch::cli
