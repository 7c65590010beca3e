// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

/// The version of these headers, which the build reads here.
/// Until 1.0, a change of the public surface raises the minor number; CHANGELOG.md lists the changes.
#define BCH_VERSION_MAJOR 0
#define BCH_VERSION_MINOR 4
#define BCH_VERSION_PATCH 0

/// Contains all that the library declares for its users.
namespace bch {

/// Represents a version of the library.
struct Version {
  int major, minor, patch;
  friend bool operator==(const Version&, const Version&) = default;
};

/// Returns the version of the library to which the program is linked.
Version library_version() noexcept;

}  // namespace bch
