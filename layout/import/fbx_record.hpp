// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Private to the importer: an FBX file, binary or text, as a tree of records. assimp hands over neither how keys are interpolated nor
// which object a name belongs to, so these are read here.

namespace bch::detail::importing {

/// Holds one value of a record. Arrays are decoded when they are asked for.
struct FbxValue {
  char type = 0;           ///< as in a binary file; 'n' is a number in a text file, 't' an array in one
  double number = 0;       ///< of a number
  std::int64_t whole = 0;  ///< of a number: towards zero, at most what an int64 holds
  std::string_view bytes;  ///< of a text, or of an array as it lies in the file
  std::uint32_t size = 0;  ///< of an array in a binary file: elements
  bool packed = false;     ///< likewise: compressed by zlib

  bool is_text() const { return type == 'S' || type == 'R'; }
};

/// Represents a record: a name, values, and records below it.
struct FbxRecord {
  std::string_view name;
  std::vector<FbxValue> values;
  std::vector<FbxRecord> children;

  /// Returns the first record of that name below this one, or nullptr.
  const FbxRecord* child(std::string_view child_name) const;
  /// Returns a text, or an empty one where there is none.
  std::string_view text(std::size_t index) const;
  /// Returns a number, or 0 where there is none.
  double number(std::size_t index) const;
  std::int64_t whole(std::size_t index) const;
};

/// Holds the bytes of a file and its records.
class FbxFile {
 public:
  /// Errors:  throws ImportError on records that do not end within the file or nest too deeply.
  explicit FbxFile(const std::filesystem::path& path);
  FbxFile(const FbxFile&) = delete;
  FbxFile& operator=(const FbxFile&) = delete;

  const FbxRecord& root() const { return root_; }

  /// Returns the numbers of the array in the record of that name below an object; none where there is no such record.
  /// Errors:  throws ImportError on an array that cannot be decoded.
  std::vector<double> numbers(const FbxRecord& object, std::string_view name) const;
  /// Does the same for an array of floats that text files hold as whole numbers of the same bits.
  std::vector<double> float_bits(const FbxRecord& object, std::string_view name) const;

  [[noreturn]] void reject(const std::string& reason) const;

 private:
  std::filesystem::path path_;
  std::string bytes_;
  FbxRecord root_;
};

}  // namespace bch::detail::importing
