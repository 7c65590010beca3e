// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/bodies.hpp>

#include "layout/animation/clip_samples.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/skinning.hpp"

namespace bch {
namespace detail {
namespace {

constexpr float longest_chunk = 0.1334f;      ///< seconds
constexpr double shortest_interval = 0.0045;  ///< seconds, of two keys
constexpr float same_place = 2.5e-5f;         ///< metres, of the ends of a loop

/// Returns the power of two that coordinates up to an extent are rounded to: each is it times a number of 16 bits.
double step_of(double max_extent) {
  int exponent = 0;
  std::frexp(max_extent, &exponent);
  return std::ldexp(1.0, exponent - 15);
}

/// Makes the moving spheres of one clip: chunk after chunk, whose keys are among the samples of the chunk.
class ClipAnimator {
 public:
  ClipAnimator(const BodyModel& model, std::uint32_t clip, const AnimateOptions& options)
      : model_(model),
        clip_(clip),
        options_(options),
        samples_(model, clip),
        end_(model.character->clips[clip].seconds) {}

  AnimatedDiscs run() {
    AnimatedDiscs result;
    result.loops = options_.loops ? *options_.loops : loops();
    const double count = std::ceil(double{end_} / double{longest_chunk});
    float from = 0;
    for (double i = 1; i <= count; ++i) {
      const float to = i == count ? end_ : static_cast<float>(double{end_} * (i / count));
      result.chunks.push_back(chunk(from, to));
      from = to;
    }
    result.heights = samples_.heights();
    return result;
  }

 private:
  /// Holds the spheres of a key.
  using Key = std::vector<Sphere>;

  AnimatedChunk chunk(float from, float to) {
    samples_.take(from, to);
    step_ = step_of(samples_.max_extent());
    times_.clear(), keys_.clear();
    add_key(0, centres(0));
    add_keys(0, samples_.size() - 1);
    AnimatedChunk made;
    made.disc_count = static_cast<std::uint32_t>(model_.sphere_count());
    made.times = times_;
    for (const Key& key : keys_)
      for (const Sphere& s : key) {
        made.keys.push_back({s.x, s.y, static_cast<float>(std::ceil(double{s.radius} / step_) * step_)});
        made.z.push_back(s.z);
      }
    return made;
  }

  void add_key(std::size_t sample, Key key) {
    times_.push_back(double{samples_[sample].seconds});
    keys_.push_back(std::move(key));
  }

  /// Appends keys after that of the first sample, up to that of the last one: in the middle, too, where spheres would stand out of the
  /// posed ones by more than the error.
  void add_keys(std::size_t first, std::size_t last) {
    Key from = keys_.back(), to = centres(last);
    const double most = cover(first, last, from, to);
    const double seconds = double{samples_[last].seconds} - double{samples_[first].seconds};
    if (most > double{options_.error} && last - first > 1 && seconds > 2 * shortest_interval) {
      const std::size_t middle = first + (last - first) / 2;
      add_keys(first, middle);
      return add_keys(middle, last);
    }
    keys_.back() = std::move(from);
    add_key(last, std::move(to));
  }

  Key centres(std::size_t sample) const {
    Key key;
    for (const Sphere& sphere : samples_[sample].spheres) {
      const auto rounded = [&](float value) {
        return static_cast<float>(std::nearbyint(double{value} / step_) * step_);
      };
      key.push_back({rounded(sphere.x), rounded(sphere.y), rounded(sphere.z), 0});
    }
    return key;
  }

  /// Enlarges the spheres of two keys until they hold all corners at all times between.
  /// Returns: by how much they stand out of the spheres of a sample between, at most.
  double cover(std::size_t first, std::size_t last, Key& from, Key& to) const {
    double most = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const SpacePoint begin = centre(from[i]), move = centre(to[i]) - begin;
      const double r_from = samples_.radius(first, i, begin), r_to = samples_.radius(last, i, begin + move);
      const auto even_radius = [&](double fraction) { return r_from + fraction * (r_to - r_from); };
      double excess = 0;
      for (std::size_t k = first + 1; k < last; ++k) {
        const double fraction = samples_.fraction(k, first, last);
        excess = std::max(excess, samples_.radius(k, i, begin + fraction * move) - even_radius(fraction));
      }
      for (std::size_t k = first + 1; k < last; ++k) {
        const Sphere& sphere = samples_[k].spheres[i];
        const double fraction = samples_.fraction(k, first, last);
        const double aside = std::sqrt(squared_distance(begin + fraction * move, centre(sphere)));
        most = std::max(most, aside + even_radius(fraction) + excess - double{sphere.radius});
      }
      from[i].radius = std::max(from[i].radius, rounding::round_up(r_from + excess));
      to[i].radius = rounding::round_up(r_to + excess);
    }
    return most;
  }

  static SpacePoint centre(const Sphere& s) { return {double{s.x}, double{s.y}, double{s.z}}; }

  /// Returns whether every vertex is at the clip's end where it was at its beginning. A clip that is shorter than a loop may be is none.
  bool loops() const {
    if (double{end_} < shortest_interval) return false;
    Skinner skinner(*model_.character);
    const auto first = skinner.pose(Pose(clip_, 0));
    const std::vector<Vec3> begin(first.begin(), first.end());
    const auto end = skinner.pose(Pose(clip_, end_));
    for (std::size_t v = 0; v < begin.size(); ++v)
      if (std::sqrt(squared_distance(space_point(begin[v]), space_point(end[v]))) > double{same_place})
        return false;
    return true;
  }

  const BodyModel& model_;
  std::uint32_t clip_;
  AnimateOptions options_;
  ClipSamples samples_;  ///< before the end, because they look whether there is such a clip
  float end_;
  // Of the chunk:
  double step_ = 0;
  std::vector<double> times_;
  std::vector<Key> keys_;
};

}  // namespace
}  // namespace detail

AnimatedDiscs animate(const BodyModel& model, std::uint32_t clip, const AnimateOptions& options) {
  const detail::FloatingPointStateGuard floats;
  validate(model);
  if (!(options.error > 0 && options.error <= 1e6f))
    throw std::invalid_argument("animate: expected an error above 0 m, found " +
                                detail::shortest(options.error) + " m");
  return detail::ClipAnimator(model, clip, options).run();
}

}  // namespace bch
