// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output_file.hpp"
#include "bench/base/printable.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;

/// `output` is what errors call the file.
void require_unread(const std::string& output, const FileIdentity& identity,
                    const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (identity_of(fs::path(input)) == identity)
      throw UsageError(output + " would overwrite " + input + ", an input of this command");
}

/// Returns whether an input may be a model that reads this file as well: a buffer, materials, motions in its
/// folder. Which ones a model names is not known before it is read.
bool may_be_read_by(const fs::path& input, const fs::path& output) {
  std::error_code none;
  const std::string ending = output.extension();
  const bool named = ending == ".bin" || ending == ".mtl" || ending == ".md5anim";
  return named && fs::exists(output, none) &&
         fs::equivalent(fs::canonical(input, none).parent_path(), fs::canonical(output, none).parent_path(),
                        none);
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
  write_all(STDOUT_FILENO, printable(text), "standard output");
}

void write_standard_data(std::string_view data) {
  if (isatty(STDOUT_FILENO) == 1) return write_standard_output(data);
  write_all(STDOUT_FILENO, data, "standard output");
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

void require_outputs(const std::vector<OutputOption>& outputs, const std::vector<std::string>& inputs) {
  std::map<FileIdentity, std::string> written;  // and by whom
  if (const auto file = identity_of(STDOUT_FILENO)) {
    require_unread("standard output", *file, inputs);
    written.emplace(*file, "standard output");
  }
  for (const auto& [name, file] : outputs) {
    if (file.empty()) continue;
    if (file == "-") throw UsageError(name + ": '-' is not a file");
    const OutputPlace place = writable_place(file);
    const auto identity = identity_of(place);
    if (!identity) continue;
    const auto [other, added] = written.emplace(*identity, name);
    if (!added) throw UsageError(other->second + " and " + name + ": " + file + " cannot be both");
    require_unread(name + ": " + file, *identity, inputs);
    for (const std::string& input : inputs)
      if (may_be_read_by(input, place.path))
        throw UsageError(name + ": " + file + " lies beside " + input + ", which may need it");
  }
}

void require_unread(const OutputOption& output, const std::vector<std::string>& inputs) {
  if (const auto identity = identity_of(fs::path(output.file)))
    require_unread(output.name + ": " + output.file, *identity, inputs);
}

}  // namespace bch::cli
