// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch::test {

using Arguments = std::vector<std::string>;

/// A person-sized box, 0.5 m x 0.3 m on the ground, y up.
constexpr const char* box =
    "v -0.25 0 -0.15\nv 0.25 0 -0.15\nv 0.25 0 0.15\nv -0.25 0 0.15\n"
    "v -0.25 1.8 -0.15\nv 0.25 1.8 -0.15\nv 0.25 1.8 0.15\nv -0.25 1.8 0.15\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

using Rows = std::vector<std::vector<std::string>>;

/// A scene of four boxes that `bch query --what` is asked about.
class QueryWhat : public testing::Test {
 protected:
  Ending run(const std::string& what, const Arguments& more) const {
    Arguments arguments{"query", shapes, agents, "--up", "y", "--scale", "1", "--what", what};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(BCH_PROGRAM, arguments);
  }

  /// Without the header, which has to be as said.
  Rows rows(const std::string& what, const std::string& header, const Arguments& more) const {
    const Ending ending = run(what, more);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err.find("bch: "), std::string::npos) << ending.err;  // notes of the import alone
    std::istringstream lines(ending.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, header);
    Rows all;
    while (std::getline(lines, line)) {
      std::istringstream fields(line);
      for (all.emplace_back(); std::getline(fields, line, ',');) all.back().push_back(line);
    }
    return all;
  }

  void expect_usage_error(const Arguments& more, const std::string& word) const {
    Arguments arguments{"query", shapes, agents, pairs};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ending ending = run_program(BCH_PROGRAM, arguments);
    EXPECT_EQ(ending.code, 2) << ending.err;
    EXPECT_EQ(ending.out, "");
    EXPECT_NE(ending.err.find(word), std::string::npos) << ending.err;
  }

  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box);
  /// b overlaps a by 0.1 m, c stands 0.05 m beside a, d is far away. a and c approach by 0.2 m, d follows a.
  const std::string agents = folder.write("agents.csv",
                                          "id,shape,x,y,heading,dx,dy\na,0,0,0,0,0,0.15\nb,0,0.4,0,0,1,0\n"
                                          "c,0,0,0.35,0,0,-0.05\nd,0,9,9,1,0,0.15\n");
  const std::string pairs = folder.write("pairs.csv", "first,second\nb,a\na,c\na,d\n");
};

inline double number(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

}  // namespace bch::test
