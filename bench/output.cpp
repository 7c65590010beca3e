// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/exit_codes.hpp"
#include "bench/interrupt.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void reject(const std::string& destination, int error) {
  throw InputError(destination + ": cannot be written: " + std::strerror(error));
}

/// Returns: 0 or the error.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int write_all(int descriptor, std::span<const std::string_view> parts) {
  for (const std::string_view part : parts)
    if (const int error = write_all(descriptor, part)) return error;
  return 0;
}

/// Closes after `error`, which is 0 for none. Returns: 0 or the first error.
int close_after(int error, int descriptor) {
  if (close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

bool is_special(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return fs::exists(status) && !fs::is_regular_file(status);
}

/// Where a symbolic link leads, so that the link stays and its target is replaced.
fs::path resolved(const std::string& file) {
  std::error_code failed;
  const fs::path target = fs::canonical(file, failed);
  return failed ? fs::path(file) : target;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

void write_standard_output(std::string_view text) {
  if (const int error = write_all(STDOUT_FILENO, text)) reject("standard output", error);
}

void write_file(const std::string& file, std::string_view text) {
  write_file(file, {&text, 1});
}

void write_file(const std::string& file, std::span<const std::string_view> parts) {
  const fs::path target = resolved(file);
  if (is_special(target)) {
    const int descriptor = open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) reject(file, errno);
    if (const int error = close_after(write_all(descriptor, parts), descriptor)) reject(file, error);
    return;
  }
  const fs::path temporary = target.string() + ".bch-" + std::to_string(getpid());
  const RemovedOnSignal guard(temporary);
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) reject(file, errno);
  int error = write_all(descriptor, parts);
  // On the disk before it has the name: a crash must not leave a file of zeros there.
  if (error == 0 && fsync(descriptor) != 0) error = errno;
  error = close_after(error, descriptor);
  if (error == 0 && rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(temporary.c_str());
  reject(file, error);
}

void write_json(const std::string& file, const nlohmann::ordered_json& json) {
  if (file.empty()) return;
  write_file(file, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void make_folder(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder + ": cannot be made a folder: " + error.message());
}

void require_writable(const std::string& file) {
  if (file.empty()) return;
  const fs::path target = resolved(file);
  std::error_code none;
  if (fs::is_directory(target, none)) reject(file, EISDIR);
  // "/." because a file in the folder's place can be written to as well.
  const fs::path written = is_special(target) ? target : folder_of(target) / ".";
  if (access(written.c_str(), W_OK) != 0) reject(file, errno);
}

void require_outputs(std::initializer_list<OutputOption> options) {
  std::map<fs::path, const char*> written;
  for (const auto& [name, file] : options) {
    if (file.empty()) continue;
    if (file == "-") throw UsageError(std::string(name) + ": '-' is not a file");
    require_writable(file);
    std::error_code failed;  // in a circle of links, which the writing replaces
    const fs::path target = fs::weakly_canonical(fs::absolute(file), failed);
    if (is_special(target)) continue;
    const auto [other, added] = written.emplace(target, name);
    if (!added)
      throw UsageError(std::string(other->second) + " and " + name + ": " + file + " cannot be both");
  }
}

}  // namespace bch::cli
