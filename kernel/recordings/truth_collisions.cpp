// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/truth_collisions.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "kernel/broad_phase/pair_limit.hpp"

namespace bch::detail {
namespace {

TrajectoryReader& of_rate(TrajectoryReader& truth, double fps) {
  if (truth.info().fps == fps) return truth;
  std::ostringstream text;
  text << truth.place_of(0) << ": has " << truth.info().fps << " frames a second, and the prediction " << fps;
  throw TrajectoryError(std::move(text).str());
}

std::vector<LibraryMotion> joined(std::vector<LibraryMotion> first,
                                  const std::vector<LibraryMotion>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

TruthCollisions::TruthCollisions(TrajectoryReader& truth, const TrajectoryInfo& predicted,
                                 const CheckOptions& options)
    : options_(options),
      true_motions_(library_motions(truth.info().motions, options_.library, options_.footprints)),
      motions_(
          joined(library_motions(predicted.motions, options_.library, options_.footprints), true_motions_)),
      truth_(of_rate(truth, predicted.fps), options_.facing),
      run_(options_, true_motions_, {}),
      shapes_(options_.plan, options_.library, motions_, options_.baked) {
  require_people(truth.info().motions, options_);
  if (!options_.bodies.empty()) bodies_.emplace(options_.bodies, options_.library);
}

void TruthCollisions::add(const CheckedFrame& frame) {
  now_ = {};
  for (std::size_t i = 0; i < frame.people.size(); ++i) {
    const Walker& walker = frame.people[i].walker;
    now_.predicted.push_back({walker.id, walker.x, walker.y, walker.heading, frame.poses[i]});
  }
  read_truth(frame.frame);
  find(halfway(last_.predicted, now_.predicted), halfway(last_.true_ones, now_.true_ones));
  find(now_.predicted, now_.true_ones);
  std::swap(last_, now_);
}

void TruthCollisions::read_truth(std::int64_t frame) {
  while (!is_over_ && (block_.frames() == 0 || block_.frame(0) < frame)) read_next();
  if (is_over_ || block_.frame(0) > frame) return;
  ++frames_;
  run_.look(block_, 0, 1);
  for (std::size_t i = 0; i < block_.begin(1); ++i) {
    const Walker& walker = block_.people()[i];
    Person& person =
        now_.true_ones.emplace_back(Person{walker.id, walker.x, walker.y, walker.heading, run_.poses()[i]});
    if (person.pose.footprint != WalkerPose::on_foot)
      person.pose.footprint += static_cast<std::uint32_t>(motions_.size() - true_motions_.size());
  }
}

/// Reads until a block begins with the next frame; the last block has no other.
void TruthCollisions::read_next() {
  is_over_ = at_end_;
  if (at_end_) return;
  at_end_ = next_block_.read(truth_, 1, block_);
  std::swap(block_, next_block_);
}

/// Returns the people who are there before and after, in the middle of their way, but those who jump.
std::vector<TruthCollisions::Person> TruthCollisions::halfway(std::span<const Person> from,
                                                              std::span<const Person> to) {
  std::vector<Person> people;
  auto before = from.begin();
  for (const Person& person : to) {
    while (before != from.end() && before->id < person.id) ++before;
    if (before == from.end() || before->id > person.id) continue;
    const double x = person.x - before->x, y = person.y - before->y;
    if (x * x + y * y > FrameRun::farthest_step * FrameRun::farthest_step) continue;
    Person& middle = people.emplace_back(*before);
    middle.x += x / 2, middle.y += y / 2;
  }
  return people;
}

/// Finds who collides with anybody else.
void TruthCollisions::find(std::span<const Person> predicted, std::span<const Person> others) {
  if (predicted.empty() || others.empty()) return;
  find_discs(predicted, {others.begin(), others.end()});
  std::vector<Person> all(predicted.begin(), predicted.end());
  all.insert(all.end(), others.begin(), others.end());
  std::vector<WalkerPose> poses;
  poses.reserve(all.size());
  for (const Person& person : all) poses.push_back(person.pose);
  if (bodies_) {
    bodies_->prepare(poses);
    return find_overlaps(RunSpheres(*bodies_, poses, poses.size()), all, predicted.size());
  }
  std::vector<std::uint32_t> shapes(poses.size());
  shapes_.find(poses, shapes);
  find_overlaps(RunOutlines(shapes_.set(), options_.leaves, shapes), all, predicted.size());
}

void TruthCollisions::find_discs(std::span<const Person> predicted, std::vector<Person> others) {
  constexpr double touching = 2 * measured_disc;
  std::sort(others.begin(), others.end(),
            [](const Person& a, const Person& b) { return a.x != b.x ? a.x < b.x : a.id < b.id; });
  for (const Person& own : predicted) {
    auto other = std::lower_bound(others.begin(), others.end(), own.x - touching,
                                  [](const Person& person, double x) { return person.x < x; });
    for (; other != others.end() && other->x <= own.x + touching; ++other) {
      const double x = other->x - own.x, y = other->y - own.y;
      if (other->id == own.id || x * x + y * y > touching * touching) continue;
      disc_colliding_.insert(static_cast<std::uint64_t>(own.id));
      break;
    }
  }
}

/// Finds the overlaps of the first people with the others, who are as they truly went.
void TruthCollisions::find_overlaps(const RunBodies& bodies, std::span<const Person> all,
                                    std::size_t predicted) {
  std::vector<double> x, y, heading;
  for (const Person& person : all)
    x.push_back(person.x), y.push_back(person.y), heading.push_back(person.heading);
  const Agents agents{bodies.numbers(), x, y, heading};
  const std::size_t most = options_.max_pairs > 0 ? options_.max_pairs : usual_max_pairs(all.size());
  std::vector<Pair> pairs;
  try {
    for (const auto [first, second] : phase_.find(bodies.roots(), agents, 0, most)) {
      const Pair pair{std::min(first, second), std::max(first, second)};
      if (pair.first < predicted && pair.second >= predicted && all[pair.first].id != all[pair.second].id)
        pairs.push_back(pair);
    }
  } catch (const std::length_error&) {
    throw TooManyPairs("prediction and truth: more than " + std::to_string(most) +
                       " pairs of people of a frame are near each other");
  }
  std::vector<std::uint8_t> hits(pairs.size());
  bodies.collide(agents, pairs, hits);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (hits[i] != 0) colliding_.insert(static_cast<std::uint64_t>(all[pairs[i].first].id));
}

}  // namespace bch::detail
