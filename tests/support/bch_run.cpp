// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bch_run.hpp"

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

nlohmann::json read_json(const std::filesystem::path& file) {
  return nlohmann::json::parse(read_text(file));
}

}  // namespace bch::test
