// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/pairs.hpp>
#include <bch/shapes.hpp>

#include "baselines/pair_distances.hpp"
#include "baselines/ragdoll.hpp"
#include "baselines/structure.hpp"
#include "bench/characters/crowd.hpp"
#include "bench/report/report.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/base/random.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

// What experiments compare: structures, cuts and sets that answer the same pairs.

namespace bch::report {

/// Answers the pairs of agents.
using Answer =
    std::function<void(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits)>;

/// Represents the cases of the paper's experiment on errors. In each case, two people stand apart, turned at
/// random. The first one slides along the x axis past the second, on a line up to half a metre beside the
/// other, until a collision is detected; then the distance between the two meshes is measured. A case is
/// drawn again where the leaf discs over the outlines do not meet on the way, so that in every case the two
/// collide.
class SlideCases {
 public:
  /// Draws the cases, which are the same for the same shapes and seed everywhere.
  SlideCases(std::span<const Shape> shapes, std::uint32_t cases, std::uint64_t seed);

  std::size_t size() const { return from_.size(); }
  Agents agents() const { return crowd_.agents(); }

  /// Returns where on the x axis the first person is when a collision is detected, metres: one place a case,
  /// NaN where there is none. The answer is asked for at every millimetre, and that interval is then bisected to a
  /// micrometre. Runs on all threads.
  std::vector<double> contacts(const Answer& answer) const;

  /// Returns how far the bodies are from each other at such places, centimetres; 0 where they meet, NaN as
  /// above.
  std::vector<double> distances(const baselines::PairDistances& bodies, std::span<const double> places) const;

 private:
  void draw(detail::Random& random, std::size_t of);

  cli::Crowd crowd_;          ///< agents 2 i and 2 i + 1 are case i
  std::vector<double> from_;  ///< where even boxes about boxes do not meet yet
};

constexpr std::string_view kernel_name = "BCH outline in the batch kernel";
/// The name of the batch kernel with exact leaves.
constexpr std::string_view exact_leaves_name = "BCH outline with exact leaves";
/// Returns the name of a cut of the outline's hierarchy: "single cylinder", "BCH outline to depth 3".
std::string cut_name(std::uint32_t depth);

/// Holds the mean number of tests that a traversal makes of a pair; NaN where it is not counted.
struct MeanTests {
  double nodes = unknown;   ///< of two discs or boxes
  double leaves = unknown;  ///< of two triangles or segments
};

/// Holds the mean size of trees over shapes; NaN of a structure whose tree is not accessible.
struct TreeSize {
  double nodes = unknown;
  double height = unknown;  ///< edges on the longest path from the root to a leaf
};
/// Returns the size of hierarchies.
TreeSize tree_size(std::span<const Shape> shapes);

/// Represents anything that answers pairs: a structure down to some depth, or a kernel over a set.
struct Subject {
  std::string structure;
  std::uint32_t depth;
  Answer answer;
  std::function<MeanTests(const bench::Workload&)> tests;  ///< over its first pairs
  std::string semantics = "boundary", arithmetic = "single";
  TreeSize size = {};
  double bytes = unknown;  ///< of a shape
};

/// Makes a subject, which refers to the structure or set: it must outlive it.
Subject subject_of(std::string_view name, const baselines::Structure& structure,
                   std::uint32_t max_depth = all_depths);
Subject subject_of(std::string_view name, const ShapeSet& set,
                   const detail::AllOptions& query = bench::disc_query, std::uint32_t depth = all_depths);

Subject subject_of(std::string_view name, const BodySet& set);

bench::Hits answers(const Subject& subject, const bench::Workload& workload);

/// Collects the tables of an experiment over subjects, whose rows refer to subjects by number:
///   NAME.csv         what the subjects are
///   NAME_pairs.csv   their hits and tests of the pairs of workloads
///   NAME_times.csv   their times of these pairs, run by run
///   NAME_slides.csv  where people who slide at each other are detected, and how far apart their meshes then are
class SubjectTables {
 public:
  explicit SubjectTables(Run& run) : run_(run) {}

  /// Adds subjects, which all that follows is of. `of`: what they are made of.
  void add(std::span<const Subject> subjects, const std::string& of = "");
  void count_pairs(const bench::Workload& workload);
  /// Times all subjects in turn, so that what slows the machine down for a while slows all of them, and ratios stay.
  void time_pairs(const bench::Workload& workload);
  /// Lets every subject end the slides. Returns: the places, a subject.
  std::vector<std::vector<double>> slide(const SlideCases& cases, const baselines::PairDistances& distances);
  /// Writes the tables, those of slides and pairs where there are some.
  void write(const std::string& name) const;

 private:
  Run& run_;
  std::span<const Subject> subjects_;
  std::size_t first_ = 0, count_ = 0;
  bool has_pairs_ = false, has_slides_ = false;
  Table subjects_table_{{"subject", "of", "structure", "depth", "semantics", "arithmetic", "nodes a shape",
                         "height", "bytes a shape"}};
  Table pairs_{{"subject", "pairs", "asked", "hits", "node tests a pair", "leaf tests a pair"}};
  Table times_{{"subject", "pairs", "run", "ns/pair"}};
  Table slides_{{"subject", "case", "place (m)", "distance (cm)"}};
};

/// Represents a structure by the name that tables have for it.
struct Contender {
  std::string_view name;  ///< "OBB outline"
  std::string_view kind;  ///< of baselines::kinds()
  bool has_depth = false;
  float fixed_radius = 0.25f;
  bool centre = false;  ///< the hierarchy is split in the middle of the extent

  bool is_disc() const { return kind == "single" || kind == "fixed"; }
};

/// Returns the paper's structures, then others; those of FCL only where the build has it.
std::vector<Contender> contenders();

TreeSize tree_size(const Contender& contender, std::span<const baselines::Body> bodies);

/// Holds structures over all bodies of a scene, each made when it is first asked for.
class Structures {
 public:
  explicit Structures(bench::Scene& scene) : scene_(scene) {}

  const baselines::Structure& of(const Contender& contender);
  /// Errors:  throws std::invalid_argument on a name that no contender has.
  const baselines::Structure& of(std::string_view name);

  /// Checks a structure's answers for a workload of the scene.
  /// Errors:  throws std::runtime_error where wrong_structure() finds the answers wrong, or, for hierarchies
  ///          that are not the scene's, where they differ from those of a kernel over the same hierarchies.
  void require_right(const Contender& contender, const bench::Workload& workload,
                     std::uint32_t max_depth = all_depths);

 private:
  bench::Scene& scene_;
  std::vector<baselines::Body> centre_bodies_;
  std::map<std::string, std::unique_ptr<baselines::Structure>, std::less<>> made_;
};

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

/// Returns the bodies with hierarchies of another kind.
std::vector<baselines::Body> with_hierarchies(std::span<const baselines::Body> bodies, float threshold,
                                              detail::SplitRule rule);
/// Returns the shapes of bodies.
std::vector<Shape> shapes_of(std::span<const baselines::Body> bodies);
/// Returns shapes as they are, but with one cylinder around the origin for each.
std::vector<Shape> with_fixed_cylinders(std::span<const Shape> shapes, float radius);

}  // namespace bch::report
