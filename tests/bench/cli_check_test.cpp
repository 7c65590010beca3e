// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"
#include "tests/support/two_who_meet.hpp"

// `bch check`.

namespace bch::test {
namespace {

TEST(Cli, CheckWritesTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet()), people = folder.file("people.bch"),
                    pairs = folder.file("pairs.csv"), json = folder.file("check.json"),
                    page = folder.file("check.html");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "200", "--depths", "0,all", "-o", people}).code, 0);
  for (const Arguments& bodies : {Arguments{}, Arguments{"--depth", "4", "--leaves", "discs"},
                                  Arguments{"--bodies", "spheres", "--spheres", "64"},
                                  Arguments{"--character", "default:bulky", "--character", "default:female"},
                                  Arguments{"--character", people, "--clip-speed", "walk=1.3"}}) {
    std::vector<std::string> written;
    for (const char* const threads : {"1", "2"}) {
      const Ending run = bch(
          {"check", file, "--pairs", pairs, "--json", json, "--html", page, "--threads", threads}, bodies);
      EXPECT_EQ(run.code, 0) << run.err;
      EXPECT_GT(read_json(json)["all"]["overlapping"], 10);
      EXPECT_NE(read_text(page).find("two.txt"), std::string::npos);
      if (bodies.empty()) {  // a page tells nobody where its recording was
        EXPECT_EQ(read_text(page).find(folder.path().string()), std::string::npos);
      }
      written.push_back(run.out + read_text(pairs) + read_text(json) + read_text(page));
    }
    EXPECT_TRUE(written[0] == written[1]);
  }
}

}  // namespace
}  // namespace bch::test
