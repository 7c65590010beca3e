// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/guarded_import.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

#include "layout/import/character_bytes.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/test.hpp"

// A parser that goes wrong in any way: what is left is one line, and a process that goes on.

namespace bch::detail {
namespace {

using Read = std::function<ImportedCharacter()>;
using test::complaint;

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
