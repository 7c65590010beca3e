// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/subjects.hpp"

#include <algorithm>
#include <array>

#include <bch/poses.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

#include "bench/base/stopwatch.hpp"

namespace bch::report {
namespace {

constexpr double shape_threshold = 0.01;  // metres
/// The poses that ragdolls are fitted to, of a character.
constexpr std::uint32_t fitted_poses = 12;

/// Makes shapes of one character ready for a set, pose by pose.
struct ShapeWorkshop {
  ShapeBuilder shape_builder;
  BuiltShape prepared{ShapeSetPlan{}};

  explicit ShapeWorkshop(const Character& character)
      : shape_builder(character, {}, static_cast<float>(shape_threshold)) {}
};

/// Returns something of each character of a scene.
template <class Make>
auto of_each_character(bench::Scene& scene, Make make) {
  std::vector<decltype(make(scene.characters()[0].character))> all;
  for (const cli::LoadedCharacter& loaded : scene.characters()) all.push_back(make(loaded.character));
  return all;
}

using Capsules = std::vector<baselines::Capsule>;

Capsules capsules_of(const Character& character, std::uint32_t count) {
  std::vector<std::vector<Affine3d>> poses;
  for (const PoseTime at : sample_poses(character, fitted_poses))
    poses.push_back(joint_transforms(character, at, JointFrame::world));
  return baselines::fit_ragdoll(character, poses, count);
}

}  // namespace

BodySubjects::BodySubjects(bench::Scene& scene) : scene_(scene) {
  for (const PoseId& source : scene.sources())
    joints_.push_back(
        joint_transforms(scene.characters()[source.character].character, source.at, JointFrame::world));
}

void BodySubjects::add_outlines() {
  const ShapeSet& set = sets_.emplace_back(scene_.shapes(), ShapeSetPlan{});
  Subject subject = subject_of(std::string(exact_leaves_name), set, {.leaves = Leaves::segments});
  subject.bytes = static_cast<double>(set.bytes()) / set.shape_count();
  const auto workshops = std::make_shared<std::vector<ShapeWorkshop>>(
      of_each_character(scene_, [](const Character& character) { return ShapeWorkshop(character); }));
  all_.push_back({std::move(subject),
                  [this, workshops](std::size_t shape) {
                    ShapeWorkshop& of = (*workshops)[scene_.sources()[shape].character];
                    of.prepared.prepare(of.shape_builder.shape(WorldPose{joints_[shape]}), shape);
                  },
                  false});
}

void BodySubjects::add_meshes() {
  all_.push_back({subject_of("OBB full mesh", scene_.structure("obb_full")), {}});
}

void BodySubjects::add_ragdolls_and_spheres(std::uint32_t max_spheres) {
  for (const std::uint32_t capsules : {15u, 32u}) add_ragdolls(capsules);
  for (const std::uint32_t spheres : {64u, 128u, 256u, 512u})
    if (spheres <= max_spheres) add_spheres(spheres);
}

void BodySubjects::add_spheres(std::uint32_t spheres) {
  const std::vector<BodyModel>& models = scene_.models(spheres);
  const BodySet& bodies = bodies_.emplace_back(scene_.bodies(spheres));
  Subject subject = subject_of(fmt::format("{} spheres", spheres), bodies);
  subject.bytes = static_cast<double>(bodies.bytes()) / bodies.body_count();
  const auto singles = std::make_shared<std::vector<LiveBodies>>();
  for (std::uint32_t model = 0; model < models.size(); ++model)
    singles->emplace_back(models, std::span(&model, 1));
  all_.push_back({std::move(subject), [this, singles](std::size_t shape) {
                    const Pose pose{WorldPose{joints_[shape]}};
                    (*singles)[scene_.sources()[shape].character].pose({&pose, 1});
                  }});
}

void BodySubjects::add_ragdolls(std::uint32_t capsules) {
  struct Growth {
    std::string_view name;
    float grown;
  };
  const auto ragdolls = std::make_shared<std::vector<Capsules>>(of_each_character(
      scene_, [&](const Character& character) { return capsules_of(character, capsules); }));
  const auto pose = [this, ragdolls](std::size_t shape, float grown, baselines::PosedRagdoll& posed) {
    const std::uint32_t of = scene_.sources()[shape].character;
    baselines::pose_ragdoll(scene_.characters()[of].character, (*ragdolls)[of], joints_[shape], grown, posed);
  };
  for (const auto& [name, grown] :
       std::array<Growth, 3>{{{"thin", 0}, {"between", 0.5f}, {"holding all", 1}}}) {
    std::vector<baselines::PosedRagdoll> posed(joints_.size());
    for (std::size_t i = 0; i < posed.size(); ++i) pose(i, grown, posed[i]);
    const auto bytes = static_cast<double>(posed[0].bytes());
    const auto& structure = *structures_.emplace_back(baselines::ragdoll_structure(std::move(posed)));
    Subject subject = subject_of(fmt::format("{} capsules, {}", capsules, name), structure);
    subject.bytes = bytes;
    subject.semantics = "solid";
    all_.push_back({std::move(subject), [pose, grown = grown, kept = baselines::PosedRagdoll()](
                                            std::size_t shape) mutable { pose(shape, grown, kept); }});
  }
}

namespace {

constexpr std::size_t warming_poses = 10;

/// Adds what each subject that knows heights says of the pairs, of which `meshes` are those whose meshes meet.
void add_hits(Table& table, std::string_view ground, const std::vector<BodySubject>& all,
              const bench::Workload& pairs, const bench::Hits& meshes) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!pairs.crowd.z.empty() && !all[i].knows_heights) continue;
    const bench::Hits hits = answers(all[i].subject, pairs);
    std::size_t wrong = 0, missed = 0;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      wrong += hits[k] > meshes[k] ? 1 : 0;
      missed += hits[k] < meshes[k] ? 1 : 0;
    }
    table.add({i, ground, hits.size(), std::ranges::count(meshes, 1), wrong, missed});
  }
}

/// Times a pose, all kinds in turn in every run; a few poses before it bring code and data into caches.
Table pose_times(const std::vector<BodySubject>& all, std::size_t shapes, std::uint32_t runs) {
  Table table({"subject", "run", "pose (us)"});
  for (std::uint32_t run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].pose) continue;
      for (std::size_t shape = 0; shape < shapes; shape += std::max<std::size_t>(1, shapes / warming_poses))
        all[i].pose(shape);
      const bench::Stopwatch watch(1);
      for (std::size_t shape = 0; shape < shapes; ++shape) all[i].pose(shape);
      table.add({i, run, watch.nanoseconds() / 1000 / static_cast<double>(shapes)});
    }
  return table;
}

}  // namespace

/// The error of each kind of bodies, with the time of a pair, the bytes of a pose and the time to make one.
void run_bodies(Run& run) {
  BodySubjects bodies(run.scene);
  bodies.add_outlines();
  bodies.add_ragdolls_and_spheres(run.sizes().max_spheres);
  bodies.add_meshes();
  std::vector<Subject> subjects;
  for (const BodySubject& body : bodies.all()) subjects.push_back(body.subject);

  const bench::Workload& crowd = run.scene.workload("crowd");
  SubjectTables tables(run);
  tables.add(subjects);
  tables.time_pairs(crowd);
  tables.slide(SlideCases(run.scene.shapes(), run.sizes().cases, run.seed()),
               *baselines::fcl_mesh_distances(run.scene.bodies()));
  tables.write("bodies");
  Table hits({"subject", "ground", "asked", "meshes meet", "false hits", "missed"});
  add_hits(hits, "level", bodies.all(), crowd, run.scene.hits("obb_full", crowd));
  const bench::Workload stairs = bench::on_stairs(crowd);
  add_hits(hits, "stairs", bodies.all(), stairs, answers(subjects.back(), stairs));
  run.write("bodies_hits", hits);
  run.write("bodies_poses", pose_times(bodies.all(), run.scene.shapes().size(), run.sizes().runs));
}

}  // namespace bch::report
