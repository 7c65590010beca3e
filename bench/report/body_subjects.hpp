// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <bch/bodies.hpp>

#include "baselines/ragdoll.hpp"
#include "bench/report/subjects.hpp"

// What animated people can be: outlines, capsules on bones, spheres. As subjects, with what a pose costs.

namespace bch::report {

/// Makes the shape of a number anew, from the transforms of joints to what can be asked.
using MakePose = std::function<void(std::size_t shape)>;

/// Represents a kind of bodies that is asked, and posed where that is timed.
struct BodySubject {
  Subject subject;
  MakePose pose;  ///< or none
  bool knows_heights = true;
};

/// Makes bodies of all shapes of a scene, and owns them.
class BodySubjects {
 public:
  explicit BodySubjects(bench::Scene& scene);

  /// Adds outlines with exact leaves.
  void add_outlines();
  /// Adds ragdolls of 15 and 32 capsules, each thin, holding all vertices in the poses of the fit, and halfway between; and 64 to 512
  /// spheres.
  void add_ragdolls_and_spheres(std::uint32_t max_spheres);
  /// Adds the meshes themselves.
  void add_meshes();

  const std::vector<BodySubject>& all() const { return all_; }

 private:
  void add_ragdolls(std::uint32_t capsules);
  void add_spheres(std::uint32_t spheres);

  bench::Scene& scene_;
  std::vector<std::vector<Affine3d>> joints_;  ///< one a shape, as of WorldPose
  std::deque<ShapeSet> sets_;
  std::deque<BodySet> bodies_;
  std::deque<std::unique_ptr<baselines::Structure>> structures_;
  std::vector<BodySubject> all_;
};

}  // namespace bch::report
