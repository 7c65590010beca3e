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

using detail::TrajectoryOptions;

/// Recordings that are given as text.
class Trajectories : public testing::Test {
 protected:
  TemporaryFolder folder;

  ReadRecording read(const std::string& text, const detail::TrajectoryOptions& options = {}) const {
    return read_recording(folder.write("f", text), options);
  }
  std::string complaint(const std::string& text, const detail::TrajectoryOptions& options = {}) const {
    return trajectory_complaint(folder.write("f", text), options);
  }
};

/// "character/clip" and the place of each that rows name, and by row which one it is and the time in it; nothing where no row has any.
std::string motions_of(const ReadRecording& recording) {
  std::string all;
  for (const auto& motion : recording.info.motions)
    all += (motion.body.empty() ? motion.character + "/" + motion.clip
                                : motion.body + " " + detail::shortest(motion.length) + " x " +
                                      detail::shortest(motion.width)) +
           " at" + motion.place.substr(motion.place.rfind(':')) + "\n";
  for (const auto& frame : recording.frames)
    for (const auto& person : frame.people)
      all += (person.motion == detail::TrackedPerson::no_motion ? "-" : std::to_string(person.motion)) + " " +
             (std::isnan(person.clip_seconds) ? "-" : detail::shortest(person.clip_seconds)) + "\n";
  return all.find_first_not_of("- \n") == std::string::npos ? "" : all;
}

/// Of words such as "fps=10 columns=id,frame,x,y".
TrajectoryOptions options_of(const std::string& text) {
  TrajectoryOptions options;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string name = word.substr(0, word.find('=')), value = word.substr(name.size() + 1);
    if (name == "columns")
      options.columns = value;
    else if (name == "memory")
      options.sort_memory = std::stoul(value);
    else
      (name == "fps" ? options.fps : options.unit) = std::stod(value);
  }
  return options;
}

TEST_F(Trajectories, AreReadAsTheyAreWritten) {
  expect_table(__FILE__, "readings.txt", [&](const auto& fields) {
    const ReadRecording recording = read(fields[1], options_of(fields[0]));
    return recording.info.format + ", fps " + detail::shortest(recording.info.fps) + "\n" +
           text_of(recording) + motions_of(recording) + assumptions_of(recording);
  });
}

TEST_F(Trajectories, AreTheSameInAnyOrderAndWithAnyMemory) {
  Random random(1);
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
  EXPECT_THROW(read_recording(folder.file("f"), little),
               detail::TrajectoryError);  // there is no folder
  std::filesystem::create_directory(folder.file("tmp"));
  read_recording(folder.file("f"), little);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("tmp")));
  unsetenv("TMPDIR");
}

TEST_F(Trajectories, AreRefusedByOneLine) {
  expect_table(__FILE__, "refusals.txt",
               [&](const auto& fields) { return complaint(fields[1], options_of(fields[0])); });
  EXPECT_EQ(trajectory_complaint(folder.path()), folder.path().filename().string() + ": is not a file");
  EXPECT_EQ(trajectory_complaint(folder.file("none")), "none: cannot be opened: No such file or directory");
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
  many = "frame,id,x,y,length/mm,width/m\n";
  for (int k = 0; k <= 65'536; ++k)
    many += std::to_string(k) + ",1,0,0," + std::to_string(1 + k % 10'000) + "," +
            std::to_string(1 + k / 10'000) + "\n";
  EXPECT_EQ(complaint(many, {.fps = 10}), "f:1: length, width and radius are of different units");
  many.replace(many.find("width/m"), 7, "width/mm");
  EXPECT_EQ(
      complaint(many, {.fps = 10}),
      "f:65538: body 'box' of 5537 mm by 7 mm is beyond the 65536 different bodies that a file may have");
}

// ---- Recordings in memory.

/// A person at a time, as programs keep them: packed, so that hardly a value is aligned.
#pragma pack(push, 1)
struct PackedRow {
  char kind;
  std::int32_t frame;
  std::int64_t id;
  double x;
  float y;
  double heading, stature;
  const char* clip;
};
#pragma pack(pop)

using Type = detail::ColumnView::Type;

std::vector<detail::ColumnView> columns_of(const std::vector<PackedRow>& rows) {
  const auto* const base = reinterpret_cast<const char*>(rows.data());
  const auto column = [&](const char* name, std::size_t offset, Type type) {
    return detail::ColumnView{name, base + offset, sizeof(PackedRow), type};
  };
  return {column("kind", offsetof(PackedRow, kind), Type::int32),  // which nobody reads
          column("Frame", offsetof(PackedRow, frame), Type::int32),
          column("id", offsetof(PackedRow, id), Type::int64),
          column("x [cm]", offsetof(PackedRow, x), Type::float64),
          column("y/cm", offsetof(PackedRow, y), Type::float32),
          column("angle", offsetof(PackedRow, heading), Type::float64),
          column("height/m", offsetof(PackedRow, stature), Type::float64),
          column("clip", offsetof(PackedRow, clip), Type::text)};
}

ReadRecording read_columns(const std::vector<detail::ColumnView>& columns, std::size_t rows,
                           const TrajectoryOptions& wanted) {
  const auto reader = detail::open_columns(columns, rows, wanted);
  ReadRecording recording{reader->info(), {}};
  for (RecordedFrame frame; reader->next(frame.number, frame.people);) recording.frames.push_back(frame);
  return recording;
}

TEST_F(Trajectories, InMemoryAreThoseOfTheSameRowsAsCsv) {
  Random random(7);
  std::vector<PackedRow> rows;
  std::string csv = "kind,Frame,id,x [cm],y/cm,angle,height/m,clip\n";
  for (int frame = 400; frame > 0; --frame)
    for (int k = 0; k < 20; ++k) {
      if (random.below(3) == 0) continue;
      const bool has_more = random.below(2) == 0;
      const double none = std::numeric_limits<double>::quiet_NaN();
      rows.push_back({'a', frame, (std::int64_t{1} << 60) + k, random.uniform(-1e5, 1e5),
                      static_cast<float>(random.uniform(-900, 900)), has_more ? random.uniform(-7, 7) : none,
                      has_more ? 1.5 + 0.1 * k : none, has_more ? "walk" : nullptr});
      const PackedRow& row = rows.back();
      csv += "a," + std::to_string(row.frame) + "," + std::to_string(row.id);
      for (const double value : {row.x, double{row.y}, row.heading, row.stature})
        csv += "," + detail::shortest(value);
      csv += std::string(",") + (row.clip == nullptr ? "" : row.clip) + "\n";
    }
  for (const std::size_t memory : {std::size_t{0}, std::size_t{1} << 25}) {
    const TrajectoryOptions wanted{.fps = 25, .sort_memory = memory};
    const ReadRecording of_file = read(csv, wanted),
                        in_memory = read_columns(columns_of(rows), rows.size(), wanted);
    EXPECT_EQ(text_of(in_memory), text_of(of_file));
    EXPECT_EQ(motions_of(in_memory).substr(0, 7), "/walk a");
    EXPECT_EQ(assumptions_of(in_memory), assumptions_of(of_file));
    EXPECT_EQ(in_memory.info.format, "columns");
    EXPECT_EQ(in_memory.info.people, of_file.info.people);
  }
}

TEST_F(Trajectories, InMemoryAreRefusedByOneLine) {
  const std::vector<double> time{0, 0.5, 1}, x{1, 2, NAN}, far{0, 1, 1e9}, id{0, 0.5, 1};
  const std::vector<std::int64_t> ids{7, 7, 7}, zeros{0, 0, 0};
  const std::vector<const char*> texts{"1", "2", "three"};
  const auto refused = [&](std::vector<detail::ColumnView> columns, const TrajectoryOptions& wanted = {}) {
    return test::complaint<detail::TrajectoryError>([&] { read_columns(columns, 3, wanted); });
  };
  const auto numbers = [](const char* name, const std::vector<double>& values) {
    return detail::ColumnView{name, values.data(), 8, Type::float64};
  };
  const detail::ColumnView person{"id", ids.data(), 8, Type::int64}, y = numbers("y", time);
  const std::vector<detail::ColumnView> sound{numbers("t", time), person, numbers("x", time), y};
  EXPECT_EQ(refused(sound), "accepted");
  EXPECT_EQ(refused({sound[0], person, numbers("x", x), y}), "recording: row 2: x nan is not finite");
  EXPECT_EQ(refused({sound[0], person, numbers("x", far), y}),
            "recording: row 2: x 1e+09 is not within +-1e8 m");
  EXPECT_EQ(refused({sound[0], numbers("ID", id), sound[2], y}),
            "recording: row 1: id 0.5 is not a whole number");
  EXPECT_EQ(refused({sound[0], person, {"x", texts.data(), 8, Type::text}, y}),
            "recording: row 2: x 'three' is not a number");
  EXPECT_EQ(refused({sound[0], person, sound[2], y, numbers("clip", id)}),
            "recording: row 0: clip 0 is not a name");
  EXPECT_EQ(refused({{"frame", zeros.data(), 8, Type::int64}, person, sound[2], y}, {.fps = 1}),
            "recording: row 1: person 7 is at two places in frame 0, here at (0.5, 0.5), by row 0 at (0, 0)");
  EXPECT_EQ(refused({sound[0], person, {"x", nullptr, 8, Type::float64}, y}),
            "recording: column 'x' does not have a number in every row");
  EXPECT_EQ(refused({sound[0], person, y}), "recording: has no column called 'x', only 't, id, y'");
  EXPECT_EQ(refused({numbers("frame", time), person, sound[2], y}),
            "recording: says no frame rate: --fps has to give the frame numbers a second");
  EXPECT_EQ(refused(sound, {.fps = -1}),
            "recording: the frame rate of --fps is -1 frames a second, not above 0 and at most 10000");
  EXPECT_EQ(refused(sound, {.columns = "t,id,x,y"}),
            "recording: has columns with names; --columns is for files");
  EXPECT_EQ(test::complaint<detail::TrajectoryError>([&] { read_columns(sound, 0, {}); }),
            "recording: has no rows");
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
      Random random(static_cast<std::uint64_t>(id));
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

TEST_F(Trajectories, WithoutNamesAreToldByTheWaysOfPeople) {
  const ReadRecording named = read("frame id x/m y/m z/m\n" + walkers("fixyh"), {.fps = 25});
  EXPECT_EQ(named.frames.size(), 12u);
  const std::string taken = "Columns are taken for ", unnamed = ", which the file does not name: line ";
  for (const std::string comment : {"", "# framerate: 25\n", "# people who walk\n"}) {
    const std::string number = comment.empty() ? "1" : "2";
    const ReadRecording frames = read(comment + walkers("fixyh"), options);
    EXPECT_EQ(text_of(frames), text_of(named)) << comment;
    EXPECT_TRUE(assumptions_of(frames).starts_with(taken + "frame, id, x, y, z" + unnamed + number +
                                                   " has frame 780, id 1, x "))
        << assumptions_of(frames);
    const ReadRecording ids = read(comment + walkers("ifxyh"), options);
    EXPECT_EQ(text_of(ids), text_of(named)) << comment;
    EXPECT_TRUE(assumptions_of(ids).starts_with(taken + "id, frame, x, y, z" + unnamed + number +
                                                " has id 1, frame 780, x "))
        << assumptions_of(ids);
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
      EXPECT_TRUE(has(message, std::to_string(std::string(columns).size()) + asks)) << columns;
      EXPECT_TRUE(has(message, "; the first rows are '"));
    }
  // A single frame, or one person who jumps?
  for (const std::string& text :
       {walkers("fixyh", 10, 1, 1), walkers("fixyh", 40, 1, 1), std::string("1 1 1 2 1.7\n")})
    EXPECT_TRUE(has(complaint(text, options), asks));
  EXPECT_TRUE(
      has(complaint("# frame_number pedestrian_ID pos_x pos_z pos_y v_x v_z v_y\n" + walkers("fixoyvov"),
                    options),
          "f:2: has 8 columns without names: "));
}

TEST_F(Trajectories, WithoutNamesNeedARateAndAUnit) {
  const std::string text = walkers("ifxyh");
  EXPECT_TRUE(has(complaint(text), "f: says no unit and no frame rate: "));
  EXPECT_TRUE(has(complaint(text, {.fps = 16}), "f: says no unit: "));
  EXPECT_TRUE(has(complaint(text, {.unit = 0.01}), "f: says no frame rate: "));
  const ReadRecording recording = read(text, {.fps = 16, .unit = 0.01});
  EXPECT_EQ(recording.info.format, "text without a header");
  EXPECT_EQ(recording.info.fps, 16);
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
  const auto data = test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const Expected& expected = GetParam();
  const ReadRecording recording = read_recording(*data / "trajectories" / expected.file, expected.options);
  EXPECT_EQ(recording.info.format, expected.format);
  EXPECT_EQ(recording.info.fps, expected.fps);
  EXPECT_EQ(recording.info.rows, expected.rows);
  EXPECT_EQ(recording.info.people, expected.people);
  for (const RecordedFrame& frame : recording.frames)
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
}  // namespace bch::test