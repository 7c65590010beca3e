// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string_view>

namespace bch::cli {

/// Names the standard streams.
enum Stream : int { standard_output = 1, standard_error = 2 };

/// Opens the standard streams that are closed, each the wrong way round, so that using them is still an error. Otherwise the next file
/// or pipe would be one of them. What is written to them stays as it is.
/// Errors:  throws UsageError where the stack is smaller than queries need, which would end the program somewhere in the work.
void prepare_process();

bool is_terminal(int descriptor);
/// Writes the first bytes of a text, as many as the system takes at once.
/// Returns: how many, or -1, and then errno says why.
std::ptrdiff_t write_some(int descriptor, std::string_view text);

/// Returns the GiB in main memory that are no file's; 0 where the system does not say.
double own_memory();

}  // namespace bch::cli
