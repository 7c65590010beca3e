// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "bench/base/output.hpp"
#include "bench/base/progress.hpp"
#include "bench/report/provenance.hpp"

namespace bch::report {
namespace {

using Json = nlohmann::ordered_json;

bool wants(const Options& options, const Experiment& experiment) {
  const auto& names = options.experiments;
  return names.empty() || std::find(names.begin(), names.end(), experiment.name) != names.end();
}

std::vector<const Experiment*> wanted(const Options& options) {
  std::vector<const Experiment*> these;
  for (const Experiment& experiment : experiments())
    if (wants(options, experiment)) these.push_back(&experiment);
  return these;
}

std::vector<std::string> files_in(const std::filesystem::path& folder, std::string_view ending) {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().extension() == ending) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_clip(const std::filesystem::path& file) {
  return file.filename().string().starts_with("clip_");
}

/// What was run, on what, by what.
Table facts_of(const Options& options) {
  Table table({"what", "value"});
  for (const auto& [what, value] : provenance()) table.add({what, value});
  table.add({"command", options.command});
  std::string characters;
  for (const std::string& one : options.characters) characters += (characters.empty() ? "" : ", ") + one;
  table.add({"characters", characters});
  table.add({"real characters", options.real_characters.string()});
  table.add({"recordings", options.recordings.string()});
  table.add({"seed", options.seed});
  const Sizes& sizes = options.sizes;
  table.add({"poses of a character", sizes.poses});
  table.add({"pairs of a workload", sizes.pairs});
  table.add({"agents of the crowd", sizes.agents});
  table.add({"cases of people who slide", sizes.cases});
  table.add({"runs of what is timed", sizes.runs});
  table.add({"people who are packed", sizes.people});
  table.add({"packings", sizes.packings});
  table.add({"radius of discs of simulators (m)", sizes.disc_radius});
  return table;
}

/// Files that are characters, in the order of their names: glTF files, and FBX files of the folder `native`, which its clips
/// follow where they fit.
std::vector<cli::LoadedCharacter> load_real_characters(const std::filesystem::path& folder) {
  std::vector<cli::LoadedCharacter> loaded;
  ImportOptions with_clips;
  for (const auto& file : files_in(folder / "native", ".fbx"))
    if (is_clip(file)) with_clips.clip_files.push_back(file);
  for (const auto& file : files_in(folder, ".glb")) loaded.push_back(cli::load_character(file, {}));
  for (const auto& file : files_in(folder / "native", ".fbx")) {
    if (is_clip(file)) continue;
    try {
      loaded.push_back(cli::load_character(file, with_clips));
    } catch (const ImportError&) {  // another skeleton
      loaded.push_back(cli::load_character(file, {}));
    }
  }
  return loaded;
}

Json json_of(const Experiment& experiment, const Table& facts) {
  Json json{{"experiment", experiment.name}, {"title", experiment.title}};
  for (const auto& row : facts.rows()) json["run"][row[0]] = row[1];
  return json;
}

}  // namespace

void run_report(const Options& options) {
  bench::Scene scene({.characters = options.characters,
                      .poses = options.sizes.poses,
                      .pose_seed = options.seed,
                      .sizes = {options.sizes.pairs, options.sizes.agents}});
  // First, as a bad file should neither cost minutes nor leave files, and an import wants a process without threads.
  scene.characters();
  const bool has_real = !options.real_characters.empty() &&
                        (wants(options, real_experiment) || wants(options, motions_experiment));
  const auto real =
      has_real ? load_real_characters(options.real_characters) : std::vector<cli::LoadedCharacter>();
  cli::make_folder(options.folder);
  const Table facts = facts_of(options);
  cli::write_file(options.folder / "run.csv", csv_of(facts));

  const auto these = wanted(options);
  double total = 0;
  for (const Experiment* experiment : these) total += experiment->seconds;
  cli::Progress progress("report", static_cast<std::size_t>(total));
  double before = 0;
  std::size_t shown = 0;
  for (const Experiment* experiment : these) {
    Json json = json_of(*experiment, facts);
    const auto write = [&](const std::string& name, const Table& table) {
      cli::write_file(options.folder / (name + ".csv"), csv_of(table));
      json["tables"][name] = json_of(table);
    };
    std::mutex counting;  // experiments tell from any thread
    const auto done = [&](double share) {
      const std::lock_guard lock(counting);
      for (const double now = before + share * experiment->seconds; static_cast<double>(shown + 1) <= now;
           ++shown)
        progress.advance();
    };
    Run run(scene, real, options.recordings, options.sizes, options.seed, write, done);
    if (!experiment->needs_distances || run.distances() != nullptr) experiment->run(run);
    done(1);
    before += experiment->seconds;
    cli::write_json(options.folder / (std::string(experiment->name) + ".json"), json);
  }
  make_page(options.folder);
}

}  // namespace bch::report
