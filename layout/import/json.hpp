// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

// Private to the importer: JSON whose errors name the place.

namespace bch::detail::importing {

/// Represents a value of a JSON document and its place there, such as "accessors[3].count". It may be absent. The document and the
/// file's path must outlive it. Every function but the two operators of absent values throws ImportError, naming file and
/// place, on a value of another type.
class JsonValue {
 public:
  JsonValue(const std::filesystem::path& file, const nlohmann::json& document)
      : file_(&file), value_(&document) {}

  explicit operator bool() const { return value_ != nullptr; }

  /// Returns the member of that name: absent if this has none or is absent itself.
  JsonValue operator[](const char* member) const;
  /// Returns an element of an array.
  /// Errors:  throws ImportError if the array has no such element.
  JsonValue operator[](std::size_t index) const;

  std::size_t size() const;                        ///< of an array; 0 if absent
  std::size_t integer(std::size_t largest) const;  ///< from 0 to `largest`
  std::size_t integer(std::size_t largest, std::size_t if_absent) const;
  float number() const;
  bool as_bool() const;      ///< false if absent
  std::string text() const;  ///< empty if absent

  const std::string& place() const { return place_; }
  [[noreturn]] void reject(const std::string& reason) const;

 private:
  const std::filesystem::path* file_;
  const nlohmann::json* value_;
  std::string place_;

  JsonValue(const JsonValue& parent, const nlohmann::json* value, std::string place);
};

}  // namespace bch::detail::importing
