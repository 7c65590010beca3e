// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "layout/import/character_bytes.hpp"
#include "layout/import/guarded_import.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// What a file must not say, and which files are read beside the one that is given.

namespace bch::detail {
namespace {

using test::complaint;

namespace fs = std::filesystem;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

class ImportFaults : public test::ImportTest {
 protected:
  const fs::path good = folder.write("good.gltf", SkinnedStrip().text());

  std::string complaint_of_clips(const fs::path& clips) const {
    ImportOptions options;
    options.clip_files = {clips};
    return complaint(good, options);
  }
};

TEST_F(ImportFaults, FilesThatAreNone) {
  EXPECT_EQ(complaint(folder.file("missing.glb")), "missing.glb: no such file");
  EXPECT_TRUE(complaint(folder.path()).ends_with("is a directory"));
  ImportOptions options;
  for (const float scale : {0.0f, -1.0f, nan, infinity}) {
    options.scale = scale;
    EXPECT_TRUE(complaint(good, options).ends_with("is not a positive number")) << scale;
  }
}

TEST_F(ImportFaults, EveryTruncationIsRefused) {
  const std::string whole = SkinnedStrip().file().binary(), text = SkinnedStrip().text();
  for (const std::size_t size : {1ul, 4ul, 11ul, 12ul, 19ul, 20ul, 100ul, whole.size() / 2, whole.size() - 1})
    EXPECT_NE(complaint("cut.glb", whole.substr(0, size)), "accepted") << size;
  for (const std::size_t size : {1ul, 10ul, text.size() / 4, text.size() / 2, text.size() - 1})
    EXPECT_NE(complaint("cut.gltf", text.substr(0, size)), "accepted") << size;
}

/// One change to a good strip.
TEST_F(ImportFaults, NumbersAndNames) {
  using Strip = SkinnedStrip;
  const std::pair<std::function<void(Strip&)>, const char*> cases[] = {
      {[](Strip& s) { s.mode = 0; }, "no triangles"},
      {[](Strip& s) { s.indices[1] = 77, s.indices[2] = 78, s.indices.resize(3); }, "no triangles"},
      {[](Strip& s) { s.positions[4] = nan; }, "vertex 1 is not finite"},
      {[](Strip& s) { s.positions[11] = infinity; }, "vertex 3 is not finite"},
      {[](Strip& s) { s.positions[6] = 1e30f; }, "vertex 2 is absurdly far away"},
      {[](Strip& s) { s.positions[0] = 2e6f; }, "vertex 0 is absurdly far away"},
      {[](Strip& s) { s.weights.assign(16, 0); }, "zero weights"},
      {[](Strip& s) { s.weights[5] = nan; }, "gives vertex 1 the weight nan"},
      {[](Strip& s) { s.weights[5] = -0.5f; }, "gives vertex 1 the weight -0.5"},
      {[](Strip& s) { s.weights[8] = 1.01f; }, "gives vertex 2 the weight 1.01"},
      {[](Strip& s) { s.joints[13] = 2; }, "gives vertex 3 joint 2 of 2"},
      {[](Strip& s) { s.inverse_binds[12] = nan; }, "bone 'hips' of mesh 0 'strip'"},
      {[](Strip& s) { s.inverse_binds[16 + 3] = 2; }, "not affine"},
      {[](Strip& s) { s.inverse_binds[0] = 1e20f; }, "absurd transform"},
      {[](Strip& s) { s.turns.assign(12, 0); }, "rotation key 0 is no rotation"},
      {[](Strip& s) { s.turns[5] = nan; }, "rotation key 1 is no rotation"},
      {[](Strip& s) { s.way[3] = infinity; }, "position key 1 is not finite"},
      {[](Strip& s) { s.way[3] = 1e9f; }, "'hips' absurdly far away"},
      {[](Strip& s) { s.times[1] = nan; }, "key 1 is at"},
      {[](Strip& s) { s.times[2] = 1e9f; }, "key 2 is at"}};
  for (const auto& [change, reason] : cases) {
    Strip strip;
    change(strip);
    EXPECT_TRUE(test::has(complaint("strip.gltf", strip.text()), reason));
  }
}

TEST_F(ImportFaults, ClipFiles) {
  EXPECT_EQ(complaint_of_clips(folder.file("missing.bvh")), "missing.bvh: no such file");
  EXPECT_TRUE(test::has(complaint_of_clips(folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
                        "box.obj: no clips"));
  SkinnedStrip other;
  other.hips = "pelvis", other.head = "neck";
  EXPECT_TRUE(test::has(complaint_of_clips(folder.write("other.gltf", other.text())),
                        "moves no joint that the character has"));
  other = {};
  other.head_place = "'translation':[0.5,0,0]";
  EXPECT_TRUE(test::has(complaint_of_clips(folder.write("turned.gltf", other.text())),
                        "joints are turned otherwise"));
}

/// What must not be read would be a good buffer, of a name that is not there beside the model: assimp looks there, too, for what it does not
/// find.
class ImportFiles : public test::ImportTest {
 protected:
  ImportFiles() {
    fs::create_directory(models);
    fs::create_directory(models / "below");
    for (const char* const name : {"models/buffer.bin", "secret.bin", "models/below/secret.bin"})
      folder.write(name, gltf.buffer());
  }

  fs::path model(const std::string& uri) const { return folder.write("models/strip.gltf", gltf.text(uri)); }
  bool reads(const fs::path& file) const { return import_character(file).report.triangles == 2; }
  void expect_unread(const std::string& uri) const {
    EXPECT_TRUE(complaint(model(uri)).starts_with("models/strip.gltf: ")) << uri;
  }

  const fs::path models = folder.file("models");
  const GltfFile gltf = SkinnedStrip().file();
};

TEST_F(ImportFiles, SiblingsAreReadAndNothingElseIs) {
  EXPECT_TRUE(reads(model("buffer.bin")));
  EXPECT_TRUE(reads(model("../models/./buffer.bin")));
  const fs::path before = fs::current_path();
  fs::current_path(models);
  EXPECT_TRUE(reads("strip.gltf"));
  fs::current_path(before);
  const std::string secret = folder.file("secret.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("below/secret.bin"), std::string("below/../../secret.bin"),
        secret, "file://" + secret, "/../../../../../../.." + secret, std::string("..\\\\secret.bin"),
        std::string("%2e%2e/secret.bin")})
    expect_unread(uri);
}

/// Of a model that is a link itself, siblings are those of the link.
TEST_F(ImportFiles, LinksThatLeadElsewhereAreNotFollowed) {
  fs::create_symlink(folder.file("secret.bin"), models / "away.bin");
  fs::create_symlink(models / "buffer.bin", models / "here.bin");
  expect_unread("away.bin");
  EXPECT_TRUE(reads(model("here.bin")));
  fs::create_symlink(folder.write("elsewhere.gltf", gltf.text("buffer.bin")), models / "link.gltf");
  EXPECT_TRUE(reads(models / "link.gltf"));
}

TEST_F(ImportFiles, PipesAreNotOpenedAndHugeFilesRefused) {
  fs::remove(models / "buffer.bin");
  ASSERT_EQ(mkfifo((models / "buffer.bin").c_str(), 0600), 0);
  expect_unread("buffer.bin");  // else it would wait for a writer for ever
  fs::remove(models / "buffer.bin");
  constexpr std::uintmax_t huge = (std::uintmax_t{1} << 30) + 1;  // of holes
  fs::resize_file(folder.write("models/buffer.bin", ""), huge);
  expect_unread("buffer.bin");
  fs::resize_file(model("buffer.bin"), huge);
  EXPECT_TRUE(test::has(complaint(models / "strip.gltf"), "larger than 1 GiB"));
}

// ---- A parser that goes wrong in any way: what is left is one line, and a process that goes on.

using Read = std::function<ImportedCharacter()>;

const ImportLimits little_memory{.memory = std::size_t{256} << 20};
const ImportLimits little_time{.time = std::chrono::milliseconds(300)};

void expect_rejected(const Read& read, const std::string& reason,
                     const ImportLimits& limits = little_memory) {
  const std::string message = complaint<ImportStopped>([&] { guarded_import("a.glb", read, limits); });
  EXPECT_TRUE(message.starts_with("a.glb: ")) << message;
  EXPECT_TRUE(test::has(message, reason));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

ImportedCharacter good() {
  return {default_male(), {}};
}

TEST(GuardedImport, ACharacterArrivesAsItWasRead) {
  const TemporaryFolder folder;
  SkinnedStrip strip;
  strip.interpolation = "'interpolation':'CUBICSPLINE',";
  strip.times = {0};
  strip.way.assign(9, 1);
  strip.turns.assign(12, 0.5f);
  const std::string file = folder.write("strip.gltf", strip.text());
  const std::string direct = to_bytes(import_character(file));
  EXPECT_EQ(to_bytes(import_in_child(file)), direct);
  const ImportedCharacter again = imported_from(direct);
  EXPECT_EQ(to_bytes(again), direct);
  EXPECT_EQ(again.character.clips.at(0).channels.size(), 2u);
  const Curve<Vec3>& curve = again.character.clips[0].channels[0].position_curve;
  EXPECT_EQ(curve.interpolation, Interpolation::cubic);
  ASSERT_EQ(curve.tangents.size(), 1u);
  EXPECT_EQ(curve.tangents[0].out, (Vec3{1, 1, 1}));
  EXPECT_EQ(again.report.clips.at(0).name, "walk");
  EXPECT_EQ(again.report.triangles, 2u);
}

/// A file of clips, say, is named where it is known to be the one, and with the character where it is not.
TEST(GuardedImport, ErrorsNameTheFileThatIsRead) {
  EXPECT_EQ(complaint<ImportError>([] { import_in_child("/nowhere/a.glb"); }),
            "/nowhere/a.glb: no such file");
  const auto without_memory = []() -> ImportedCharacter {
    throw ImportError("walk.bvh: needs more memory than there is");
  };
  EXPECT_EQ(complaint<ImportStopped>([&] { guarded_import("a.glb", without_memory); }),
            "walk.bvh: reading it takes more than 2 GiB of memory");
  ImportOptions options;
  options.clip_files = {"b.bvh", "c.fbx"};
  EXPECT_TRUE(test::has(complaint<ImportStopped>([&] {
                          import_in_child("/nowhere/a.glb", options, {.time = std::chrono::milliseconds(0)});
                        }),
                        "/nowhere/a.glb with b.bvh with c.fbx: "));
}

TEST(GuardedImport, Crashes) {
  for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
    expect_rejected([number]() -> ImportedCharacter { return raise(number), good(); },
                    "crashes on it (signal " + std::to_string(number) + ")");
}

TEST(GuardedImport, Hangs) {
  expect_rejected(
      []() -> ImportedCharacter {
        for (volatile int i = 0;;) i = i + 1;
      },
      "more than 0.3 seconds", little_time);
  expect_rejected([]() -> ImportedCharacter { return pause(), good(); }, "more than 0.3 seconds",
                  little_time);
  // One that would be heard, but not ended, by a signal that can be ignored.
  expect_rejected(
      []() -> ImportedCharacter {
        for (int number = 1; number < 32; ++number) signal(number, SIG_IGN);
        while (true) pause();
      },
      "more than 0.3 seconds", little_time);
}

TEST(GuardedImport, CallersMayEndIt) {
  int asked = 0;
  const ImportLimits limits{.go_on = [&] { return ++asked < 4; }};
  expect_rejected([]() -> ImportedCharacter { return pause(), good(); }, "cancelled", limits);
  EXPECT_EQ(asked, 5);
}

/// A program may have said that it does not care for its children.
TEST(GuardedImport, WithoutNewsOfTheChildsEnd) {
  signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(guarded_import("a.glb", good).character.triangles, good().character.triangles);
  expect_rejected([]() -> ImportedCharacter { std::abort(); }, "gives up on it");
  signal(SIGCHLD, SIG_DFL);
}

#if !defined(BCH_SANITIZED) && !defined(BCH_EMULATED)  // neither has a limit of memory
TEST(GuardedImport, Bombs) {
  expect_rejected(
      []() -> ImportedCharacter {
        std::vector<std::vector<char>> all;
        while (true) all.emplace_back(std::size_t{1} << 20, 'x');
      },
      "more than 0.25 GiB of memory");
  expect_rejected(
      []() -> ImportedCharacter {
        while (char* const block = static_cast<char*>(std::malloc(1 << 20))) std::memset(block, 1, 1 << 20);
        throw std::bad_alloc();
      },
      "more than 0.25 GiB of memory");
}

/// A program that has read many characters may read the next one, and is no less guarded.
TEST(GuardedImport, MemoryOfTheParentDoesNotCount) {
  const std::size_t held = 2 * little_memory.memory;
  void* const memory = mmap(nullptr, held, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  EXPECT_EQ(guarded_import("a.glb", good, little_memory).character.triangles, good().character.triangles);
  expect_rejected(
      []() -> ImportedCharacter {
        const std::string all(2 * little_memory.memory, 'x');
        const volatile char& last = all.back();  // else the compiler may leave the memory out
        return last == 'x' ? good() : ImportedCharacter();
      },
      "more than 0.25 GiB of memory");
  munmap(memory, held);
}
#endif

TEST(GuardedImport, Leavings) {
  for (const int code : {0, 1, 3})
    expect_rejected([code]() -> ImportedCharacter { _exit(code); }, "gives up on it");
}

/// What a child whose memory is damaged may say.
TEST(GuardedImport, CharactersThatAreNone) {
  expect_rejected(
      [] {
        ImportedCharacter imported = good();
        imported.character.triangles[0][1] = 0x7fffffff;
        return imported;
      },
      "malformed");
  const std::string bytes = to_bytes({default_male(), {}});
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{8}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(imported_from(std::span(bytes).first(size)), std::invalid_argument) << size;
  EXPECT_THROW(imported_from(bytes + '\0'), std::invalid_argument);
  // A count of 2^64 - 1 names.
  EXPECT_THROW(imported_from(std::string(8, '\xff') + bytes), std::invalid_argument);
}

}  // namespace
}  // namespace bch::detail
