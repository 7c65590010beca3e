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
#include "bench/report/recorded_crowds.hpp"
#include "bench/report/statistics.hpp"
#include "kernel/recordings/check.hpp"

// Bodies on recorded people, who never overlap, so that whatever does is a false alarm; and beside them on simulated ones.

namespace bch::report {
namespace {

using detail::CheckedFrame;
using detail::CheckedPerson;
using detail::OverlapCount;
using detail::OverlapCounts;

constexpr const char* all_recordings = "all of people";

/// Fixed cylinders of everybody, by their indices in detail::compared_discs.
constexpr std::array<std::size_t, 2> fixed{1, 3};

std::string fixed_name(std::size_t disc) {
  return fmt::format("fixed cylinder {:.2f} m", detail::compared_discs[disc]);
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

/// What a kind of bodies says of a recording.
struct BodyOverlaps {
  OverlapCount all;
  OverlapCounts by_density;
  double time = std::nan("");
  std::array<double, fixed.size()> cylinder_times{};
};

BodyOverlaps outcome_of(const Run& run, const Source& source, const Bodies& of) {
  const auto reader = open(run, source);
  BodyOverlaps outcome;
  TimedPairs timed(run.sizes(), reader->info().last_frame);
  const detail::CheckSummary summary = detail::check(
      *reader, of.options(),
      [&](const CheckedFrame& frame, const ShapeSet& shapes) { timed.add(frame, shapes, of.leaves); });
  outcome.all = summary.all, outcome.by_density = summary.by_density;
  outcome.time = timed.time();
  for (std::size_t k = 0; k < fixed.size(); ++k) outcome.cylinder_times[k] = timed.time_of_cylinder(k);
  return outcome;
}

/// Counts of one of the compared discs in the places of those of bodies.
OverlapCount of_disc(OverlapCount count, std::size_t disc) {
  count.overlapping = count.discs[disc], count.overlapping_pairs = count.disc_pairs[disc];
  return count;
}

/// The two tables of the experiment.
class RecordingTables {
 public:
  void add(const Source& source, const std::string& structure, const OverlapCount& all, double time) {
    summary_.add({source.file, std::string(source.made_by), structure, all.people,
                  percent(all.overlapping, all.people), all.near_pairs,
                  percent(all.overlapping_pairs, all.near_pairs), time});
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
  Table summary_{{"recording", "made by", "structure", "person-frames", "in overlap (% of person-frames)",
                  "neighbours", "in overlap (% of neighbours)", "ns/pair"}};
  Table densities_{{"recording", "structure", "from people per m2", "person-frames",
                    "in overlap (% of person-frames)", "neighbours", "in overlap (% of neighbours)"}};
};

OverlapCounts of_disc(OverlapCounts counts, std::size_t disc) {
  for (OverlapCount& count : counts) count = of_disc(count, disc);
  return counts;
}

void add_fixed(const Source& source, const BodyOverlaps& outcome, RecordingTables& tables) {
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    tables.add(source, fixed_name(fixed[k]), of_disc(outcome.all, fixed[k]), outcome.cylinder_times[k]);
    tables.add(source.file, fixed_name(fixed[k]), of_disc(outcome.by_density, fixed[k]));
  }
}

void run_recordings(Run& run) {
  const std::vector<Source> recorded = wanted_sources(run);
  if (recorded.empty()) return;
  const std::vector<Bodies> compared = all_bodies();
  std::vector<OverlapCounts> together(compared.size());
  RecordingTables tables;
  double done = 0;
  for (const Source& source : recorded)
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const BodyOverlaps outcome = outcome_of(run, source, compared[i]);
      if (i == 0) add_fixed(source, outcome, tables);
      tables.add(source, compared[i].name, outcome.all, outcome.time);
      tables.add(source.file, compared[i].name, outcome.by_density);
      for (std::size_t k = 0; k < together[i].size() && source.made_by == made_by_people; ++k)
        together[i][k] += outcome.by_density[k];
      run.done(++done / static_cast<double>(recorded.size() * compared.size()));
    }
  for (const std::size_t disc : fixed)
    tables.add(all_recordings, fixed_name(disc), of_disc(together[0], disc));
  for (std::size_t i = 0; i < compared.size(); ++i) tables.add(all_recordings, compared[i].name, together[i]);
  tables.write(run);
}

std::string overlapping(const Results& results, std::string_view of) {
  return range_in(results("recordings"), of, "in overlap (% of neighbours)");
}

std::string time_of_pair(const Results& results, std::string_view of) {
  return range_in(results("recordings"), of, "ns/pair");
}

}  // namespace

const Experiment recordings_experiment{
    "recordings",
    "Recorded people",
    40,
    false,
    run_recordings,
    {{"neighbours in overlap", overlapping}, {"time of neighbours", time_of_pair}}};

}  // namespace bch::report
