// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include <bch/crowd.hpp>

#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/progress.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/cli/crowd.hpp"
#include "kernel/runtime/tasks.hpp"
#include "layout/base/heading.hpp"
#include "layout/body/body_record.hpp"

namespace bch::cli {
namespace {

constexpr double compared_spheres = 2e9;  ///< pairs of spheres that a check compares: a second, or less
/// Metres: nearer to touching, float and double may differ.
constexpr double rounding_band = 1e-5;

void pose(LiveBodies& bodies, std::span<const PoseId> sources, std::vector<Pose>& poses) {
  poses.clear();
  for (const PoseId& source : sources) poses.emplace_back(source.at);
  bodies.pose(poses);
}

/// Returns the least gap between any two spheres of two agents, below 0 where they overlap.
double least_gap(const BodySet& bodies, const Crowd& crowd, Pair pair) {
  const auto turned = [](const Sphere& s, detail::Rotation by) {
    const double x{s.x}, y{s.y};
    return std::pair{by.cosine * x - by.sine * y, by.sine * x + by.cosine * y};
  };
  const auto [a, b] = pair;
  const detail::Rotation of_a = detail::rotation(crowd.heading[a]), of_b = detail::rotation(crowd.heading[b]);
  const std::vector<Sphere> others = bodies.spheres(crowd.shape[b]);
  double least = HUGE_VAL;
  for (const Sphere& s : bodies.spheres(crowd.shape[a])) {
    const auto [x, y] = turned(s, of_a);
    for (const Sphere& t : others) {
      const auto [u, v] = turned(t, of_b);
      const double dx = crowd.x[b] + u - crowd.x[a] - x, dy = crowd.y[b] + v - crowd.y[a] - y,
                   dz = double{t.z} - double{s.z};
      least = std::min(least, std::sqrt(dx * dx + dy * dy + dz * dz) - double{s.radius} - double{t.radius});
    }
  }
  return least;
}

/// Compares candidates, evenly spread, with all spheres against all. Returns how many.
std::size_t require_right(const LiveRun& run) {
  const BodySet& bodies = run.bodies.set();
  const double each = static_cast<double>(run.options.spheres) * run.options.spheres;
  const std::size_t step =
      1 + static_cast<std::size_t>(static_cast<double>(run.candidates.size()) * each / compared_spheres);
  const std::size_t count = (run.candidates.size() + step - 1) / step;
  std::atomic<bool> is_wrong = false;
  detail::run_each(count, [&](std::size_t i) {
    const Pair pair = run.candidates[i * step];
    const double gap = least_gap(bodies, run.crowd.crowd(), pair);
    const bool hit = std::binary_search(run.collisions.begin(), run.collisions.end(), pair, before);
    if (hit ? gap > rounding_band : gap < -rounding_band) is_wrong = true;
  });
  if (is_wrong) throw std::logic_error("collisions differ from those of all spheres against all");
  return count;
}

/// What is drawn of the last frame.
CrowdPicture picture_of(const LiveRun& run) {
  const Crowd& crowd = run.crowd.crowd();
  const BodySet& bodies = run.bodies.set();
  CrowdPicture picture{crowd, run.options.density};
  const auto cylinder = [&bodies](std::uint32_t body) {
    const detail::BodyHeader& header = detail::header_of(bodies.view().record(body));
    return Disc{header.x, header.y, header.radius};
  };
  for (std::uint32_t i = 0; i < bodies.body_count(); ++i) {
    const Disc disc = cylinder(i);
    picture.reach = std::max(picture.reach, std::hypot(double{disc.x}, double{disc.y}) + double{disc.radius});
  }
  const auto shape_builders = std::make_shared<std::vector<ShapeBuilder>>();
  for (const LoadedCharacter& loaded : run.characters) shape_builders->emplace_back(loaded.character);
  picture.body = [&run, &bodies, shape_builders, cylinder](std::uint32_t agent) {
    const PoseId& pose = run.crowd.poses()[agent];
    return DrawnBody{(*shape_builders)[pose.character].make_outline(pose.at).outline, cylinder(agent),
                     bodies.spheres(agent)};
  };
  std::set_difference(run.candidates.begin(), run.candidates.end(), run.collisions.begin(),
                      run.collisions.end(), std::back_inserter(picture.cleared), before);
  picture.colliding = run.collisions;
  picture.key = picture.body(0);
  picture.title = fmt::format("{} agents, {:g} per m²: {} of {} pairs whose cylinders overlap do not collide",
                              grouped(crowd.size()), run.options.density, grouped(picture.cleared.size()),
                              grouped(run.candidates.size()));
  picture.parts_are = fmt::format("Bodies of {}.", counted(run.options.spheres, "sphere"));
  picture.part_name = "sphere";
  return picture;
}

void write_files(const LiveRun& run) {
  const CrowdOptions& options = run.options;
  write_json(options.json, json_report(run));
  if (!options.csv.empty()) write_file(options.csv, csv_of(run.collisions));
  if (!options.svg.empty()) write_file(options.svg, draw_crowd(picture_of(run)));
}

}  // namespace

void run_live_crowd(const CrowdOptions& options) {
  const auto characters = load_characters(options.characters, options.shapes.import_options());
  const Threads threads(options.answer.threads);
  WalkingCrowd crowd(characters, options.agents, options.density, options.seed);
  std::vector<std::uint32_t> model_of_agent;
  for (const PoseId& pose : crowd.poses()) model_of_agent.push_back(pose.character);
  LiveBodies bodies(make_models(characters, options.spheres), model_of_agent);
  const Implementation* const implementation = options.answer.query_options().implementation;
  LiveRun run{options, characters, crowd, bodies, {}, {}, {}, 0, implementation->name, threads.count};
  bch::Crowd finder;
  std::vector<Pose> poses;
  Progress progress("frames", options.frames + 1);
  for (std::uint32_t frame = 0; frame <= options.frames; ++frame) {
    crowd.step();
    const bench::Stopwatch watch(0);
    pose(bodies, crowd.poses(), poses);
    const double posed = watch.nanoseconds();
    const bch::Crowd::Pairs hits = finder.collisions(bodies.set(), crowd.crowd().agents(), implementation);
    const double answered = watch.nanoseconds();
    if (frame > 0)
      run.times.posing.push_back(posed / 1e6), run.times.queries.push_back((answered - posed) / 1e6);
    if (frame == options.frames) run.collisions = sorted(hits);
    progress.advance();
  }
  run.candidates = sorted(finder.candidates(bodies.set(), crowd.crowd().agents()));
  run.checked = require_right(run);
  write_files(run);
  write_standard_output(text_report(run) + notes_text(characters));
}

namespace {

double bytes_per_body(const LiveRun& run) {
  return static_cast<double>(run.bodies.set().bytes()) / run.bodies.set().body_count();
}

struct TimeRow {
  const char* name;
  std::vector<double> milliseconds;

  double least() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }
};

std::vector<TimeRow> rows_of(const FrameTimes& times) {
  return {{"posing", times.posing}, {"queries", times.queries}, {"frame", times.whole()}};
}

}  // namespace

std::vector<double> FrameTimes::whole() const {
  std::vector<double> sums = posing;
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += queries[i];
  return sums;
}

std::string text_report(const LiveRun& run) {
  std::string table = fmt::format("{:<12}{:>9} {:>9}\n", "ms a frame", "median", "least");
  for (const TimeRow& row : rows_of(run.times))
    table += fmt::format("{:<12}{:>9.2f} {:>9.2f}\n", row.name, bench::median(row.milliseconds), row.least());
  return fact("characters", names_of(run.characters)) +
         fact("bodies", fmt::format("{} each, {:.1f} kB each", counted(run.options.spheres, "sphere"),
                                    bytes_per_body(run) / 1e3)) +
         fact("agents", agents_text(run.options, run.crowd.crowd())) +
         fact("frames", fmt::format("{} of 1/60 s, in which everybody is posed anew",
                                    grouped(run.times.posing.size()))) +
         fact("kernel", fmt::format("{}, {}", run.implementation, counted(run.threads, "thread"))) + "\n" +
         table + "\n" +
         fmt::format("{} in the last frame, of {} whose discs meet.\n",
                     counted(run.collisions.size(), "collision"), counted(run.candidates.size(), "pair")) +
         fmt::format("{} compared with brute force: the same answers.\n", counted(run.checked, "pair"));
}

nlohmann::ordered_json json_report(const LiveRun& run) {
  const CrowdOptions& options = run.options;
  nlohmann::ordered_json json{{"program", "bch " BCH_VERSION},
                              {"options",
                               {{"characters", options.characters},
                                {"agents", options.agents},
                                {"density_per_m2", options.density},
                                {"seed", options.seed},
                                {"spheres", options.spheres},
                                {"frames", options.frames}}},
                              {"kernel", {{"implementation", run.implementation}, {"threads", run.threads}}},
                              {"bytes_per_body", bytes_per_body(run)},
                              {"candidate_pairs", run.candidates.size()},
                              {"collisions", run.collisions.size()},
                              {"checked_pairs", run.checked}};
  for (const TimeRow& row : rows_of(run.times))
    json["milliseconds"][row.name] = {{"median", bench::median(row.milliseconds)}, {"least", row.least()}};
  return json;
}

}  // namespace bch::cli
