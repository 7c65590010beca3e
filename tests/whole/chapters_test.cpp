// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

// What chapters show is what runs. BCH_SOURCE: the repository.

namespace {

std::string read(const char* file) {
  std::ifstream stream(std::filesystem::path(BCH_SOURCE) / file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(Readme, ShowsTheLinesThatCiRuns) {
  const std::string ci = read(".ci/run");
  const std::string readme = read("README.md");
  std::istringstream lines(ci);
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("apt-get update")) {
      ++found;
      EXPECT_NE(readme.find("\n" + line + "\n"), std::string::npos) << line;
    }
  EXPECT_EQ(found, 2u);
}

TEST(Readme, IsShort) {
  const std::string readme = read("README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 160);
  EXPECT_LE(readme.size(), 10'240u);
}

/// But for indentation; `install` runs the program.
TEST(Tutorial, ShowsPartsOfItsProgram) {
  const auto flush = [](const std::string& text) {
    return std::regex_replace(text, std::regex("\n +"), "\n");
  };
  const std::string program = flush(read("tests/examples/consumer/tutorial.cpp"));
  const std::string chapter = read("kernel/README.md");
  const std::size_t end = chapter.find("\n## ", chapter.find("\n## Tutorial") + 1);
  const std::string begin_of_part = "```cpp", end_of_part = "\n```";
  int parts = 0;
  for (std::size_t at = chapter.find(begin_of_part); at < end;
       at = chapter.find(begin_of_part, at), ++parts) {
    at += begin_of_part.size();
    const std::string part = flush(chapter.substr(at, chapter.find(end_of_part, at) - at));
    EXPECT_NE(program.find(part), std::string::npos) << part;
  }
  EXPECT_GE(parts, 6);
}

}  // namespace
