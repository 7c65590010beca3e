// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <hdf5.h>

#include <chrono>

#include "tests/support/character_shapes.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/test.hpp"

// Recordings of the Pedestrian Dynamics Data Archive.

namespace bch::test {
namespace {

/// A file of the Pedestrian Dynamics Data Archive or of JuPedSim, and ways in which it is none.
struct ArchiveFile {
  struct Row {
    std::int64_t id, frame;
    double x, y, z, ox = 0, oy = 0;
  };
  enum class Storage : std::uint8_t {
    contiguous,
    deflated,
    big_chunks,
    external_file,
    external_link,
    soft_link,
    scaled
  };

  std::vector<Row> rows{{1, 0, 1.5, 2, 1.76}, {2, 0, 3, 4, 0.5}, {1, 1, 1.75, 2, 1.76}};
  std::optional<double> fps = 25;
  std::optional<std::string> geometry = "POLYGON ((0 0, 1 0, 1 1, 0 0))";
  bool fixed_text = false;  ///< the geometry has a length, not an end
  bool fps_is_text = false;
  bool is_plane = false;  ///< two dimensions
  bool floats = false;    ///< of half the size
  bool x_is_integer = false;
  bool has_orientation = false;  ///< ox and oy, before all others
  bool ids_are_unsigned = false;
  std::uint64_t chunk = 2;  ///< rows, of those that are deflated
  std::optional<std::string> producer = std::nullopt;
  std::string name = "trajectory", z = "z";
  Storage storage = Storage::contiguous;

  void write(const std::filesystem::path& file) const;
};

hid_t made(hid_t id) {
  if (id < 0) throw std::runtime_error("an HDF5 file cannot be made");
  return id;
}

hid_t memory_type(const ArchiveFile& file) {
  const hid_t type = made(H5Tcreate(H5T_COMPOUND, sizeof(ArchiveFile::Row)));
  H5Tinsert(type, "id", offsetof(ArchiveFile::Row, id),
            file.ids_are_unsigned ? H5T_NATIVE_UINT64 : H5T_NATIVE_INT64);
  H5Tinsert(type, "frame", offsetof(ArchiveFile::Row, frame), H5T_NATIVE_INT64);
  H5Tinsert(type, "x", offsetof(ArchiveFile::Row, x), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "y", offsetof(ArchiveFile::Row, y), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, file.z.c_str(), offsetof(ArchiveFile::Row, z), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "ox", offsetof(ArchiveFile::Row, ox), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "oy", offsetof(ArchiveFile::Row, oy), H5T_NATIVE_DOUBLE);
  return type;
}

hid_t file_type(const ArchiveFile& file) {
  const std::size_t whole = file.floats ? 4 : 8;
  const hid_t integer = file.floats ? H5T_STD_I32BE : H5T_STD_I64LE,
              real = file.floats ? H5T_IEEE_F32BE : H5T_IEEE_F64LE;
  const std::size_t begin = file.has_orientation ? 2 * whole : 0;
  const hid_t type = made(H5Tcreate(H5T_COMPOUND, begin + 5 * whole));
  if (file.has_orientation) {
    H5Tinsert(type, "oy", 0, real);
    H5Tinsert(type, "ox", whole, real);
  }
  H5Tinsert(type, "id", begin, file.ids_are_unsigned ? H5T_STD_U64LE : integer);
  H5Tinsert(type, "frame", begin + whole, integer);
  H5Tinsert(type, file.z.c_str(), begin + 2 * whole, real);
  H5Tinsert(type, "x", begin + 3 * whole, file.x_is_integer ? integer : real);
  H5Tinsert(type, "y", begin + 4 * whole, real);
  return type;
}

hid_t creation(const ArchiveFile& file) {
  const hid_t list = made(H5Pcreate(H5P_DATASET_CREATE));
  hsize_t chunk[] = {file.storage == ArchiveFile::Storage::big_chunks ? hsize_t{1} << 20 : file.chunk, 1};
  using enum ArchiveFile::Storage;
  if (file.storage == deflated || file.storage == big_chunks) H5Pset_chunk(list, 1, chunk);
  if (file.storage == deflated) {
    H5Pset_shuffle(list);
    H5Pset_deflate(list, 6);
    H5Pset_fletcher32(list);
  }
  if (file.storage == scaled) {
    H5Pset_chunk(list, 1, chunk);
    H5Pset_nbit(list);
  }
  if (file.storage == external_file) H5Pset_external(list, "/dev/zero", 0, H5F_UNLIMITED);
  return list;
}

void add_text(hid_t object, const char* name, const std::string& text, bool is_fixed) {
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, is_fixed ? text.size() : H5T_VARIABLE);
  const hid_t attribute = made(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  const char* const start = text.c_str();
  H5Awrite(attribute, type, is_fixed ? static_cast<const void*>(start) : &start);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

void add_fps(hid_t dataset, const ArchiveFile& file) {
  if (file.fps_is_text) return add_text(dataset, "fps", "25", false);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = made(H5Acreate2(dataset, "fps", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT));
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, &*file.fps);
  H5Aclose(attribute);
  H5Sclose(space);
}

void add_dataset(hid_t opened, const ArchiveFile& file) {
  const bool may_grow =
      file.storage == ArchiveFile::Storage::big_chunks;  // chunks are no larger than what is there
  const hsize_t sizes[] = {file.rows.size(), 1}, unlimited[] = {H5S_UNLIMITED, H5S_UNLIMITED};
  const hid_t space = made(H5Screate_simple(file.is_plane ? 2 : 1, sizes, may_grow ? unlimited : nullptr));
  const hid_t list = creation(file), memory = memory_type(file), type = file_type(file);
  const hid_t dataset =
      made(H5Dcreate2(opened, file.name.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT));
  if (file.storage != ArchiveFile::Storage::external_file && !file.rows.empty())
    H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, file.rows.data());
  if (file.fps) add_fps(dataset, file);
  H5Dclose(dataset);
  for (const hid_t closing : {type, memory}) H5Tclose(closing);
  H5Pclose(list);
  H5Sclose(space);
}

void ArchiveFile::write(const std::filesystem::path& file) const {
  const hid_t opened = made(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  if (storage == Storage::external_link)
    H5Lcreate_external("other.h5", "/trajectory", opened, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  else if (storage == Storage::soft_link)
    H5Lcreate_soft("/elsewhere", opened, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  else
    add_dataset(opened, *this);
  if (geometry) add_text(opened, "wkt_geometry", *geometry, fixed_text);
  if (producer) add_text(opened, "producer", *producer, fixed_text);
  H5Fclose(opened);
}

using Storage = ArchiveFile::Storage;

class ArchiveFiles : public testing::Test {
 protected:
  TemporaryFolder folder;

  ReadRecording read(const ArchiveFile& file, const detail::TrajectoryOptions& options = {}) const {
    file.write(folder.file("f"));
    return read_recording(folder.file("f"), options);
  }
  std::string complaint(const ArchiveFile& file) const {
    file.write(folder.file("f"));
    return trajectory_complaint(folder.file("f"));
  }
};

constexpr const char* rows = "0 1 1.5 2 - 1.76\n0 2 3 4 - -\n1 1 1.75 2 - 1.76\n";

TEST_F(ArchiveFiles, AreRead) {
  ArchiveFile file;
  const ReadRecording recording = read(file);
  EXPECT_EQ(recording.info.format, "HDF5 of the Pedestrian Dynamics Data Archive");
  EXPECT_EQ(recording.info.fps, 25);
  EXPECT_EQ(recording.info.geometry, "POLYGON ((0 0, 1 0, 1 1, 0 0))");
  EXPECT_EQ(text_of(recording), rows);
  EXPECT_EQ(recording.info.assumptions.size(), 2u);  // on heights
  file.fixed_text = true;
  EXPECT_EQ(read(file).info.geometry, "POLYGON ((0 0, 1 0, 1 1, 0 0))");
  file.geometry.reset();
  EXPECT_EQ(read(file).info.assumptions.front(), "There are no walls: the file has no geometry.");
  file.floats = true;
  EXPECT_EQ(text_of(read(file)), rows);
  file.storage = Storage::deflated;
  EXPECT_EQ(text_of(read(file)), rows);
  file.fps.reset();
  EXPECT_EQ(read(file, {.fps = 8, .unit = 0.5}).frames[0].people[1].y, 2);
}

TEST_F(ArchiveFiles, MayHaveMoreRowsThanABatch) {
  ArchiveFile file;
  file.rows.clear();
  for (std::int64_t frame = 5'000; frame > 0; --frame)
    for (std::int64_t id = 0; id < 3; ++id)
      file.rows.push_back({id, frame, 0.25 * static_cast<double>(frame), 1, 1.5});
  const ReadRecording recording = read(file);
  EXPECT_EQ(recording.info.rows, 15'000u);
  EXPECT_EQ(recording.frames[41].people[2].x, 10.5);
  file.rows.push_back({2, 7, 3, 1, 1.5});
  EXPECT_EQ(complaint(file),
            "f: row 15001: person 2 is at two places in frame 7, here at (3, 1), by row 14982 at (1.75, 1)");
}

TEST_F(ArchiveFiles, OfJuPedSimSayWherePeopleFaceAndNotHowTallTheyAre) {
  ArchiveFile file;
  file.has_orientation = true;
  file.rows = {{1, 0, 1.5, 2, 0, 0, 1}, {2, 0, 3, 4, 1.5, -1, 0}, {3, 0, 5, 6, 0, 0, 0}};
  const ReadRecording recording = read(file);
  EXPECT_EQ(recording.info.format, "JuPedSim HDF5");
  EXPECT_EQ(text_of(recording), "0 1 1.5 2 1.5707964 -\n0 2 3 4 3.1415927 -\n0 3 5 6 - -\n");
  EXPECT_EQ(recording.info.assumptions,
            std::vector<std::string>{"z is the height of the floor, and is ignored."});
  file.rows[1].z = 0;
  EXPECT_TRUE(read(file).info.assumptions.empty());
  file.rows[0].ox = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(read(file).frames[0].people[0].heading));
  file.rows[0].ox = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint(file), "f: row 1: ox 'inf' is not finite");
  // Without directions, too.
  file = {};
  file.producer = "JuPedSim";
  EXPECT_EQ(text_of(read(file)), "0 1 1.5 2 - -\n0 2 3 4 - -\n1 1 1.75 2 - -\n");
  file.producer = "another";
  EXPECT_EQ(text_of(read(file)), rows);
}

TEST_F(ArchiveFiles, HaveIdsOf63Bits) {
  ArchiveFile file;
  file.ids_are_unsigned = true;
  EXPECT_EQ(text_of(read(file)), rows);
  file.rows[0].id = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(read(file).frames[0].people[1].id, file.rows[0].id);
  file.rows[1].id = std::numeric_limits<std::int64_t>::min();  // as an unsigned number
  EXPECT_EQ(complaint(file), "f: row 2: id '9223372036854775808' is not below 2^63");
}

/// Returns the bytes that this process and its children have read from files; 0 where nobody counts them.
std::uint64_t bytes_read() {
  std::ifstream counts("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  return counts >> name >> bytes ? bytes : 0;
}

TEST_F(ArchiveFiles, AreInflatedOnceForEachPass) {
  ArchiveFile file;
  file.storage = Storage::deflated;
  file.rows.clear();
  Random random(1);
  for (std::int64_t row = 0; row < 100'000; ++row)
    file.rows.push_back({row % 100, row / 100, random.uniform(-100, 100), random.uniform(-100, 100), 1.5});
  std::string text;
  for (const std::uint64_t chunk : {100'000u, 30'000u, 1'000u}) {
    file.chunk = chunk;
    file.write(folder.file("f"));
    const std::uint64_t before = bytes_read();
    const ReadRecording recording = read_recording(folder.file("f"));
    const std::uint64_t pipes = 2 * 64 * file.rows.size();  // from the child
    EXPECT_LT(bytes_read() - before, 4 * std::filesystem::file_size(folder.file("f")) + pipes) << chunk;
    if (text.empty()) text = text_of(recording);
    EXPECT_EQ(text_of(recording), text) << chunk;
  }
}

TEST_F(ArchiveFiles, AreReadNoFurtherThanTheCallerLikes) {
  ArchiveFile().write(folder.file("f"));
  EXPECT_EQ(trajectory_complaint(folder.file("f"), {.go_on = [] { return false; }}),
            "f: reading it was cancelled");
}

TEST_F(ArchiveFiles, AreRefusedByOneLine) {
  using File = ArchiveFile;
  const std::pair<std::function<void(File&)>, const char*> cases[] = {
      {[](File& f) { f.name = "positions"; }, "has no dataset 'trajectory'"},
      {[](File& f) { f.z = "height"; }, "the records of 'trajectory' have no 'z'"},
      {[](File& f) { f.x_is_integer = true; }, "'x' of 'trajectory' is not a floating-point number"},
      {[](File& f) { f.is_plane = true; }, "the dataset 'trajectory' is not one-dimensional"},
      {[](File& f) { f.fps_is_text = true; }, "the attribute 'fps' is not a number"},
      {[](File& f) { f.fps = 0; }, "the attribute 'fps' is 0 frames a second, not above 0 and at most 10000"},
      {[](File& f) { f.fps = 20'000; },
       "the attribute 'fps' is 20000 frames a second, not above 0 and at most 10000"},
      {[](File& f) { f.fps.reset(); }, "says no frame rate: --fps has to give the frame numbers a second"},
      {[](File& f) { f.rows.clear(); }, "has no rows"},
      {[](File& f) { f.rows[1].y = std::nan(""); }, "row 2: y 'nan' is not finite"},
      {[](File& f) { f.rows[1].y = 2e8; }, "row 2: y '2e+08' is not within +-1e8 m"},
      {[](File& f) { f.rows[2].frame = std::numeric_limits<std::int64_t>::min(); },
       "row 3: frame '-9223372036854775808' is not within +-1e15"},
      // They lie in one file, and need no plugin.
      {[](File& f) { f.storage = Storage::external_link; }, "'trajectory' is a link to elsewhere"},
      {[](File& f) { f.storage = Storage::soft_link; }, "'trajectory' is a link to elsewhere"},
      {[](File& f) { f.storage = Storage::external_file; }, "the dataset 'trajectory' lies in other files"},
      {[](File& f) { f.storage = Storage::scaled; },
       "the dataset 'trajectory' uses filter 5; deflate, shuffle and fletcher32 are read"},
      {[](File& f) { f.storage = Storage::big_chunks; },
       "the dataset 'trajectory' has chunks of more than 32 MiB"}};
  for (const auto& [change, message] : cases) {
    ArchiveFile file;
    change(file);
    EXPECT_EQ(complaint(file), std::string("f: ") + message);
  }
}

TEST_F(ArchiveFiles, ThatAreDamagedAreReadOrRefused) {
  ArchiveFile file;
  file.write(folder.file("f"));
  const std::string bytes = read_text(folder.file("f"));
  ASSERT_GT(bytes.size(), 2'000u);
  for (std::size_t size = 8; size < bytes.size(); size += 1 + bytes.size() / 40) {
    const std::string message = trajectory_complaint(folder.write("g", bytes.substr(0, size)));
    EXPECT_TRUE(message.starts_with("g: ")) << size << ": " << message;
  }
  // The library looks for ever at some heaps of texts.
  const detail::TrajectoryOptions hasty{.patience = std::chrono::milliseconds(300)};
  Random random(1);
  std::uint32_t refused = 0;
  for (std::uint32_t i = 0; i < samples(800); ++i) {
    std::string damaged = bytes;
    for (int flips = 0; flips < 4; ++flips)
      damaged[8 + random.below(static_cast<std::uint32_t>(bytes.size() - 8))] ^=
          static_cast<char>(1 << random.below(8));
    refused += trajectory_complaint(folder.write("g", damaged), hasty) != "accepted";
  }
  EXPECT_GT(refused, 0u);
}

TEST_F(ArchiveFiles, OfTheArchiveAreRead) {
  const auto data = test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const ReadRecording recording = read_recording(*data / "trajectories/data_archive_00_01a.h5");
  EXPECT_EQ(recording.info.rows, 30'701u);
  EXPECT_EQ(recording.info.people, 46u);
  EXPECT_EQ(recording.info.fps, 25);
  EXPECT_TRUE(recording.info.geometry.starts_with("POLYGON ((-4 -4, -4 6, "));
}

}  // namespace
}  // namespace bch::test
