// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cstdlib>

#include "tests/support/bch_run.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// What the program writes, word for word, as the files in golden/ have it:
//   # a comment
//   @ NAME TEXT     makes a file; \n, \r, \t, \\, \" and \xHH in texts and words stand for bytes
//   $ WORDS         runs bch in the folder of these files, as a shell would; \" may keep blanks together
//   < NAME          shows a file
// Below a command stand its exit code and the lines of standard output (>) and standard error (!), below a file its lines.
// With BCH_REWRITE_GOLDEN in the environment, the files are written anew.

namespace bch::test {
namespace {

namespace fs = std::filesystem;

const fs::path golden = fs::path(__FILE__).parent_path() / "golden";

/// The words of a line; quotes keep blanks together.
Arguments words_of(const std::string& line) {
  Arguments words;
  bool quoted = false, open = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == ' ' && !quoted) {
      open = false;
      continue;
    }
    if (!std::exchange(open, true)) words.emplace_back();
    if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == '\\')
      words.back() += line.substr(i++, 2);
    else
      words.back() += line[i];
  }
  for (std::string& word : words) word = unescaped(word);
  return words;
}

/// Which instruction sets there are depends on the machine.
std::string without_isas(std::string text) {
  std::string names;
  for (const Implementation& each : implementations())
    names += (names.empty() ? "" : ", ") + std::string(each.name);
  for (std::size_t at; (at = text.find(names)) != std::string::npos;)
    text.replace(at, names.size(), "{ISAS}");
  return text;
}

std::string marked(const char* mark, const std::string& text) {
  std::string all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    all += line.empty() ? std::string(mark, 1) + "\n" : mark + line + "\n";
    if (all.size() > 200'000) throw std::runtime_error("too much to be compared");
  }
  return text.empty() || text.ends_with('\n') ? all : all + mark + "[no line feed]\n";
}

std::string outcome_of(const Arguments& words) {
  const Ending run = bch(words);
  EXPECT_TRUE(run.code < 2 || run.out.empty()) << run.out;
  std::istringstream lines(words.empty() || words.back() != "--help" ? "" : run.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  return without_isas(fmt::format("{}\n", run.code) + marked("> ", run.out) + marked("! ", run.err));
}

/// What a line asks for.
std::string outcome_of(const std::string& line) {
  const std::string rest = line.substr(std::min<std::size_t>(2, line.size()));
  if (line[0] == '$') return outcome_of(words_of(rest));
  if (line[0] == '<') return marked("> ", read_text(rest));
  if (line[0] != '@') return {};
  const std::size_t end = std::min(rest.find(' '), rest.size());
  std::ofstream(rest.substr(0, end), std::ios::binary)
      << unescaped(rest.substr(std::min(end + 1, rest.size())));
  return {};
}

/// Whether a line is one of an outcome.
bool is_outcome(const std::string& line) {
  return !line.empty() && std::string_view("0123456789>!").find(line[0]) != std::string_view::npos;
}

class CliGolden : public testing::TestWithParam<const char*> {
 protected:
  CliGolden() {
    folder.write("box.obj", box), folder.write("four.csv", four_agents);
    folder.write("two.txt", two_who_meet());
    fs::current_path(folder.path());
  }
  ~CliGolden() override { fs::current_path(before); }

  const fs::path before = fs::current_path();
  const TemporaryFolder folder;
};

TEST_P(CliGolden, IsWhatTheProgramWrites) {
  const fs::path file = golden / (std::string(GetParam()) + ".txt");
  std::istringstream lines(read_text(file));
  ASSERT_FALSE(lines.str().empty()) << file;
  std::string written, asked, expected;
  const auto compare = [&] {
    const std::string outcome = outcome_of(asked);
    EXPECT_EQ(outcome, expected) << asked;
    written += outcome;
  };
  for (std::string line; std::getline(lines, line);) {
    if (is_outcome(line)) {
      expected += line + "\n";
      continue;
    }
    compare();
    asked = line, expected.clear();
    written += line + "\n";
  }
  compare();
  if (std::getenv("BCH_REWRITE_GOLDEN") != nullptr) std::ofstream(file, std::ios::binary) << written;
}

INSTANTIATE_TEST_SUITE_P(Files, CliGolden,
                         testing::Values("baked", "check", "help", "inspect", "place", "query",
                                         "query_options", "resolve", "tables", "usage"),
                         [](const auto& file) { return std::string(file.param); });

}  // namespace
}  // namespace bch::test
