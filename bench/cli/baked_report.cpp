// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/inspection.hpp"
#include "layout/format/shape_arrays.hpp"

namespace bch::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string clip_of(const ShapeOrigins& origins, std::uint32_t shape) {
  const std::uint32_t clip = origins.origins[shape].clip;
  return clip == ShapeOrigin::no_clip ? "rest pose" : origins.names[clip];
}

std::string depths_text(const ShapeSet& set) {
  std::string text;
  for (const std::uint32_t depth : set.depths()) text += (text.empty() ? "" : ", ") + depth_name(depth);
  return text;
}

/// "walk (30 shapes), run (12 shapes)".
std::string clips_text(const ShapeOrigins& origins, std::uint32_t character) {
  std::map<std::uint32_t, std::pair<std::string, std::size_t>> clips;
  for (std::uint32_t s = 0; s < origins.origins.size(); ++s) {
    if (origins.origins[s].character != character) continue;
    auto& [name, count] = clips[origins.origins[s].clip];
    if (count++ == 0) name = clip_of(origins, s);
  }
  std::string text;
  for (const auto& [clip, named] : clips)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", named.first, counted(named.second, "shape"));
  return text;
}

/// The radius of a shape's root disc.
float root_radius(const ShapeSet& set, std::uint32_t shape) {
  return set.arrays().roots[std::size_t{shape} * set.level_count()].radius;
}

}  // namespace

BakedShapes open_baked(const std::string& file) {
  try {
    return load_baked(file);
  } catch (const std::bad_alloc&) {
    throw InputError(file + ": loading it takes more memory than there is");
  }
}

BakedShapes load_baked_for(const std::string& file, const AnswerOptions& answer) {
  BakedShapes baked = open_baked(file);
  if (baked.set.shape_count() == 0)
    throw InputError(file + ": has no shapes; bake it with --poses or --rate");
  if (answer.leaves == "segments" && !baked.set.exact_leaves())
    throw InputError(file + ": has no leaves of segments; bake it with --depths all");
  return baked;
}

std::vector<BodyModel> models_of(const std::string& file, const BakedShapes& baked) {
  std::vector<BodyModel> models;
  for (const BakedBody& body : baked.bodies) try {
      models.push_back(body_model(body));
    } catch (const std::invalid_argument& error) {
      throw InputError(fmt::format("{}: body {}: {}", file, models.size(), error.what()));
    }
  return models;
}

std::string clip_name(const ShapeOrigins& origins, const BakedClip& clip) {
  return clip.clip == ShapeOrigin::no_clip ? std::string() : origins.names[clip.clip];
}

std::string text_of(const std::string& file, const BakedShapes& baked) {
  const ShapeSet& set = baked.set;
  std::string out = printable_line(file) + "\n";
  out += fact("  format", "baked shapes");
  out += fact("  shapes", fmt::format("{}, {:.1f} kB each", grouped(set.shape_count()),
                                      static_cast<double>(set.bytes()) / 1e3 /
                                          std::max(1.0, double{1} * set.shape_count())));
  out += fact("  depths", depths_text(set));
  if (set.has_heights()) out += fact("  heights", "kept: agents may have a z");
  out += fact("  threshold", fmt::format("{:g} mm", baked.origins.threshold * 1e3));
  out += fact("  leaves", set.exact_leaves() ? "segments, discs" : "discs");
  std::map<std::uint32_t, bool> seen;
  for (const ShapeOrigin& origin : baked.origins.origins)
    if (!std::exchange(seen[origin.character], true))
      out += fact("  character",
                  baked.origins.names[origin.character] + ": " + clips_text(baked.origins, origin.character));
  for (const BakedClip& clip : baked.clips)
    out += fact("  animated", fmt::format("{}: {} ({})", baked.origins.names[clip.character],
                                          clip_name(baked.origins, clip), text_of(facts_of(clip.discs))));
  const std::vector<BodyModel> models = models_of(file, baked);
  for (std::size_t i = 0; i < models.size(); ++i)
    out += fact("  body", fmt::format("{}: {} spheres, {} clips, {:.1f} kB", models[i].character->name,
                                      models[i].sphere_count(), models[i].character->clips.size(),
                                      static_cast<double>(baked.bodies[i].size()) / 1e3));
  return out;
}

std::string verified_text(const ShapeSet& set) {
  const bool outlines = !set.arrays().shape_contours.empty();
  return fact("  verified", set.roots_only() ? "levels"
                            : outlines
                                ? "nodes, levels, culling data, and that discs cover the outlines"
                                : "nodes, levels, culling data as far as the discs tell (no outlines)");
}

std::string table_text(const BakedShapes& baked) {
  const ShapeSet& set = baked.set;
  const ShapeOrigins& origins = baked.origins;
  std::size_t widest = 9;  // "rest pose"
  for (const std::string& name : origins.names) widest = std::max(widest, printable_line(name).size());
  std::string out = fmt::format("\n{:>6}  {:<{}}  {:<{}}  {:>9}  {:>8}  {:>6}\n", "shape", "character",
                                widest, "clip", widest, "time", "radius", "discs");
  for (std::uint32_t s = 0; s < origins.origins.size(); ++s)
    out += fmt::format("{:>6}  {:<{}}  {:<{}}  {:>7.2f} s  {:>6.3f} m  {:>6}\n", s,
                       printable_line(origins.names[origins.origins[s].character]), widest,
                       printable_line(clip_of(origins, s)), widest, origins.origins[s].seconds,
                       root_radius(set, s), set.discs(s, set.level_count() - 1).size());
  return out;
}

Json json_of(const std::string& file, const BakedShapes& baked) {
  const ShapeSet& set = baked.set;
  const ShapeOrigins& origins = baked.origins;
  Json json{{"source", file}, {"shape_count", set.shape_count()}, {"bytes", set.bytes()}};
  for (const std::uint32_t depth : set.depths()) json["depths"].push_back(depth_name(depth));
  json["threshold_m"] = shortest(static_cast<float>(origins.threshold));
  json["heights"] = set.has_heights();
  json["outlines"] = set.plan().outlines;
  json["exact_leaves"] = set.exact_leaves();
  json["shapes"] = Json::array();
  for (std::uint32_t s = 0; s < origins.origins.size(); ++s) {
    const ShapeOrigin& origin = origins.origins[s];
    const bool rest = origin.clip == ShapeOrigin::no_clip;
    json["shapes"].push_back({{"shape", s},
                              {"character", origins.names[origin.character]},
                              {"clip", rest ? Json(nullptr) : Json(origins.names[origin.clip])},
                              {"seconds", rest ? Json(nullptr) : Json(shortest(origin.seconds))},
                              {"root_radius_m", shortest(root_radius(set, s))},
                              {"discs", set.discs(s, set.level_count() - 1).size()}});
  }
  json["animated"] = Json::array();
  for (const BakedClip& clip : baked.clips) {
    Json& row = json["animated"].emplace_back(
        Json{{"character", origins.names[clip.character]}, {"clip", clip_name(origins, clip)}});
    row.update(json_of(facts_of(clip.discs)));
  }
  json["bodies"] = Json::array();
  for (const BodyModel& model : models_of(file, baked))
    json["bodies"].push_back({{"character", model.character->name},
                              {"spheres", model.sphere_count()},
                              {"clips", model.character->clips.size()}});
  return json;
}

}  // namespace bch::cli
