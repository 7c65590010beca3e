// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/version.hpp>

namespace bch {

Version library_version() noexcept {
  return header_version;
}

}  // namespace bch
