// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// `bch query`.

namespace bch::test {
namespace {

TEST(Cli, AllPairsEqualsExplicitPairs) {
  const TemporaryFolder folder;
  constexpr int side = 9;
  const std::string shapes = folder.write("box.obj", box),
                    agents = folder.write("agents.csv", crooked_lattice(side));
  std::string every = "first,second\n";
  for (int a = 0; a < side * side; ++a)
    for (int b = a + 1; b < side * side; ++b) every += std::to_string(a) + "," + std::to_string(b) + "\n";
  const Ending each = bch({"query", shapes, agents, folder.write("pairs.csv", every)}, as_metres);
  const Ending all = bch({"query", shapes, agents, "--all-pairs"}, as_metres);
  ASSERT_EQ(each.code, 0) << each.err;
  ASSERT_EQ(all.code, 0) << all.err;
  std::string expected;
  std::istringstream rows(each.out);
  for (std::string row; std::getline(rows, row);)
    if (!row.ends_with(",0")) expected += row + "\n";
  EXPECT_EQ(all.out, expected);
  EXPECT_GT(lines(all.out), 20u);
}

/// So many agents at one place.
std::string spot(int count) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading\n";
  for (int i = 0; i < count; ++i) csv << i << ",0,1,1,0\n";
  return csv.str();
}

/// Of so many pairs that they are answered and written piece by piece.
TEST(Cli, QueryAnswersMillionsOfPairs) {
  const TemporaryFolder folder;
  const Ending run =
      bch({"query", folder.write("box.obj", box), folder.write("agents.csv", spot(1500)), "--all-pairs"},
          as_metres);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(lines(run.out), 1u + 1500 * 1499 / 2);
  EXPECT_TRUE(run.out.starts_with("first,second,hit\n0,1,1\n0,2,1\n"));
  EXPECT_TRUE(run.out.ends_with("\n1497,1498,1\n1497,1499,1\n1498,1499,1\n"));
}

// ---- `bch crowd`, and pictures.

/// What must not depend on the machine: the answers.
struct CrowdAnswer {
  std::vector<std::uint64_t> hits;
  std::string csv;
  friend bool operator==(const CrowdAnswer&, const CrowdAnswer&) = default;
};

CrowdAnswer small_crowd(const TemporaryFolder& folder, const Arguments& more) {
  const std::string json_file = folder.file("crowd.json"), csv_file = folder.file("crowd.csv");
  const Ending run =
      bch({"crowd", "--agents", "200", "--poses", "5", "--json", json_file, "--csv", csv_file}, more);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  CrowdAnswer answer{{}, read_text(csv_file)};
  const auto json = read_json(json_file);
  for (const auto& level : json["levels"]) answer.hits.push_back(level["hits"]);
  return answer;
}

TEST(Cli, CrowdGivesTheSameAnswersEverywhere) {
  const TemporaryFolder folder;
  const CrowdAnswer first = small_crowd(folder, {"--threads", "1"});
  ASSERT_EQ(first.hits.size(), 4u);
  EXPECT_GT(first.hits[0], first.hits[3]);
  EXPECT_EQ(lines(first.csv), first.hits[3] + 1);
  EXPECT_EQ(first, small_crowd(folder, {"--threads", "3"}));
  EXPECT_NE(first, small_crowd(folder, {"--seed", "2"}));
  for (const Implementation& row : supported())
    EXPECT_EQ(first, small_crowd(folder, {"--isa", row.name})) << row.name;
}

/// The collisions of the last frame of a small crowd whose bodies are posed anew, and their pairs.
CrowdAnswer live_crowd(const TemporaryFolder& folder, const Arguments& more) {
  const std::string json_file = folder.file("live.json"), csv_file = folder.file("live.csv");
  const Ending run = bch({"crowd", "--live", "--agents", "60", "--spheres", "64", "--frames", "2", "--json",
                          json_file, "--csv", csv_file},
                         more);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto json = read_json(json_file);
  EXPECT_GT(json["checked_pairs"], 0u);
  EXPECT_EQ(json["checked_pairs"], json["candidate_pairs"]);
  return {{json["collisions"]}, read_text(csv_file)};
}

TEST(Cli, LiveCrowdGivesTheSameAnswersEverywhere) {
  const TemporaryFolder folder;
  const CrowdAnswer first = live_crowd(folder, {"--threads", "1"});
  EXPECT_GT(first.hits[0], 0u);
  EXPECT_EQ(lines(first.csv), first.hits[0] + 1);
  EXPECT_EQ(first, live_crowd(folder, {"--threads", "3", "--isa", "scalar"}));
  EXPECT_NE(first, live_crowd(folder, {"--seed", "2"}));
}

/// Of shapes, and of the last frame of bodies that are posed anew. The terminal's last line is about all depths.
TEST(Cli, CrowdDrawsAPicture) {
  const TemporaryFolder folder;
  const std::string svg_file = folder.file("crowd.svg");
  const Arguments of_shapes{"crowd", "--agents", "200", "--poses", "5"},
      live{"crowd", "--live", "--agents", "60", "--spheres", "64"};
  for (const auto& [crowd, says] :
       {std::pair(of_shapes, ": depth 6 clears"), std::pair(live, "Bodies of 64 spheres.")}) {
    const Ending run = bch(crowd, {"--svg", svg_file});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string svg = read_text(svg_file);
    EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    EXPECT_LT(svg.size(), 600000u);
    for (const char* id :
         {"crowd", "colliding", "cleared", "free", "overlaps", "single-cylinders", "legend", "scale"})
      EXPECT_TRUE(has(svg, "id=\"" + std::string(id) + "\""));
    EXPECT_TRUE(has(svg, says));
    EXPECT_EQ(count_of(svg, "<g"), count_of(svg, "</g>"));
    for (const char* const number : {"nan", "inf"}) EXPECT_EQ(count_of(svg, number), 0u);
  }
}

TEST(Cli, InspectDrawsSpheresFromTwoSides) {
  const TemporaryFolder folder;
  const std::string svg_file = folder.file("body.svg"), json_file = folder.file("body.json");
  const Ending run = bch({"inspect", "default:male", "--bodies", "spheres", "--spheres", "64", "--clip",
                          "walk", "--time", "0.5", "--svg", svg_file, "--json", json_file});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(read_json(json_file)["body"]["spheres_xyz_radius_m"].size(), 64u);
  const std::string svg = read_text(svg_file);
  EXPECT_LT(svg.size(), 150'000u);
  EXPECT_EQ(count_of(svg, "<circle"), 2u * 64 + 2);  // two views and the legend
  EXPECT_EQ(count_of(svg, "<g"), count_of(svg, "</g>"));
}

// ---- `bch check`.

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
