// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

#include "tests/support/outline_soups.hpp"

namespace bch::test {

/// Returns the triangles as a binary STL file, where each has vertices of its own.
std::string stl_file(const Soup& soup);

}  // namespace bch::test
