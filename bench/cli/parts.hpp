// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

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

/// Returns a file's name, size and checksum (XXH3, 64 bits, as `xxhsum -H3` tells it).
/// Errors:  throws InputError.
nlohmann::ordered_json identity_of_file(const std::string& file, const std::string& name);

/// Returns what parts of the same run have in common.
/// Inputs:  the options that were given; what is read, of which built-in characters are no files.
nlohmann::ordered_json run_of(const std::string& command, const nlohmann::ordered_json& options,
                              const std::vector<std::string>& inputs);

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
  /// Makes the folder, and takes away the manifest of another run.
  void begin() const;
  /// Writes the manifest. `share`: what the part did.
  void finish(const nlohmann::ordered_json& run, const nlohmann::ordered_json& share,
              const std::vector<std::string>& kinds) const;

 private:
  std::string folder_;
  Part part_;
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

/// The table of a part of bch query.
constexpr const char* answers_kind = "answers.csv";
/// Returns the tables of all parts as one.
std::string joined_tables(const WholeRun& whole, const std::string& kind);

}  // namespace bch::cli
