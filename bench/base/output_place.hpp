// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <sys/stat.h>

#include <compare>
#include <filesystem>
#include <optional>
#include <string>

namespace bch::cli {

/// Identifies a file as the system knows it, whatever its names are: device and inode. A file that does not exist yet
/// is known by its folder, and by its name there.
struct FileIdentity {
  dev_t device;
  ino_t inode;
  std::string name;  ///< empty where the file exists

  friend auto operator<=>(const FileIdentity&, const FileIdentity&) = default;
};

/// Identifies a file by device and inode.
/// Returns: nothing for what does not exist, and for what is no regular file (devices may be read and written
///          at once).
std::optional<FileIdentity> identity_of(const std::filesystem::path& file);
std::optional<FileIdentity> identity_of(int descriptor);

/// Represents the place where the bytes of an output go.
struct OutputPlace {
  std::filesystem::path path;        ///< behind all symbolic links; as the user wrote it for a device
  std::optional<struct stat> there;  ///< what has the name now

  bool is_special() const noexcept { return there && !S_ISREG(there->st_mode); }
  std::filesystem::path folder() const;
};

/// Finds the place of an output and checks that it can be written: a device, or a file in a folder that takes new files.
/// Errors:  throws InputError naming the file and the reason.
OutputPlace writable_place(const std::string& file);

/// Identifies the file at the place of an output.
/// Returns: nothing for a device.
std::optional<FileIdentity> identity_of(const OutputPlace& place);

}  // namespace bch::cli
