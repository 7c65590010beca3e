// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/exit_codes.hpp"
#include "bench/output_file.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

void reject_output(const std::string& destination, int error) {
  throw InputError(destination + ": cannot be written: " + std::strerror(error));
}

void write_all(int descriptor, std::string_view text, const std::string& destination) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) reject_output(destination, errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void write_standard_output(std::string_view text) {
  write_all(STDOUT_FILENO, text, "standard output");
}

void write_file(const std::string& file, std::string_view text) {
  OutputFile output(file);
  output.write(text);
  output.commit();
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
  if (fs::is_directory(target, none)) reject_output(file, EISDIR);
  // "/." because a file in the folder's place can be written to as well.
  const fs::path written = is_special(target) ? target : folder_of(target) / ".";
  if (access(written.c_str(), W_OK) != 0) reject_output(file, errno);
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
