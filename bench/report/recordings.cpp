// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/check.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <bch/hierarchy.hpp>
#include <bch/pairs.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/report.hpp"

// Bodies on recorded people, who never overlap, so that whatever does is a false alarm, and beside them on simulated ones; and what
// a simulator's own radius hides: bodies that overlap while the discs that it moves are clear of each other, and the other way round.

namespace bch::report {
namespace {

using detail::CheckedFrame;
using detail::CheckedPerson;
using detail::OverlapCount;

constexpr double near = 1.2;  // metres, of neighbours

/// A recording of the test data, and what its file does not say.
struct Source {
  const char *file, *made_by;
  detail::TrajectoryOptions options = {};
};

/// How bodies are tested.
struct Bodies {
  const char* name;
  std::uint32_t depth = all_depths;
  Leaves leaves = Leaves::segments;
  detail::CheckOptions options() const {
    detail::CheckOptions options;
    options.plan = {.depths = {depth}};
    options.leaves = leaves;
    return options;
  }
};
const Bodies outlines{"segments"};

/// Fixed cylinders of everybody, by their indices in detail::compared_discs.
constexpr std::array<std::size_t, 2> fixed{1, 3};

std::string fixed_name(std::size_t disc) {
  return fmt::format("fixed cylinder {:.2f} m", detail::compared_discs[disc]);
}

std::unique_ptr<detail::TrajectoryReader> open(const Run& run, const Source& source) {
  return detail::open_trajectory(run.options.recordings / source.file, source.options);
}

/// The recordings that are there and not too long.
std::vector<Source> wanted_sources(const Run& run) {
  std::vector<Source> sources = {
      {"juelich_bottleneck_040_c_56_h.txt", "people"},
      {"juelich_unidirectional_uo-050-180-180.txt", "people", {.fps = 16, .unit = 0.01}},
      {"data_archive_00_01a.h5", "people"},
      {"single_file_n56_cam1.csv", "people", {.fps = 25}},
      {"jpscore_corner_traj.txt", "simulator"},
      {"jupedsim_v2_demo.sqlite", "simulator"},
      {"pathfinder.csv", "simulator"}};
  std::erase_if(sources, [&](const Source& source) {
    return !std::filesystem::exists(run.options.recordings / source.file) ||
           open(run, source)->info().rows > run.sizes().rows;
  });
  return sources;
}

double square_distance(const CheckedPerson& a, const CheckedPerson& b) {
  const double x = a.walker.x - b.walker.x, y = a.walker.y - b.walker.y;
  return x * x + y * y;
}

/// Neighbours of some frames, whose test is timed where there are enough.
class TimedPairs {
 public:
  TimedPairs(const Run& run, std::int64_t last_frame) : sizes_(run.sizes()), last_frame_(last_frame) {}

  /// Takes a frame; times the pairs once there are enough, or at the end.
  void add(const CheckedFrame& frame, const ShapeSet& shapes, Leaves leaves) {
    if (!times_.empty() || frame.people.empty()) return;
    const std::uint32_t given_up = frame.people[0].pose - frame.people[0].shape;
    if (given_up != given_up_) crowd_ = {}, pairs_.clear();  // their shapes are gone
    given_up_ = given_up;
    const auto first = static_cast<std::uint32_t>(crowd_.size());
    for (const CheckedPerson& person : frame.people) {
      crowd_.shape.push_back(person.shape), crowd_.heading.push_back(person.walker.heading);
      crowd_.x.push_back(person.walker.x), crowd_.y.push_back(person.walker.y);
    }
    for (std::uint32_t i = 0; i < frame.people.size(); ++i)
      for (std::uint32_t j = i + 1; j < frame.people.size(); ++j)
        if (square_distance(frame.people[i], frame.people[j]) <= near * near)
          pairs_.push_back({first + i, first + j});
    if (!pairs_.empty() && (pairs_.size() >= sizes_.pairs || frame.frame == last_frame_))
      measure(shapes, leaves);
  }

  /// Nanoseconds a pair in each run; none where nothing was timed.
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& times_of_cylinder(std::size_t k) const { return cylinder_times_[k]; }

 private:
  std::vector<double> times_of(const ShapeSet& shapes, Leaves leaves) const {
    std::vector<std::uint8_t> answers(pairs_.size());
    std::vector<double> times;
    oneapi::tbb::task_arena one(1);
    for (std::uint32_t run = 0; run < sizes_.runs; ++run)
      one.execute([&] {
        const bench::Stopwatch watch(1);
        collide(shapes, crowd_.agents(), pairs_, answers, {.leaves = leaves});
        times.push_back(watch.nanoseconds() / static_cast<double>(pairs_.size()));
      });
    return times;
  }

  void measure(const ShapeSet& shapes, Leaves leaves) {
    times_ = times_of(shapes, leaves);
    crowd_.shape.assign(crowd_.size(), 0);
    for (std::size_t k = 0; k < fixed.size(); ++k) {
      Shape disc;
      disc.hierarchy = fixed_cylinder(static_cast<float>(detail::compared_discs[fixed[k]]));
      cylinder_times_[k] = times_of(ShapeSet({&disc, 1}), Leaves::discs);
    }
  }

  const Sizes& sizes_;
  const std::int64_t last_frame_;
  std::uint32_t given_up_ = 0;
  cli::Crowd crowd_;
  std::vector<Pair> pairs_;
  std::vector<double> times_;
  std::array<std::vector<double>, fixed.size()> cylinder_times_;
};

/// The two tables of the experiment `recordings`.
struct RecordingTables {
  Table counts{{"recording", "made by", "structure", "from people per m2", "person-frames",
                "in overlap (person-frames)", "neighbours", "in overlap (neighbours)"}};
  Table times{{"recording", "structure", "run", "ns/pair"}};

  /// `overlaps`: returns the overlapping person-frames and neighbours of a count.
  template <class Overlaps>
  void add(const Source& source, const std::string& structure, const detail::CheckSummary& summary,
           std::span<const double> taken, Overlaps overlaps) {
    for (std::size_t k = 0; k < summary.by_density.size(); ++k) {
      const OverlapCount& count = summary.by_density[k];
      const auto [people, pairs] = overlaps(count);
      counts.add({source.file, source.made_by, structure, detail::density_classes[k], count.people, people,
                  count.near_pairs, pairs});
    }
    for (std::size_t i = 0; i < taken.size(); ++i) times.add({source.file, structure, i, taken[i]});
  }
};

void check_recording(const Run& run, const Source& source, const Bodies& bodies, bool with_fixed,
                     RecordingTables& tables) {
  const auto reader = open(run, source);
  TimedPairs timed(run, reader->info().last_frame);
  const detail::CheckSummary summary = detail::check(
      *reader, bodies.options(),
      [&](const CheckedFrame& frame, const ShapeSet& shapes) { timed.add(frame, shapes, bodies.leaves); });
  for (std::size_t k = 0; k < fixed.size() && with_fixed; ++k)
    tables.add(
        source, fixed_name(fixed[k]), summary, timed.times_of_cylinder(k),
        [&](const OverlapCount& all) { return std::pair(all.discs[fixed[k]], all.disc_pairs[fixed[k]]); });
  tables.add(source, bodies.name, summary, timed.times(),
             [](const OverlapCount& all) { return std::pair(all.overlapping, all.overlapping_pairs); });
}

/// How often neither bodies nor the simulator's discs overlap, the bodies alone, the discs alone, and both.
using Verdicts = std::array<std::uint64_t, 4>;

/// Compares the overlaps of bodies with those of discs of one radius.
class DiscComparison {
 public:
  explicit DiscComparison(double radius) : square_reach_(4 * radius * radius) {}

  void add(const CheckedFrame& frame) {
    const auto people = frame.people;
    std::vector<bool> in_discs(people.size());
    auto next = frame.pairs.begin();
    for (std::size_t i = 0; i < people.size(); ++i)
      for (std::size_t k = i + 1; k < people.size(); ++k) {
        const double distance = square_distance(people[i], people[k]);
        const bool discs = distance < square_reach_;
        const float depth = depth_of(frame, next, people[i], people[k]);
        if (discs) in_discs[i] = in_discs[k] = true;
        if (distance <= near * near) ++neighbours_[(depth >= 0) + 2 * discs];
        if (depth < 0 && !discs) continue;
        auto& seen = of_two_[{people[i].walker.id, people[k].walker.id}];
        seen.first |= depth >= 0, seen.second |= discs;
        if (!discs) deepest_ = std::max(deepest_, depth);
      }
    for (std::size_t i = 0; i < people.size(); ++i) ++people_[people[i].overlaps + 2 * in_discs[i]];
  }

  void write(Table& table, const Source& source, const Bodies& bodies, double radius) const {
    Verdicts of_two{};  // what is said of two people in the whole recording
    for (const auto& [ids, seen] : of_two_) ++of_two[seen.first + 2 * seen.second];
    for (const auto& [counted, verdicts] :
         {std::pair("neighbours", neighbours_), {"person-frames", people_}, {"encounters", of_two}}) {
      const auto& [neither, bodies_alone, discs_alone, both] = verdicts;
      table.add({source.file, source.made_by, bodies.name, radius, counted,
                 neither + bodies_alone + discs_alone + both, both, bodies_alone, discs_alone,
                 100 * static_cast<double>(deepest_)});
    }
  }

 private:
  using NextPair = std::span<const detail::CheckedPair>::iterator;

  /// Returns how deep the bodies of two people overlap; below 0 where they do not. Asked for in the order of the frame's pairs.
  static float depth_of(const CheckedFrame& frame, NextPair& next, const CheckedPerson& a,
                        const CheckedPerson& b) {
    const auto wanted = std::pair(a.walker.id, b.walker.id);
    const auto is_over = [&](const detail::CheckedPair& pair) {
      return pair.is_wall || !pair.overlap || std::pair(pair.first, pair.second) < wanted;
    };
    while (next != frame.pairs.end() && is_over(*next)) ++next;
    return next != frame.pairs.end() && std::pair(next->first, next->second) == wanted ? next->depth : -1;
  }

  const double square_reach_;
  Verdicts neighbours_{}, people_{};
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<bool, bool>> of_two_;
  float deepest_ = 0;
};

}  // namespace

void run_recordings(Run& run) {
  const Bodies compared[] = {{"single cylinder of the pose", 0, Leaves::discs},
                             {"depth 3", 3, Leaves::discs},
                             {"depth 6", 6, Leaves::discs},
                             {"all depths", all_depths, Leaves::discs},
                             outlines};
  const std::vector<Source> sources = wanted_sources(run);
  if (sources.empty()) return;
  RecordingTables tables;
  for (const Source& source : sources)
    for (const Bodies& bodies : compared) {
      check_recording(run, source, bodies, &bodies == compared, tables);
    }
  run.write("recordings", tables.counts);
  run.write("recordings_times", tables.times);
}

void run_simulated(Run& run) {
  const std::vector<Source> sources = wanted_sources(run);
  if (sources.empty()) return;
  Table table({"recording", "made by", "structure", "radius of discs (m)", "counted", "all", "both overlap",
               "bodies alone", "discs alone", "deepest while discs are clear (cm)"});
  for (const Source& source : sources) {
    DiscComparison comparison(run.sizes().disc_radius);
    const auto reader = open(run, source);
    detail::check(*reader, outlines.options(),
                  [&](const CheckedFrame& frame, const ShapeSet&) { comparison.add(frame); });
    comparison.write(table, source, outlines, run.sizes().disc_radius);
  }
  run.write("simulated", table);
}

}  // namespace bch::report
