// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/recording_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {

using namespace detail;

namespace {

constexpr std::size_t worst_events = 10;

const char* kind_of(const CheckedPair& pair) {
  return pair.is_wall ? "wall" : pair.passing ? "pass" : pair.overlap ? "overlap" : "near";
}

const char* kind_of(const OverlapEvent& event) {
  return event.is_wall ? "wall" : event.is_pass() ? "pass" : "overlap";
}

/// The deepest ones first; of equal ones as they are.
std::vector<OverlapEvent> worst_of(const CheckSummary& summary) {
  std::vector<OverlapEvent> worst;
  for (const OverlapEvent& event : summary.events) {
    const auto place = std::upper_bound(worst.begin(), worst.end(), event,
                                        [](const auto& a, const auto& b) { return a.depth > b.depth; });
    worst.insert(place, event);
    if (worst.size() > worst_events) worst.pop_back();
  }
  return worst;
}

/// The kinds of bodies that do not walk.
std::vector<std::string> other_bodies(const TrajectoryInfo& info) {
  std::vector<std::string> kinds;
  for (const NamedMotion& motion : info.motions)
    if (!motion.body.empty() && std::ranges::find(kinds, motion.body) == kinds.end())
      kinds.push_back(printable_line(motion.body));
  return kinds;
}

std::string poses_text(const CheckedRecording& recording) {
  if (recording.baked) return "those of the baked set";
  if (recording.spheres > 0) return "at each person's phase, in the walk of the nearest speed";
  return fmt::format(
      "within {} cm of each person's {}", recording.info.rows < coarse_from ? 1 : 3,
      recording.characters == 0 ? "speed and phase" : "phase, in the walk of the nearest speed");
}

std::string facts(const CheckedRecording& recording, const CheckSummary& summary) {
  const double fps = recording.info.fps;
  const double seconds = static_cast<double>(summary.last_frame - summary.first_frame) / fps;
  std::string text =
      fact("recording",
           fmt::format("{}: {}, {:g} frames a second", recording.file, recording.info.format, fps)) +
      fact("people", fmt::format("{} in {} ({:.1f} s), {} person-frames", grouped(summary.people),
                                 counted(summary.frames, "frame"), seconds, grouped(summary.all.people))) +
      fact("bodies", recording.spheres > 0 ? bodies_text(recording)
                                           : fmt::format("{}, {}", bodies_text(recording),
                                                         counted(summary.poses.size(), "pose"))) +
      fact("poses", poses_text(recording)) +
      fact("headings", fmt::format("{:.1f} % guessed: people who stand keep the last one",
                                   percent(summary.guessed, summary.all.people)));
  const std::vector<std::string> others = other_bodies(recording.info);
  if (!others.empty()) text += fact("others", fmt::format("{}, as rows name them", fmt::join(others, ", ")));
  for (const std::string& assumption : recording.info.assumptions) text += fact("assumed", assumption);
  return text;
}

std::string count_line(const std::string& name, const OverlapCount& count) {
  std::string text = fmt::format("{:>9} {:>13} {:>10}", name, grouped(count.people),
                                 percent_text(count.overlapping, count.people));
  for (const std::uint64_t disc : count.discs)
    text += fmt::format(" {:>10}", percent_text(disc, count.people));
  return text + "\n";
}

std::string density_table(const CheckSummary& summary) {
  std::string text = fmt::format(
      "\nShare of person-frames in overlap, by people per square metre; beside it what discs would say:\n"
      "{:>9} {:>13} {:>10}",
      "density", "person-frames", "bodies");
  for (const double radius : compared_discs) text += fmt::format(" {:>10}", fmt::format("{:.2f} m", radius));
  text += "\n";
  for (std::size_t k = 0; k < density_classes.size(); ++k)
    if (summary.by_density[k].people > 0) text += count_line(density_name(k, "-"), summary.by_density[k]);
  return text + count_line("all", summary.all);
}

std::string worst_table(const CheckSummary& summary, double fps) {
  if (summary.events.empty()) return "\nNobody overlaps anybody.\n";
  std::string text = fmt::format(
      "\n{}: {}. The deepest:\n"
      "{:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
      counted(summary.events.size(), "event"), events_text(summary), "first", "second", "from, s", "for, s",
      "depth, m", "x, m", "y, m");
  for (const OverlapEvent& event : worst_of(summary)) {
    const std::string second =
        event.is_wall ? fmt::format("wall {}", event.second) : fmt::format("{}", event.second);
    const double from = event.is_pass() ? event.worst : static_cast<double>(event.from);
    text += fmt::format("{:>10} {:>10} {:>9.2f} ", event.first, second, from / fps);
    text += event.is_pass() ? fmt::format("{:>9} {:>9}", "pass", "-")
                            : fmt::format("{:>9.2f} {:>9.3f}",
                                          static_cast<double>(event.to - event.from + 1) / fps, event.depth);
    text += fmt::format(" {:>9.2f} {:>9.2f}\n", event.x, event.y);
  }
  return text;
}

nlohmann::ordered_json json_of(const OverlapCount& count) {
  nlohmann::ordered_json discs;
  for (std::size_t k = 0; k < compared_discs.size(); ++k)
    discs.push_back({{"radius", compared_discs[k]},
                     {"overlapping", count.discs[k]},
                     {"pairs_within_1.2_m", count.disc_pairs[k]}});
  return {{"person_frames", count.people},
          {"overlapping", count.overlapping},
          {"in_walls", count.in_walls},
          {"pairs_within_1.2_m", count.near_pairs},
          {"overlapping_pairs_within_1.2_m", count.overlapping_pairs},
          {"discs", discs}};
}

/// All but the events.
nlohmann::ordered_json json_of(const CheckedRecording& recording, const CheckSummary& summary,
                               bool has_measures, const TruthCollisions* truth) {
  nlohmann::ordered_json densities;
  for (std::size_t k = 0; k < density_classes.size(); ++k) {
    nlohmann::ordered_json of = json_of(summary.by_density[k]);
    of["from_people_per_m2"] = density_classes[k];
    densities.push_back(of);
  }
  std::vector<std::string> notes = recording.info.notes;
  notes.insert(notes.end(), summary.notes.begin(), summary.notes.end());
  nlohmann::ordered_json json{{"file", recording.file},
                              {"format", recording.info.format},
                              {"fps", recording.info.fps},
                              {"assumptions", recording.info.assumptions},
                              {"notes", notes}};
  if (recording.spheres > 0) {
    json["spheres"] = recording.spheres;
  } else {
    json["depth"] = depth_name(recording.depth);
    json["leaves"] = recording.leaves == Leaves::segments ? "segments" : "discs";
  }
  if (const auto others = other_bodies(recording.info); !others.empty()) json["other_bodies"] = others;
  json.update({{"characters", recording.characters},
               {"people", summary.people},
               {"frames", summary.frames},
               {"first_frame", summary.first_frame},
               {"last_frame", summary.last_frame},
               {"guessed_headings", summary.guessed},
               {"overlap_events", summary.overlap_events},
               {"pass_events", summary.passings},
               {"wall_events", summary.wall_events},
               {"all", json_of(summary.all)},
               {"by_density", densities}});
  if (has_measures)
    json.update({{"colliding_people", summary.colliding}, {"disc_colliding_people", summary.disc_colliding}});
  if (truth != nullptr)
    json.update({{"truth_frames", truth->frames()},
                 {"truth_colliding_people", truth->colliding()},
                 {"truth_disc_colliding_people", truth->disc_colliding()}});
  return json;
}

nlohmann::ordered_json json_of(const OverlapEvent& event) {
  nlohmann::ordered_json json{{"first", event.first},
                              {"second", event.second},
                              {"kind", kind_of(event)},
                              {"from_frame", event.from},
                              {"to_frame", event.to},
                              {"frames", event.frames},
                              {"worst_frame", event.worst_frame()},
                              {"depth", std::max(0.0f, event.depth)},
                              {"x", event.x},
                              {"y", event.y}};
  if (event.is_pass()) json["after"] = event.after();
  return json;
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Indents all lines of a text by two steps.
std::string indented(const std::string& text) {
  std::string lines = "    ";
  for (const char letter : text) {
    lines += letter;
    if (letter == '\n') lines += "    ";
  }
  return lines;
}

}  // namespace

std::vector<OutputOption> CheckOutputs::files() const {
  return {{"--events", events}, {"--frames", frames},     {"--pairs", pairs},
          {"--json", json},     {"--measures", measures}, {"--conflicts", conflicts}};
}

CheckTables::CheckTables(const CheckOutputs& outputs)
    : frames(outputs.frames, frame_columns),
      pairs(outputs.pairs, pair_columns),
      events(outputs.events, event_columns),
      measures(outputs.measures, measure_columns),
      conflicts(outputs.conflicts, conflict_columns),
      json(outputs.json) {}

void CheckTables::add(const CheckedFrame& frame) {
  if (frames) frames.add(frame_line(frame));
  if (measures) measures.add(measure_lines(frame));
  if (conflicts) conflicts.add(conflict_lines(frame));
  constexpr std::size_t at_once = 10'000;  // lines, because a frame may have millions
  CheckedFrame some = frame;
  for (std::size_t i = 0; pairs && i < frame.pairs.size(); i += at_once) {
    some.pairs = frame.pairs.subspan(i, std::min(at_once, frame.pairs.size() - i));
    pairs.add(pair_lines(some));
  }
}

void CheckTables::finish(const CheckedRecording& recording, const CheckSummary& summary,
                         const TruthCollisions* truth) {
  for (const OverlapEvent& event : summary.events)
    if (events) events.add(event_line(event, recording.info.fps));
  frames.commit(), pairs.commit(), events.commit(), measures.commit(), conflicts.commit();
  write_check_json(json, recording, summary, measures || conflicts, truth);
}

std::string frame_line(const CheckedFrame& frame) {
  std::size_t overlapping = 0, in_walls = 0, pairs = 0;
  double density = 0;
  for (const CheckedPerson& person : frame.people) {
    overlapping += person.overlaps, in_walls += person.in_wall;
    density += static_cast<double>(person.density);
  }
  for (const CheckedPair& pair : frame.pairs) pairs += pair.overlap && !pair.is_wall;
  return fmt::format("{},{:.4f},{},{:.3f},{},{},{}\n", frame.frame, frame.seconds, frame.people.size(),
                     frame.people.empty() ? 0 : density / static_cast<double>(frame.people.size()),
                     overlapping, pairs, in_walls);
}

std::string pair_lines(const CheckedFrame& frame) {
  std::string lines;
  for (const CheckedPair& pair : frame.pairs)
    lines += fmt::format("{},{:.4f},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", frame.frame, frame.seconds,
                         pair.first, pair.second, kind_of(pair), pair.depth, pair.gap, pair.x + 0.0f,
                         pair.y + 0.0f);
  return lines;
}

std::string event_line(const OverlapEvent& event, double fps) {
  return fmt::format("{},{},{},{:.4f},{:.4f},{},{:.4f},{:.4f},{:.3f},{:.3f}\n", event.first, event.second,
                     kind_of(event), static_cast<double>(event.from) / fps,
                     static_cast<double>(event.to) / fps, event.frames, event.worst / fps,
                     std::max(0.0f, event.depth), event.x, event.y);
}

double percent_in_overlap(const CheckSummary& summary) {
  return percent(summary.all.overlapping, summary.all.people);
}

std::string check_text(const CheckedRecording& recording, const CheckSummary& summary) {
  const double fps = recording.info.fps;
  std::string text = facts(recording, summary);
  text += fact("overlaps", fmt::format("{} of person-seconds; of neighbours within 1.2 m, {} of pairs",
                                       percent_text(summary.all.overlapping, summary.all.people),
                                       percent_text(summary.all.overlapping_pairs, summary.all.near_pairs)));
  if (recording.walls != nullptr)
    text +=
        fact("walls", percent_text(summary.all.in_walls, summary.all.people) + " of person-seconds in one");
  return text + density_table(summary) + worst_table(summary, fps);
}

void write_check_json(const std::string& file, const CheckedRecording& recording, const CheckSummary& summary,
                      bool has_measures, const TruthCollisions* truth) {
  if (file.empty()) return;
  // Without the brace at its end.
  std::string head = json_text(json_of(recording, summary, has_measures, truth));
  head.resize(head.size() - 2);
  StreamedFile json(file, head + ",\n  \"events\": [");
  for (const OverlapEvent& event : summary.events)
    json.add((&event == summary.events.data() ? "\n" : ",\n") + indented(json_text(json_of(event))));
  json.add(summary.events.empty() ? "]\n}\n" : "\n  ]\n}\n");
  json.commit();
}

void report(const CheckedRecording& recording, const CheckSummary& summary, const CheckOutputs& outputs,
            const TruthCollisions* truth) {
  std::string text = check_text(recording, summary);
  if (outputs.has_measures())
    text += fmt::format("\n{} of people collide at some time, as discs of {:g} m {}.\n",
                        percent_text(summary.colliding, summary.people), measured_disc,
                        percent_text(summary.disc_colliding, summary.people));
  if (truth != nullptr)
    text += fmt::format(
        "\n{} of people collide with others as these truly went, as discs of {:g} m {}, in {}.\n",
        percent_text(truth->colliding(), summary.people), measured_disc,
        percent_text(truth->disc_colliding(), summary.people), counted(truth->frames(), "common frame"));
  write_standard_output(text);
  if (percent_in_overlap(summary) > outputs.fail_above)
    throw CheckFailed(fmt::format("{}: {:.2f} % of person-seconds in overlap, more than {:g} %",
                                  recording.file, percent_in_overlap(summary), outputs.fail_above));
}

}  // namespace bch::cli
