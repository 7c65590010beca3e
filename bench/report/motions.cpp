// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/motions.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <bch/pose_shape.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/slide.hpp"
#include "bench/report/statistics.hpp"
#include "bench/report/words.hpp"
#include "bench/workload/outline_contacts.hpp"
#include "layout/animation/contour.hpp"
#include "layout/base/random.hpp"
#include "layout/character/skinning.hpp"

// Clips as animated shapes against poses baked at a rate: bytes, errors, and contacts between samples.

namespace bch::report {
namespace {

using bench::AnimatedClip;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double rates[] = {10, 30, 120};
constexpr double sample_rates[] = {30, 120, 1000};

/// How long the parts of clips are, seconds: all clips of the scene, those of characters from elsewhere, and a walk.
double clip_seconds(const Run& run) {
  return std::max(bench::least_clip_seconds, 0.015 * run.sizes().poses);
}
double real_clip_seconds(const Run& run) {
  return std::max(bench::least_clip_seconds, clip_seconds(run) / 4);
}
double walk_seconds(const Run& run) {
  return std::max(bench::least_clip_seconds, 0.12 * run.sizes().poses);
}

/// How far discs stand out of the outline at a time, and the outline out of them, metres.
struct CoverErrors {
  std::vector<double> outside, uncovered;

  void add(const Shape& cover, const Outline& outline) {
    const std::vector<Disc> discs = ShapeSet({{cover}}, {.outlines = false, .culling = false}).discs(0, 0);
    for (const Disc& disc : discs)
      outside.push_back(double{disc.radius} - detail::depth_in(outline, {double{disc.x}, double{disc.y}}));
    double most = 0;
    for (const Vec2& vertex : outline.points) {
      const detail::PlanePoint p = detail::plane_point(vertex);
      double away = std::max(0.0, -detail::depth_in(cover.outline, p));
      for (const Disc& disc : discs)
        away = std::min(away, std::max(0.0, detail::length(p - detail::PlanePoint{disc.x, disc.y}) -
                                                double{disc.radius}));
      most = std::max(most, away);
    }
    uncovered.push_back(most);
  }

  /// Returns the value in millimetres below which a share of those of `outside` are.
  double outside_at(double share) {
    std::sort(outside.begin(), outside.end());
    return millimetres * outside[static_cast<std::size_t>(share * static_cast<double>(outside.size() - 1))];
  }
  double mean_outside() const {
    double sum = 0;
    for (const double each : outside) sum += each;
    return millimetres * sum / static_cast<double>(outside.size());
  }
  double most_uncovered() const {
    return millimetres * *std::max_element(uncovered.begin(), uncovered.end());
  }
};

void add_storage(Run& run, std::span<const AnimatedClip> clips, const std::string& characters, Table& table) {
  constexpr std::uint32_t times_of_clip = 20;
  double seconds = 0, bytes = 0, poses[std::size(rates)] = {};
  CoverErrors animated, baked[std::size(rates)];
  detail::Random random(run.seed());
  for (const AnimatedClip& clip : clips) {
    seconds += clip.seconds, bytes += static_cast<double>(clip.shape.bytes());
    PoseShaper shaper(*clip.character);
    for (std::size_t k = 0; k < std::size(rates); ++k)
      poses[k] += static_cast<double>(bench::baked_poses(clip, rates[k]).bytes());
    for (std::uint32_t i = 0; i < times_of_clip; ++i) {
      const auto time = static_cast<float>(random.uniform(clip.seconds));
      const Outline outline = shaper.shape({clip.clip, time}).outline;
      animated.add(clip.shape.shape(double{time}), outline);
      for (std::size_t k = 0; k < std::size(rates); ++k)
        baked[k].add(
            shaper.shape({clip.clip, static_cast<float>(std::round(double{time} * rates[k]) / rates[k])}),
            outline);
    }
  }
  const auto add = [&](const std::string& what, double of, CoverErrors& errors) {
    table.add({characters, what, clips.size(), seconds, of / seconds / 1000, of / poses[1],
               errors.mean_outside(), errors.outside_at(0.99), errors.outside_at(1),
               errors.most_uncovered()});
  };
  add("animated shapes", bytes, animated);
  for (std::size_t k = 0; k < std::size(rates); ++k)
    add(fmt::format("poses at {:g} a second", rates[k]), poses[k], baked[k]);
}

/// Returns how long one of so many takes, on one thread.
template <class Work>
double microseconds_of(std::size_t count, Work work) {
  double nanoseconds = 0;
  tbb::task_arena(1).execute([&] {
    const bench::Stopwatch watch(1);
    work();
    nanoseconds = watch.nanoseconds();
  });
  return nanoseconds / 1000 / static_cast<double>(count);
}

/// Compares first_contact() with samples of the nearest pose.
void add_contacts(Run& run, const bench::MotionScene& scene) {
  Table table({"samples a second", "pairs", "contacts", "contacts missed", "lateness, least (ms)",
               "lateness, mean (ms)", "lateness, most (ms)", "sampled (us)", "first contact (us)"});
  std::vector<double> times(scene.pairs().size());
  const double own_time = microseconds_of(times.size(), [&] {
    first_contact(scene.motions(), scene.pairs(), bench::MotionScene::interval, times);
  });
  for (const double rate : sample_rates) {
    const bench::SampledMotions sampled(scene, rate, rate);
    std::vector<double> late;
    std::size_t contacts = 0, missed = 0;
    std::vector<double> found;
    const double taken = microseconds_of(times.size(), [&] {
      for (const Pair& pair : scene.pairs()) found.push_back(sampled.first_contact(pair));
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      contacts += times[i] < never, missed += times[i] < never && found[i] == never;
      if (times[i] < never && found[i] < never) late.push_back(1000 * (found[i] - times[i]));
    }
    std::sort(late.begin(), late.end());
    const double sum = std::accumulate(late.begin(), late.end(), 0.0), none = std::nan("");
    table.add({rate, times.size(), contacts, missed, late.empty() ? none : late.front(),
               sum / static_cast<double>(late.size()), late.empty() ? none : late.back(), taken, own_time});
  }
  run.write("motions_contacts", table);
}

/// The protocol of distance_experiment, at random times between keys: by shapes that are built for that very time, and by animated ones.
void add_slides(Run& run, std::span<const AnimatedClip> clips) {
  detail::Random random(run.seed());
  std::vector<Shape> built, animated;
  std::vector<baselines::Body> bodies;
  for (std::uint32_t i = 0; i < std::min(run.sizes().poses, most_costly_poses); ++i) {
    const AnimatedClip& clip = clips[random.below(static_cast<std::uint32_t>(clips.size()))];
    const auto time = static_cast<float>(random.uniform(clip.seconds));
    PoseShaper shaper(*clip.character);
    detail::Skinner skinner(*clip.character);
    const auto positions = skinner.pose({clip.clip, time});
    built.push_back(shaper.shape({clip.clip, time}));
    bodies.push_back({{positions.begin(), positions.end()}, clip.character->triangles, built.back()});
    animated.push_back(clip.shape.shape(double{time}));
  }
  const SlideCases cases(built, run.sizes().cases, run.seed());
  const auto distances = baselines::fcl_mesh_distances(bodies);
  Table table({"body", "mean (cm)", "mean (95 % low)", "mean (95 % high)", "cases", "never detected"});
  const auto add = [&](const char* what, const std::vector<double>& places) {
    const std::vector<double> found = known(cases.distances(*distances, places));
    const Estimate mean = estimate(found, run.seed());
    table.add({what, mean.mean, mean.low, mean.high, cases.size(), cases.size() - found.size()});
  };
  const ShapeSet built_set(built);
  const std::vector<double> outlines = cases.contacts(built_set, Leaves::segments),
                            moving = cases.contacts(ShapeSet(animated));
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (!std::isnan(outlines[i]) && !(moving[i] <= outlines[i]))
      throw std::logic_error(fmt::format("motions: case {} touches later than its outlines", i));
  add("outlines of the time", outlines);
  add("shape built for the time", cases.contacts(built_set));
  add("animated shape", moving);
  run.write("motions_slide", table);
}

/// Compares with the outlines of poses at every millisecond.
void add_lateness(const Run& run, std::span<const AnimatedClip> clips, const std::string& characters,
                  Table& table) {
  const bench::MotionScene scene(clips, std::min(10'000u, 500 * run.sizes().poses), run.seed());
  const bench::OutlineContacts outlines = bench::outline_contacts(scene);
  table.add({characters, clips.size(), scene.pairs().size(), scene.pairs(true).size(), outlines.compared,
             outlines.meeting, 1000 * outlines.ahead, outlines.late, 1000 * outlines.latest});
}

void run_motions(Run& run) {
  Table storage({"characters", "clips as", "clips", "seconds", "kB a second", "over poses at 30 a second",
                 "discs outside of the outline, mean (mm)", "99 % (mm)", "most (mm)",
                 "outline outside of the cover, most (mm)"});
  Table late({"characters", "clips", "pairs", "contacts", "outlines compared", "outlines meet",
              "contact ahead of that, mean (ms)", "later than a sample of the outlines", "by at most (ms)"});
  const auto add = [&](std::span<const AnimatedClip> clips, const std::string& characters) {
    add_storage(run, clips, characters, storage);
    add_lateness(run, clips, characters, late);
  };
  const std::vector<AnimatedClip> clips =
      bench::animated_clips(run.scene().characters(), "", clip_seconds(run));
  run.done(0.3);
  add(clips, "of the scene");
  add_slides(run, clips);
  run.done(0.6);
  if (!run.real_characters().empty())
    add(bench::animated_clips(run.real_characters(), "", real_clip_seconds(run)), "real");
  run.write("motions_storage", storage);
  run.write("motions_late", late);
  run.done(0.8);
  const std::vector<AnimatedClip> walks =
      bench::animated_clips(run.scene().characters(), "walk", walk_seconds(run));
  add_contacts(run, bench::MotionScene(walks, run.sizes().cases, run.seed()));
}

/// Of the clips of the scene as something, over poses at 30 a second.
std::string value_of(const Results& results, std::string_view what) {
  const Table& table = results("motions_storage");
  return brief(table.number({{"clips as", what}}, "over poses at 30 a second"));
}

std::string slide_difference(const Results& results, std::string_view) {
  const Table& table = results("motions_slide");
  return brief(table.number({{"body", "animated shape"}}, "mean (cm)") -
               table.number({{"body", "shape built for the time"}}, "mean (cm)"));
}

}  // namespace

const Experiment motions_experiment{
    "motions", "Motions",   200,
    true,      run_motions, {{"bytes over poses", value_of}, {"slide difference", slide_difference}}};

}  // namespace bch::report
