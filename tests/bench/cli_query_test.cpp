// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

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

}  // namespace
}  // namespace bch::test
