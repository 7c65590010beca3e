// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/check_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"

namespace bch::cli {

using namespace detail;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char *frames_kind = "frames.csv", *pairs_kind = "pairs.csv", *events_kind = "events.csv",
                     *summary_kind = "summary.json";

Json kept(const OverlapCount& count) {
  return {count.people, count.guessed,    count.overlapping,       count.in_walls,
          count.discs,  count.near_pairs, count.overlapping_pairs, count.disc_pairs};
}

OverlapCount count_of(const Json& json) {
  OverlapCount count;
  json.at(0).get_to(count.people), json.at(1).get_to(count.guessed);
  json.at(2).get_to(count.overlapping), json.at(3).get_to(count.in_walls);
  json.at(4).get_to(count.discs);
  json.at(5).get_to(count.near_pairs), json.at(6).get_to(count.overlapping_pairs);
  json.at(7).get_to(count.disc_pairs);
  return count;
}

/// A line with an event's numbers, as exact as they are.
std::string kept_line(const OverlapEvent& event) {
  return fmt::format("{},{},{:d},{},{},{},{},{},{},{}\n", event.first, event.second, event.is_wall,
                     event.from, event.to, event.worst, event.frames, event.depth, event.x, event.y);
}

/// Reads the numbers of a line.
class LineNumbers {
 public:
  explicit LineNumbers(std::string_view line) : left_(line) {}

  template <class Number>
  void next(Number& number) {
    const auto [stop, error] = std::from_chars(left_.data(), left_.data() + left_.size(), number);
    if (error != std::errc()) throw std::invalid_argument("no number");
    left_.remove_prefix(std::min(left_.size(), static_cast<std::size_t>(stop - left_.data()) + 1));
  }

 private:
  std::string_view left_;
};

OverlapEvent event_of(const std::string& line) {
  LineNumbers numbers(line);
  OverlapEvent event{};
  int is_wall = 0;
  numbers.next(event.first), numbers.next(event.second), numbers.next(is_wall);
  numbers.next(event.from), numbers.next(event.to), numbers.next(event.worst);
  numbers.next(event.frames), numbers.next(event.depth), numbers.next(event.x), numbers.next(event.y);
  event.is_wall = is_wall != 0;
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
  json.at("frames").get_to(summary.frames), json.at("people").get_to(summary.people);
  json.at("guessed").get_to(summary.guessed), json.at("passings").get_to(summary.passings);
  json.at("first_frame").get_to(summary.first_frame), json.at("last_frame").get_to(summary.last_frame);
  summary.all = count_of(json.at("all"));
  for (std::size_t k = 0; k < summary.by_density.size(); ++k)
    summary.by_density[k] = count_of(json.at("by_density").at(k));
  json.at("poses").get_to(summary.poses);
  return summary;
}

Json kept(const CheckedRecording& recording) {
  return {{"file", recording.file},
          {"format", recording.info.format},
          {"fps", recording.info.fps},
          {"assumptions", recording.info.assumptions},
          {"rows", recording.info.rows},
          {"slabs", recording.slabs},
          {"depth", recording.depth},
          {"leaves", recording.leaves},
          {"characters", recording.characters},
          {"baked", recording.baked},
          {"walls", recording.walls}};
}

CheckedRecording recording_of(const Json& json) {
  CheckedRecording recording{json.at("file"),
                             {},
                             json.at("slabs"),
                             json.at("depth"),
                             json.at("leaves"),
                             json.at("characters"),
                             json.at("baked"),
                             json.at("walls"),
                             {}};
  json.at("format").get_to(recording.info.format), json.at("fps").get_to(recording.info.fps);
  json.at("assumptions").get_to(recording.info.assumptions), json.at("rows").get_to(recording.info.rows);
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
  const std::string file = part.file(summary_kind);
  try {
    std::ifstream stream(file, std::ios::binary);
    const Json kept = Json::parse(stream);
    KeptPart read{recording_of(kept.at("recording")), summary_of(kept.at("summary"))};
    read.summary.events = read_events(part);
    return read;
  } catch (const Json::exception&) {
    throw InputError(file + ": is damaged");
  } catch (const std::invalid_argument&) {
    throw InputError(part.file(events_kind) + ": is damaged");
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

void add_rows(StreamedTable& table, const PartFiles& part, const char* kind) {
  if (table) for_each_piece(part.file(kind), [&](const std::string& rows) { table.add(rows); });
}

}  // namespace

std::string check_part(const CheckInput& input, const PartFiles& files, const Json& run) {
  const std::string name = files.part().name();
  if (files.is_done(run)) return files.done_line();
  const OpenedCheck opened(input);
  CheckOptions how = opened.options(input);
  how.frames = frames_of(files.part(), opened.recording.info);
  files.begin();
  StreamedTable frames(files.file(frames_kind), ""), pairs(files.file(pairs_kind), ""),
      events(files.file(events_kind), "");
  const CheckSummary summary = check(*opened.reader, how, [&](const CheckedFrame& frame, const ShapeSet&) {
    frames.add(frame_line(frame));
    pairs.add(pair_lines(frame));
  });
  for (const OverlapEvent& event : summary.events) events.add(kept_line(event));
  frames.commit(), pairs.commit(), events.commit();
  write_json(files.file(summary_kind), {{"recording", kept(opened.recording)}, {"summary", kept(summary)}});
  files.finish(run, {{"from_frame", how.frames.from}, {"to_frame", how.frames.to - 1}},
               {frames_kind, pairs_kind, events_kind, summary_kind});
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
  tell(*recording, summary, outputs);
}

}  // namespace bch::cli
