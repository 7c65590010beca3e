// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bch_run.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bch::test {

Ending bch(Arguments arguments, const Arguments& more, const Streams& streams) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(BCH_PROGRAM, arguments, streams);
}

void expect_failure(const Ending& run, int code, const Arguments& words) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(lines(run.err), 1u) << run.err;
  EXPECT_TRUE(run.err.starts_with("bch: ")) << run.err;
  for (const std::string& word : words)
    EXPECT_NE(run.err.find(word), std::string::npos) << "no '" << word << "' in: " << run.err;
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

std::string crooked_lattice(int side, int shapes, int levels) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading,level\n";
  for (int i = 0; i < side * side; ++i)
    csv << i << ',' << i % shapes << ',' << 0.43 * (i % side) + 0.01 * (i % 7) << ',' << 0.41 * (i / side)
        << ',' << 0.7 * i << ',' << i % levels << '\n';
  return csv.str();
}

std::string two_who_meet() {
  std::string text = "# framerate: 25\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < 100; ++k)
    text += fmt::format("7 {0} {1:.3f} 0 1.8\n5 {0} {2:.3f} 0.1 1.7\n12 {0} 3 {3:.3f} 1.6\n", k,
                        -2.4 + 0.048 * k, 2.4 - 0.048 * k, 5 + 0.04 * k);
  return text;
}

nlohmann::json read_json(const std::filesystem::path& file) {
  return nlohmann::json::parse(read_text(file));
}

}  // namespace bch::test
