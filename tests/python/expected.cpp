// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <bch/bch.hpp>

#include "tests/support/scenes.hpp"

// Writes a random scene, and what the C++ library answers to it, for the tests of the Python package: a set, and a file of numbers
// for each array. Usage: python_expected FOLDER

namespace bch {
namespace {

class Folder {
 public:
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

  template <class Value>
  void write(const std::string& name, std::span<const Value> values) const {
    std::ofstream stream(file(name), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(values.data()),
                 static_cast<std::streamsize>(values.size_bytes()));
    if (!stream.flush()) throw std::runtime_error("cannot write " + file(name).string());
  }
  template <class Value>
  void write(const std::string& name, const std::vector<Value>& values) const {
    write(name, std::span<const Value>(values));
  }
  /// Depths, and the directions' components.
  void write(const std::string& name, const std::vector<Penetration>& depths) const {
    std::vector<double> numbers;
    for (const auto& [depth, x, y] : depths)
      numbers.insert(numbers.end(), {static_cast<double>(depth), x, y});
    write(name, numbers);
  }

 private:
  std::filesystem::path path_;
};

constexpr const char* walls_text = "LINESTRING(-40 0, 40 1) POLYGON((-9 -9, 9 -9, 9 9, -9 9))";

struct Scene {
  test::Random random{285};
  const ShapeSet set{test::synthetic_shapes(284, 12), {.depths = {0, 3, all_depths}}};
  test::Crowd crowd;
  std::vector<Pair> pairs;
  std::vector<double> x, y;
  std::vector<Vec2> directions;

  Scene() {
    for (int i = 0; i < 1'000; ++i)
      crowd.add({random.below(12), random.uniform(-25, 25), random.uniform(-25, 25), random.uniform(-7, 7),
                 static_cast<std::uint8_t>(random.below(3))});
    pairs = candidate_pairs(set, crowd.agents(), 0.4);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      x.push_back(random.uniform(-2, 2)), y.push_back(random.uniform(-2, 2));
      directions.push_back({static_cast<float>(x.back()), static_cast<float>(y.back())});
    }
  }
};

void write_scene(const Scene& scene, const Folder& to) {
  save_baked(to.file("set.bch"), scene.set);
  to.write("shape", scene.crowd.shape);
  to.write("x", scene.crowd.x);
  to.write("y", scene.crowd.y);
  to.write("heading", scene.crowd.heading);
  to.write("level", scene.crowd.level);
  to.write("pairs", scene.pairs);
  to.write("way_x", scene.x);
  to.write("way_y", scene.y);
  to.write("directions", scene.directions);
}

void answer_pairs(const Scene& scene, const Folder& to) {
  const Agents agents = scene.crowd.agents();
  const std::size_t n = scene.pairs.size();
  std::vector<std::uint8_t> hits(n);
  collide(scene.set, agents, scene.pairs, hits);
  to.write("collide", hits);
  collide(scene.set, agents, scene.pairs, hits, {.semantics = Semantics::solid, .leaves = Leaves::discs});
  to.write("collide_solid_discs", hits);
  const double near[] = {0.2};
  within(scene.set, agents, scene.pairs, near, hits);
  to.write("within", hits);
  std::vector<float> distance(n);
  std::vector<Vec2> direction(n);
  std::vector<DiscPair> discs(n);
  std::vector<NearestPoints> points(n);
  clearance(scene.set, agents, scene.pairs, {distance}, {.max_distance = 0.3, .overlap = Overlap::deepest});
  to.write("clearance_deepest", distance);
  clearance(scene.set, agents, scene.pairs, {distance, direction, discs, points},
            {.distance_leaves = Leaves::segments});
  to.write("clearance", distance);
  to.write("direction", direction);
  to.write("discs", discs);
  to.write("points", points);
  std::vector<Penetration> depths(n);
  penetration(scene.set, agents, scene.pairs, 16, depths);
  to.write("penetration", depths);
  penetration_along(scene.set, agents, scene.pairs, scene.directions, depths);
  to.write("penetration_along", depths);
  time_of_impact(scene.set, agents, scene.pairs, {scene.x, scene.y}, distance);
  to.write("time_of_impact", distance);
}

void answer_crowd(const Scene& scene, const Folder& to) {
  const Agents agents = scene.crowd.agents();
  const ObstacleSet walls = obstacles_from_wkt(walls_text);
  CrowdCollider collider;
  const CrowdCollisions all = collider.collide_all(scene.set, agents, walls, {.semantics = Semantics::solid});
  to.write("neighbour_offsets", all.agents.offsets);
  to.write("neighbours", all.agents.values);
  to.write("touched_offsets", all.obstacles.offsets);
  to.write("touched", all.obstacles.values);
  ContactFinder finder;
  const CrowdContacts contacts = finder.find_all(scene.set, agents);
  to.write("contact_pairs", contacts.pairs);
  to.write("contact_offsets", contacts.contacts.offsets);
  to.write("contacts", contacts.contacts.values);

  std::vector<std::uint8_t> hits(agents.size());
  collide(scene.set, agents, walls, hits);
  to.write("wall_collide", hits);
  const std::vector<double> near(agents.size(), 0.25), way_x(agents.size(), 1.5), way_y(agents.size(), -0.5);
  within(scene.set, agents, walls, near, hits);
  to.write("wall_within", hits);
  std::vector<float> distance(agents.size());
  clearance(scene.set, agents, walls, {distance});
  to.write("wall_clearance", distance);
  std::vector<Penetration> depths(agents.size());
  penetration(scene.set, agents, walls, depths);
  to.write("wall_penetration", depths);
  time_of_impact(scene.set, agents, {way_x, way_y}, walls, distance);
  to.write("wall_time_of_impact", distance);
}

/// A post that bends in the middle, as the test in Python makes it.
Character bending_post() {
  Character of;
  of.name = "post";
  of.joints = {{"foot", -1, {}}, {"knee", 0, {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}}}}};
  of.bones = {{0, {}}, {1, {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -1}}}}};
  of.vertices = {{-0.25f, 0, 0}, {0.25f, 0, 0}, {0.25f, 0.125f, 1}, {-0.25f, 0.125f, 1}, {0, 0.25f, 2}};
  of.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}};
  of.influence_begin = {0, 1, 2, 4, 6, 7};
  of.influences = {{0, 1}, {0, 1}, {0, 0.5f}, {1, 0.5f}, {0, 0.25f}, {1, 0.75f}, {1, 1}};
  Channel channel;
  channel.joint = 1;
  channel.positions = {{0, {0, 0, 1}}, {1, {0, 0.5f, 1}}};
  channel.position_curve = {Interpolation::cubic, {{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 0, 0}}}};
  channel.rotations = {{0, {0, 0, 0, 1}}, {1, {0, 0.6f, 0, 0.8f}}};
  channel.scales = {{0, {1, 1, 1}}, {0.5f, {1, 2, 1}}};
  channel.scale_curve.interpolation = Interpolation::step;
  of.clips = {{"bend", 1, {channel}}};
  of.root_joint = 0;
  validate(of);
  return of;
}

void make_scenes(const Folder& to) {
  const Character post = bending_post();
  PoseShaper bent(post);
  std::vector<Shape> posts;
  for (const PoseTime& at : {PoseTime{}, {0, 0.25f}, {0, 0.75f}}) posts.push_back(bent.shape(at));
  save_baked(to.file("posts.bch"), ShapeSet(posts));

  const Character people[] = {default_male(), default_female()};
  std::vector<SceneAgent> agents;
  for (std::uint32_t i = 0; i < 100; ++i)
    agents.push_back({{i % 2, {i % 3, 0.25f * static_cast<float>(i % 7)}}, 0.3 * i, 0.05 * i});
  const ScenePlan plan = plan_scene(agents, {.density_depth = depth_at_density,
                                             .slices = standing_slices(3),
                                             .whole_from = 20,
                                             .pose_step = 0.5f,
                                             .pairs_per_shape = 20});
  to.write("agent_shape", plan.agent_shape);
  to.write("agent_level", plan.agent_level);
  PoseShaper shapers[] = {PoseShaper(people[0], plan.set), PoseShaper(people[1], plan.set)};
  std::vector<Shape> shapes;
  for (const ShapeSource& source : plan.shapes)
    shapes.push_back(shapers[source.character].shape(source.at, source.whole));
  save_baked(to.file("scene.bch"), ShapeSet(shapes, plan.set));

  std::vector<float> planes;
  for (int i = 1; i < 18; ++i) planes.push_back(0.1f * static_cast<float>(i));
  std::vector<Shape> bodies;
  for (const Character& character : people) {
    PoseShaper shaper(character, {.slices = planes});
    for (const PoseTime& at : sample_poses(character, 5)) bodies.push_back(shaper.shape(at));
  }
  to.write("planes", planes);
  to.write("best_slices", best_slices(bodies, planes, 3));
}

}  // namespace
}  // namespace bch

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: python_expected FOLDER\n", stderr), 2;
  const bch::Scene scene;
  const bch::Folder to(argv[1]);
  write_scene(scene, to);
  answer_pairs(scene, to);
  answer_crowd(scene, to);
  make_scenes(to);
  return 0;
}
