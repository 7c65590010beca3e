// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// `bch query`.

namespace bch::test {
namespace {

/// Agents on a crooked lattice, dense enough for many to collide.
std::string lattice(int side) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading\n";
  for (int i = 0; i < side * side; ++i)
    csv << "agent" << i << ",0," << 0.43 * (i % side) + 0.01 * (i % 7) << ',' << 0.41 * (i / side) << ','
        << 0.7 * i << '\n';
  return csv.str();
}

TEST(Cli, AllPairsEqualsExplicitPairs) {
  const TemporaryFolder folder;
  constexpr int side = 9;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", lattice(side));
  std::string every = "first,second\n";
  for (int a = 0; a < side * side; ++a)
    for (int b = a + 1; b < side * side; ++b)
      every += "agent" + std::to_string(a) + ",agent" + std::to_string(b) + "\n";
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

/// One body within another: those that nest are near each other.
TEST(Cli, AllPairsWithinADistanceHoldThoseThatNest) {
  const auto square = [](float half) {
    const std::vector<std::vector<Vec2>> rings = {
        {{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
    return shape_from_polygons(rings);
  };
  const TemporaryFolder folder;
  const std::string nest = folder.file("nest.bch");
  save_baked(nest, ShapeSet(std::vector<Shape>{square(1), square(0.1f)}));
  const std::string inside = folder.write("inside.csv", "id,shape,x,y,heading\na,0,0,0,0\nb,1,0.1,0,0\n"),
                    one = folder.write("one.csv", "first,second\na,b\n"), header = "first,second,hit\n";
  for (const std::string& pairs : {one, std::string("--all-pairs")})
    EXPECT_EQ(bch({"query", nest, inside, pairs, "--what", "within", "--max-distance", "0.3"}).out,
              header + "a,b,1\n");
}

/// One man, another beside him who stands in him, on a bench, and on the floor above.
constexpr const char* floors =
    "id,shape,x,y,heading,z\nman,0,0,0,0,0\nsame,1,0.2,0,1,0\nbench,1,0.2,0,1,0.5\nabove,1,0.2,0,1,3\n";

Ending ask_spheres(const TemporaryFolder& folder, const Arguments& more) {
  return bch({"query", "default:male", folder.write("floors.csv", floors), "--bodies", "spheres", "--spheres",
              "64", "--poses", "3"},
             more);
}

TEST(Cli, QueryOfSpheresKnowsHeights) {
  const TemporaryFolder folder;
  EXPECT_EQ(ask_spheres(folder, {"--all-pairs"}).out,
            "first,second,hit\nman,same,1\nman,bench,1\nsame,bench,1\n");
  const std::string pairs = folder.write("pairs.csv", "first,second\nman,above\nman,bench\n");
  EXPECT_EQ(ask_spheres(folder, {pairs}).out, "first,second,hit\nman,above,0\nman,bench,1\n");
  EXPECT_EQ(ask_spheres(folder, {pairs, "--what", "within", "--max-distance", "1.5"}).out,
            "first,second,hit\nman,above,1\nman,bench,1\n");
  const std::string gaps = ask_spheres(folder, {pairs, "--what", "clearance", "--points"}).out;
  EXPECT_TRUE(
      gaps.starts_with("first,second,distance,x,y,z,first_x,first_y,first_z,second_x,second_y,second_z\n"
                       "man,above,1."))
      << gaps;
  EXPECT_NE(gaps.find("\nman,bench,0,0,0,0,"), std::string::npos) << gaps;
}

TEST(Cli, QueryOfSpheresHasContactsAndWaysOut) {
  const TemporaryFolder folder;
  const std::string pairs = folder.write("pairs.csv", "first,second\nman,above\nman,bench\n");
  const std::string contacts = ask_spheres(folder, {pairs, "--what", "contacts"}).out;
  EXPECT_TRUE(contacts.starts_with(
      "first,second,first_sphere,second_sphere,depth,x,y,z,normal_x,normal_y,normal_z\nman,bench,"))
      << contacts;
  EXPECT_EQ(contacts.find("man,above"), std::string::npos);
  const std::string ways = ask_spheres(folder, {pairs, "--what", "penetration"}).out;
  EXPECT_TRUE(ways.starts_with("first,second,depth,x,y\nman,above,0,")) << ways;
  EXPECT_NE(ways.find("\nman,bench,0."), std::string::npos) << ways;
}

TEST(Cli, QueryOfSpheresKnowsTheHeightsOfObstacles) {
  const TemporaryFolder folder;
  const std::string wall = folder.write("wall.wkt", "LINESTRING (0 -1, 0 1)");
  EXPECT_EQ(ask_spheres(folder, {"--obstacles", wall, "--obstacle-heights", "2,4"}).out,
            "id,hit\nman,0\nsame,0\nbench,1\nabove,1\n");
}

TEST(Cli, QueryOfSpheresRefusesWhatIsOfOutlines) {
  const TemporaryFolder folder;
  expect_failure(ask_spheres(folder, {"--all-pairs", "--depths", "3"}), 2, {"--depths", "--bodies spheres"});
  const std::string wall = folder.write("wall.wkt", "LINESTRING (0 -1, 0 1)");
  expect_failure(ask_spheres(folder, {"--obstacles", wall, "--what", "penetration"}), 2,
                 {"'penetration' about --obstacles", "--bodies spheres"});
  expect_failure(bch({"query", "default:male", "a.csv", "--all-pairs", "--spheres", "64"}), 2,
                 {"--spheres", "--bodies spheres"});
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
  for (const Implementation& row : implementations())
    if (row.supported()) {
      EXPECT_EQ(first, small_crowd(folder, {"--isa", row.name})) << row.name;
    }
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

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

void expect_crowd_picture(const std::string& svg_file) {
  const std::string svg = read_text(svg_file);
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  EXPECT_LT(svg.size(), 600000u);
  for (const char* id :
       {"crowd", "colliding", "cleared", "free", "overlaps", "single-cylinders", "legend", "scale"})
    EXPECT_NE(svg.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
  EXPECT_EQ(count_of(svg, "<g"), count_of(svg, "</g>"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Cli, CrowdDrawsAPicture) {
  const TemporaryFolder folder;
  const std::string svg_file = folder.file("crowd.svg");
  const Ending run = bch({"crowd", "--agents", "200", "--poses", "5", "--svg", svg_file});
  ASSERT_EQ(run.code, 0) << run.err;
  expect_crowd_picture(svg_file);
  // The terminal's last line is about all depths.
  EXPECT_NE(read_text(svg_file).find(": depth 6 clears"), std::string::npos);
}

TEST(Cli, LiveCrowdDrawsItsLastFrame) {
  const TemporaryFolder folder;
  const std::string svg_file = folder.file("crowd.svg");
  const Ending run = bch({"crowd", "--live", "--agents", "60", "--spheres", "64", "--svg", svg_file});
  ASSERT_EQ(run.code, 0) << run.err;
  expect_crowd_picture(svg_file);
  EXPECT_NE(read_text(svg_file).find("Bodies of 64 spheres."), std::string::npos);
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

}  // namespace
}  // namespace bch::test
