// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace bch::cli {

/// Errors of all: throw InputError naming the destination and the reason.

[[noreturn]] void reject_output(const std::string& destination, int error, const std::string& where = {});

/// Writes text for people to standard output: see printable().
void write_standard_output(std::string_view text);
/// Writes data for programs to standard output, byte for byte; as text for people where it is a terminal.
void write_standard_data(std::string_view data);
/// Writes text to an open file, which errors call `destination`.
void write_all(int descriptor, std::string_view text, const std::string& destination);

/// Writes text to a file. The file holds all of the text or is left as it was, see OutputFile.
void write_file(const std::string& file, std::string_view text);
/// Writes JSON to a file. An empty name is no file: nothing is written. Bytes of names that are not UTF-8 are
/// replaced.
void write_json(const std::string& file, const nlohmann::ordered_json& json);

/// Makes a folder and the folders above it. An empty name is no folder and no error, nor is a folder that
/// exists.
void make_folder(const std::string& folder);

/// Represents an option that names a file to write, empty where it was not given.
struct OutputOption {
  std::string name;
  std::string file;
};

/// Refuses, before anything is read, outputs that cannot be written or that would destroy something: an output that is
/// also an input, by way of links and other paths as well, or a buffer that lies beside one (glTF's .bin), and two outputs
/// of one path. Devices may be named several times.
/// Inputs:  all files that the command is going to read; those that do not exist are left to their readers.
/// Errors:  throws UsageError, and InputError as OutputFile does.
void require_outputs(const std::vector<OutputOption>& outputs, const std::vector<std::string>& inputs);

/// Refuses an output that is an input. It is meant for files that may or may not be written later.
/// Errors:  throws UsageError.
void require_unread(const OutputOption& output, const std::vector<std::string>& inputs);

}  // namespace bch::cli
