// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/standard.hpp"

// Tables of cases in text files: a line for each, whose fields, divided by " | ", are what is asked and, last, what is to be answered.
// In fields \n, \t, \r, \\ and \xNN are bytes, and {name} is the text of a line "name := text" above. "//" begins a line that says something
// to the reader. With BCH_REWRITE_TABLES in the environment the answers are written in place of what was expected.

namespace bch::test {

/// Returns the bytes that a text stands for: \n, \t, \r, \xNN, and any other character behind a \ for itself.
inline std::string unescaped(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      bytes += text[i];
    } else if (text.at(++i) == 'x') {
      bytes += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      bytes += text[i] == 'n' ? '\n' : text[i] == 't' ? '\t' : text[i] == 'r' ? '\r' : text[i];
    }
  }
  return bytes;
}

class Table {
 public:
  explicit Table(const std::filesystem::path& file) : file_(file) {
    std::ifstream stream(file);
    EXPECT_TRUE(stream) << file << " cannot be read";
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
  }

  /// Asks every case, whose fields but the last `answer` gets, and compares.
  template <class Answer>
  void expect(const Answer& answer) {
    std::map<std::string, std::string> names;
    for (std::string& line : lines_) {
      if (line.empty() || line.starts_with("//")) continue;
      if (const std::size_t at = line.find(" := "); at != std::string::npos) {
        names[line.substr(0, at)] = line.substr(at + 4);
        continue;
      }
      const std::size_t last = line.rfind(" | ");
      std::string asked = line.substr(0, last);
      for (const auto& [name, text] : names)
        for (std::size_t at; (at = asked.find("{" + name + "}")) != std::string::npos;)
          asked.replace(at, name.size() + 2, text);
      const std::string answered = answer(fields_of(asked));
      EXPECT_EQ(answered, unescaped(line.substr(last + 3))) << file_.filename() << ": " << line;
      line.replace(last + 3, std::string::npos, escaped(answered));
    }
    if (std::getenv("BCH_REWRITE_TABLES") == nullptr) return;
    std::ofstream stream(file_);
    for (const std::string& line : lines_) stream << line << "\n";
  }

 private:
  static std::string escaped(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) text.append(c == '\\' || c == '\n' ? "\\" : "").push_back(c == '\n' ? 'n' : c);
    return text;
  }
  static std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    for (std::size_t at = 0, end; at <= line.size(); at = end + 3) {
      end = std::min(line.find(" | ", at), line.size());
      fields.push_back(unescaped(line.substr(at, end - at)));
    }
    return fields;
  }

  std::filesystem::path file_;
  std::vector<std::string> lines_;
};

/// Asks the cases of the table that lies beside a test's source, __FILE__.
template <class Answer>
void expect_table(const char* source, const std::string& name, const Answer& answer) {
  Table(std::filesystem::path(source).parent_path() / name).expect(answer);
}

}  // namespace bch::test
