// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <optional>
#include <stdexcept>

#include <bch/crowd.hpp>
#include <bch/default_characters.hpp>
#include <bch/pose_shape.hpp>
#include <bch/time_of_impact.hpp>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr double grid_rate = 120;              ///< times a second of the grid
constexpr std::uint32_t steps_of_a_frame = 4;  ///< on the grid: 30 frames a second
constexpr double clip_speed = 1.2;             ///< metres a second
constexpr int frames_to_warm = 30;             ///< until every place is large enough

/// A crowd of walkers, each as poses on a grid of times and as moving discs, of which each agent is at a time of the
/// clip.
struct WalkingCrowd {
  std::vector<AnimatedShape> walkers;
  std::vector<Shape> poses;
  std::vector<std::uint32_t> first_pose{0};  ///< of walkers; then poses.size()
  std::optional<ShapeSet> set_of_poses;
  cli::Crowd crowd;
  std::vector<std::uint32_t> body, begin;  ///< of agents: the latter a time of the grid
  std::vector<double> apart;               ///< of agents: from the grid, seconds
  std::vector<Pair> pairs;

  explicit WalkingCrowd(std::uint32_t agents)
      : crowd(cli::place_crowd(agents, agents_per_square_metre, 1, crowd_seed)) {
    for (const Sex sex : {Sex::female, Sex::male}) add_walker(default_pedestrian(sex, 1.75, 0));
    set_of_poses.emplace(poses);
    detail::Random random(crowd_seed);
    for (std::uint32_t i = 0; i < agents; ++i) {
      body.push_back(random.below(static_cast<std::uint32_t>(walkers.size())));
      begin.push_back(random.below(first_pose[body[i] + 1] - first_pose[body[i]]));
      apart.push_back(random.uniform(1 / grid_rate));
      crowd.shape[i] = first_pose[body[i]] + step(i, 0);
    }
    bch::Crowd finder;
    const CrowdPairs near = finder.candidates(*set_of_poses, crowd.agents(), {.margin = 0.05});
    pairs.assign(near.begin(), near.end());
  }

  void add_walker(const Character& character) {
    const auto clip = static_cast<std::uint32_t>(std::lround(clip_speed / pedestrian_speed_step));
    walkers.emplace_back(animate(character, clip));
    PoseShaper shaper(character);
    for (std::uint32_t i = 0; i < std::floor(walkers.back().end() * grid_rate); ++i)
      poses.push_back(shaper.shape({clip, static_cast<float>(i / grid_rate)}));
    first_pose.push_back(static_cast<std::uint32_t>(poses.size()));
  }

  std::vector<const AnimatedShape*> bodies() const {
    std::vector<const AnimatedShape*> all;
    for (const AnimatedShape& walker : walkers) all.push_back(&walker);
    return all;
  }
  /// Returns which time of the grid an agent is at in a frame.
  std::uint32_t step(std::uint32_t agent, std::uint32_t frame) const {
    return (begin[agent] + frame * steps_of_a_frame) %
           (first_pose[body[agent] + 1] - first_pose[body[agent]]);
  }
};

/// What is done in a frame.
enum class Asked { poses, shown, grid, own };

/// Culling data does not pay for a moment that one agent shows in one frame; outlines are not asked for.
ShapeSetPlan plan_for(Asked asked) {
  return {.outlines = asked != Asked::own, .culling = asked != Asked::own};
}

/// Answers about one frame after the other.
class Frames {
 public:
  Frames(const WalkingCrowd& crowd, Asked asked)
      : crowd_(crowd),
        asked_(asked),
        moments_(crowd.bodies(), plan_for(asked)),
        shape_(crowd.body.size()),
        seconds_(shape_.size()),
        hits_(crowd.pairs.size()) {}

  void next() {
    ++frame_;
    if (asked_ == Asked::poses) {
      for (std::uint32_t i = 0; i < shape_.size(); ++i)
        shape_[i] = crowd_.first_pose[crowd_.body[i]] + crowd_.step(i, frame_);
    } else if (asked_ != Asked::shown || frame_ == 1) {  // else collide() alone
      for (std::uint32_t i = 0; i < shape_.size(); ++i)
        seconds_[i] = crowd_.step(i, frame_) / grid_rate + (asked_ == Asked::own ? crowd_.apart[i] : 0);
      moments_.show(crowd_.body, seconds_, shape_);
    }
    collide(asked_ == Asked::poses ? *crowd_.set_of_poses : moments_.set(), agents(), crowd_.pairs, hits_,
            disc_query);
  }

  /// Throws std::runtime_error if a pair is not answered as the reference does of shapes of these times.
  void check() const {
    const std::string wrong = wrong_answers({shapes(), {}, Leaves::discs}, agents(), crowd_.pairs, hits_);
    if (!wrong.empty()) throw std::runtime_error("moments: " + wrong);
  }

  double places() const { return moments_.set().shape_count(); }

 private:
  Agents agents() const { return {shape_, crowd_.crowd.x, crowd_.crowd.y, crowd_.crowd.heading}; }

  const std::vector<Shape>& shapes() const {
    if (asked_ == Asked::poses) return crowd_.poses;
    shapes_.assign(moments_.set().shape_count(), crowd_.poses[0]);  // also of places that are not used
    for (std::uint32_t i = 0; i < shape_.size(); ++i)
      crowd_.walkers[crowd_.body[i]].shape(seconds_[i], shapes_[shape_[i]]);
    return shapes_;
  }

  const WalkingCrowd& crowd_;
  Asked asked_;
  MomentSet moments_;
  std::uint32_t frame_ = 0;
  std::vector<std::uint32_t> shape_;
  std::vector<double> seconds_;
  Hits hits_;
  mutable std::vector<Shape> shapes_;
};

}  // namespace

void add_moments(Scene& scene) {
  const auto crowd = once([&scene] { return std::make_shared<const WalkingCrowd>(scene.agents()); });
  constexpr std::pair<const char*, Asked> all[] = {{"moments/poses", Asked::poses},
                                                   {"moments/shown", Asked::shown},
                                                   {"moments/grid", Asked::grid},
                                                   {"moments/own", Asked::own}};
  for (const auto& [name, asked] : all)
    add(name, [crowd, asked = asked]() -> Contender {
      const auto frames = std::make_shared<Frames>(crowd(), asked);
      frames->next();
      frames->check();
      for (int i = 0; i < frames_to_warm; ++i) frames->next();
      return {[frames] { frames->next(); }, crowd().pairs.size(), {{"places", frames->places()}}};
    });
}

}  // namespace bch::bench
