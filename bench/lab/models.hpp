// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>

namespace bch::bench {

struct ModelsOptions {
  std::uint32_t spheres = 0;  ///< of the only models that are made; all: 0
  std::string folder;         ///< for the files that the library is made of; none: empty
};

/// Makes the built-in characters' models anew, and writes them or compares them with those that come with the library.
/// Returns: a line a model, with its size.
/// Errors:  throws std::runtime_error where one is another than the library's, and what writing throws.
std::string remake_models(const ModelsOptions& options);

}  // namespace bch::bench
