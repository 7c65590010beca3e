// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/shortest.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// Recordings as text, CSV and ndjson.

namespace bch::test {
namespace {

/// Recordings that are given as text.
class Trajectories : public testing::Test {
 protected:
  TemporaryFolder folder;

  ReadRecording read(const std::string& text, const detail::TrajectoryOptions& options = {}) const {
    ReadRecording recording = read_recording(folder.write("f", text), options);
    expect_sound(recording);
    return recording;
  }
  std::string complaint(const std::string& text, const detail::TrajectoryOptions& options = {}) const {
    return trajectory_complaint(folder.write("f", text), options);
  }
};

}  // namespace
}  // namespace bch::test

namespace bch {
namespace {

using detail::TrajectoryOptions;
using test::ReadRecording;
using test::text_of;
using test::Trajectories;

std::string assumptions_of(const ReadRecording& recording) {
  std::string all;
  for (const std::string& sentence : recording.info.assumptions) all += sentence + "\n";
  return all;
}

constexpr const char* metres_assumed = "Coordinates are in metres; the file does not say their unit.\n";
constexpr const char* height_assumed = "z is the person's height where it is from 1 to 2.5 m.\n";
constexpr const char* not_heights = "z below 1 m or above 2.5 m is not a person's height, and is ignored.\n";

TEST_F(Trajectories, OfPeTrackSayTheirRateAndUnit) {
  const ReadRecording recording = read(
      "# PeTrack project: a\n# framerate: 25 fps\n# id frame x/cm y/cm z/cm\n1 7 150 -20 "
      "176\n2\t7\t0\t0\t30\r\n\n1 8 160 -20 180\n");
  EXPECT_EQ(text_of(recording), "7 1 1.5 -0.2 - 1.76\n7 2 0 0 - -\n8 1 1.6 -0.2 - 1.8\n");
  EXPECT_EQ(recording.info.format, "PeTrack text");
  EXPECT_EQ(recording.info.fps, 25);
  EXPECT_EQ(assumptions_of(recording), std::string(height_assumed) + not_heights);
}

/// "character/clip" and the place of each that rows name, and by row which one it is and the time in it.
std::string motions_of(const ReadRecording& recording) {
  std::string all;
  for (const auto& motion : recording.info.motions)
    all += motion.character + "/" + motion.clip + " at" + motion.place.substr(motion.place.rfind(':')) + "\n";
  for (const auto& frame : recording.frames)
    for (const auto& person : frame.people)
      all += (person.motion == detail::TrackedPerson::no_motion ? "-" : std::to_string(person.motion)) + " " +
             (std::isnan(person.clip_seconds) ? "-" : detail::shortest(person.clip_seconds)) + "\n";
  return all;
}

TEST_F(Trajectories, OfCsvMayNameCharactersAndClips) {
  const std::string rows =
      "1,1,0,0,man.glb,\"walk, slowly\",0.5\n0,1,0,0,,run,\n0,2,5,5,,,\n1,2,5,5,man.glb,,1\n";
  const std::string expected = "man.glb/walk, slowly at:2\n/run at:3\nman.glb/ at:5\n1 -\n- -\n0 0.5\n2 1\n";
  const ReadRecording recording =
      read("frame,id,x/m,y/m,character,clip,time\n" + rows, {.fps = 10, .sort_memory = 0});
  EXPECT_EQ(motions_of(recording), expected);
  EXPECT_EQ(assumptions_of(recording),
            "Times are those of the clips that rows name, because there are frames.\n"
            "Times of clips are in seconds; the file does not say their unit.\n");
  EXPECT_EQ(motions_of(read("time/s,id,x/m,y/m,character,clip,clip_time/s\n" + rows)), expected);
  EXPECT_EQ(motions_of(read("frame,id,x,y,time\n0,1,0,0,x\n", {.fps = 10})), "- -\n");  // of no clip
}

TEST_F(Trajectories, ThatEndWithoutALineEndMayHaveBeenCut) {
  const std::string text = "# framerate: 25\n# id frame x/m y/m\n1 0 2 3\n1 1 2 3.25";
  EXPECT_EQ(assumptions_of(read(text + "\n")), "");
  EXPECT_EQ(
      assumptions_of(read(text)),
      "The last row, line 4, has no line end and is read as it stands; a file that was cut off looks so.\n");
  EXPECT_EQ(assumptions_of(read(text + "\n# the end")), "");
}

TEST_F(Trajectories, OfJuelichMayBeWrittenInManyWays) {
  const std::string rows = "1 0 2 3 0.5\n";
  for (const char* const header :
       {"#framerate: 16\n# ID\tframe\tX\tY\tZ\n",
        "#description: a\n#framerate: 16.00\n#geometry: a.xml\n#ID\tFR\tX\tY\tZ\n",
        "# Framerate: 16fps\n#X,Y,Z: the agents coordinates (in metres)\n#ID\tFR\tX\tY\tZ\tA\n",
        "# framerate: 16\n", "# framerate: 16 fps\n# id frame x [in m] y [in m] z [in m]\n",
        "# framerate: 16\n# PersID Frame X/m Y/m Z/m\n\n"}) {
    const ReadRecording recording = read(header + rows);
    EXPECT_EQ(text_of(recording), "0 1 2 3 - -\n") << header;
    EXPECT_EQ(recording.info.fps, 16) << header;
    const std::string said = header;
    const auto says = [&](const char* part) { return said.find(part) != std::string::npos; };
    const bool says_unit = says("m]") || says("/m") || says("metres"), has_more_names = says("\tA"),
               says_columns = said.find("rame") != said.rfind("rame") || says("FR");
    EXPECT_EQ(
        assumptions_of(recording),
        std::string(says_columns ? ""
                                 : "Columns are taken for id, frame, x, y, z, which the file does not name: "
                                   "line 2 has id 1, frame 0, x 2, y 3, z 0.5.\n") +
            (has_more_names ? "Line 3 names 6 columns and rows have 5, which are taken in that order: line 4 "
                              "has id 1, fr 0, x 2, y 3, z 0.5.\n"
                            : "") +
            (says_unit ? "" : metres_assumed) + not_heights)
        << header;
  }
  EXPECT_EQ(text_of(read("# framerate: 8\n# frame id y/cm x/cm\n3 1 100 200\n")), "3 1 2 1 - -\n");
  EXPECT_EQ(text_of(read("# framerate: 8\n# id frame x [in cm] y [in cm]\n3 1 100 200 further\n")),
            "1 3 1 2 - -\n");
  EXPECT_EQ(text_of(read("# framerate: 8\n# X,Y: coordinates (in cm)\n3 1 100 200")), "1 3 1 2 - -\n");
}

TEST_F(Trajectories, HaveAnglesAsHeadings) {
  const std::string rate = "# framerate: 8\n", row = "3 1 1 2 0 0.2 0.3 57.29577951308232 100\n";
  const ReadRecording juelich = read(rate + "# ID\tFR\tX/m\tY/m\tZ/m\tA/m\tB/m\tANGLE\tCOLOR\n" + row);
  EXPECT_EQ(text_of(juelich), "1 3 1 2 1 -\n");
  EXPECT_TRUE(test::has(assumptions_of(juelich), "Angles are headings in degrees"));
  EXPECT_EQ(text_of(read("id,frame,x,y,angle [rad]\n3,1,1,2,0.5\n", {.fps = 8})), "1 3 1 2 0.5 -\n");
  EXPECT_EQ(text_of(read("id,frame,x,y,heading (deg)\n3,1,1,2,-57.29577951308232\n", {.fps = 8})),
            "1 3 1 2 -1 -\n");
}

TEST_F(Trajectories, OptionsWinOverTheFile) {
  const ReadRecording recording =
      read("# framerate: 25 fps\n# id frame x/m y/m\n1 7 150 -20\n", {.fps = 10, .unit = 0.5});
  EXPECT_EQ(text_of(recording), "7 1 75 -10 - -\n");
  EXPECT_EQ(recording.info.fps, 10);
  EXPECT_EQ(text_of(read("a,b,c,d\n1,2,3,4\n", {.fps = 1, .unit = 1, .columns = "y,x,id,frame"})),
            "4 3 2 1 - -\n");
  EXPECT_EQ(text_of(read("1,2,3,4\n", {.fps = 1, .unit = 1, .columns = "y,x,id,frame"})), "4 3 2 1 - -\n");
  EXPECT_EQ(text_of(read("1 2 3 4 5\n", {.fps = 1, .unit = 1, .columns = "y,x,what,id,frame"})),
            "5 4 2 1 - -\n");
}

TEST_F(Trajectories, OfCsvHaveColumnsByName) {
  const TrajectoryOptions rate{.fps = 10};
  const ReadRecording recording = read(
      "\xef\xbb\xbf"
      "ID,Frame,v_x,x,y,Heading,height\n7,0,9,1,2,-0.5,1.8\n8,0,nan,3,4,,\n9, 0 , 9,\"5\",+6,nan,nan\n",
      rate);
  EXPECT_EQ(text_of(recording), "0 7 1 2 -0.5 1.8\n0 8 3 4 - -\n0 9 5 6 - -\n");
  EXPECT_EQ(recording.info.format, "CSV");
  EXPECT_EQ(assumptions_of(recording), std::string(metres_assumed) + height_assumed);
  EXPECT_EQ(text_of(read("agent;frame;x [cm];y [cm]\n1;2;300;400\n", rate)), "2 1 3 4 - -\n");
  EXPECT_EQ(text_of(read("agent frame x y\n1 2 3 4\n", rate)), "2 1 3 4 - -\n");
  EXPECT_EQ(text_of(read("# framerate: 5\nagent,frame,x,y,name\n1,2,3,4,\"a, \"\"b\"\" c\"\n")),
            "2 1 3 4 - -\n");
}

TEST_F(Trajectories, OfTimesGetTheRateThatFitsAll) {
  const ReadRecording even = read("id,t,x,y\n1,0,1,2\n2,0,1,3\n1,0.5,1,2\n1,0.775,1,2\n1,2,1,2\n");
  EXPECT_EQ(even.info.fps, 40);
  EXPECT_EQ(text_of(even), "0 1 1 2 - -\n0 2 1 3 - -\n20 1 1 2 - -\n31 1 1 2 - -\n80 1 1 2 - -\n");
  EXPECT_EQ(
      assumptions_of(even),
      std::string(metres_assumed) + "Times are in seconds; the file does not say their unit.\n" +
          "The frame rate is taken for 40, the smallest rate at which every time is that of a frame.\n");
  const ReadRecording rounded =
      read("id,time [s],x/m,y/m\n1,0,1,2\n1,0.0333,1,2\n1,0.0667,1,2\n1,0.1,1,2\n1,0.1333,1,2\n");
  EXPECT_EQ(rounded.info.fps, 30);
  EXPECT_EQ(rounded.frames.back().number, 4);
  EXPECT_EQ(assumptions_of(rounded), "The frame rate is taken for 30, that of most steps of time.\n");
  const ReadRecording given = read("id,time/ms,x,y\n1,0,1,2\n1,1500,1,2\n", {.fps = 4, .unit = 1});
  EXPECT_EQ(text_of(given), "0 1 1 2 - -\n6 1 1 2 - -\n");
  // Frames count where both are there.
  EXPECT_EQ(text_of(read("id,t,frame,x,y\n1,oops,3,1,2\n", {.fps = 4, .unit = 1})), "3 1 1 2 - -\n");
}

TEST_F(Trajectories, OfPathfinderHaveALineOfUnits) {
  const ReadRecording recording = read(
      "\"t\",\"id\",\"name\",\"x\",\"y\",\"z\",\"location\"\n\"s\",\"\",\"\",\"m\",\"m\",\"m\",\"\"\n"
      "0.000000,0,\"00001\",-10.5,-2,1.5,\"Room, 07\"\n0.500000,0,\"00001\",-10,-2,1.5,\"\"\n");
  EXPECT_EQ(recording.info.format, "Pathfinder CSV");
  EXPECT_EQ(text_of(recording), "0 0 -10.5 -2 - -\n1 0 -10 -2 - -\n");
  EXPECT_EQ(recording.info.fps, 2);
}

TEST_F(Trajectories, OfTrajNetHaveFramesOfAFinerRate) {
  const ReadRecording recording = read(
      "{\"scene\": {\"id\": 0, \"p\": 1, \"s\": 10, \"e\": 30, \"fps\": 2.5, \"tag\": [4, [\"a]\\\"\"]]}}\n"
      "{\"track\": {\"f\": 20, \"p\": 1, \"x\": 8.46, \"y\": -3.5}}\n\n"
      "{\"track\":{\"p\":2,\"f\":10,\"x\":1e1,\"y\":3,\"prediction_number\":0,\"scene_id\":0}}\n"
      "{\"track\": {\"f\": 30, \"p\": 1, \"x\": 9, \"y\": 3, \"prediction_number\": null}}\n"
      "{\"track\": {\"f\": 30, \"p\": 1, \"x\": 7, \"y\": 3, \"prediction_number\": 1}}\n");
  EXPECT_EQ(recording.info.format, "TrajNet++ ndjson");
  EXPECT_EQ(text_of(recording), "10 2 10 3 - -\n20 1 8.46 -3.5 - -\n30 1 9 3 - -\n");
  EXPECT_EQ(recording.info.fps, 25);
  EXPECT_EQ(assumptions_of(recording),
            "The first prediction of each scene counts: 1 rows of others are left out.\n"
            "The frame rate of 2.5 is that of rows, whose frame numbers go up by 10: there are 25 frame "
            "numbers a second.\n");
  const std::string alone = "{\"track\": {\"f\": 20, \"p\": 1, \"x\": 8, \"y\": 3}}";
  EXPECT_EQ(read(alone, {.fps = 5}).info.fps, 5);
}

TEST_F(Trajectories, AreTheSameInAnyOrderAndWithAnyMemory) {
  test::Random random(1);
  std::vector<std::string> rows;
  for (int frame = -20; frame < 60; ++frame)
    for (int id = 0; id < 40; ++id)
      if (random.below(3) > 0)
        rows.push_back(std::to_string(id) + " " + std::to_string(frame) + " " +
                       std::to_string(random.uniform(-9, 9)) + " 1 1." + std::to_string(10 + id) + "\n");
  const auto text = [&] {
    std::string all = "# framerate: 25\n# id frame x/m y/m z/m\n";
    for (const std::string& row : rows) all += row;
    return all;
  };
  const std::string expected = text_of(read(text()));
  EXPECT_EQ(static_cast<std::size_t>(std::count(expected.begin(), expected.end(), '\n')), rows.size());
  for (int order = 0; order < 4; ++order) {
    if (order == 1)
      std::stable_sort(rows.begin(), rows.end(),
                       [](const auto& a, const auto& b) { return std::stoi(a) < std::stoi(b); });
    if (order == 2) std::reverse(rows.begin(), rows.end());
    if (order == 3)
      for (std::size_t i = rows.size(); i > 1; --i)
        std::swap(rows[i - 1], rows[random.below(static_cast<std::uint32_t>(i))]);
    for (const std::size_t memory : {0, 1000, 5000, 1 << 25})
      EXPECT_EQ(text_of(read(text(), {.sort_memory = memory})), expected) << order << " " << memory;
  }
}

TEST_F(Trajectories, OfTimesOutOfOrderGetTheSameRate) {
  const std::string header = "id,t,x/m,y/m\n";
  std::string ordered, reversed;
  for (int i = 0; i < 200; ++i) {
    const std::string row = "1," + std::to_string(i * 0.04) + ",1,2\n";
    ordered += row;
    reversed = row + reversed;
  }
  EXPECT_EQ(read(header + ordered).info.fps, 25);
  const ReadRecording sorted = read(header + reversed, {.sort_memory = 0});
  EXPECT_EQ(sorted.info.fps, 25);
  EXPECT_EQ(text_of(sorted), text_of(read(header + ordered)));
}

TEST_F(Trajectories, MayHaveManyPeopleAndFarFrames) {
  std::string text = "# framerate: 1\n# id frame x/m y/m\n";
  for (int id = 20'000; id > 0; --id) text += std::to_string(id) + " -1000000000000000 1 2\n";
  text += "5 1000000000000000 1 2\n";
  const ReadRecording recording = read(text);
  EXPECT_EQ(recording.info.people, 20'000u);
  EXPECT_EQ(recording.frames.size(), 2u);
  EXPECT_EQ(recording.frames[0].people.front().id, 1);
}

TEST_F(Trajectories, LeaveNoFileBehind) {
  const std::string text = "# framerate: 1\n# id frame x/m y/m\n1 1 1 1\n1 0 1 1\n";
  std::string rows;
  for (int i = 2; i < 100; ++i) rows += "1 " + std::to_string(i) + " 1 1\n";
  ASSERT_EQ(setenv("TMPDIR", folder.file("tmp").c_str(), 1), 0);
  const TrajectoryOptions little{.sort_memory = 0};
  folder.write("f", text + rows);
  EXPECT_THROW(test::read_recording(folder.file("f"), little),
               detail::TrajectoryError);  // there is no folder
  std::filesystem::create_directory(folder.file("tmp"));
  test::expect_sound(test::read_recording(folder.file("f"), little));
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("tmp")));
  unsetenv("TMPDIR");
}

TEST_F(Trajectories, AreRefusedByOneLine) {
  test::expect_table(__FILE__, "refusals.txt", [&](const auto& fields) {
    TrajectoryOptions options;
    std::istringstream words(fields[0]);
    for (std::string word; words >> word;)
      (word.starts_with("fps=") ? options.fps : options.unit) = std::stod(word.substr(word.find('=') + 1));
    return complaint(fields[1], options);
  });
  EXPECT_EQ(test::trajectory_complaint(folder.path()), folder.path().filename().string() + ": is not a file");
  EXPECT_EQ(test::trajectory_complaint(folder.file("none")),
            "none: cannot be opened: No such file or directory");
}

TEST_F(Trajectories, NameNoMoreThanCanBe) {
  const std::string header = "frame,id,x/m,y/m,clip,clip_time\n",
                    row = "# framerate: 25\n# id frame x/m y/m z/m\n1 1 ", start(40, '7');
  EXPECT_EQ(complaint(row + std::string(70'000, '1')), "f:3: is longer than 65536 bytes");
  EXPECT_EQ(complaint(row + std::string(200, '7') + " 2 1\n"),
            "f:3: x '" + start + "...' is not within +-1e8 m");
  EXPECT_EQ(complaint(header + "0,1,0,0," + std::string(256, '7') + ",1\n", {.fps = 10}),
            "f:2: the name '" + start + "...' has more than 255 bytes");
  std::string many = header;
  for (int k = 0; k <= 4096; ++k) many += std::to_string(k) + ",1,0,0,clip" + std::to_string(k) + ",\n";
  EXPECT_EQ(
      complaint(many, {.fps = 10}),
      "f:4098: character '' and clip 'clip4096' are beyond the 4096 different pairs that a file may name");
}

// ---- Recordings as text whose columns have no names, or not as many as rows have fields; whose times are far from 0, whose numbers are closer
// to it than any double, or that are made to take long.

const TrajectoryOptions options{.fps = 25, .unit = 1};

/// Writes twelve frames of a few people who walk, with a line end behind each of `columns`: f frame, i id, x, y, h height, o 0, t time,
/// a heading, v speed.
std::string walkers(const std::string& columns, int people = 6, int step = 1, int frames = 12) {
  std::string text;
  for (int frame = 0; frame < frames; ++frame)
    for (int id = 1; id <= people; ++id) {
      test::Random random(static_cast<std::uint64_t>(id));
      const double u = random.uniform(0, 1), v = random.uniform(0, 1),
                   x = random.uniform(0, 20) + 0.04 * u * frame, y = random.uniform(0, 20) + 0.04 * v * frame;
      for (const char column : columns) {
        const double value = column == 'f'   ? 780 + step * frame
                             : column == 'i' ? id
                             : column == 'x' ? x
                             : column == 'y' ? y
                             : column == 'h' ? 1.6 + 0.02 * id
                             : column == 't' ? 0.04 * frame
                             : column == 'a' ? -std::atan2(v, u)
                             : column == 'v' ? u
                                             : 0;
        text += std::to_string(value) + " ";
      }
      text.back() = '\n';
    }
  return text;
}

std::string first_assumption(const ReadRecording& recording) {
  return recording.info.assumptions.empty() ? "" : recording.info.assumptions.front();
}

TEST_F(Trajectories, WithoutNamesAreToldByTheWaysOfPeople) {
  const ReadRecording named = read("frame id x/m y/m z/m\n" + walkers("fixyh"), {.fps = 25});
  EXPECT_EQ(named.frames.size(), 12u);
  const std::string taken = "Columns are taken for ", unnamed = ", which the file does not name: line ";
  for (const std::string comment : {"", "# framerate: 25\n", "# people who walk\n"}) {
    const std::string number = comment.empty() ? "1" : "2";
    const ReadRecording frames = read(comment + walkers("fixyh"), options);
    EXPECT_EQ(text_of(frames), text_of(named)) << comment;
    EXPECT_TRUE(test::has(first_assumption(frames),
                          taken + "frame, id, x, y, z" + unnamed + number + " has frame 780, id 1, x "));
    const ReadRecording ids = read(comment + walkers("ifxyh"), options);
    EXPECT_EQ(text_of(ids), text_of(named)) << comment;
    EXPECT_TRUE(test::has(first_assumption(ids),
                          taken + "id, frame, x, y, z" + unnamed + number + " has id 1, frame 780, x "));
    EXPECT_EQ(text_of(read(comment + walkers("fixy"), options)),
              text_of(read("frame id x y\n" + walkers("fixy"), options)));
  }
  // One person alone, and frames that are not one after the other.
  EXPECT_EQ(text_of(read(walkers("ifxyh", 1, 1, 40), options)),
            text_of(read(walkers("fixyh", 1, 1, 40), options)));
  EXPECT_EQ(text_of(read(walkers("ifxyh", 6, 7), options)), text_of(read(walkers("fixyh", 6, 7), options)));
}

TEST_F(Trajectories, WithoutNamesAreAskedAboutWhereRowsDoNotTell) {
  const std::string asks = " columns without names: --columns has to name them in order, such as ";
  for (const std::string comment : {"", "# framerate: 25\n"})
    for (const char* const columns : {"fixoyvov", "fixyhv", "fixyhaaaaa", "fixoy", "fioxy", "fixya", "tixyh",
                                      "xyif", "fixyhoooooooooo"}) {
      const std::string message = complaint(comment + walkers(columns), options);
      EXPECT_TRUE(test::has(message, std::to_string(std::string(columns).size()) + asks)) << columns;
      EXPECT_TRUE(test::has(message, "; the first rows are '"));
    }
  // A single frame, or one person who jumps?
  for (const std::string& text :
       {walkers("fixyh", 10, 1, 1), walkers("fixyh", 40, 1, 1), std::string("1 1 1 2 1.7\n")})
    EXPECT_TRUE(test::has(complaint(text, options), asks));
  EXPECT_EQ(text_of(read("780 1 8.5 0 3.5 1.6 0 0.05\n786 1 8.75 0 3.6 1.6 0 0.05\n",
                         {.fps = 15, .unit = 1, .columns = "frame,id,x,skip,y"})),
            "780 1 8.5 3.5 - -\n786 1 8.75 3.6 - -\n");
}

TEST_F(Trajectories, WithoutNamesNeedARateAndAUnit) {
  const std::string text = walkers("ifxyh");
  EXPECT_TRUE(test::has(complaint(text), "f: says no unit and no frame rate: "));
  EXPECT_TRUE(test::has(complaint(text, {.fps = 16}), "f: says no unit: "));
  EXPECT_TRUE(test::has(complaint(text, {.unit = 0.01}), "f: says no frame rate: "));
  const ReadRecording recording = read(text, {.fps = 16, .unit = 0.01});
  EXPECT_EQ(recording.info.format, "text without a header");
  EXPECT_EQ(recording.info.fps, 16);
  const std::string few = "1 43 79.5 774 183\n1 44 79 764 183\n";
  EXPECT_EQ(text_of(read(few, {.fps = 16, .unit = 0.01})),
            "43 1 0.795 7.74 - 1.83\n44 1 0.79 7.640000000000001 - 1.83\n");
}

TEST_F(Trajectories, OfFourColumnsAreToldBySteps) {
  const TrajectoryOptions rate{.fps = 25};
  const ReadRecording eth = read("780.0\t1.0\t8.46\t3.59\n790.0\t1.0\t9.57\t3.79\n790.0\t2.0\t9\t3\n", rate);
  EXPECT_EQ(text_of(eth), "780 1 8.46 3.59 - -\n790 1 9.57 3.79 - -\n790 2 9 3 - -\n");
  EXPECT_EQ(eth.info.format, "ETH/UCY columns");
  EXPECT_EQ(eth.info.assumptions,
            (std::vector<std::string>{
                "Columns are taken for frame, id, x, y, which the file does not name: line 1 has "
                "frame 780, id 1, x 8.46, y 3.59; line 2 has frame 790, id 1, x 9.57, y 3.79.",
                "Coordinates are in metres; the file does not say their unit."}));

  const std::string juelich = "1 0 1 2\n1 10 3 4\n2 0 5 6\n", unclear = "1 0 1 2\n1 1 3 4\n2 0 5 6\n";
  EXPECT_EQ(text_of(read(juelich, options)), "0 1 1 2 - -\n0 2 5 6 - -\n10 1 3 4 - -\n");
  EXPECT_EQ(text_of(read(unclear, {.fps = 25, .columns = "frame,id,x,y"})),
            "1 0 1 2 - -\n1 1 3 4 - -\n2 0 5 6 - -\n");
  EXPECT_EQ(text_of(read(unclear, {.fps = 25, .unit = 1, .columns = "id,frame,x,y"})),
            "0 1 1 2 - -\n0 2 5 6 - -\n1 1 3 4 - -\n");
}

TEST_F(Trajectories, MayHaveOtherNumbersOfNamesThanOfColumns) {
  const std::string row = "1 1 0 2 3\n";
  for (const char* const header :
       {"# framerate: 5\n# id frame x/m y/m\n", "# framerate: 5\nid frame x/m y/m\n"}) {
    const ReadRecording recording = read(header + row);
    EXPECT_EQ(text_of(recording), "1 1 0 2 - -\n");
    EXPECT_EQ(
        first_assumption(recording),
        "Line 2 names 4 columns and rows have 5, which are taken in that order: line 3 has id 1, frame 1, x "
        "0, y 2.");
  }
  EXPECT_EQ(read("# framerate: 5\nid frame x/m y/m\n# a comment\n1 1 0 2\n").info.assumptions.size(), 0u);
  // Where columns are given, x tells whether there is a header.
  EXPECT_EQ(
      text_of(read("Biker,1,0,2,3\nBiker,1,1,2,3\n", {.fps = 5, .unit = 1, .columns = "label,id,frame,x,y"})),
      "0 1 2 3 - -\n1 1 2 3 - -\n");
  EXPECT_EQ(
      text_of(read("a,b,c,d,e\nBiker,1,1,2,3\n", {.fps = 5, .unit = 1, .columns = "label,id,frame,x,y"})),
      "1 1 2 3 - -\n");
  EXPECT_EQ(text_of(read("# framerate: 5\n# Columns: frame, id, x/m, y/m, z/m\n" + row)), "1 1 0 2 - -\n");
  EXPECT_TRUE(test::has(
      complaint("# frame_number pedestrian_ID pos_x pos_z pos_y v_x v_z v_y\n" + walkers("fixoyvov"),
                options),
      "f:2: has 8 columns without names: "));
}

TEST_F(Trajectories, OfTimesFarFromZeroCountFromTheEarliest) {
  const TrajectoryOptions atc{.unit = 0.001, .columns = "time,id,x,y,z,v,motion,heading"};
  const std::string rows[] = {"1351651211.642,7,41830,-16580,1703,900.1,0.02,-0.5\n",
                              "1351651211.675,7,41860,-16580,1703,900.1,0.02,-0.5\n",
                              "1351651211.741,8,41830,-14580,0,900.1,0.02,0\n"};
  const ReadRecording recording = read(rows[0] + rows[1] + rows[2], atc);
  const std::string expected =
      "0 7 41.83 -16.580000000000002 -0.5 1.703\n1 7 41.86 -16.580000000000002 -0.5 1.703\n"
      "3 8 41.83 -14.58 0 -\n";
  EXPECT_EQ(text_of(recording), expected);
  const std::string origin = "Times and frames count from the earliest time, 1351651211.642 s.";
  EXPECT_EQ(recording.info.assumptions[3], origin);
  const ReadRecording unordered = read(rows[2] + rows[1] + rows[0], atc);
  EXPECT_EQ(text_of(unordered), expected);
  EXPECT_EQ(unordered.info.assumptions, recording.info.assumptions);

  const std::string expected_here = "0 1 1 2 - -\n2 1 1 2 - -\n";
  for (const char* const text :
       {"id,time/ms,x/m,y/m\n1,1351651211642,1,2\n1,1351651212142,1,2\n",
        "id,time [us],x/m,y/m\n1,1351651211642000,1,2\n1,1351651212142000,1,2\n",
        "id,t,x/m,y/m\n1,-1e10,1,2\n1,-9999999999.5,1,2\n", "id,t,x/m,y/m\n1,2e9,1,2\n1,2000000000.5,1,2\n"})
    EXPECT_EQ(text_of(read(text, {.fps = 4})), expected_here) << text;
  // Nearer to 0, they are what they were.
  EXPECT_EQ(text_of(read("id,t,x/m,y/m\n1,999999999.5,1,2\n1,1000000000.5,1,2\n", {.fps = 2})),
            "1999999999 1 1 2 - -\n2000000001 1 1 2 - -\n");
}

TEST_F(Trajectories, MayHaveNumbersThatVanish) {
  EXPECT_EQ(text_of(read("id,frame,x/m,y/m,heading\n1,1e-400,-4e-999,2e-310,1e-5000\n", {.fps = 1})),
            "0 1 -0 2e-310 0 -\n");
  EXPECT_EQ(text_of(read("{\"track\": {\"f\": 0, \"p\": 1, \"x\": 1e-400, \"y\": 3}}", {.fps = 1})),
            "0 1 0 3 - -\n");
}

/// Brackets that nothing closes are looked for once, not by each of the 64 000 of a line.
TEST_F(Trajectories, MayHaveManyBracketsInComments) {
  std::string text;
  for (int line = 0; line < 40; ++line)
    text += "#" + std::string(32'000, '[') + std::string(32'000, '(') + "\n";
  EXPECT_EQ(text_of(read(text + "# framerate: 10\n# id frame x/m y/m\n1 0 1 2\n")), "0 1 1 2 - -\n");
}

/// Multiples of two numbers of buckets that libstdc++ takes. This takes a minute where ids are their own hashes.
TEST_F(Trajectories, MayHaveIdsThatWouldShareABucket) {
  std::string text = "id,frame,x/m,y/m\n";
  constexpr std::int64_t buckets = std::int64_t{85'229} * 172'933, people = 85'000;
  for (std::int64_t k = 0; k < people; ++k)
    text += std::to_string(k * buckets) + "," + std::to_string(k / 200) + ",1,2\n";
  EXPECT_EQ(read(text, {.fps = 10}).info.people, static_cast<std::uint64_t>(people));
}

// ---- Real recordings, found through the environment variable BCH_TEST_DATA; what they hold is written in the
// SOURCES.md beside them.

/// What is known of a file.
struct Expected {
  const char* file;
  const char* format;
  double fps;
  std::uint64_t rows, people;
  TrajectoryOptions options = {};
};

class TrajectoryData : public testing::TestWithParam<Expected> {};

TEST_P(TrajectoryData, IsRead) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const Expected& expected = GetParam();
  const test::ReadRecording recording =
      test::read_recording(*data / "trajectories" / expected.file, expected.options);
  test::expect_sound(recording);
  EXPECT_EQ(recording.info.format, expected.format);
  EXPECT_EQ(recording.info.fps, expected.fps);
  EXPECT_EQ(recording.info.rows, expected.rows);
  EXPECT_EQ(recording.info.people, expected.people);
  for (const test::RecordedFrame& frame : recording.frames)
    for (const detail::TrackedPerson& person : frame.people)
      ASSERT_LT(std::max(std::abs(person.x), std::abs(person.y)), 60) << "metres are that far";
}

INSTANTIATE_TEST_SUITE_P(
    Files, TrajectoryData,
    testing::Values(Expected{"juelich_bottleneck_040_c_56_h.txt", "PeTrack text", 25, 63'110, 75},
                    Expected{"juelich_unidirectional_uo-050-180-180.txt",
                             "text without a header",
                             16,
                             9'712,
                             61,
                             {.fps = 16, .unit = 0.01}},
                    Expected{"single_file_n56_cam1.csv", "CSV", 25, 2'391, 53, {.fps = 25}},
                    Expected{"jpscore_corner_traj.txt", "PeTrack text", 16, 18'704, 137},
                    Expected{"jupedsim_v2_demo.sqlite", "JuPedSim SQLite, version 2", 25, 8'083, 30},
                    Expected{"jupedsim_v1.sqlite", "JuPedSim SQLite, version 1", 25, 65'482, 75},
                    Expected{"pathfinder.csv", "Pathfinder CSV", 40, 12'120, 150}),
    [](const auto& parameter) {
      std::string name;
      for (const char c : std::string(parameter.param.file))
        name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
      return name;
    });

}  // namespace
}  // namespace bch
