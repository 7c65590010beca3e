// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/pairs.hpp>
#include <bch/shapes.hpp>

#include "baselines/structure.hpp"
#include "bench/characters/characters.hpp"
#include "bench/characters/shape_table.hpp"
#include "bench/workload/workload.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::bench {

/// A query that the scalar reference, which knows discs alone, answers as well.
constexpr detail::AllOptions disc_query{.leaves = Leaves::discs};

/// Returns "discs" or "segments".
std::string_view name_of(Leaves leaves);

struct SceneOptions {
  std::vector<std::string> characters = {"default:male", "default:female"};  ///< as load_character() takes
  std::uint32_t poses = 100;                                                 ///< of a character
  std::optional<std::uint64_t> pose_seed =
      {};  ///< draws the poses at random; none: they lie evenly over the clips
  WorkloadSizes sizes;
  bool draft_models = false;  ///< of spheres: made in seconds
};

/// Holds everything that benchmarks measure on. Each thing is made when it is first asked for and kept, so a
/// benchmark that the filter leaves out costs nothing. Shapes are contour hierarchies with a threshold of 1
/// cm. For one thread.
class Scene {
 public:
  explicit Scene(SceneOptions options);

  const std::vector<cli::LoadedCharacter>& characters();
  std::uint32_t poses() const { return options_.poses; }          ///< of a character
  std::uint32_t agents() const { return options_.sizes.agents; }  ///< of a crowd
  const std::vector<PoseId>& sources();
  const std::vector<Shape>& shapes();
  const std::vector<baselines::Body>& bodies();
  /// Returns models of so many spheres, one a character.
  const std::vector<BodyModel>& models(std::uint32_t spheres);
  /// Returns the bodies of spheres of all sources.
  BodySet bodies(std::uint32_t spheres);
  /// Returns a set of the finest level alone, with all that queries may ask.
  const ShapeSet& set();
  const baselines::Structure& structure(std::string_view kind);
  /// Returns a workload. Errors: throws std::invalid_argument on a name that workload_names() does not have.
  const Workload& workload(std::string_view name);

  /// Returns a kind's answers, at all depths.
  const Hits& hits(std::string_view kind, const Workload& workload);
  /// Returns what the kernel must answer, pair by pair and disc by disc: baselines::Reference by brute force.
  const Hits& expected(Leaves leaves, const Workload& workload);
  /// Returns the same of the paper's question: whether outlines cross.
  const Hits& boundary(Leaves leaves, const Workload& workload);

 private:
  Workload make_workload(std::string_view name);

  SceneOptions options_;
  std::vector<cli::LoadedCharacter> characters_;
  std::vector<PoseId> sources_;
  std::vector<Shape> shapes_;
  std::vector<baselines::Body> bodies_;
  std::map<std::uint32_t, std::vector<BodyModel>> models_;
  std::optional<ShapeSet> set_;
  std::map<std::string, std::unique_ptr<baselines::Structure>, std::less<>> structures_;
  std::map<std::string, Workload, std::less<>> workloads_;
  std::map<std::string, Hits> hits_;
};

}  // namespace bch::bench
