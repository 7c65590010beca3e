// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/output.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output_file.hpp"
#include "bench/base/system.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;

/// Returns whether an input may be a model that reads this file as well: a buffer, materials, motions in its
/// folder. Which ones a model names is not known before it is read.
bool may_be_read_by(const fs::path& input, const fs::path& output) {
  std::error_code none;
  const std::string ending = output.extension().string();
  const bool named = ending == ".bin" || ending == ".mtl" || ending == ".md5anim";
  return named && fs::exists(output, none) &&
         fs::equivalent(fs::canonical(input, none).parent_path(), fs::canonical(output, none).parent_path(),
                        none);
}

}  // namespace

void reject_output(const std::string& destination, int error, const std::string& where) {
  throw InputError(destination + ": cannot be written: " + where + std::strerror(error));
}

void write_all(int descriptor, std::string_view text, const std::string& destination) {
  while (!text.empty()) {
    const std::ptrdiff_t written = write_some(descriptor, text);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) reject_output(destination, errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void write_standard_output(std::string_view text) {
  write_all(standard_output, printable(text), "standard output");
}

void write_standard_data(std::string_view data) {
  if (is_terminal(standard_output)) return write_standard_output(data);
  write_all(standard_output, data, "standard output");
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
  std::map<fs::path, std::string> written;  // and by which option
  for (const OutputOption& output : outputs) {
    const auto& [name, file] = output;
    if (file.empty()) continue;
    if (file == "-") throw UsageError(name + ": '-' is not a file");
    if (!is_replaced(file)) continue;
    { const OutputFile tried(file); }
    const fs::path place = fs::weakly_canonical(fs::absolute(file));
    const auto [other, added] = written.emplace(place, name);
    if (!added) throw UsageError(other->second + " and " + name + ": " + file + " cannot be both");
    require_unread(output, inputs);
    for (const std::string& input : inputs)
      if (may_be_read_by(input, place))
        throw UsageError(name + ": " + file + " lies beside " + input + ", which may need it");
  }
}

void require_unread(const OutputOption& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (std::error_code none; fs::equivalent(output.file, input, none))
      throw UsageError(output.name + ": " + output.file + " would overwrite " + input +
                       ", an input of this command");
}

}  // namespace bch::cli
