// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/base/disc_union_area.hpp"
#include "bench/base/svg.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/cli/inspection.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::cli {
namespace {

using Json = nlohmann::ordered_json;

std::size_t leaves(const Shape& shape) {
  return (shape.hierarchy.nodes.size() + 1) / 2;
}

float root_radius(const Shape& shape) {
  return shape.hierarchy.nodes.front().disc.radius;
}

double clip_seconds(const ImportReport& report) {
  double seconds = 0;
  for (const ImportReport::Clip& clip : report.clips) seconds += static_cast<double>(clip.seconds);
  return seconds;
}

std::string shown_clip(const LoadedCharacter& character, PoseTime at) {
  return printable_line(clip_name(character, at));
}

Json seconds_json(PoseTime at) {
  return at.clip == PoseTime::rest ? Json(nullptr) : Json(shortest(at.seconds));
}

Json row_json(const LoadedCharacter& character, PoseTime at, const Shape& shape) {
  return {{"clip", at.clip == PoseTime::rest ? Json(nullptr) : Json(clip_name(character, at))},
          {"seconds", seconds_json(at)},
          {"root_radius_m", shortest(root_radius(shape))},
          {"nodes", shape.hierarchy.nodes.size()},
          {"leaves", leaves(shape)}};
}

Json contours_json(const Outline& outline) {
  Json contours = Json::array();
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    Json& points = contours.emplace_back(Json::array());
    for (const Vec2 point : outline.contour(c)) points.push_back({shortest(point.x), shortest(point.y)});
  }
  return contours;
}

}  // namespace

ShapeFacts examine(const Shape& shape, const PoseId& source, std::optional<std::uint32_t> index) {
  ShapeFacts facts{index, source, shape, area(shape.outline), {}};
  const std::uint32_t deepest = detail::height(shape.hierarchy);
  for (std::uint32_t depth = 0; depth <= deepest; ++depth) {
    const std::vector<Disc> discs = discs_of(shape.hierarchy, depth);
    double radii = 0;
    for (const Disc& disc : discs) radii += static_cast<double>(disc.radius);
    facts.depths.push_back(
        {depth, discs.size(), radii / static_cast<double>(discs.size()), union_area(discs)});
  }
  return facts;
}

std::string pose_title(const LoadedCharacter& character, PoseTime at) {
  return at.clip == PoseTime::rest ? "rest pose"
                                   : fmt::format("{} at {:.2f} s", shown_clip(character, at), at.seconds);
}

std::string shape_title(const LoadedCharacter& character, const ShapeFacts& facts) {
  const std::string pose = pose_title(character, facts.source.at);
  return facts.index ? fmt::format("shape {}: {}", *facts.index, pose) : pose;
}

std::string text_of(const LoadedCharacter& character) {
  const ImportReport& report = character.report;
  std::string out = printable_line(character.source) + "\n";
  out += fact("  format", report.format);
  out += fact("  mesh", fmt::format("{}, {} vertices, {}", counted(report.triangles, "triangle"),
                                    grouped(report.vertices),
                                    report.meshes == 1 ? "1 mesh" : fmt::format("{} meshes", report.meshes)));
  if (report.dropped_faces + report.dropped_vertices > 0)
    out += fact("  dropped",
                fmt::format("{} and {} that no triangle uses", counted(report.dropped_faces, "face"),
                            report.dropped_vertices == 1 ? std::string("1 vertex")
                                                         : grouped(report.dropped_vertices) + " vertices"));
  out += fact("  height", fmt::format("{:.3f} m at rest", report.height));
  out += fact("  skeleton", counted(report.bones, "bone"));
  out += fact("  clips", report.clips.empty() ? std::string("none")
                                              : fmt::format("{}, {:.2f} s together", report.clips.size(),
                                                            clip_seconds(report)));
  for (const ImportReport::Clip& clip : report.clips)
    out +=
        fmt::format("  {:<10}{:>8.2f} s  {}{}\n", "", clip.seconds, printable_line(clip.name),
                    clip.channels == clip.channels_in_file
                        ? ""
                        : fmt::format(" ({} of {} channels move it)", clip.channels, clip.channels_in_file));
  for (const std::string& note : report.notes) out += fact("  note", note);
  return out;
}

std::string text_of(const LoadedCharacter& character, const ShapeTable& table) {
  std::size_t widest = 9;  // "rest pose"
  for (const Clip& clip : character.character.clips)
    widest = std::max(widest, printable_line(clip.name).size());
  std::string out = fmt::format("\n{:>6}  {:<{}}  {:>9}  {:>8}  {:>6}  {:>6}\n", "shape", "clip", widest,
                                "time", "radius", "nodes", "leaves");
  for (std::size_t i = 0; i < table.sources.size(); ++i) {
    const PoseTime at = table.sources[i].at;
    const Shape& shape = table.shapes[i];
    out += fmt::format("{:>6}  {:<{}}  {:>7.2f} s  {:>6.3f} m  {:>6}  {:>6}\n", i, shown_clip(character, at),
                       widest, at.seconds, root_radius(shape), shape.hierarchy.nodes.size(), leaves(shape));
  }
  return out;
}

std::string text_of(const LoadedCharacter& character, const ShapeFacts& facts) {
  const Outline& outline = facts.shape.outline;
  std::string out = fmt::format(
      "\n{}\n  outline   {}, {}, {:.4f} m2\n  hierarchy {}, {}\n\n", shape_title(character, facts),
      counted(outline.contours(), "contour"), counted(outline.points.size(), "point"), facts.outline_area,
      counted(facts.shape.hierarchy.nodes.size(), "node"),
      leaves(facts.shape) == 1 ? std::string("1 leaf") : grouped(leaves(facts.shape)) + " leaves");
  out += fmt::format("{:>6}  {:>6}  {:>11}  {:>9}  {:>10}\n", "depth", "discs", "mean radius", "area",
                     "of outline");
  for (const DepthFacts& depth : facts.depths)
    out += fmt::format("{:>6}  {:>6}  {:>9.4f} m  {:>6.3f} m2  {:>10}\n", depth.depth, depth.discs,
                       depth.mean_radius, depth.area,
                       facts.outline_area > 0 ? fmt::format("{:.2f}", depth.area / facts.outline_area) : "-");
  return out +
         "\nAreas are exact, of the discs by the arcs of their union. Deep discs follow the outline and "
         "leave its inside "
         "empty.\n";
}

Json json_of(const LoadedCharacter& character) {
  const ImportReport& report = character.report;
  Json clips = Json::array();
  for (const ImportReport::Clip& clip : report.clips)
    clips.push_back({{"name", clip.name},
                     {"seconds", shortest(clip.seconds)},
                     {"channels", clip.channels},
                     {"channels_in_file", clip.channels_in_file}});
  return {{"source", character.source},
          {"format", report.format},
          {"meshes", report.meshes},
          {"vertices", report.vertices},
          {"triangles", report.triangles},
          {"dropped_faces", report.dropped_faces},
          {"dropped_vertices", report.dropped_vertices},
          {"height_m", shortest(report.height)},
          {"bones", report.bones},
          {"clips", clips},
          {"clip_seconds", clip_seconds(report)},
          {"notes", report.notes}};
}

Json json_of(const LoadedCharacter& character, const ShapeTable& table) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < table.sources.size(); ++i) {
    Json row{{"shape", i}};
    row.update(row_json(character, table.sources[i].at, table.shapes[i]));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json json_of(const LoadedCharacter& character, const ShapeFacts& facts) {
  Json json{{"shape", facts.index ? Json(*facts.index) : Json(nullptr)}};
  json.update(row_json(character, facts.source.at, facts.shape));
  json["outline"] = {{"area_m2", facts.outline_area},
                     {"grid_step_m", facts.shape.outline.grid_step},
                     {"contours", contours_json(facts.shape.outline)}};
  for (const DepthFacts& depth : facts.depths)
    json["depths"].push_back({{"depth", depth.depth},
                              {"discs", depth.discs},
                              {"mean_radius_m", depth.mean_radius},
                              {"area_m2", depth.area}});
  return json;
}

std::vector<bool> BodyFacts::are_core() const {
  std::vector<bool> are(spheres.size());
  for (const std::uint32_t sphere : model.core) are[sphere] = true;
  return are;
}

BodyFacts examine(const BodyModel& model, const PoseId& source) {
  const BodySet set = posed_bodies({&model, 1}, {&source, 1});
  return {source, model, set.spheres(0), set.heights(0), set.bytes()};
}

std::string text_of(const LoadedCharacter& character, const BodyFacts& facts) {
  const auto [least, most] = std::ranges::minmax(facts.spheres, {}, &Sphere::radius);
  return fmt::format("\n{}\n", pose_title(character, facts.source.at)) +
         fact("  spheres", fmt::format("{}, radii of {:.1f} to {:.1f} mm", grouped(facts.spheres.size()),
                                       1e3 * double{least.radius}, 1e3 * double{most.radius})) +
         fact("  heights", fmt::format("{:.3f} to {:.3f} m", facts.heights.bottom, facts.heights.top)) +
         fact("  memory", fmt::format("{:.1f} kB", static_cast<double>(facts.bytes) / 1e3)) +
         fact("  model", fmt::format("{} to bones, {} of the skin, of which cuts made {}",
                                     counted(facts.model.influences.size(), "binding"),
                                     counted(facts.model.corners.size(), "corner"),
                                     grouped(facts.model.midpoints.size())));
}

nlohmann::ordered_json json_of(const LoadedCharacter& character, const BodyFacts& facts) {
  nlohmann::ordered_json json{{"pose", pose_title(character, facts.source.at)},
                              {"bytes", facts.bytes},
                              {"bottom_m", shortest(facts.heights.bottom)},
                              {"top_m", shortest(facts.heights.top)},
                              {"core", facts.model.core}};
  for (const Sphere& s : facts.spheres)
    json["spheres_xyz_radius_m"].push_back({shortest(s.x), shortest(s.y), shortest(s.z), shortest(s.radius)});
  return json;
}

}  // namespace bch::cli
