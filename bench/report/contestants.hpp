// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "baselines/structure.hpp"
#include "bench/workload/scene.hpp"

namespace bch::report {

/// Represents a structure by the name that tables have for it.
struct Contestant {
  std::string_view name;  ///< "OBB outline"
  std::string_view kind;  ///< of baselines::kinds()
  bool centre = false;    ///< the hierarchy is split in the middle of the extent
  float fixed_radius = 0.25f;
  bool has_depth = false;
  bool projected = true;  ///< never sees less than what the meshes cover seen from above
};

/// Returns the paper's structures, then others; those of FCL only where the build has it.
std::vector<Contestant> contestants();

/// Holds structures over all bodies of a scene, each made when it is first asked for.
class Contestants {
 public:
  explicit Contestants(bench::Scene& scene) : scene_(scene) {}

  const baselines::Structure& structure(const Contestant& contestant);
  const baselines::Structure& structure(std::string_view name);

  /// Checks a structure's answers for a workload of the scene.
  /// Errors:  throws std::runtime_error where wrong_structure() finds the answers wrong, or, for hierarchies
  ///          that are not the scene's, where they differ from those of a kernel over the same hierarchies.
  void require_right(const Contestant& contestant, const bench::Workload& workload,
                     std::uint32_t max_depth = all_depths);

 private:
  bench::Scene& scene_;
  std::vector<baselines::Body> centre_bodies_;
  std::map<std::string, std::unique_ptr<baselines::Structure>, std::less<>> made_;
};

/// Returns the bodies with hierarchies of another kind.
std::vector<baselines::Body> with_hierarchies(std::span<const baselines::Body> bodies, float threshold,
                                              SplitRule rule);

/// Returns shapes as they are, but with one cylinder around the origin for each.
std::vector<Shape> with_fixed_cylinders(std::span<const Shape> shapes, float radius);

}  // namespace bch::report
