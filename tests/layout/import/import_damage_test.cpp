// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/guarded_import.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/test.hpp"

// Damaged models by the thousand: each is a valid character, or a line.

namespace bch::detail {
namespace {

namespace fs = std::filesystem;

struct Model {
  std::string name;
  std::string bytes;
};

std::vector<Model> own_models() {
  const GltfFile strip = SkinnedStrip().file();
  return {{"strip.glb", strip.binary()},
          {"strip.gltf", strip.text()},
          {"box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 2\nf 1 2 3 4\nf 1 -1 -2\n"},
          {"flat.ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
           "z\nelement "
           "face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n"},
          {"flat.stl",
           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
           "1\nendloop\nendfacet\n"
           "endsolid a\n"}};
}

/// Small real ones of every format that is read, with what lies beside them left out.
std::vector<Model> real_models() {
  std::vector<Model> models;
  const auto data = test::test_data();
  if (!data) return models;
  constexpr std::uintmax_t largest = 300'000;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(*data)) {
    if (!entry.is_regular_file() || entry.file_size() > largest || entry.file_size() == 0) continue;
    const std::string ending = entry.path().extension();
    const char* const known[] = {".glb", ".gltf", ".fbx", ".dae", ".md5mesh", ".iqm", ".obj", ".ply", ".stl"};
    if (std::find(std::begin(known), std::end(known), ending) == std::end(known)) continue;
    models.push_back({entry.path().filename(), test::read_text(entry.path())});
  }
  std::sort(models.begin(), models.end(), [](const Model& a, const Model& b) { return a.name < b.name; });
  return models;
}

std::string damaged(std::string bytes, test::Random& random) {
  const auto place = [&] { return random.below(static_cast<std::uint32_t>(bytes.size())); };
  const std::uint32_t kind = random.below(5);
  if (kind == 0) return bytes.substr(0, 1 + place());
  if (kind == 1) return bytes.erase(place(), 1 + random.below(64));
  if (kind == 2) return bytes.insert(place(), bytes.substr(place(), 1 + random.below(64)));
  const std::uint32_t changes = 1 + random.below(16);
  for (std::uint32_t i = 0; i < changes; ++i) {
    char& byte = bytes[place()];
    byte = kind == 3 ? static_cast<char>(byte ^ 1 << random.below(8)) : static_cast<char>(random.below(256));
  }
  return bytes;
}

/// Than the program gives, so that files which exhaust it take less long.
const ImportLimits less{std::chrono::seconds(2), std::size_t{512} << 20};

struct Outcomes {
  std::size_t read = 0, refused = 0, stopped = 0;
};

void import_damaged(const fs::path& file, Outcomes& outcomes) {
  std::string message;
  try {
    const auto read = [&] { return import_character(file); };
    validate(guarded_import(file.string(), read, less).character);
    ++outcomes.read;
    return;
  } catch (const ImportStopped& error) {
    message = error.what();
    ++outcomes.stopped;
  } catch (const ImportError& error) {
    message = error.what();
    ++outcomes.refused;
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
}

/// Parts of 50.
class ImportDamage : public testing::TestWithParam<std::uint32_t> {};

TEST_P(ImportDamage, IsACharacterOrALine) {
  std::vector<Model> models = own_models();
  std::ranges::move(real_models(), std::back_inserter(models));
  const TemporaryFolder folder;
  Outcomes outcomes;
  test::Random random(100 + GetParam());
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Model& model = models[random.below(static_cast<std::uint32_t>(models.size()))];
    SCOPED_TRACE(model.name + ", model " + std::to_string(i));
    const fs::path file = folder.write(model.name, damaged(model.bytes, random));
    import_damaged(file, outcomes);
    fs::remove(file);
  }
  std::printf("%zu models, %zu read, %zu refused, %zu crashed or exhausted assimp\n", models.size(),
              outcomes.read, outcomes.refused, outcomes.stopped);
  EXPECT_GT(outcomes.read + outcomes.refused, 25u);
}

INSTANTIATE_TEST_SUITE_P(Parts, ImportDamage, testing::Range(0u, 8u));
// With these 2 000 models: --gtest_also_run_disabled_tests.
INSTANTIATE_TEST_SUITE_P(DISABLED_More, ImportDamage, testing::Range(8u, 40u));

}  // namespace
}  // namespace bch::detail
