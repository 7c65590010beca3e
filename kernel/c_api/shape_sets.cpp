// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include <bch/files.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/outlines.hpp"
#include "layout/base/aligned_vector.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/shape_set/verify.hpp"

namespace bch::c_api {
namespace {

const ShapeSet& set_of(const bch_shape_set* set) {
  return object_of(set, "set").set;
}

void check_shape(const ShapeSet& set, uint32_t shape) {
  check_index(shape, set.shape_count(), "shape");
}

void add_outline(const detail::ShapeSetView& view, uint32_t shape, OutlineWriter& to) {
  if (view.shape_contours == nullptr) return;
  const detail::ContourRange range = view.shape_contours[shape];
  for (uint32_t i = range.begin; i < range.end; ++i) {
    const detail::Contour& contour = view.contours[i];
    to.add({view.points + contour.begin, view.points + contour.end});
  }
}

bch_shape_origin origin_of(const ShapeOrigins& origins, uint32_t shape) {
  if (origins.origins.empty()) return {nullptr, nullptr, 0};
  const ShapeOrigin& origin = origins.origins[shape];
  const bool rest = origin.clip == ShapeOrigin::no_clip;
  return {origins.names[origin.character].c_str(), rest ? nullptr : origins.names[origin.clip].c_str(),
          origin.seconds};
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_shape_set_load(const char* path, int32_t access, bch_shape_set** set) {
  return guarded([&] {
    required(path, "path");
    required(set, "set");
    const FileAccess how = one_of(access, FileAccess::map, "access");
    require_file(path);
    hand_out(std::make_unique<bch_shape_set>(load_baked(path, how)), set);
  });
}

bch_status bch_shape_set_load_bytes(const void* bytes, size_t size, const char* name, bch_shape_set** set) {
  return guarded([&] {
    if (size > 0) required(static_cast<const char*>(bytes), "bytes");
    required(name, "name");
    required(set, "set");
    detail::AlignedVector<char> own(size);
    std::copy_n(static_cast<const char*>(bytes), size, own.begin());
    const auto memory = std::make_shared<const detail::AlignedVector<char>>(std::move(own));
    hand_out(std::make_unique<bch_shape_set>(load_baked(std::as_bytes(std::span(*memory)), name, memory)),
             set);
  });
}

bch_status bch_shape_set_save(const bch_shape_set* handle, const char* path) {
  return guarded([&] {
    const bch_shape_set& set = object_of(handle, "set");
    required(path, "path");
    set.own ? save_baked(path, set.set, set.own->origins, set.own->clips, set.own->bodies)
            : save_baked(path, set.set);
  });
}

bch_status bch_shape_set_get_info(const bch_shape_set* handle, bch_shape_set_info* info) {
  return guarded([&] {
    const bch_shape_set& of = object_of(handle, "set");
    bch_shape_set_info all = BCH_SHAPE_SET_INFO_INIT;
    all.shapes = of.set.shape_count();
    all.levels = of.set.level_count();
    all.has_heights = of.set.has_heights();
    all.outlines = of.set.plan().outlines;
    all.exact_leaves = of.set.exact_leaves();
    all.bytes = of.set.bytes();
    all.depths = of.set.depths().data();
    fill(info, all, "info");
  });
}

bch_status bch_shape_set_get_origin(const bch_shape_set* handle, uint32_t shape, bch_shape_origin* origin) {
  return guarded([&] {
    const bch_shape_set& set = object_of(handle, "set");
    required(origin, "origin");
    check_shape(set.set, shape);
    *origin = set.own ? origin_of(set.own->origins, shape) : bch_shape_origin{nullptr, nullptr, 0};
  });
}

bch_status bch_shape_set_get_radius(const bch_shape_set* set, uint32_t shape, float* radius) {
  return guarded([&] {
    const float found = set_of(set).bounding_radius(shape);
    required(radius, "radius") = found;
  });
}

bch_status bch_shape_set_get_discs(const bch_shape_set* set, uint32_t shape, uint32_t level, bch_disc* discs,
                                   size_t capacity, size_t* count) {
  return guarded([&] { deliver(set_of(set).discs(shape, level), discs, capacity, "discs", count); });
}

bch_status bch_shape_set_get_outline(const bch_shape_set* handle, uint32_t shape, bch_outline* outline) {
  return guarded([&] {
    const ShapeSet& set = set_of(handle);
    check_shape(set, shape);
    OutlineWriter to(outline);
    add_outline(set.view(), shape, to);
    to.finish();
  });
}

bch_status bch_shape_set_verify(const bch_shape_set* set, size_t most, bch_inconsistency inconsistency,
                                void* user, size_t* count) {
  return guarded([&] {
    required(count, "count");
    const std::vector<detail::Inconsistency> found = detail::verify(set_of(set), most);
    if (inconsistency != nullptr)
      for (const detail::Inconsistency& each : found) inconsistency(user, text_of(each).c_str());
    *count = found.size();
  });
}

bch_status bch_shape_set_free(bch_shape_set* set) {
  return free_object(set, "set");
}
