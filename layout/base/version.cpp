// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/version.hpp>

namespace bch {

Version library_version() noexcept {
  return {BCH_VERSION_MAJOR, BCH_VERSION_MINOR, BCH_VERSION_PATCH};
}

}  // namespace bch
