// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <bch/import.hpp>

#include "tests/support/temporary_folder.hpp"

namespace bch::test {

/// Imports the text of a glTF file, or says why it is refused.
class ImportGltf : public testing::Test {
 protected:
  TemporaryFolder folder;

  ImportedCharacter import(const std::string& text) {
    ImportedCharacter imported = import_character(folder.write("file.gltf", text));
    validate(imported.character);
    return imported;
  }

  void expect_error(const std::string& text, const std::string& reason) {
    try {
      import(text);
      ADD_FAILURE() << "accepted, not refused for '" << reason << "'";
    } catch (const ImportError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }

  static bool has_note(const ImportReport& report, const std::string& part) {
    return std::any_of(report.notes.begin(), report.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
  }
};

/// A text with a part of it replaced.
inline std::string with(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  if (place == std::string::npos) throw std::logic_error("no " + from);
  return std::string(text).replace(place, from.size(), to);
}

}  // namespace bch::test
