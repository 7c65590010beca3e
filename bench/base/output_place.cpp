// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  ///< as Linux follows

std::optional<FileIdentity> identity_of(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, {}};
}

/// Follows the links of a file's own name, also to a file that does not exist, which fs::canonical() refuses.
fs::path behind_links(const std::string& file) {
  fs::path path = file;
  std::error_code none;
  for (int links = 0; links < most_links && fs::is_symlink(path, none); ++links)
    path = path.parent_path() / fs::read_symlink(path, none);
  return path;
}

OutputPlace place_of(const std::string& file) {
  struct stat status;
  if (stat(file.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode)) return {file, status};
    return {behind_links(file), status};
  }
  if (errno != ENOENT) reject_output(file, errno);
  return {behind_links(file), std::nullopt};
}

bool may(const fs::path& path, int what) {
  return faccessat(AT_FDCWD, path.c_str(), what, AT_EACCESS) == 0;
}

/// Sets errno.
bool takes_new_files(const fs::path& folder) {
  struct stat status;
  if (stat(folder.c_str(), &status) != 0) return false;
  if (status.st_nlink == 0)
    return errno = ENOENT, false;  // it was removed, and is somebody's working directory
  // "/." because a file in the folder's place can be written to as well.
  return may(folder / ".", W_OK | X_OK);
}

}  // namespace

std::optional<FileIdentity> identity_of(const fs::path& file) {
  struct stat status;
  return stat(file.c_str(), &status) == 0 ? identity_of(status) : std::nullopt;
}

std::optional<FileIdentity> identity_of(int descriptor) {
  struct stat status;
  return fstat(descriptor, &status) == 0 ? identity_of(status) : std::nullopt;
}

fs::path OutputPlace::folder() const {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

OutputPlace writable_place(const std::string& file) {
  const OutputPlace place = place_of(file);
  if (place.there && S_ISDIR(place.there->st_mode)) reject_output(file, EISDIR);
  if (place.there && !may(place.path, W_OK)) reject_output(file, errno);
  if (place.is_special()) return place;
  if (!takes_new_files(place.folder()))
    throw InputError(file + ": cannot be written: folder " + place.folder().string() + ": " +
                     std::strerror(errno));
  if (!place.path.has_filename()) reject_output(file, EISDIR);
  return place;
}

std::optional<FileIdentity> identity_of(const OutputPlace& place) {
  if (place.there) return identity_of(*place.there);
  struct stat folder;
  if (stat(place.folder().c_str(), &folder) != 0) return std::nullopt;
  return FileIdentity{folder.st_dev, folder.st_ino, place.path.filename()};
}

}  // namespace bch::cli
