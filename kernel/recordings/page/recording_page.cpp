// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/recording_page.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include <bch/obstacles.hpp>
#include <bch/version.hpp>

#include "kernel/obstacles/segment.hpp"
#include "layout/base/text.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

namespace {

/// The segments of walls, or none.
std::vector<std::vector<PagePoint>> lines_of(const ObstacleSet* walls) {
  std::vector<std::vector<PagePoint>> lines;
  for (std::uint32_t i = 0; walls != nullptr && i < walls->segment_count(); ++i) {
    const WorldSegment& segment = walls->view().segments[i];
    lines.push_back({{segment.ax, segment.ay}, {segment.bx, segment.by}});
  }
  return lines;
}

std::string version_text() {
  const Version version = library_version();
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.patch);
}

PageFacts facts_of(const CheckedRecording& recording) {
  PageFacts facts{std::filesystem::path(recording.file).filename().string(), recording.info.fps};
  facts.facts = {{"format", recording.info.format},
                 {"people", std::to_string(recording.info.people)},
                 {"bodies", bodies_text(recording)}};
  if (recording.spheres > 0)
    facts.facts.emplace_back("drawn", "outlines of the same people, in poses within a centimetre");
  for (const std::string& assumption : recording.info.assumptions)
    facts.facts.emplace_back("assumed", assumption);
  for (const std::string& note : recording.info.notes) facts.facts.emplace_back("note", note);
  if (!recording.options.empty()) facts.facts.emplace_back("options", recording.options);
  if (!recording.date.empty()) facts.facts.emplace_back("date", recording.date);
  facts.facts.emplace_back("checked by", "bch " + version_text());
  facts.walls = lines_of(recording.walls);
  return facts;
}

/// A disc as a contour, for a body that has no outline because it is one.
std::vector<Vec2> contour_of(const Disc& disc) {
  constexpr int corners = 48;
  std::vector<Vec2> contour;
  for (int k = 0; k < corners; ++k) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / corners;
    contour.push_back({disc.x + disc.radius * std::cos(angle), disc.y + disc.radius * std::sin(angle)});
  }
  return contour;
}

/// The outlines of a shape. A set of depth 0 has none.
std::vector<std::vector<Vec2>> contours_of(const ShapeSetView& view, std::uint32_t shape) {
  std::vector<std::vector<Vec2>> contours;
  if (view.shape_contours == nullptr) return contours;
  for (std::uint32_t i = view.shape_contours[shape].begin; i < view.shape_contours[shape].end; ++i)
    contours.emplace_back(view.points + view.contours[i].begin, view.points + view.contours[i].end);
  return contours;
}

std::vector<std::string> density_row(const std::string& name, const OverlapCount& count) {
  constexpr std::size_t usual = 1;  // of compared_discs
  return {name, grouped(count.people), percent_text(count.overlapping, count.people),
          percent_text(count.discs[usual], count.people)};
}

PageResults results_of(const CheckedRecording& recording, const CheckSummary& summary) {
  PageResults results;
  const OverlapCount& all = summary.all;
  results.facts = {{"overlaps", percent_text(all.overlapping, all.people) + " of person-seconds"},
                   {"neighbours", percent_text(all.overlapping_pairs, all.near_pairs) +
                                      " of the pairs within 1.2 m overlap"}};
  if (recording.walls != nullptr)
    results.facts.emplace_back("walls", percent_text(all.in_walls, all.people) + " of person-seconds in one");
  results.facts.emplace_back("events", events_text(summary));
  results.facts.emplace_back("headings", percent_text(summary.guessed, all.people) + " guessed");
  for (const std::string& note : summary.notes) results.facts.emplace_back("note", note);
  results.table.push_back({"people/m²", "person-frames", "overlap", "disc 0.25 m"});
  for (std::size_t k = 0; k < density_classes.size(); ++k)
    if (summary.by_density[k].people > 0)
      results.table.push_back(density_row(density_name(k, "–"), summary.by_density[k]));
  results.table.push_back(density_row("all", all));
  return results;
}

/// What somebody's row says of his body.
std::string name_of(const Walker& walker, const TrajectoryInfo& info) {
  if (walker.motion == TrackedPerson::no_motion || info.motions[walker.motion].body.empty())
    return "pedestrian";
  const NamedMotion& motion = info.motions[walker.motion];
  if (motion.length == 0 && motion.width == 0) return motion.body;
  const std::string length = number_text(motion.length) + " m", width = number_text(motion.width) + " m";
  return motion.body + ", " +
         (motion.width == 0    ? length + " long"
          : motion.length == 0 ? width + " wide"
                               : length + " by " + width);
}

}  // namespace

RecordingPage::RecordingPage(const CheckedRecording& recording)
    : recording_(recording),
      page_(facts_of(recording), [this](std::uint32_t number) { return shape(number); }) {}

/// The page asks for the shape of a person that is being added.
PageShape RecordingPage::shape(std::uint32_t pose) const {
  const std::uint32_t number = pose - first_pose_;
  const auto person = std::ranges::find(frame_->people, pose, &CheckedPerson::pose);
  PageShape shape{name_of(person->walker, recording_.info), contours_of(shapes_->view(), number)};
  if (shapes_->depths().back() == all_depths) return shape;
  shape.discs = shapes_->discs(number, shapes_->level_count() - 1);
  if (shape.contours.empty())
    for (const Disc& disc : shape.discs) shape.contours.push_back(contour_of(disc));
  return shape;
}

void RecordingPage::add(const CheckedFrame& frame, const ShapeSet& shapes) {
  frame_ = &frame;
  shapes_ = &shapes;
  if (!frame.people.empty()) first_pose_ = frame.people[0].pose - frame.people[0].shape;
  page_.add_frame(frame);
}

std::string RecordingPage::finish(const CheckSummary& summary) && {
  return std::move(page_).finish(summary.events, results_of(recording_, summary));
}

}  // namespace bch::detail
