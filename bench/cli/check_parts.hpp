// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/cli/check_input.hpp"
#include "bench/cli/parts.hpp"

namespace bch::cli {

/// Checks a part of a recording's frames, unless that is done already. Returns a line about it.
std::string check_part(const CheckInput& input, const PartFiles& files, const nlohmann::ordered_json& run);

/// Writes what one run would.
/// Errors:  throws InputError; CheckFailed as outputs.fail_above asks for.
void merge_check(const WholeRun& whole, const CheckOutputs& outputs);

}  // namespace bch::cli
