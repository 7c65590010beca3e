// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

/// Gives the version of these headers, from which the build reads it.
/// Until 1.0, a change of the public surface raises the minor number; CHANGELOG.md lists the changes.
#define BCH_VERSION_MAJOR 0
#define BCH_VERSION_MINOR 4
#define BCH_VERSION_PATCH 0

/// Holds all that the library declares for its users.
namespace bch {

/// Represents a version of the library.
struct Version {
  int major, minor, patch;
  friend bool operator==(const Version&, const Version&) = default;
};

/// Returns the version of the library that the program is linked to.
Version library_version() noexcept;

}  // namespace bch
