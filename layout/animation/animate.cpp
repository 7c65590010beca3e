// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/outline_builder.hpp>
#include <bch/pose_shape.hpp>

#include "layout/animation/clip_heights.hpp"
#include "layout/animation/cover_check.hpp"
#include "layout/animation/disc_ring.hpp"
#include "layout/animation/parts_apart.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/skinning.hpp"

namespace bch {
namespace detail {
namespace {

constexpr float longest_chunk = 0.1334f, shortest_chunk = 0.017f;  ///< seconds
constexpr std::uint32_t keys_of_chunk = 3;
constexpr double points_of_disc = 4;  ///< of a contour

/// Makes the chunks of one clip.
class ClipAnimator {
 public:
  ClipAnimator(const Character& character, std::uint32_t clip, const AnimateOptions& options)
      : check_(character, clip, double{options.spacing}),
        character_(character),
        clip_(clip),
        options_(options),
        end_(character.clips[clip].seconds),
        skinner_(character),
        builder_(character.triangles, character.vertices.size(), character.vertices) {}

  AnimatedDiscs run();

 private:
  std::vector<AnimatedChunk> chunks();
  void pose(float seconds, std::vector<Vec2>& vertices);
  KeyContour contour_of(const Outline& outline, const KeyPose& key, const KeyPose& next);
  void add_parts(OutlineBuilder& builder, const TriangleList& triangles, std::span<const KeyPose> keys,
                 std::vector<std::vector<KeyContour>>& parts);
  AnimatedChunk rings(float from, float to);
  double excess(const AnimatedChunk& chunk, std::size_t key, float share);
  bool is_tight(const AnimatedChunk& chunk, const AnimatedChunk& rings);
  void add_chunks(float from, float to, std::vector<AnimatedChunk>& chunks);
  bool loops();

  CoverCheck check_;  ///< the first, because it looks whether there is such a clip
  const Character& character_;
  std::uint32_t clip_;
  AnimateOptions options_;
  float end_;
  Skinner skinner_;
  OutlineBuilder builder_;
  Outline outline_;
  std::vector<Vec2> now_, later_;
};

void ClipAnimator::pose(float seconds, std::vector<Vec2>& vertices) {
  const std::span<const Vec2> posed = skinner_.ground_pose({clip_, seconds});
  vertices.assign(posed.begin(), posed.end());
}

KeyContour ClipAnimator::contour_of(const Outline& outline, const KeyPose& key, const KeyPose& next) {
  const double step = double{options_.spacing} / points_of_disc;
  KeyContour contour = {double{key.seconds}, follow(longest_contour(outline), step), {}, {}};
  for (const std::uint32_t v : vertices_on(outline, key.vertices)) {
    contour.here.push_back(key.vertices[v]);
    contour.next.push_back(next.vertices[v]);
  }
  return contour;
}

/// Appends the contours of triangles at the keys, where they are one part, or those of their parts. `builder`: of these triangles.
void ClipAnimator::add_parts(OutlineBuilder& builder, const TriangleList& triangles,
                             std::span<const KeyPose> keys, std::vector<std::vector<KeyContour>>& parts) {
  std::vector<Outline> outlines(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) builder.build(keys[k].vertices, outlines[k]);
  const std::vector<TriangleList> apart = parts_apart(triangles, keys, outlines);
  for (const TriangleList& part : apart) {
    OutlineBuilder of_part(part, character_.vertices.size(), character_.vertices);
    add_parts(of_part, part, keys, parts);
  }
  if (!apart.empty()) return;
  parts.emplace_back();
  for (std::size_t k = 0; k < keys.size(); ++k)
    parts.back().push_back(contour_of(outlines[k], keys[k], keys[std::min(k + 1, keys.size() - 1)]));
}

AnimatedChunk ClipAnimator::rings(float from, float to) {
  std::vector<KeyPose> keys(keys_of_chunk);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const double share = static_cast<double>(k) / (keys_of_chunk - 1);
    keys[k].seconds = static_cast<float>(double{from} + (double{to} - double{from}) * share);
    pose(keys[k].seconds, keys[k].vertices);
  }
  std::vector<std::vector<KeyContour>> parts;
  add_parts(builder_, character_.triangles, keys, parts);
  return rings_along(parts, options_);
}

/// Returns how far a disc reaches out of the outline at a time at most; `share` is that of the time from a key to the next one.
double ClipAnimator::excess(const AnimatedChunk& chunk, std::size_t key, float share) {
  const double from = chunk.times[key], seconds = chunk.times[key + 1] - from;
  pose(static_cast<float>(from + seconds * double{share}), now_);
  builder_.build(now_, outline_);
  double most = 0;
  for (std::size_t i = 0; i < chunk.disc_count; ++i) {
    const Disc &a = chunk.keys[key * chunk.disc_count + i], &b = chunk.keys[(key + 1) * chunk.disc_count + i];
    const auto between = [&](float x, float y) { return double{x + (y - x) * share}; };
    const double depth = depth_in(outline_, {between(a.x, b.x), between(a.y, b.y)});
    most = std::max(most, between(a.radius, b.radius) - depth);
  }
  return most;
}

/// Returns whether discs, half-way between two keys, reach out by no more than the error farther than the rings did at these keys.
bool ClipAnimator::is_tight(const AnimatedChunk& chunk, const AnimatedChunk& rings) {
  double at_key = excess(rings, 0, 0);
  for (std::size_t key = 0; key + 1 < chunk.times.size(); ++key) {
    const double before = at_key;
    at_key = excess(rings, key, 1);
    if (excess(chunk, key, 0.5f) > std::max(before, at_key) + double{options_.error}) return false;
  }
  return true;
}

/// Rounds radii up, so that 16 bits hold each number of the discs.
void round_radii(AnimatedChunk& chunk) {
  float reach = 0;
  for (const Disc& disc : chunk.keys)
    reach = std::max({reach, std::abs(disc.x), std::abs(disc.y), disc.radius});
  const double step = step_of(double{reach});
  for (Disc& disc : chunk.keys)
    disc.radius = static_cast<float>(std::ceil(double{disc.radius} / step) * step);
}

/// Appends a chunk, or those of the halves of its time where it is not tight.
void ClipAnimator::add_chunks(float from, float to, std::vector<AnimatedChunk>& chunks) {
  const AnimatedChunk made_for_keys = rings(from, to);
  AnimatedChunk chunk = made_for_keys;
  check_.hold(chunk);
  if (to - from > 2 * shortest_chunk && !is_tight(chunk, made_for_keys)) {
    const float between = from + (to - from) / 2;
    add_chunks(from, between, chunks);
    return add_chunks(between, to, chunks);
  }
  round_radii(chunk);
  chunks.push_back(std::move(chunk));
}

/// Returns whether every vertex is at the clip's end where it was at its beginning, to a 1000th of the spacing. A clip that is shorter than
/// any chunk is no loop.
bool ClipAnimator::loops() {
  if (end_ < shortest_chunk) return false;
  pose(0, now_);
  pose(end_, later_);
  for (std::size_t v = 0; v < now_.size(); ++v)
    if (length(plane_point(now_[v]) - plane_point(later_[v])) > 0.001 * double{options_.spacing})
      return false;
  return true;
}

std::vector<AnimatedChunk> ClipAnimator::chunks() {
  std::vector<AnimatedChunk> result;
  const double count = std::ceil(double{end_} / double{longest_chunk});
  float from = 0;
  for (double i = 1; i <= count; ++i) {
    const float to = i == count ? end_ : static_cast<float>(double{end_} * (i / count));
    add_chunks(from, to, result);
    from = to;
  }
  return result;
}

AnimatedDiscs ClipAnimator::run() {
  AnimatedDiscs result;
  result.loops = options_.loops ? *options_.loops : loops();
  result.heights = clip_heights(character_, clip_);
  result.chunks = chunks();
  return result;
}

void require(float value, const char* what) {
  if (!(value > 0 && value <= 1e6f))
    throw std::invalid_argument(std::string("animated discs: ") + what + " of " + shortest(value) + " m");
}

}  // namespace
}  // namespace detail

AnimatedDiscs animate(const Character& character, std::uint32_t clip, const AnimateOptions& options) {
  const detail::FloatingPointStateGuard floats;
  detail::require(options.spacing, "a spacing");
  detail::require(options.inset, "an inset");
  detail::require(options.error, "an error");
  return detail::ClipAnimator(character, clip, options).run();
}

}  // namespace bch
