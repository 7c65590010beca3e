// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace bch::cli {

/// Errors of all: throw InputError naming the destination and the reason.

[[noreturn]] void reject_output(const std::string& destination, int error);

void write_standard_output(std::string_view text);
/// To an open file, which errors call `destination`.
void write_all(int descriptor, std::string_view text, const std::string& destination);

/// The file holds all of the text or is left as it was, see OutputFile.
void write_file(const std::string& file, std::string_view text);
/// An empty name is no file: nothing is written. Bytes of names that are not UTF-8 are replaced.
void write_json(const std::string& file, const nlohmann::ordered_json& json);

/// And the folders above it. An empty name is no folder and fine, as is one that is there.
void make_folder(const std::string& folder);

/// Says early what write_file() would say after the work was done: no such folder, or one that cannot be
/// written to. An empty name is no file and fine.
void require_writable(const std::string& file);

/// An option that names a file to write, empty where it was not given.
struct OutputOption {
  const char* name;
  const std::string& file;
};

/// The same of all; and they are files, of which no two are one, unless it is a device.
/// Errors:  throws UsageError as well.
void require_outputs(std::initializer_list<OutputOption> options);

}  // namespace bch::cli
