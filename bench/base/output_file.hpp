// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <sys/stat.h>

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "bench/base/interrupt.hpp"

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

/// Owns a file descriptor that is closed with its owner.
struct Descriptor {
  int number = -1;

  Descriptor() = default;
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

/// Represents a file that gets its name once it is complete. It grows beside the file that has the name now,
/// under a random name that an attacker cannot predict, and replaces that file in commit(). Without commit(),
/// the destructor or a signal removes it. The new file has the permissions of the one it replaces. Where the
/// name is a symbolic link, the file that it leads to is replaced. Devices and pipes are written to directly.
/// Errors of all: throw InputError naming the file and the reason.
class OutputFile {
 public:
  explicit OutputFile(const std::string& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Returns whether write_at(), skip() and clear() can be called.
  bool is_regular() const noexcept { return !temporary_.empty(); }

  /// Appends behind what was written or skipped before.
  void write(std::string_view bytes);
  void skip(std::uint64_t bytes);
  /// Writes at any offset; the position of write() stays. The system is asked to have the bytes on the disk
  /// soon.
  void write_at(std::uint64_t offset, std::string_view bytes);
  /// Makes the file empty again, as it was at first.
  void clear();

  /// Gives the file its name. No function can be called after it.
  void commit();

 private:
  void check(bool good) const;

  std::string user_name_;  ///< as the user wrote it
  std::string name_;       ///< in the folder, behind symbolic links
  std::string temporary_;  ///< in the folder; empty where the output is not a regular file
  Descriptor folder_, file_;
  std::optional<RemovedOnSignal> removed_;
};

/// Keeps other processes from the same work: one of them can hold a lock file of that name at a time. The file is removed with
/// its owner, or by a signal. One that a killed process left is taken over. Where the file system knows no locks, nobody
/// is kept out.
class FileLock {
 public:
  /// Takes a folder that exists, and a name of at most RemovedOnSignal::longest_name bytes.
  /// Errors:  throws InputError where another process holds the lock, or the file cannot be made.
  FileLock(const std::string& folder, const std::string& name);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::string name_;
  Descriptor folder_, file_;
  std::optional<RemovedOnSignal> removed_;
};

}  // namespace bch::cli
