// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/base/output_file.hpp"

namespace bch::cli {

/// Represents one of the parts in which a run is done, 1 to `count`.
struct Part {
  std::uint32_t number = 1, count = 1;

  /// Returns which of so many items belong to it: from the first number on, up to the second.
  std::pair<std::uint64_t, std::uint64_t> share_of(std::uint64_t items) const;
  std::string name() const;  ///< as people say it
};

/// Reads "I/N".
/// Errors:  throws UsageError.
Part parse_part(const std::string& text);

/// Returns what all parts of a command have in common: the options that were given, except for those that do not change an answer, and
/// the files that are read.
nlohmann::ordered_json run_of(const CLI::App& command, const std::vector<std::string>& inputs);

/// Reads JSON of a part, which is flat: what nests deeper than all that parts have is refused, before anything that recurses
/// sees it.
/// Errors:  throws InputError where there is no regular file, or no such JSON.
nlohmann::ordered_json read_part_json(const std::string& file);

/// The kinds of files that a part of a command has; none of a command that is not done in parts.
constexpr const char *frames_kind = "frames.csv", *pairs_kind = "pairs.csv", *events_kind = "events.csv",
                     *summary_kind = "summary.json", *answers_kind = "answers.csv";
std::vector<std::string> kinds_of(const std::string& command);

/// Returns name, size and checksum (XXH3, 64 bits, as `xxhsum -H3` tells it) of what was written into a file: whatever has its
/// name afterwards may be somebody else's.
nlohmann::ordered_json identity_of(const StreamedFile& file);

/// Represents a part of a run in a folder: its files, and a manifest that says what was run and which bytes these have. The
/// manifest is written last, so that a part that has one is whole.
/// Errors of all: throw InputError.
class PartFiles {
 public:
  PartFiles(std::string folder, Part part);

  const Part& part() const noexcept { return part_; }
  std::string manifest() const { return file("manifest.json"); }
  std::string file(const std::string& kind) const;

  /// Returns whether the part is there, whole, and of this run.
  bool is_done(const nlohmann::ordered_json& run) const;
  std::string done_line() const;  ///< tells that it is
  /// Makes the folder. Two processes may do one part at a time: each file is replaced by the same bytes.
  /// Errors:  throws UsageError where the part would overwrite an input.
  void prepare(const std::string& command, const std::vector<std::string>& inputs) const;
  /// Takes away the manifest of another run.
  void begin() const;
  /// Writes the manifest. `share`: what the part did; `files`: the identity of each.
  void finish(const nlohmann::ordered_json& run, const nlohmann::ordered_json& share,
              const nlohmann::ordered_json& files) const;

 private:
  std::string folder_;
  Part part_;
};

/// Holds the options of a command that does a part of its work.
struct PartOptions {
  std::string part, folder;

  void add_to(CLI::App& command);
  /// Returns whether a part is wanted.
  /// Errors:  throws UsageError where one of the options is there without the other.
  bool are_given() const;
  PartFiles files() const { return {folder, parse_part(part)}; }
};

/// Holds the parts that make a run.
struct WholeRun {
  nlohmann::ordered_json run;
  std::vector<PartFiles> parts;    ///< in their order
  std::vector<std::string> files;  ///< all that are read
};

/// Finds the parts of a run, by their manifests or by a folder that has these.
/// Errors:  throws InputError naming the part that is missing, damaged, twice there or of another run.
WholeRun find_parts(const std::vector<std::string>& names);

/// Returns the tables of all parts as one.
std::string joined_tables(const WholeRun& whole, const std::string& kind);

}  // namespace bch::cli
