// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/outlines.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <bch/outline_builder.hpp>

#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/posing.hpp"
#include "kernel/c_api/work.hpp"

struct bch_outlines {
  std::vector<bch::Outline> outlines;
};

namespace bch::c_api {
namespace {

/// Finds outlines on the threads that the caller wants, and hands them out. `find`: a function of the options.
template <class Find>
void find_outlines(const bch_outline_options* given, const bch_work* work, bch_outlines** to, Find find) {
  required(to, "outlines");
  const auto wanted = sized<bch_outline_options>(given, BCH_OUTLINE_OPTIONS_INIT, "options");
  const auto how = sized<bch_work>(work, BCH_WORK_INIT, "work");
  OutlineOptions options{{wanted.bottom, wanted.top}, wanted.holes != 0, Work::function_of(how)};
  auto found = std::make_unique<bch_outlines>();
  on_threads(how.threads, [&] { found->outlines = find(options); });
  hand_out(std::move(found), to);
}

const Outline& outline_of(const bch_outlines* handle, size_t pose) {
  const std::vector<Outline>& outlines = object_of(handle, "outlines").outlines;
  check_index(pose, outlines.size(), "pose");
  return outlines[pose];
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_outlines_of_mesh(const bch_vec3* positions, size_t vertices, size_t poses,
                                const uint32_t* triangles, size_t triangle_count,
                                const bch_outline_options* options, const bch_work* work,
                                bch_outlines** outlines) {
  return guarded([&] {
    if (triangle_count > SIZE_MAX / 3) throw Failure(BCH_INVALID_ARGUMENT, "triangle_count is too large");
    if (vertices == 0 || poses > SIZE_MAX / vertices)
      throw Failure(BCH_INVALID_ARGUMENT,
                    "vertices is " + std::to_string(vertices) + ", poses " + std::to_string(poses));
    const auto points = same_array<Vec3>(positions, vertices * poses, "positions");
    const auto corners = array_of(triangles, 3 * triangle_count, "triangles");
    std::vector<std::array<std::uint32_t, 3>> all(triangle_count);
    for (std::size_t i = 0; i < triangle_count; ++i)
      all[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    find_outlines(options, work, outlines,
                  [&](const OutlineOptions& how) { return bch::outlines(points, vertices, all, how); });
  });
}

bch_status bch_outlines_of_character(const bch_character* character, const bch_pose* poses, size_t count,
                                     const bch_outline_options* options, const bch_work* work,
                                     bch_outlines** outlines) {
  return guarded([&] {
    const Character& of = *object_of(character, "character").character;
    const auto all = array_of(poses, count, "poses");
    check_poses(of, all);
    std::vector<PoseTime> times;
    for (const bch_pose& pose : all) times.push_back({pose.clip, pose.seconds});
    find_outlines(options, work, outlines,
                  [&](const OutlineOptions& how) { return bch::outlines(of, times, how); });
  });
}

bch_status bch_outlines_get(const bch_outlines* outlines, size_t pose, bch_outline* outline) {
  return guarded([&] {
    const Outline& of = outline_of(outlines, pose);
    OutlineWriter to(outline);
    for (std::size_t i = 0; i < of.contours(); ++i) to.add(of.contour(i));
    to.finish();
  });
}

bch_status bch_outlines_get_text(const bch_outlines* outlines, size_t pose, int32_t format, char* text,
                                 size_t capacity, size_t* length) {
  return guarded([&] {
    const Outline& of = outline_of(outlines, pose);
    const auto to = array_of(text, capacity, "text");
    required(length, "length");
    if (format != BCH_WKT && format != BCH_GEOJSON)
      throw Failure(BCH_INVALID_ARGUMENT,
                    "format is " + std::to_string(format) + "; expected BCH_WKT or BCH_GEOJSON");
    const std::string all = format == BCH_WKT ? to_wkt(of) : to_geojson(of);
    std::copy_n(all.begin(), std::min(all.size(), to.size()), to.begin());
    *length = all.size();
  });
}

bch_status bch_outlines_free(bch_outlines* outlines) {
  return free_object(outlines, "outlines");
}
