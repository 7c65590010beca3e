// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int manifest_version = 1;
constexpr std::uint32_t max_parts = 1'000'000;
constexpr const char* manifest_ending = ".manifest.json";
/// Options that say who does the work and where it goes.
constexpr std::string_view without_answers[] = {"--part", "--into",      "--parts",  "--threads",
                                                "--isa",  "--events",    "--frames", "--pairs",
                                                "--json", "--fail-above"};
constexpr int deepest = 5;  ///< levels of nesting: a summary, its counts by density, each of these, its discs

/// Reads a number from 1 to max_parts, or 0 where it is none.
std::uint32_t part_number(std::string_view text) {
  std::uint32_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() && number <= max_parts ? number : 0;
}

/// A pipe may have nobody at its other end for ever, and a device no end.
void require_regular(const fs::path& file) {
  std::error_code none;
  if (fs::exists(file, none) && !fs::is_regular_file(file, none))
    throw InputError(file.string() + ": is not a regular file");
}

std::ifstream opened(const std::string& file) {
  require_regular(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file + ": cannot be read: " + std::strerror(errno));
  return stream;
}

Json identity_of(const std::string& name, const detail::baked::StreamChecksum& all) {
  return {{"file", name}, {"bytes", all.bytes}, {"xxh3", fmt::format("{:016x}", all.checksum)}};
}

Json identity_of_file(const std::string& file, const std::string& name) {
  std::ifstream stream = opened(file);
  const detail::baked::StreamChecksum all = detail::baked::checksum(stream);
  if (stream.bad()) throw InputError(file + ": cannot be read: " + std::strerror(errno));
  return identity_of(name, all);
}

Json read_manifest(const std::string& file) {
  Json manifest = read_part_json(file);
  if (!manifest.is_object() || manifest.value("bch_part", Json()) != manifest_version)
    throw InputError(file + ": is not the manifest of a part");
  return manifest;
}

/// Reads the number of a part, or of all; 0 where it is none. A conversion would round and wrap others.
std::uint32_t checked_number(const Json& number) {
  return number.is_number_unsigned() && number <= max_parts ? number.get<std::uint32_t>() : 0;
}

/// Checks that a part has the files of its command, with the bytes that its manifest says.
void require_whole(const PartFiles& part, const Json& manifest) {
  const std::string manifest_file = part.manifest(), command = manifest.at("run").at("command");
  const std::vector<std::string> kinds = kinds_of(command);
  const Json& files = manifest.at("files");
  if (kinds.empty()) throw InputError(manifest_file + ": '" + command + "' is not done in parts");
  if (!files.is_array() || files.size() != kinds.size())
    throw InputError(fmt::format("{}: has not the {} of a part of bch {}", manifest_file,
                                 counted(kinds.size(), "file"), command));
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const fs::path file = part.file(kinds[i]);
    const std::string name = files[i].at("file");
    if (name != file.filename())
      throw InputError(manifest_file + ": '" + name + "' is elsewhere, where " + file.filename().string() +
                       " is expected");
    if (identity_of_file(file.string(), name) != files[i])
      throw InputError(file.string() + ": is not what " + part.part().name() + " wrote");
  }
}

struct FoundPart {
  PartFiles files;
  Json manifest;
};

/// Reads a manifest and checks its part.
FoundPart find_part(const std::string& file) {
  const Json manifest = read_manifest(file);
  try {
    const Part part{checked_number(manifest.at("part")), checked_number(manifest.at("of"))};
    if (part.number == 0 || part.number > part.count)
      throw InputError(file + ": is damaged: 'part' and 'of' are not a part and its number of parts");
    const PartFiles files(fs::path(file).parent_path().string(), part);
    if (fs::path(files.manifest()).filename() != fs::path(file).filename())
      throw InputError(file + ": is " + part.name() + ", and has the name of another");
    require_whole(files, manifest);
    return {files, manifest};
  } catch (const Json::exception&) {
    throw InputError(file + ": is damaged");
  }
}

/// A folder's manifests take its place.
std::vector<std::string> manifests_of(const std::vector<std::string>& names) {
  std::vector<std::string> manifests;
  for (const std::string& name : names) {
    std::error_code none;
    if (!fs::is_directory(name, none)) {
      manifests.push_back(name);
      continue;
    }
    const std::size_t before = manifests.size();
    for (const fs::directory_entry& entry : fs::directory_iterator(name))
      if (entry.path().filename().string().ends_with(manifest_ending))
        manifests.push_back(entry.path().string());
    if (manifests.size() == before) throw InputError(name + ": has no parts");
  }
  std::sort(manifests.begin(), manifests.end());
  return manifests;
}

/// What differs between two runs, for people.
std::string difference(const Json& a, const Json& b) {
  for (const auto& [key, value] : a.items())
    if (b.value(key, Json()) != value)
      return fmt::format("{} {} there and {} here", key, value.dump(), b.value(key, Json()).dump());
  return "more is said of it";
}

}  // namespace

std::pair<std::uint64_t, std::uint64_t> Part::share_of(std::uint64_t items) const {
  const auto begin = [&](std::uint64_t k) { return items / count * k + items % count * k / count; };
  return {begin(number - 1), begin(number)};
}

std::string Part::name() const {
  return fmt::format("part {} of {}", number, count);
}

Part parse_part(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const Part part{part_number(text.substr(0, slash)),
                  slash == text.size() ? 0 : part_number(text.substr(slash + 1))};
  if (part.number == 0 || part.number > part.count)
    throw UsageError(fmt::format("--part: '{}' is not I/N, part I of N, such as 2/8", text));
  return part;
}

Json read_part_json(const std::string& file) {
  std::ifstream stream = opened(file);
  const auto is_flat = [&](int depth, Json::parse_event_t event, const Json&) {
    if ((event == Json::parse_event_t::array_start || event == Json::parse_event_t::object_start) &&
        depth >= deepest)
      throw InputError(fmt::format("{}: nests deeper than {} levels, as no part does", file, deepest));
    return true;
  };
  return Json::parse(stream, is_flat, false);
}

std::vector<std::string> kinds_of(const std::string& command) {
  if (command == "check") return {frames_kind, pairs_kind, events_kind, summary_kind};
  if (command == "query") return {answers_kind};
  return {};
}

Json identity_of(const StreamedFile& file) {
  return identity_of(fs::path(file.name()).filename().string(), file.checksum());
}

Json run_of(const CLI::App& command, const std::vector<std::string>& inputs) {
  Json options = Json::object(), files = Json::array();
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && std::ranges::count(without_answers, option->get_name()) == 0)
      options[option->get_name()] = option->results();
  for (const std::string& input : inputs)
    if (fs::is_regular_file(input)) files.push_back(identity_of_file(input, input));
  const Json run{
      {"command", command.get_name()}, {"version", BCH_VERSION}, {"options", options}, {"inputs", files}};
  try {
    static_cast<void>(run.dump());
  } catch (const Json::type_error&) {
    throw InputError("a file's name or an option is not UTF-8, as manifests of parts are");
  }
  return run;
}

void PartOptions::add_to(CLI::App& command) {
  const OptionAdder add(command);
  add("--part", part, "I/N", "Do only part I of N, such as 1/8; bch merge joins the parts");
  add("--into", folder, "DIR", "Folder for the files of --part; a complete part of the same run is skipped");
}

bool PartOptions::are_given() const {
  if (part.empty() && !folder.empty()) throw UsageError("--into: belongs to --part");
  if (!part.empty() && folder.empty()) throw UsageError("--part: needs --into, the folder of parts");
  return !part.empty();
}

PartFiles::PartFiles(std::string folder, Part part) : folder_(std::move(folder)), part_(part) {}

std::string PartFiles::file(const std::string& kind) const {
  return (fs::path(folder_) / fmt::format("part-{}-of-{}.{}", part_.number, part_.count, kind)).string();
}

bool PartFiles::is_done(const Json& run) const {
  if (!fs::exists(manifest())) return false;
  try {
    return find_part(manifest()).manifest.at("run") == run;
  } catch (const InputError&) {
    return false;
  }
}

std::string PartFiles::done_line() const {
  return fmt::format("{} is done already: {}\n", part_.name(), manifest());
}

void PartFiles::prepare(const std::string& command, const std::vector<std::string>& inputs) const {
  make_folder(folder_);
  std::vector<OutputOption> outputs{{"--into", manifest()}};
  for (const std::string& kind : kinds_of(command)) outputs.push_back({"--into", file(kind)});
  require_outputs(outputs, inputs);
  for (const std::string& kind : kinds_of(command)) require_regular(file(kind));
}

void PartFiles::begin() const {
  fs::remove(manifest());
}

void PartFiles::finish(const Json& run, const Json& share, const Json& files) const {
  write_json(manifest(), {{"bch_part", manifest_version},
                          {"part", part_.number},
                          {"of", part_.count},
                          {"share", share},
                          {"run", run},
                          {"files", files}});
}

WholeRun find_parts(const std::vector<std::string>& names) {
  std::vector<FoundPart> found;
  for (const std::string& file : manifests_of(names)) found.push_back(find_part(file));
  std::sort(found.begin(), found.end(), [](const FoundPart& a, const FoundPart& b) {
    return a.files.part().number < b.files.part().number;
  });
  WholeRun whole{found[0].manifest.at("run"), {}, {}};
  const std::string first = found[0].files.manifest();
  const std::uint32_t count = found[0].files.part().count;
  for (const auto& [files, manifest] : found) {
    const auto [number, of] = files.part();
    const std::uint32_t next = static_cast<std::uint32_t>(whole.parts.size()) + 1;
    if (of != count)
      throw InputError(fmt::format("{}: is one of {}, but {} one of {}", files.manifest(), of, first, count));
    if (manifest.at("run") != whole.run)
      throw InputError(fmt::format("{}: another run than {}: {}", files.manifest(), first,
                                   difference(whole.run, manifest.at("run"))));
    if (number < next)
      throw InputError(fmt::format("{}: {} is there twice", files.manifest(), files.part().name()));
    if (number > next)
      throw InputError(fmt::format("{} is missing, of the run of {}", Part{next, count}.name(), first));
    whole.parts.push_back(files);
    whole.files.push_back(files.manifest());
    for (const Json& file : manifest.at("files"))
      whole.files.push_back(
          (fs::path(files.manifest()).parent_path() / std::string(file.at("file"))).string());
  }
  if (whole.parts.size() < count)
    throw InputError(fmt::format("{} is missing, of the run of {}",
                                 Part{static_cast<std::uint32_t>(whole.parts.size()) + 1, count}.name(),
                                 first));
  return whole;
}

std::string joined_tables(const WholeRun& whole, const std::string& kind) {
  std::string all;
  for (const PartFiles& part : whole.parts) {
    std::ifstream stream(part.file(kind), std::ios::binary);
    const std::string table{std::istreambuf_iterator<char>(stream), {}};
    all += all.empty() ? table : table.substr(table.find('\n') + 1);
  }
  return all;
}

}  // namespace bch::cli
