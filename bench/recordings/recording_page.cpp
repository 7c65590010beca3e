// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/recording_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include <bch/obstacles.hpp>

#include "kernel/obstacles/segment.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::cli {

using namespace detail;

namespace {

/// The segments of the floor's borders.
std::vector<std::vector<PagePoint>> lines_of(const std::string& floor) {
  std::vector<std::vector<PagePoint>> lines;
  if (floor.empty()) return lines;
  const ObstacleSet walls = obstacles_from_wkt(floor, Polygons::walkable);
  for (std::uint32_t i = 0; i < walls.segment_count(); ++i) {
    const WorldSegment& segment = walls.view().segments[i];
    lines.push_back({{segment.ax, segment.ay}, {segment.bx, segment.by}});
  }
  return lines;
}

PageFacts facts_of(const CheckedRecording& recording) {
  PageFacts facts{std::filesystem::path(recording.file).filename().string(), recording.info.fps};
  facts.facts = {{"format", recording.info.format},
                 {"people", fmt::format("{}", recording.info.people)},
                 {"bodies", bodies_text(recording)}};
  if (recording.spheres > 0)
    facts.facts.emplace_back("drawn", "outlines of the same people, in poses within a centimetre");
  for (const std::string& assumption : recording.info.assumptions)
    facts.facts.emplace_back("assumed", assumption);
  facts.walls = lines_of(recording.floor);
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

}  // namespace

RecordingPage::RecordingPage(const CheckedRecording& recording)
    : page_(facts_of(recording), [this](std::uint32_t number) { return shape(number); }) {}

/// The page asks for the shape of a person that is being added.
PageShape RecordingPage::shape(std::uint32_t pose) const {
  const std::uint32_t number = pose - first_pose_;
  PageShape shape{"pedestrian", contours_of(shapes_->view(), number)};
  if (shapes_->depths().back() == all_depths) return shape;
  shape.discs = shapes_->discs(number, shapes_->level_count() - 1);
  if (shape.contours.empty())
    for (const Disc& disc : shape.discs) shape.contours.push_back(contour_of(disc));
  return shape;
}

void RecordingPage::add(const CheckedFrame& frame, const ShapeSet& shapes) {
  shapes_ = &shapes;
  if (!frame.people.empty()) first_pose_ = frame.people[0].pose - frame.people[0].shape;
  page_.add_frame(frame);
}

}  // namespace bch::cli
