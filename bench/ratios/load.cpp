// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include <bch/files.hpp>

#include "bench/characters/baking.hpp"
#include "bench/ratios/ratios.hpp"
#include "layout/baked/checksum.hpp"
#include "layout/baked/file_bytes.hpp"
#include "layout/format/shape_validation.hpp"

namespace bch::bench {
namespace {

/// A file of the scene's poses, which goes with this.
struct Loaded {
  std::string file = std::filesystem::temp_directory_path() / fmt::format("bch_ratios_{}.bch", getpid());
  detail::FileBytes bytes;
  BakedShapes baked;

  explicit Loaded(Scene& scene) : bytes(bake(scene)), baked(load_baked(bytes.bytes, file, bytes.memory)) {}
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;
  ~Loaded() {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }

  detail::FileBytes bake(Scene& scene) const {
    cli::bake_file(file, scene.characters(), scene.sources(), double{leaf_threshold}, {});
    return detail::map_file(file);
  }
};

struct Part {
  const char* name;
  void (*load)(const Loaded& loaded);
};
/// The file by either way, in the file cache; then what that consists of. Mapping includes its end.
constexpr Part parts[] = {
    {"map", [](const Loaded& from) { benchmark::DoNotOptimize(load_baked(from.file, FileAccess::map)); }},
    {"read", [](const Loaded& from) { benchmark::DoNotOptimize(load_baked(from.file)); }},
    {"map_alone", [](const Loaded& from) { benchmark::DoNotOptimize(detail::map_file(from.file)); }},
    {"checksum_alone",
     [](const Loaded& from) { benchmark::DoNotOptimize(detail::baked::checksum(from.bytes.bytes)); }},
    {"validation_alone", [](const Loaded& from) { validate(from.baked.set.arrays()); }}};

}  // namespace

void add_load(Scene& scene) {
  const auto loaded = once([&scene] { return std::make_shared<const Loaded>(scene); });
  for (const Part& part : parts)
    add(fmt::format("load/{}", part.name), [loaded, load = part.load]() -> Contender {
      const Loaded& from = loaded();
      const auto bytes = static_cast<double>(from.bytes.bytes.size());
      return {[&from, load] { load(from); }, 1, {{"shapes", from.baked.set.shape_count()}, {"bytes", bytes}}};
    });
}

}  // namespace bch::bench
