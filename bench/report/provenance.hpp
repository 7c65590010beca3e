// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bch::report {

/// Names and values: processor, cores, memory, system, compiler, build, commit, time.
std::vector<std::pair<std::string, std::string>> provenance();

}  // namespace bch::report
