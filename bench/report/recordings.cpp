// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <bch/collide.hpp>
#include <bch/hierarchy.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"
#include "bench/report/experiment.hpp"
#include "bench/report/statistics.hpp"
#include "bench/report/words.hpp"
#include "kernel/check/check.hpp"

// Bodies on recorded people, who never overlap, so that whatever does is a false alarm; and on simulated ones, who do.

namespace bch::report {
namespace {

using detail::CheckedFrame;
using detail::CheckedPerson;
using detail::OverlapCount;
using detail::OverlapCounts;

constexpr double near = 1.2;              // metres, of pairs
constexpr double simulator_radius = 0.2;  // metres, of many simulators' agents
constexpr const char* of_people = "people";
constexpr const char* all_recordings = "all of people";

/// A recording of the test data, and what its file does not say.
struct Source {
  const char* file;
  const char* made_by;
  detail::TrajectoryOptions options = {};
};

std::vector<Source> sources() {
  return {{"juelich_bottleneck_040_c_56_h.txt", of_people},
          {"juelich_unidirectional_uo-050-180-180.txt", of_people, {.fps = 16, .unit = 0.01}},
          {"data_archive_00_01a.h5", of_people},
          {"single_file_n56_cam1.csv", of_people, {.fps = 25}},
          {"jpscore_corner_traj.txt", "simulator"},
          {"jupedsim_v2_demo.sqlite", "simulator"},
          {"pathfinder.csv", "simulator"}};
}

/// How bodies are tested.
struct Bodies {
  const char* name;
  std::uint32_t depth;
  Leaves leaves;
  std::vector<float> slices = {};
};

std::vector<Bodies> bodies() {
  return {{"single cylinder of the pose", 0, Leaves::discs},
          {"depth 3", 3, Leaves::discs},
          {"depth 6", 6, Leaves::discs},
          {"all depths", all_depths, Leaves::discs},
          {"segments", all_depths, Leaves::segments},
          {"4 slabs", all_depths, Leaves::segments, {0.4f, 0.85f, 1.05f}}};
}

/// Fixed cylinders of everybody, by their indices in detail::compared_discs.
constexpr std::array<std::size_t, 2> fixed{1, 3};

std::string fixed_name(std::size_t disc) {
  return fmt::format("fixed cylinder {:.2f} m", detail::compared_discs[disc]);
}

double square_distance(const CheckedPerson& a, const CheckedPerson& b) {
  const double x = a.walker.x - b.walker.x, y = a.walker.y - b.walker.y;
  return x * x + y * y;
}

/// Neighbours of some frames, whose test is timed where there are enough.
class TimedPairs {
 public:
  TimedPairs(const Sizes& sizes, std::int64_t last_frame) : sizes_(sizes), last_frame_(last_frame) {}

  /// Takes a frame; times the pairs once there are enough, or at the end.
  void add(const CheckedFrame& frame, const ShapeSet& shapes, Leaves leaves) {
    if (time_ || frame.people.empty()) return;
    const std::uint32_t given_up = frame.people[0].pose - frame.people[0].shape;
    if (given_up != given_up_) clear();  // their shapes are gone
    given_up_ = given_up;
    const auto first = static_cast<std::uint32_t>(shape_.size());
    for (const CheckedPerson& person : frame.people) {
      shape_.push_back(person.shape);
      x_.push_back(person.walker.x), y_.push_back(person.walker.y);
      heading_.push_back(person.walker.heading);
    }
    for (std::uint32_t i = 0; i < frame.people.size(); ++i)
      for (std::uint32_t j = i + 1; j < frame.people.size(); ++j)
        if (square_distance(frame.people[i], frame.people[j]) <= near * near)
          pairs_.push_back({first + i, first + j});
    if (pairs_.size() >= sizes_.pairs || frame.frame == last_frame_) measure(shapes, leaves);
  }

  /// Nanoseconds a pair; NaN where nothing was timed.
  double time() const { return time_.value_or(std::nan("")); }
  double time_of_cylinder(std::size_t k) const { return cylinder_times_[k]; }

 private:
  void clear() { shape_.clear(), x_.clear(), y_.clear(), heading_.clear(), pairs_.clear(); }

  double time_of(const ShapeSet& shapes, std::span<const std::uint32_t> shape, Leaves leaves) const {
    std::vector<std::uint8_t> answers(pairs_.size());
    std::vector<double> times;
    oneapi::tbb::task_arena one(1);
    for (std::uint32_t run = 0; run < sizes_.runs; ++run)
      one.execute([&] {
        const bench::Stopwatch watch(1);
        collide(shapes, {shape, x_, y_, heading_}, pairs_, answers,
                {.semantics = Semantics::solid, .leaves = leaves});
        times.push_back(watch.nanoseconds() / static_cast<double>(pairs_.size()));
      });
    return quartiles(times).median;
  }

  void measure(const ShapeSet& shapes, Leaves leaves) {
    if (pairs_.empty()) return;
    time_ = time_of(shapes, shape_, leaves);
    const std::vector<std::uint32_t> same(shape_.size(), 0);
    for (std::size_t k = 0; k < fixed.size(); ++k) {
      Shape disc;
      disc.hierarchy = fixed_cylinder(static_cast<float>(detail::compared_discs[fixed[k]]));
      cylinder_times_[k] = time_of(ShapeSet({&disc, 1}), same, Leaves::discs);
    }
  }

  const Sizes& sizes_;
  const std::int64_t last_frame_;
  std::uint32_t given_up_ = 0;
  std::vector<std::uint32_t> shape_;
  std::vector<double> x_, y_, heading_;
  std::vector<Pair> pairs_;
  std::optional<double> time_;
  std::array<double, fixed.size()> cylinder_times_{};
};

/// The pairs of a frame in overlap whose centres are so far apart that discs of the simulators' radius are clear.
std::uint64_t hidden_pairs(const CheckedFrame& frame) {
  const auto of = [&](std::int64_t id) -> const CheckedPerson& {
    return *std::lower_bound(
        frame.people.begin(), frame.people.end(), id,
        [](const CheckedPerson& person, std::int64_t wanted) { return person.walker.id < wanted; });
  };
  std::uint64_t count = 0;
  for (const detail::CheckedPair& pair : frame.pairs) {
    if (!pair.overlap || pair.is_wall) continue;
    const double distance = square_distance(of(pair.first), of(pair.second));
    count += distance > 4 * simulator_radius * simulator_radius && distance <= near * near;
  }
  return count;
}

/// What a kind of bodies says of a recording.
struct Outcome {
  OverlapCount all;
  OverlapCounts by_density;
  std::uint64_t hidden = 0;
  double fps = 1, time = std::nan("");
  std::array<double, fixed.size()> cylinder_times{};
};

std::unique_ptr<detail::TrajectoryReader> open(const Run& run, const Source& source) {
  return detail::open_trajectory(run.recordings() / source.file, source.options);
}

/// The recordings that are there and not too long.
std::vector<Source> wanted(const Run& run) {
  std::vector<Source> kept;
  for (const Source& source : sources())
    if (std::filesystem::exists(run.recordings() / source.file) &&
        open(run, source)->info().rows <= run.sizes().rows)
      kept.push_back(source);
  return kept;
}

Outcome outcome_of(const Run& run, const Source& source, const Bodies& of) {
  const auto reader = open(run, source);
  detail::CheckOptions options;
  options.plan = {.depths = {of.depth}, .slices = of.slices};
  options.leaves = of.leaves;
  Outcome outcome;
  TimedPairs timed(run.sizes(), reader->info().last_frame);
  const detail::CheckSummary summary =
      detail::check(*reader, options, [&](const CheckedFrame& frame, const ShapeSet& shapes) {
        outcome.hidden += hidden_pairs(frame);
        timed.add(frame, shapes, of.leaves);
      });
  outcome.all = summary.all, outcome.by_density = summary.by_density;
  outcome.fps = reader->info().fps, outcome.time = timed.time();
  for (std::size_t k = 0; k < fixed.size(); ++k) outcome.cylinder_times[k] = timed.time_of_cylinder(k);
  return outcome;
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::nan("") : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Counts of one of the compared discs in the places of those of bodies.
OverlapCount of_disc(OverlapCount count, std::size_t disc) {
  count.overlapping = count.discs[disc], count.overlapping_pairs = count.disc_pairs[disc];
  return count;
}

/// The two tables of the experiment.
class Tables {
 public:
  void add(const Source& source, const std::string& structure, const OverlapCount& all, double fps,
           double hidden, double time) {
    summary_.add({source.file, source.made_by, structure, static_cast<double>(all.people) / fps,
                  percent(all.overlapping, all.people), all.near_pairs,
                  percent(all.overlapping_pairs, all.near_pairs), hidden, time});
  }
  void add(const std::string& recording, const std::string& structure, const OverlapCounts& counts) {
    for (std::size_t k = 0; k < counts.size(); ++k)
      if (counts[k].people > 0)
        densities_.add({recording, structure, detail::density_classes[k], counts[k].people,
                        percent(counts[k].overlapping, counts[k].people), counts[k].near_pairs,
                        percent(counts[k].overlapping_pairs, counts[k].near_pairs)});
  }
  void write(const Run& run) const {
    run.write("recordings", summary_);
    run.write("recordings_density", densities_);
  }

 private:
  Table summary_{{"recording", "made by", "structure", "person-seconds", "in overlap (% of person-seconds)",
                  "neighbours", "in overlap (% of neighbours)",
                  "in overlap and clear as discs of 0.20 m (% of neighbours)", "ns/pair"}};
  Table densities_{{"recording", "structure", "from people per m2", "person-frames",
                    "in overlap (% of person-frames)", "neighbours", "in overlap (% of neighbours)"}};
};

OverlapCounts of_disc(OverlapCounts counts, std::size_t disc) {
  for (OverlapCount& count : counts) count = of_disc(count, disc);
  return counts;
}

void add_fixed(const Source& source, const Outcome& outcome, Tables& tables) {
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    tables.add(source, fixed_name(fixed[k]), of_disc(outcome.all, fixed[k]), outcome.fps, std::nan(""),
               outcome.cylinder_times[k]);
    tables.add(source.file, fixed_name(fixed[k]), of_disc(outcome.by_density, fixed[k]));
  }
}

void run_recordings(Run& run) {
  const std::vector<Source> recorded = wanted(run);
  if (recorded.empty()) return;
  const std::vector<Bodies> compared = bodies();
  std::vector<OverlapCounts> together(compared.size());
  Tables tables;
  double done = 0;
  for (const Source& source : recorded)
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const Outcome outcome = outcome_of(run, source, compared[i]);
      if (i == 0) add_fixed(source, outcome, tables);
      tables.add(source, compared[i].name, outcome.all, outcome.fps,
                 percent(outcome.hidden, outcome.all.near_pairs), outcome.time);
      tables.add(source.file, compared[i].name, outcome.by_density);
      for (std::size_t k = 0; k < together[i].size() && source.made_by == of_people; ++k)
        together[i][k] += outcome.by_density[k];
      run.done(++done / static_cast<double>(recorded.size() * compared.size()));
    }
  for (const std::size_t disc : fixed)
    tables.add(all_recordings, fixed_name(disc), of_disc(together[0], disc));
  for (std::size_t i = 0; i < compared.size(); ++i) tables.add(all_recordings, compared[i].name, together[i]);
  tables.write(run);
}

/// The least and the greatest share of all recordings that were made by "people" or a "simulator", in a column: "people: segments".
std::string range_in(const Results& results, std::string_view of, std::string_view column) {
  const Table& table = results("recordings");
  const std::size_t colon = of.find(": ");
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    if (table.text(i, "made by") != of.substr(0, colon) || table.text(i, "structure") != of.substr(colon + 2))
      continue;
    least = std::min(least, table.number(i, column));
    most = std::max(most, table.number(i, column));
  }
  return fmt::format("{} to {}", brief(least), brief(most));
}

std::string overlapping(const Results& results, std::string_view of) {
  return range_in(results, of, "in overlap (% of neighbours)");
}

std::string hidden(const Results& results, std::string_view of) {
  return range_in(results, of, "in overlap and clear as discs of 0.20 m (% of neighbours)");
}

std::string time_of_pair(const Results& results, std::string_view of) {
  return range_in(results, of, "ns/pair");
}

}  // namespace

const Experiment recordings_experiment{"recordings",
                                       "Recorded people",
                                       40,
                                       false,
                                       run_recordings,
                                       {{"neighbours in overlap", overlapping},
                                        {"hidden neighbours", hidden},
                                        {"time of neighbours", time_of_pair}}};

}  // namespace bch::report
