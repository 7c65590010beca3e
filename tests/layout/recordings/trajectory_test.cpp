// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/shortest.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"
#include "tests/support/text_recordings.hpp"

// Recordings as text, CSV and ndjson.

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

}  // namespace
}  // namespace bch
