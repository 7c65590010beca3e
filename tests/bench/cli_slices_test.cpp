// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// `--slices` and heights, from baking to answers.

namespace bch::test {
namespace {

std::string agents_at_heights(int side, int shapes) {
  std::ostringstream csv;
  csv << "id,shape,x,y,z,heading\n";
  for (int i = 0; i < side * side; ++i)
    csv << i << ',' << i % shapes << ',' << 0.43 * (i % side) << ',' << 0.41 * (i / side) << ','
        << 0.4 * (i % 3) << ',' << 0.7 * i << '\n';
  return csv.str();
}

TEST(Cli, BakedSlabsAnswerLikeTheirCharacter) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("female.bch"),
                    agents = folder.write("agents.csv", agents_at_heights(9, 5));
  const Arguments how{"--poses", "5", "--slices", "0.4,1.0"};
  ASSERT_EQ(bch({"bake", "default:female", "-o", baked}, how).code, 0);
  for (const Arguments& what : {Arguments{"--all-pairs"}, Arguments{"--all-pairs", "--what", "contacts"},
                                Arguments{"--all-pairs", "--what", "penetration"},
                                Arguments{"--all-pairs", "--what", "clearance", "--max-distance", "0.2"}}) {
    Arguments of_character{"query", "default:female", agents}, of_file{"query", baked, agents};
    of_character.insert(of_character.end(), what.begin(), what.end());
    of_file.insert(of_file.end(), what.begin(), what.end());
    const Ending expected = bch(of_character, how), run = bch(of_file);
    ASSERT_EQ(expected.code, 0) << expected.err;
    EXPECT_EQ(run.out, expected.out) << run.err;
    EXPECT_GT(lines(run.out), 20u);
  }
}

TEST(Cli, SlicesClearCollisions) {
  const TemporaryFolder folder;
  const auto hits = [&](const Arguments& more) {
    const std::string json = folder.file("crowd.json");
    const Ending run =
        bch({"crowd", "--agents", "300", "--poses", "5", "--depths", "all", "--json", json}, more);
    EXPECT_EQ(run.code, 0) << run.err;
    const auto said = read_json(json)["options"];
    EXPECT_EQ(said.contains("slices_m"), !more.empty());
    if (more == Arguments{"--slices", "0.4,1"}) {  // by which a run can be repeated
      EXPECT_EQ(said["slices_m"].dump(), "[0.4,1.0]");
    }
    EXPECT_EQ(run.out.find(" slabs, cut at ") != std::string::npos, !more.empty()) << run.out;
    return read_json(json)["levels"].back()["hits"].get<std::size_t>();
  };
  const std::size_t whole = hits({}), three = hits({"--slices", "0.4,1"}),
                    eight = hits({"--slices", "0.35,0.7,0.85,0.95,1.05,1.2,1.45"});
  EXPECT_LT(three, whole);
  EXPECT_LT(eight, three);
  EXPECT_GT(eight, whole / 3);
}

TEST(Cli, ContactsNameTheirSlabs) {
  const TemporaryFolder folder;
  const std::string agents = folder.write("agents.csv", "id,shape,x,y,heading\n0,0,0,0,0\n1,1,0.1,0.1,1\n"),
                    raised = folder.write("raised.csv",
                                          "id,shape,x,y,z,heading\n0,0,0,0,0,0\n1,1,0.1,0.1,0.5,1\n");
  const auto contacts = [](const std::string& of, const Arguments& more) {
    const Ending run =
        bch({"query", "default:male", of, "--poses", "3", "--all-pairs", "--what", "contacts"}, more);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  };
  EXPECT_TRUE(contacts(agents, {}).starts_with("first,second,first_disc,second_disc\n"));
  const Arguments slices{"--slices", "0.4,1"};
  const auto slabs_of = [&](const std::string& of) {
    std::istringstream rows(contacts(of, slices));
    std::string row;
    EXPECT_TRUE(std::getline(rows, row));
    EXPECT_EQ(row, "first,second,first_disc,second_disc,first_slab,second_slab");
    std::set<std::string> slabs;
    while (std::getline(rows, row)) slabs.insert(row.substr(row.rfind(',', row.rfind(',') - 1) + 1));
    return slabs;
  };
  EXPECT_EQ(slabs_of(agents), (std::set<std::string>{"0,0", "1,1", "2,2"}));
  EXPECT_TRUE(slabs_of(raised).contains("1,0"));
  EXPECT_FALSE(slabs_of(raised).contains("0,1"));
}

TEST(Cli, SlabsAreDrawn) {
  const TemporaryFolder folder;
  const std::string crowd = folder.file("crowd.svg");
  const Arguments slices{"--slices", "0.4,1,2.5"};
  const Ending run = bch({"crowd", "--agents", "60", "--poses", "3", "--svg", crowd}, slices);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("the collisions of a cylinder for each of the 4 slabs"), std::string::npos)
      << run.out;
  EXPECT_NE(read_text(crowd).find("slab by slab"), std::string::npos);
}

}  // namespace
}  // namespace bch::test
