// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <numeric>
#include <string>

#include <bch/bodies.hpp>
#include <bch/files.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"

namespace bch::c_api {
namespace {

/// Takes values of an array one after the other.
template <class Value>
class Cursor {
 public:
  explicit Cursor(std::span<const Value> all) : all_(all) {}
  std::span<const Value> take(std::size_t count) {
    taken_ += count;
    return all_.subspan(taken_ - count, count);
  }

 private:
  std::span<const Value> all_;
  std::size_t taken_ = 0;
};

std::size_t sum_of(std::span<const std::uint32_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

AnimatedDiscs discs_of(const bch_animated_arrays* given) {
  const bch_animated_arrays arrays =
      sized(&required(given, "arrays"), bch_animated_arrays BCH_ANIMATED_ARRAYS_INIT, "arrays");
  const std::size_t chunks = arrays.chunk_count;
  const auto keys = array_of(arrays.key_counts, chunks, "arrays->key_counts");
  const auto discs = array_of(arrays.disc_counts, chunks, "arrays->disc_counts");
  std::size_t disc_keys = 0;
  for (std::size_t i = 0; i < chunks; ++i) disc_keys += std::size_t{keys[i]} * discs[i];
  Cursor times(array_of(arrays.times, sum_of(keys), "arrays->times"));
  Cursor all(std::span<const Disc>(same_array<Disc>(arrays.discs, disc_keys, "arrays->discs")));
  const std::size_t heights = arrays.z == nullptr ? 0 : disc_keys;
  Cursor z(array_of(arrays.z, heights, "arrays->z"));
  AnimatedDiscs made;
  made.loops = arrays.loops != 0;
  made.chunks.resize(chunks);
  for (std::size_t i = 0; i < chunks; ++i) {
    AnimatedChunk& chunk = made.chunks[i];
    const auto at = times.take(keys[i]);
    const auto of = all.take(std::size_t{keys[i]} * discs[i]);
    chunk.times.assign(at.begin(), at.end());
    chunk.disc_count = discs[i];
    chunk.keys.assign(of.begin(), of.end());
    const auto at_heights = z.take(heights == 0 ? 0 : of.size());
    chunk.z.assign(at_heights.begin(), at_heights.end());
  }
  return made;
}

/// Returns the set that a handle owns.
BakedShapes& owned_by(const bch_shape_set* set) {
  const bch_shape_set& of = object_of(set, "set");
  if (!of.own) throw Failure(BCH_INVALID_ARGUMENT, "set is lent, and has no clips");
  return *of.own;
}

/// Returns a body that is asked for a time.
const AnimatedShape& shape_at(const bch_animated_shape* shape, double seconds) {
  const AnimatedShape& of = object_of(shape, "shape").shape;
  if (!detail::is_finite(seconds))
    throw Failure(BCH_INVALID_ARGUMENT,
                  "seconds is " + detail::shortest(seconds) + "; expected a finite number");
  return of;
}

/// Adds a name.
uint32_t add_name(ShapeOrigins& origins, const char* name) {
  origins.names.emplace_back(name);
  return static_cast<uint32_t>(origins.names.size() - 1);
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_animated_shape_animate(const bch_body_model* model, uint32_t clip,
                                      const bch_animate_options* options, bch_animated_shape** shape) {
  return guarded([&] {
    required(shape, "shape");
    const BodyModel& of = object_of(model, "model").model;
    check_index(clip, of.character->clips.size(), "clip");
    const bch_animate_options given =
        sized<bch_animate_options>(options, BCH_ANIMATE_OPTIONS_INIT, "options");
    AnimateOptions how{.error = given.error};
    if (given.loops < -1 || given.loops > 1)
      throw Failure(BCH_INVALID_ARGUMENT,
                    "options->loops is " + std::to_string(given.loops) + "; expected -1, 0 or 1");
    if (given.loops >= 0) how.loops = given.loops == 1;
    hand_out(std::make_unique<bch_animated_shape>(animate(of, clip, how)), shape);
  });
}

bch_status bch_animated_shape_create(const bch_animated_arrays* arrays, bch_animated_shape** shape) {
  return guarded([&] {
    required(shape, "shape");
    hand_out(std::make_unique<bch_animated_shape>(discs_of(arrays)), shape);
  });
}

bch_status bch_animated_shape_get_info(const bch_animated_shape* handle, bch_animated_shape_info* info) {
  return guarded([&] {
    const auto& [discs, shape] = object_of(handle, "shape");
    bch_animated_shape_info all = BCH_ANIMATED_SHAPE_INFO_INIT;
    all.loops = shape.loops();
    all.begin = shape.begin();
    all.end = shape.end();
    all.bounding_radius = shape.bounding_radius();
    all.bytes = shape.bytes();
    all.chunks = discs.chunks.size();
    for (const AnimatedChunk& chunk : discs.chunks) all.keys += chunk.times.size();
    fill(info, all, "info");
  });
}

bch_status bch_animated_shape_get_discs(const bch_animated_shape* shape, double seconds, bch_disc* discs,
                                        size_t capacity, size_t* count) {
  return guarded([&] { deliver(shape_at(shape, seconds).discs(seconds), discs, capacity, "discs", count); });
}

bch_status bch_animated_shape_get_spheres(const bch_animated_shape* shape, double seconds,
                                          bch_sphere* spheres, size_t capacity, size_t* count) {
  return guarded(
      [&] { deliver(shape_at(shape, seconds).spheres(seconds), spheres, capacity, "spheres", count); });
}

bch_status bch_animated_shape_free(bch_animated_shape* shape) {
  return free_object(shape, "shape");
}

bch_status bch_shape_set_add_clip(bch_shape_set* set, const bch_animated_shape* shape, const char* character,
                                  const char* clip) {
  return guarded([&] {
    BakedShapes& to = owned_by(set);
    ShapeOrigins& origins = to.origins;
    const bch_animated_shape& of = object_of(shape, "shape");
    required(character, "character");
    const std::size_t names = origins.names.size();
    try {
      const uint32_t first = add_name(origins, character);
      const uint32_t second = clip == nullptr ? ShapeOrigin::no_clip : add_name(origins, clip);
      to.clips.push_back({first, second, of.discs});
    } catch (...) {
      origins.names.resize(names);
      throw;
    }
  });
}

bch_status bch_shape_set_get_clip_count(const bch_shape_set* handle, size_t* count) {
  return guarded([&] {
    const bch_shape_set& set = object_of(handle, "set");
    required(count, "count") = set.own ? set.own->clips.size() : 0;
  });
}

bch_status bch_shape_set_get_clip(const bch_shape_set* set, size_t i, const char** character,
                                  const char** clip, bch_animated_shape** shape) {
  return guarded([&] {
    const BakedShapes& from = owned_by(set);
    check_index(i, from.clips.size(), "i");
    const BakedClip& of = from.clips[i];
    const std::vector<std::string>& names = from.origins.names;
    if (shape != nullptr) hand_out(std::make_unique<bch_animated_shape>(of.discs), shape);
    if (character != nullptr) *character = names[of.character].c_str();
    if (clip != nullptr) *clip = of.clip == ShapeOrigin::no_clip ? nullptr : names[of.clip].c_str();
  });
}
