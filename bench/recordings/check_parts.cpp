// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/recording_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"

namespace bch::cli {

using namespace detail;

namespace {

using Json = nlohmann::ordered_json;

Json kept(const OverlapCount& count) {
  return {count.people, count.guessed,    count.overlapping,       count.in_walls,
          count.discs,  count.near_pairs, count.overlapping_pairs, count.disc_pairs};
}

/// Reads a whole number. The library would make one of 1.5 and of 1e308.
template <class Whole>
void take(const Json& json, Whole& whole) {
  const bool fits = json.is_number_unsigned()
                        ? std::in_range<Whole>(json.get<std::uint64_t>())
                        : json.is_number_integer() && std::in_range<Whole>(json.get<std::int64_t>());
  if (!fits) throw std::invalid_argument("no whole number");
  json.get_to(whole);
}

OverlapCount count_of(const Json& json) {
  OverlapCount count;
  take(json.at(0), count.people), take(json.at(1), count.guessed);
  take(json.at(2), count.overlapping), take(json.at(3), count.in_walls);
  take(json.at(5), count.near_pairs), take(json.at(6), count.overlapping_pairs);
  for (std::size_t k = 0; k < count.discs.size(); ++k) {
    take(json.at(4).at(k), count.discs[k]);
    take(json.at(7).at(k), count.disc_pairs[k]);
  }
  return count;
}

/// Calls each() for every member of an event, in the order of a part's line.
template <class Event, class Each>
void for_each_member(Event& event, Each each) {
  each(event.first), each(event.second), each(event.is_wall), each(event.from), each(event.to);
  each(event.worst), each(event.frames), each(event.depth), each(event.x), each(event.y);
}

/// A line with an event's numbers, as exact as they are.
std::string kept_line(const OverlapEvent& event) {
  std::string line;
  for_each_member(event, [&](auto member) { line += fmt::format("{},", +member); });
  line.back() = '\n';
  return line;
}

OverlapEvent event_of(std::string_view line) {
  OverlapEvent event{};
  for_each_member(event, [&](auto& member) {
    auto number = +member;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc()) throw std::invalid_argument("no number");
    line.remove_prefix(std::min(line.size(), static_cast<std::size_t>(stop - line.data()) + 1));
    member = static_cast<std::remove_reference_t<decltype(member)>>(number);
  });
  return event;
}

/// All numbers of a summary but for the events, which are many.
Json kept(const CheckSummary& summary) {
  Json densities = Json::array();
  for (const OverlapCount& count : summary.by_density) densities.push_back(kept(count));
  return {{"frames", summary.frames},
          {"people", summary.people},
          {"guessed", summary.guessed},
          {"passings", summary.passings},
          {"first_frame", summary.first_frame},
          {"last_frame", summary.last_frame},
          {"all", kept(summary.all)},
          {"by_density", densities},
          {"poses", summary.poses}};
}

CheckSummary summary_of(const Json& json) {
  CheckSummary summary;
  take(json.at("frames"), summary.frames), take(json.at("people"), summary.people);
  take(json.at("guessed"), summary.guessed), take(json.at("passings"), summary.passings);
  take(json.at("first_frame"), summary.first_frame), take(json.at("last_frame"), summary.last_frame);
  summary.all = count_of(json.at("all"));
  for (std::size_t k = 0; k < summary.by_density.size(); ++k)
    summary.by_density[k] = count_of(json.at("by_density").at(k));
  for (const Json& pose : json.at("poses")) {
    std::uint64_t key = 0;
    take(pose, key);
    summary.poses.insert(key);
  }
  return summary;
}

Json kept(const CheckedRecording& recording) {
  return {{"file", recording.file},
          {"format", recording.info.format},
          {"fps", recording.info.fps},
          {"assumptions", recording.info.assumptions},
          {"rows", recording.info.rows},
          {"spheres", recording.spheres},
          {"depth", recording.depth},
          {"leaves", recording.leaves},
          {"characters", recording.characters},
          {"baked", recording.baked},
          {"walls", recording.walls}};
}

CheckedRecording recording_of(const Json& json) {
  CheckedRecording recording{};
  int leaves = 0;
  take(json.at("spheres"), recording.spheres), take(json.at("depth"), recording.depth);
  take(json.at("leaves"), leaves), take(json.at("characters"), recording.characters);
  recording.leaves = static_cast<Leaves>(leaves);
  take(json.at("rows"), recording.info.rows);
  json.at("file").get_to(recording.file), json.at("format").get_to(recording.info.format);
  json.at("baked").get_to(recording.baked), json.at("walls").get_to(recording.walls);
  json.at("fps").get_to(recording.info.fps), json.at("assumptions").get_to(recording.info.assumptions);
  return recording;
}

FrameInterval frames_of(const Part& part, const TrajectoryInfo& info) {
  const std::uint64_t frames =
      info.rows == 0 ? 0 : static_cast<std::uint64_t>(info.last_frame - info.first_frame) + 1;
  const auto [from, to] = part.share_of(frames);
  return {info.first_frame + static_cast<std::int64_t>(from),
          info.first_frame + static_cast<std::int64_t>(to)};
}

std::vector<OverlapEvent> read_events(const PartFiles& part) {
  std::vector<OverlapEvent> events;
  std::ifstream stream(part.file(events_kind), std::ios::binary);
  for (std::string line; std::getline(stream, line);) events.push_back(event_of(line));
  return events;
}

struct KeptPart {
  CheckedRecording recording;
  CheckSummary summary;
};

KeptPart read_kept(const PartFiles& part) {
  std::string file = part.file(summary_kind);
  try {
    const Json kept = read_part_json(file);
    KeptPart read{recording_of(kept.at("recording")), summary_of(kept.at("summary"))};
    file = part.file(events_kind);
    read.summary.events = read_events(part);
    return read;
  } catch (const Json::exception&) {
    throw InputError(file + ": is damaged");
  } catch (const std::invalid_argument&) {
    throw InputError(file + ": is damaged");
  }
}

/// Calls take() with a file's bytes, piece by piece.
template <class Take>
void for_each_piece(const std::string& file, Take take) {
  std::ifstream stream(file, std::ios::binary);
  std::string piece(std::size_t{1} << 20, '\0');
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())) || stream.gcount() > 0)
    take(piece.substr(0, static_cast<std::size_t>(stream.gcount())));
  if (stream.bad()) throw InputError(file + ": cannot be read");
}

void add_rows(StreamedFile& table, const PartFiles& part, const char* kind) {
  if (table) for_each_piece(part.file(kind), [&](const std::string& rows) { table.add(rows); });
}

}  // namespace

std::string check_part(const CheckInput& input, const PartFiles& files, const Json& run) {
  const std::string name = files.part().name();
  if (files.is_done(run)) return files.done_line();
  files.prepare("check", input.files());
  OpenedCheck opened(input);
  CheckOptions how = opened.options(input);
  how.draws = false;
  how.frames = frames_of(files.part(), opened.recording.info);
  files.begin();
  StreamedFile frames(files.file(frames_kind)), pairs(files.file(pairs_kind)),
      events(files.file(events_kind));
  const CheckSummary summary = opened.check(how, [&](const CheckedFrame& frame, const ShapeSet&) {
    frames.add(frame_line(frame));
    pairs.add(pair_lines(frame));
  });
  for (const OverlapEvent& event : summary.events) events.add(kept_line(event));
  const Json told{{"recording", kept(opened.recording)}, {"summary", kept(summary)}};
  StreamedFile rest(files.file(summary_kind));
  rest.add(told.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  Json identities = Json::array();
  for (StreamedFile* const file : {&frames, &pairs, &events, &rest}) {
    file->commit();
    identities.push_back(identity_of(*file));
  }
  files.finish(run, {{"from_frame", how.frames.from}, {"to_frame", how.frames.to - 1}}, identities);
  return fmt::format("{}: frames {} to {}, {}\n", name, how.frames.from, how.frames.to - 1, files.manifest());
}

void merge_check(const WholeRun& whole, const CheckOutputs& outputs) {
  std::vector<CheckSummary> summaries;
  std::optional<CheckedRecording> recording;
  for (const PartFiles& part : whole.parts) {
    KeptPart kept = read_kept(part);
    summaries.push_back(std::move(kept.summary));
    if (!recording) recording = std::move(kept.recording);
  }
  CheckTables tables(outputs);
  for (const PartFiles& part : whole.parts) {
    add_rows(tables.frames, part, frames_kind);
    add_rows(tables.pairs, part, pairs_kind);
  }
  const CheckSummary summary = join(summaries);
  tables.finish(*recording, summary);
  report(*recording, summary, outputs);
}

}  // namespace bch::cli
