// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/pairs.hpp>
#include <bch/shapes.hpp>

#include "baselines/reference.hpp"
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

/// Checks the kernel's answers: the same bits as brute force over all discs, on every pair.
std::string wrong_kernel(Scene& scene, const Workload& workload, Leaves leaves, const Hits& hits);

/// Checks answers for shapes and levels that belong to no scene: equal to the reference going depth first, on
/// every pair.
std::string wrong_answers(const baselines::Reference& reference, const Agents& agents,
                          std::span<const Pair> pairs, const Hits& hits);

/// Checks a structure's answers by the properties in its row of baselines::kinds():
///   exact                  equal to the first other kind of the same truth
///   mesh, projection       outlines or meshes that meet are seen by what projects them
///   never_misses_outlines  1 wherever the outlines meet
///   reference              the same bits as brute force over all discs, where outlines cross
///   reference_segments     the same bits as brute force over all segments, and containment
///   paper_descent          1 wherever the reference says so
/// An exact structure that went down to max_depth only must not miss anything that it sees at all depths.
std::string wrong_structure(Scene& scene, const Workload& workload, const baselines::Kind& kind,
                            const Hits& hits, std::uint32_t max_depth = all_depths);

/// Represents something to be timed, whose answers were compared.
struct Contender {
  std::function<void()> call;
  std::size_t items = 1;                        ///< of a call: pairs, agents or poses
  std::map<std::string, double> counters = {};  ///< what else is worth telling
};

/// Checks that nothing is wrong: throws std::runtime_error if `wrong` is not empty.
void require_right(std::string_view name, const Workload& workload, const std::string& wrong);

/// Returns whether this build has the kind.
bool has_kind(std::string_view kind);

}  // namespace bch::bench
