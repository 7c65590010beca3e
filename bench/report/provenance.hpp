// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bch::report {

/// Returns names and values: processor, cores, memory, system, compiler, build, commit, time.
std::vector<std::pair<std::string, std::string>> provenance();

}  // namespace bch::report
