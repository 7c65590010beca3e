// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/motions.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <bch/poses.hpp>

#include "baselines/outline_depth.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/report/subjects.hpp"
#include "layout/base/random.hpp"
#include "layout/character/skinning.hpp"

// Clips as animated shapes against poses baked at a rate: bytes, errors, and contacts between samples.

namespace bch::report {
namespace {

using bench::AnimatedClip;

constexpr double millimetres = 1000;  // of a metre
constexpr double rates[] = {10, 30, 120};
constexpr double sample_rates[] = {30, 120, 1000};
constexpr std::uint32_t checked_pairs = 40;

/// How long the parts of clips are, seconds, for each pose of a character.
double clip_seconds(const Run& run, double of_a_pose) {
  return std::max(bench::least_clip_seconds, of_a_pose * run.sizes().poses);
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// How far discs stand out of the outline at a time, and the outline out of them, metres; what all of that takes.
struct Cover {
  std::string name;
  double bytes = 0;
  std::vector<double> outside = {};
  double most_uncovered = 0;

  void add(const Shape& cover, const Outline& outline) {
    const std::vector<Disc> discs = ShapeSet({{cover}}, {.outlines = false, .culling = false}).discs(0, 0);
    for (const Disc& disc : discs)
      outside.push_back(double{disc.radius} - baselines::depth_in(outline, {double{disc.x}, double{disc.y}}));
    for (const Vec2& vertex : outline.points) {
      const detail::PlanePoint p = detail::plane_point(vertex);
      double away = std::max(0.0, -baselines::depth_in(cover.outline, p));
      for (const Disc& disc : discs)
        away = std::min(away, std::max(0.0, detail::length(p - detail::PlanePoint{disc.x, disc.y}) -
                                                double{disc.radius}));
      most_uncovered = std::max(most_uncovered, away);
    }
  }

  /// Returns the value below which a share of those of `outside` are.
  double outside_at(double share) {
    std::ranges::sort(outside);
    return outside[static_cast<std::size_t>(share * static_cast<double>(outside.size() - 1))];
  }
};

void add_storage(Run& run, std::span<const AnimatedClip> clips, const std::string& characters, Table& table) {
  constexpr std::uint32_t times_of_clip = 20;
  double seconds = 0;
  std::vector<Cover> covers = {{"animated shapes"}};
  for (const double rate : rates) covers.push_back({fmt::format("poses at {:g} a second", rate)});
  detail::Random random(run.seed());
  for (const AnimatedClip& clip : clips) {
    PoseShaper shaper(*clip.character);
    seconds += clip.seconds, covers[0].bytes += static_cast<double>(clip.shape.bytes());
    for (std::size_t k = 0; k < std::size(rates); ++k)
      covers[k + 1].bytes += static_cast<double>(bench::baked_poses(clip, rates[k]).bytes());
    for (std::uint32_t i = 0; i < times_of_clip; ++i) {
      const auto time = static_cast<float>(random.uniform(clip.seconds));
      const Outline outline = shaper.shape({clip.clip, time}).outline;
      covers[0].add(clip.shape.shape(double{time}), outline);
      for (std::size_t k = 0; k < std::size(rates); ++k) {
        const double nearest = std::round(double{time} * rates[k]) / rates[k];
        covers[k + 1].add(shaper.shape({clip.clip, static_cast<float>(nearest)}), outline);
      }
    }
  }
  for (Cover& cover : covers) {
    const double mean = mean_of(cover.outside);  // in the order of the samples
    table.add({characters, cover.name, clips.size(), seconds, cover.bytes / seconds / 1000,
               cover.bytes / covers[2].bytes, millimetres * mean, millimetres * cover.outside_at(0.99),
               millimetres * cover.outside_at(1), millimetres * cover.most_uncovered});
  }
}

/// Returns how long one of so many takes, on one thread; NaN of none.
template <class Work>
double microseconds_of(std::size_t count, Work work) {
  if (count == 0) return unknown;
  return tbb::task_arena(1).execute([&] {
    const bench::Stopwatch watch(1);
    work();
    return watch.nanoseconds() / 1000 / static_cast<double>(count);
  });
}

/// Compares first_contact() with samples of the nearest pose; the times of pairs that touch, and of those that do not, aside.
void measure_contacts(Run& run, const bench::MotionScene& scene) {
  scene.check(checked_pairs);
  Table table({"samples a second", "pair", "first contact (s)", "first sample that collides (s)"});
  Table costs({"how", "pairs", "a pair (us)"});
  std::vector<double> found(scene.pairs().size());
  const auto time = [&](const std::string& how, const auto& search) {
    for (const bool touching : {false, true}) {
      const std::vector<Pair> asked = scene.pairs(touching);
      costs.add({how, touching ? "touching" : "free", microseconds_of(asked.size(), [&] { search(asked); })});
    }
    search(scene.pairs());
  };
  time("first contact", [&](std::span<const Pair> pairs) {
    first_contact(scene.motions(), pairs, bench::MotionScene::interval, std::span(found).first(pairs.size()));
  });
  const std::vector<double> times = found;
  for (const double rate : sample_rates) {
    const bench::SampledMotions sampled(scene, rate, rate);
    time(fmt::format("{:g} samples a second", rate), [&](std::span<const Pair> pairs) {
      std::ranges::transform(pairs, found.begin(),
                             [&](const Pair& pair) { return sampled.first_contact(pair); });
    });
    for (std::size_t i = 0; i < found.size(); ++i) table.add({rate, i, times[i], found[i]});
  }
  run.write("motions_contacts", table);
  run.write("motions_costs", costs);
}

/// The protocol of distances at detection, at random times between keys: by shapes that are built for that very time, and by animated ones.
void measure_slides(Run& run, std::span<const AnimatedClip> clips) {
  detail::Random random(run.seed());
  std::vector<Shape> animated;
  std::vector<baselines::Body> bodies;
  for (std::uint32_t i = 0; i < std::min(run.sizes().poses, most_costly_poses); ++i) {
    const AnimatedClip& clip = clips[random.below(static_cast<std::uint32_t>(clips.size()))];
    const auto time = static_cast<float>(random.uniform(clip.seconds));
    PoseShaper shaper(*clip.character);
    detail::Skinner skinner(*clip.character);
    const auto positions = skinner.pose({clip.clip, time});
    bodies.push_back(
        {{positions.begin(), positions.end()}, clip.character->triangles, shaper.shape({clip.clip, time})});
    animated.push_back(clip.shape.shape(double{time}));
  }
  const SlideCases cases(shapes_of(bodies), run.sizes().cases, run.seed());
  const ShapeSet built_set(shapes_of(bodies)), animated_set(animated);
  const std::vector<Subject> subjects = {subject_of("outlines of the time", built_set, {}),
                                         subject_of("shape built for the time", built_set),
                                         subject_of("animated shape", animated_set)};
  SubjectTables tables(run);
  tables.add(subjects);
  const auto places = tables.slide(cases, *baselines::fcl_mesh_distances(bodies));
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (!std::isnan(places[0][i]) && !(places[2][i] <= places[0][i]))
      throw std::logic_error(fmt::format("motions: case {} touches later than its outlines", i));
  tables.write("motions");
}

/// Compares with the outlines of poses at every millisecond.
void add_lateness(const Run& run, std::span<const AnimatedClip> clips, const std::string& characters,
                  Table& table) {
  const bench::MotionScene scene(clips, std::min(10'000u, 500 * run.sizes().poses), run.seed());
  const bench::SampledMotions outlines(scene, 1000, 1000, bench::SampledAs::outlines);
  std::vector<double> meetings(scene.pairs().size()), ahead;
  tbb::parallel_for(std::size_t{0}, meetings.size(),
                    [&](std::size_t i) { meetings[i] = outlines.first_contact(scene.pairs()[i]); });
  std::size_t late = 0;
  double latest = 0;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (std::isinf(meetings[i])) continue;
    const double behind = scene.contacts()[i] - meetings[i];
    if (behind > 0)
      ++late, latest = std::max(latest, behind);
    else
      ahead.push_back(-behind);
  }
  table.add({characters, clips.size(), scene.pairs().size(), scene.pairs(true).size(), ahead.size() + late,
             1000 * mean_of(ahead), late, 1000 * latest});
}

}  // namespace

void run_motions(Run& run) {
  Table storage({"characters", "clips as", "clips", "seconds", "kB a second", "over poses at 30 a second",
                 "discs outside of the outline, mean (mm)", "99 % (mm)", "most (mm)",
                 "outline outside of the cover, most (mm)"});
  Table late({"characters", "clips", "pairs", "contacts", "outlines meet", "contact ahead of that, mean (ms)",
              "later than a sample of the outlines", "by at most (ms)"});
  const auto add = [&](std::span<const AnimatedClip> clips, const std::string& characters) {
    add_storage(run, clips, characters, storage);
    add_lateness(run, clips, characters, late);
  };
  const std::vector<AnimatedClip> clips =
      bench::animated_clips(run.scene.characters(), "", clip_seconds(run, 0.015));
  add(clips, "of the scene");
  measure_slides(run, clips);
  if (!run.real_characters.empty())
    add(bench::animated_clips(run.real_characters, "", clip_seconds(run, 0.015 / 4)), "real");
  run.write("motions_storage", storage);
  run.write("motions_late", late);
  const std::vector<AnimatedClip> walks =
      bench::animated_clips(run.scene.characters(), "walk", clip_seconds(run, 0.12));
  measure_contacts(run, bench::MotionScene(walks, run.sizes().cases, run.seed()));
}

}  // namespace bch::report
