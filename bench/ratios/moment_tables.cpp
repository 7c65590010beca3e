// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include <bch/broad_phase.hpp>
#include <bch/default_characters.hpp>
#include <bch/pose_shape.hpp>
#include <bch/time_of_impact.hpp>

#include "bench/characters/crowd.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr double rate = 120;                   ///< times a second of the grid
constexpr std::uint32_t steps_of_a_frame = 4;  ///< on the grid: 30 frames a second
constexpr double walking_speed = 1.2;          ///< metres a second
constexpr double most_over_poses = 2;

/// A walking person as poses on a grid of times and as moving discs.
struct Walker {
  std::vector<Shape> poses;
  AnimatedShape animated;
};

Walker walker_of(Sex sex) {
  const Character character = default_pedestrian(sex, 1.75, 0);
  const auto clip = static_cast<std::uint32_t>(std::lround(walking_speed / pedestrian_speed_step));
  Walker walker{{}, AnimatedShape(animate(character, clip))};
  PoseShaper shaper(character);
  for (std::uint32_t i = 0; i < std::floor(walker.animated.end() * rate); ++i)
    walker.poses.push_back(shaper.shape({clip, static_cast<float>(i / rate)}));
  return walker;
}

/// A crowd of walkers, of which each is at a time of the clip.
class WalkingCrowd {
 public:
  explicit WalkingCrowd(std::uint32_t agents) {
    std::vector<Shape> poses;
    for (const Sex sex : {Sex::female, Sex::male}) {
      walkers_.push_back(walker_of(sex));
      first_pose_.push_back(static_cast<std::uint32_t>(poses.size()));
      poses.insert(poses.end(), walkers_.back().poses.begin(), walkers_.back().poses.end());
    }
    poses_.emplace(poses);
    detail::Random random(crowd_seed);
    crowd_ = cli::place_crowd(agents, agents_per_square_metre, 1, crowd_seed);
    for (std::uint32_t i = 0; i < crowd_.size(); ++i) {
      body.push_back(random.below(static_cast<std::uint32_t>(walkers_.size())));
      begin_.push_back(random.below(steps(i)));
      apart_.push_back(random.uniform(1 / rate));
    }
    seconds.resize(crowd_.size()), shape.resize(crowd_.size());
    show_poses(0);
    pairs = candidate_pairs(*poses_, of_shapes(), 0.05);
    hits.resize(pairs.size());
  }

  std::vector<const AnimatedShape*> bodies() const {
    std::vector<const AnimatedShape*> all;
    for (const Walker& walker : walkers_) all.push_back(&walker.animated);
    return all;
  }
  const ShapeSet& poses() const { return *poses_; }
  Agents of_shapes() const { return {shape, crowd_.x, crowd_.y, crowd_.heading}; }

  /// Lets every agent show its pose in a frame.
  void show_poses(std::uint32_t frame) {
    for (std::uint32_t i = 0; i < crowd_.size(); ++i) shape[i] = first_pose_[body[i]] + step(i, frame);
  }
  /// Sets the time of every agent in a frame: on the grid, or its own.
  void set_seconds(std::uint32_t frame, bool own) {
    for (std::uint32_t i = 0; i < crowd_.size(); ++i)
      seconds[i] = step(i, frame) / rate + (own ? apart_[i] : 0);
  }

  std::vector<std::uint32_t> body, shape;
  std::vector<double> seconds;
  std::vector<Pair> pairs;
  Hits hits;

 private:
  std::uint32_t steps(std::uint32_t agent) const {
    return static_cast<std::uint32_t>(walkers_[body[agent]].poses.size());
  }
  std::uint32_t step(std::uint32_t agent, std::uint32_t frame) const {
    return (begin_[agent] + frame * steps_of_a_frame) % steps(agent);
  }

  std::vector<Walker> walkers_;
  std::vector<std::uint32_t> first_pose_, begin_;  ///< of walkers; of agents: a time of the grid
  std::vector<double> apart_;                      ///< of agents: from the grid, seconds
  std::optional<ShapeSet> poses_;
  cli::Crowd crowd_;
};

/// What is done in a frame.
enum class Asked { poses, shown, grid, own };

/// Culling data does not pay for a moment that one agent shows in one frame; outlines are not asked for.
ShapeSetPlan plan_for(Asked asked) {
  return {.outlines = asked != Asked::own, .culling = asked != Asked::own};
}

/// A crowd, whose next frame each call asks about.
class Frames {
 public:
  Frames(std::shared_ptr<WalkingCrowd> crowd, Asked asked)
      : crowd_(std::move(crowd)), asked_(asked), moments_(crowd_->bodies(), plan_for(asked)) {}

  void next() {
    ++frame_;
    if (asked_ == Asked::poses) {
      crowd_->show_poses(frame_);
      return answer(crowd_->poses());
    }
    if (asked_ == Asked::shown && !shape_.empty()) {  // collide() alone
      std::copy(shape_.begin(), shape_.end(), crowd_->shape.begin());
      return answer(moments_.set());
    }
    crowd_->set_seconds(frame_, asked_ == Asked::own);
    moments_.show(crowd_->body, crowd_->seconds, crowd_->shape);
    shape_ = crowd_->shape;
    answer(moments_.set());
  }

  /// Throws std::runtime_error if a pair is not answered as the reference does of shapes of these times.
  void check() {
    next();
    if (asked_ == Asked::poses) return;
    std::vector<Shape> shapes(moments_.set().shape_count());
    for (std::uint32_t i = 0; i < crowd_->body.size(); ++i)
      if (Shape& shape = shapes[crowd_->shape[i]]; shape.hierarchy.nodes.empty())
        crowd_->bodies()[crowd_->body[i]]->shape(crowd_->seconds[i], shape);
    for (Shape& unused : shapes)
      if (unused.hierarchy.nodes.empty()) unused = shapes[crowd_->shape[0]];
    const baselines::Reference reference(shapes, {}, Leaves::discs);
    const std::string wrong =
        wrong_answers(reference, crowd_->of_shapes(), crowd_->pairs, crowd_->hits, Semantics::boundary);
    if (!wrong.empty()) throw std::runtime_error("moments: " + wrong);
  }

  std::size_t pairs() const { return crowd_->pairs.size(); }
  double moments() const { return moments_.set().shape_count(); }

 private:
  void answer(const ShapeSet& set) {
    collide(set, crowd_->of_shapes(), crowd_->pairs, crowd_->hits, disc_query);
  }

  std::shared_ptr<WalkingCrowd> crowd_;
  Asked asked_;
  MomentSet moments_;
  std::uint32_t frame_ = 0;
  std::vector<std::uint32_t> shape_;  ///< of agents: in the last frame
};

Contender contender_of(const Shared<WalkingCrowd>& crowd, Asked asked) {
  const auto frames = std::make_shared<Frames>(crowd.get(), asked);
  frames->check();
  // Until every place is large enough.
  for (int i = 0; i < 30; ++i) frames->next();
  return {[frames] { frames->next(); }, frames->pairs(), {{"moments", frames->moments()}}};
}

void print_moments(const Results& results) {
  const double poses = results.at("moments/poses").nanoseconds;
  fmt::print(
      "{} near pairs of a crowd of walkers; ns a pair to answer, with what makes the shapes of a frame\n",
      results.at("moments/poses").items);
  fmt::print("  poses baked at {} a second   {:9.1f}\n", rate, poses);
  const auto row = [&](const char* name, const char* what) {
    const Timing& timing = results.at(name);
    const double times = timing.nanoseconds / poses;
    fmt::print("  {}{:9.1f}   {:.2f} x   {:.0f} places   {}\n", what, timing.nanoseconds, times,
               timing.counters.at("moments"), verdict_at_most(times, most_over_poses));
  };
  row("moments/shown", "moments, without showing them ");
  row("moments/grid", "times on the grid             ");
  row("moments/own", "a time of its own each        ");
}

}  // namespace

std::vector<Table> moment_tables(Suite& suite, Scene& scene) {
  const Shared<WalkingCrowd> crowd([&scene] { return std::make_shared<WalkingCrowd>(scene.agents()); });
  const std::pair<const char*, Asked> all[] = {{"moments/poses", Asked::poses},
                                               {"moments/shown", Asked::shown},
                                               {"moments/grid", Asked::grid},
                                               {"moments/own", Asked::own}};
  for (const auto& each : all)
    suite.add(each.first, [crowd, asked = each.second] { return contender_of(crowd, asked); });
  return {{"moments", "^moments/", print_moments}};
}

}  // namespace bch::bench
