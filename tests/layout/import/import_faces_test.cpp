// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/polygon.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/collada_file.hpp"
#include "tests/support/fbx_text.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// Faces of more than three corners: each simple one is covered once, wherever its corners lie.

namespace bch {
namespace {

using Grid = std::array<int, 2>;
using Polygon = std::vector<Grid>;

int cross(const Grid& a, const Grid& b, const Grid& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int doubled_area(const Polygon& p) {
  int area = 0;
  for (std::size_t i = 2; i < p.size(); ++i) area += cross(p[0], p[i - 1], p[i]);
  return area;
}

bool is_on(const Grid& a, const Grid& b, const Grid& p) {
  const auto between = [&](int axis) {
    return std::min(a[axis], b[axis]) <= p[axis] && p[axis] <= std::max(a[axis], b[axis]);
  };
  return cross(a, b, p) == 0 && between(0) && between(1);
}

bool meet(const Grid& a, const Grid& b, const Grid& c, const Grid& d) {
  if (is_on(a, b, c) || is_on(a, b, d) || is_on(c, d, a) || is_on(c, d, b)) return true;
  const auto differ = [](int x, int y) { return (x < 0) != (y < 0); };
  return differ(cross(a, b, c), cross(a, b, d)) && differ(cross(c, d, a), cross(c, d, b));
}

bool is_simple(const Polygon& p) {
  const std::size_t size = p.size();
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i + 1; j < size; ++j) {
      const Grid &a = p[i], &b = p[(i + 1) % size], &c = p[j], &d = p[(j + 1) % size];
      const bool follows = j == i + 1, precedes = (j + 1) % size == i;
      if (a == c || (follows && (is_on(a, b, d) || is_on(c, d, a))) ||
          (precedes && (is_on(a, b, c) || is_on(c, d, b))) || (!follows && !precedes && meet(a, b, c, d)))
        return false;
    }
  return doubled_area(p) != 0;
}

Polygon random_polygon(test::Random& random) {
  Polygon polygon(4 + random.below(6));
  const std::uint32_t side = 3 + random.below(4);
  for (Grid& corner : polygon)
    corner = {static_cast<int>(random.below(side)), static_cast<int>(random.below(side))};
  return polygon;
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// In a plane that leans or stands, far from the origin.
Triangles cut(const Polygon& polygon, std::uint32_t plane) {
  std::vector<Vec3> vertices;
  for (const auto& [x, y] : polygon) {
    const float u = 0.25f * static_cast<float>(x), v = 0.25f * static_cast<float>(y);
    vertices.push_back(plane == 0 ? Vec3{u, v, u + v} : plane == 1 ? Vec3{v, 1e5f, u} : Vec3{3, u, 1e5f + v});
  }
  std::vector<std::uint32_t> corners(polygon.size());
  std::iota(corners.begin(), corners.end(), 0u);
  Triangles triangles;
  detail::importing::append_triangles_of(vertices, corners, triangles);
  return triangles;
}

TEST(Faces, SimplePolygonsAreCoveredOnceAndCornersOnEdgesKept) {
  test::Random random(1);
  std::size_t tried = 0;
  for (std::uint32_t i = 0; tried < 5000; ++i) {
    const Polygon polygon = random_polygon(random);
    if (!is_simple(polygon)) continue;
    ++tried;
    const Triangles triangles = cut(polygon, i % 3);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    int sum = 0;
    for (const auto& [a, b, c] : triangles) {
      const int area = cross(polygon[a], polygon[b], polygon[c]);
      ASSERT_GT(area * doubled_area(polygon), 0) << "polygon " << i;
      sum += area;
    }
    ASSERT_EQ(sum, doubled_area(polygon)) << "polygon " << i;
  }
}

/// Where it winds at all, a triangle covers it: the signed areas add up everywhere, so they do in sum.
TEST(Faces, OtherPolygonsAreCutAllTheSame) {
  test::Random random(2);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    Polygon polygon = random_polygon(random);
    if (i % 5 == 0) std::ranges::fill(polygon, polygon[0]);
    if (i % 5 == 1)
      for (Grid& corner : polygon) corner[1] = 2 * corner[0];
    const Triangles triangles = cut(polygon, i % 3);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    std::vector<bool> used(polygon.size());
    int sum = 0;
    for (const auto& triangle : triangles) {
      for (const std::uint32_t corner : triangle) used.at(corner) = true;
      sum += cross(polygon[triangle[0]], polygon[triangle[1]], polygon[triangle[2]]);
    }
    ASSERT_EQ(sum, doubled_area(polygon)) << "polygon " << i;
    ASSERT_EQ(std::count(used.begin(), used.end(), false), 0) << "polygon " << i;
  }
}

/// The corner at (e, e) lies beside the line through the next two by 2^-43 at 2^40, where doubles have steps of 2^-12.
TEST(Faces, TurnsAreExact) {
  const float far = 0x1p40f, next = 0x1p40f + 0x1p17f, near = 0x1p-20f, beside = 0x1p-20f + 0x1p-43f;
  const auto first_triangle = [&](Vec3 corner) {
    Triangles triangles;
    detail::importing::append_triangles_of(
        std::vector<Vec3>{corner, {far, far, 0}, {next, next, 0}, {-far, 2 * far, 0}},
        std::vector<std::uint32_t>{0, 1, 2, 3}, triangles);
    return triangles.at(0);
  };
  EXPECT_EQ(first_triangle({near, beside, 0}), (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(first_triangle({beside, near, 0}), (std::array<std::uint32_t, 3>{1, 2, 3}));
  EXPECT_EQ(first_triangle({near, near, 0}), (std::array<std::uint32_t, 3>{1, 2, 3}));
}

TEST(Faces, ConvexQuadsAreCutFromTheirFirstCorner) {
  EXPECT_EQ(cut({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 2), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(cut({{0, 1}, {2, 1}, {2, 0}, {0, 0}}, 2), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(cut({{0, 0}, {1, 1}, {4, 0}, {0, 4}}, 2), (Triangles{{1, 2, 3}, {1, 3, 0}}));
}

// ---- Files: an L of 3 m2, whose inner corner lies on the way between two others

const std::array<std::array<float, 3>, 6> ell = {
    {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}};

class FacesOfFiles : public test::ImportTest {
 protected:
  double area(const std::string& name, const std::string& text) {
    const auto [character, report] = import_character(folder.write(name, text), test::as_it_is());
    EXPECT_EQ(report.dropped_faces, 0u);
    double sum = 0;
    for (const auto& [a, b, c] : character.triangles) {
      const Eigen::Vector3f origin = detail::to_eigen(character.vertices[a]);
      sum += 0.5 * static_cast<double>((detail::to_eigen(character.vertices[b]) - origin)
                                           .cross(detail::to_eigen(character.vertices[c]) - origin)
                                           .norm());
    }
    return sum;
  }
};

std::string numbers(const char* before, const char* after, const char* between) {
  std::string text;
  for (const auto& [x, y, z] : ell)
    text += before + std::to_string(x) + between + std::to_string(y) + between + std::to_string(z) + after;
  return text;
}

TEST_F(FacesOfFiles, ObjFromEveryCornerAndBothWays) {
  for (int start = 0; start < 6; ++start)
    for (const int step : {1, 5}) {
      std::string face = "f";
      for (int i = 0; i < 6; ++i) face += ' ' + std::to_string(1 + (start + step * i) % 6);
      EXPECT_NEAR(area("ell.obj", numbers("v ", "\n", " ") + face + '\n'), 3, 1e-6) << face;
    }
  EXPECT_NEAR(area("arrow.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nf 1 2 3 4 5\n"), 3, 1e-6);
}

/// A square with a square hole, to which a cut leads; a square with a line that leads away from it; two squares with one between.
TEST_F(FacesOfFiles, CutsToHolesAndLinesToAndFro) {
  const std::string vertices =
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nv 6 5 0\nv 6 8 0\nv 4 8 0\n";
  const struct {
    std::vector<int> corners;
    double area;
  } cases[] = {{{1, 2, 3, 4, 1, 5, 6, 7, 8, 5}, 12},
               {{1, 2, 3, 9, 10, 9, 3, 4}, 16},
               {{1, 2, 3, 9, 10, 11, 9, 3, 4}, 19}};
  for (const auto& [corners, expected] : cases)
    for (std::size_t start = 0; start < corners.size(); ++start) {
      std::string face = "f";
      for (std::size_t i = 0; i < corners.size(); ++i)
        face += ' ' + std::to_string(corners[(start + i) % corners.size()]);
      EXPECT_NEAR(area("face.obj", vertices + face + '\n'), expected, 1e-6) << face;
    }
}

TEST_F(FacesOfFiles, Ply) {
  EXPECT_NEAR(area("ell.ply",
                   "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                   "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n" +
                       numbers("", "\n", " ") + "6 0 1 2 3 4 5\n"),
              3, 1e-6);
}

TEST_F(FacesOfFiles, Collada) {
  const std::string input = test::collada_input("g");
  for (const std::string& faces :
       {"<polylist count='1'>" + input + "<vcount>6</vcount><p>0 1 2 3 4 5</p></polylist>",
        "<polygons count='1'>" + input + "<p>0 1 2 3 4 5</p></polygons>",
        "<tristrips count='2'>" + input + "<p>0 1 3 2</p><p>0 3 5 4</p></tristrips>",
        "<trifans count='1'>" + input + "<p>3 4 5 0 1 2</p></trifans>"})
    EXPECT_NEAR(
        area("ell.dae", test::collada_file_of(test::collada_geometry("g", numbers("", " ", " "), 6, faces))),
        3, 1e-5)
        << faces;
}

TEST_F(FacesOfFiles, Fbx) {
  FbxText fbx;
  fbx.nodes = {{"ell", "Mesh"}};
  fbx.meshes = {{0, {}, {}, {0, 1, 2, 3, 4, -6}}};
  for (const auto& [x, y, z] : ell) fbx.meshes[0].points.emplace_back(x, y, z);
  EXPECT_NEAR(area("ell.fbx", fbx.text()), 3, 1e-6);
}

// ---- Real files, found through the environment variable BCH_TEST_DATA; what they hold is written in the
// SOURCES.md files beside them.

class ImportData : public testing::Test {
 protected:
  std::filesystem::path data;

  void SetUp() override {
    const auto folder = test::test_data();
    if (!folder) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
    data = *folder;
    ASSERT_TRUE(std::filesystem::is_directory(data)) << data;
  }

  std::filesystem::path character(const std::string& name) const { return data / "characters" / name; }

  /// The clips of native/, onto the skeleton they were made for.
  ImportOptions native_clips() const {
    ImportOptions options;
    for (const std::string name : {"atlas", "crackhead", "crossarms", "jog", "run", "walk"})
      options.clip_files.push_back(character("native/clip_" + name + ".fbx"));
    return options;
  }

  /// In every pose the character stands near its origin, upright, on the ground within a captured motion's
  /// error.
  static void expect_poses_in_place(const Character& c) {
    detail::Skinner skinner(c);
    for (std::uint32_t clip = 0; clip < c.clips.size(); ++clip)
      for (const float fraction : {0.0f, 0.13f, 0.29f, 0.5f, 0.61f, 0.77f, 0.92f, 1.0f}) {
        float max_extent = 0;
        Eigen::AlignedBox3f box;
        for (const Vec3& position : skinner.pose({clip, fraction * c.clips[clip].seconds})) {
          max_extent = std::max(max_extent, detail::to_eigen(position).head<2>().norm());
          box.extend(detail::to_eigen(position));
        }
        const std::string place = c.name + ", " + c.clips[clip].name + " at " + std::to_string(fraction);
        EXPECT_LT(max_extent, 1.0f) << place;
        EXPECT_GT(max_extent, 0.15f) << place;
        EXPECT_NEAR(box.min().z(), 0, 0.2f) << place;
        EXPECT_GT(box.max().z(), 0.7f) << place;
        EXPECT_LT(box.max().z(), 2.2f) << place;
      }
  }
};

std::string root_name(const Character& c) {
  return c.root_joint < 0 ? "" : c.joints[static_cast<std::size_t>(c.root_joint)].name;
}

/// Captured ones in metres, which have the same clips, and native ones in centimetres.
TEST_F(ImportData, Characters) {
  const struct {
    const char* name;
    std::size_t triangles, vertices, bones, clips;
    float height;
    const char* root;
  } files[] = {{"rocketbox_female_2841_cmu.glb", 2841, 1432, 80, 14, 1.743f, "Bip01"},
               {"rocketbox_male_2847_cmu.glb", 2847, 1443, 80, 14, 1.816f, "Bip01"},
               {"rocketbox_female_cmu.glb", 8732, 4369, 80, 14, 1.743f, "Bip01"},
               {"rocketbox_male_cmu.glb", 7440, 3744, 80, 14, 1.824f, "Bip01"},
               {"generic_man_cmu.glb", 2811, 1415, 53, 14, 1.828f, "Hips"},
               {"native/Female_Adult_01.fbx", 8732, 4369, 80, 1, 1.743f, "Bip01 Pelvis"},
               {"native/Male_Adult_01.fbx", 7440, 3745, 80, 1, 1.824f, "Bip01 Pelvis"},
               {"native/generic_man.fbx", 2811, 1415, 53, 1, 1.828f, "Pelvis"},
               {"native/arnaud.fbx", 6670, 3337, 53, 0, 1.831f, "Pelvis"}};
  for (const auto& file : files) {
    SCOPED_TRACE(file.name);
    const auto [c, report] = import_character(character(file.name));
    validate(c);
    EXPECT_EQ(report.triangles, file.triangles);
    EXPECT_EQ(report.vertices, file.vertices);
    EXPECT_EQ(report.bones, file.bones);
    EXPECT_EQ(report.dropped_faces, 0u);
    EXPECT_NEAR(report.height, file.height, 1e-3f);
    EXPECT_EQ(root_name(c), file.root);
    ASSERT_EQ(c.clips.size(), file.clips);
    expect_poses_in_place(c);
    if (file.clips != 14) continue;
    float seconds = 0;
    for (const ImportReport::Clip& clip : report.clips) {
      seconds += clip.seconds;
      EXPECT_EQ(clip.channels, clip.channels_in_file) << clip.name;
    }
    EXPECT_NEAR(seconds, 209, 0.5f);
    EXPECT_EQ(c.clips[6].name, "walk_turn_142_04");
    EXPECT_NEAR(c.clips[6].seconds, 31.07f, 0.01f);
  }
}

TEST_F(ImportData, NativeClipsOntoTheirSkeleton) {
  const float seconds[] = {15.0f, 3.333f, 8.6f, 0.8f, 0.667f, 1.333f};
  for (const char* name : {"native/generic_man.fbx", "native/arnaud.fbx", "generic_man_cmu.glb"}) {
    const auto [c, report] = import_character(character(name), native_clips());
    validate(c);
    EXPECT_EQ(root_name(c), "Hips") << name;
    const std::size_t own = c.clips.size() - 6;
    for (std::size_t clip = 0; clip < 6; ++clip) {
      EXPECT_NEAR(c.clips[own + clip].seconds, seconds[clip], 1e-3f) << c.clips[own + clip].name;
      EXPECT_GE(report.clips[own + clip].channels, 53u) << c.clips[own + clip].name;
    }
    expect_poses_in_place(c);
  }
}

void expect_refused(const std::filesystem::path& file, const std::string& reason,
                    const ImportOptions& options = {}) {
  EXPECT_TRUE(test::has(test::complaint<ImportError>([&] { import_character(file, options); }), reason))
      << file;
}

/// Files that bring assimp itself down, or make it read past the end of what it has: for a child process.
bool breaks_assimp(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("Overflowing") || name == "OutOfMemory.off" || name == "InvalidMeshOffset.iqm" ||
         name == "InvalidBoneIndex.md5mesh";
}

TEST_F(ImportData, NastyFilesAreReadOrRefusedAndNothingElse) {
  std::size_t read = 0;
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data / "nasty")) {
    if (!entry.is_regular_file() || breaks_assimp(entry.path())) continue;
    SCOPED_TRACE(entry.path().string());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      const Character c = import_character(entry.path()).character;
      EXPECT_NO_THROW(validate(c));
      ++read;
    } catch (const ImportError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.rfind(entry.path().string() + ": ", 0), 0u) << message;
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "left the importer: " << error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
  EXPECT_GE(read, 15u);
  EXPECT_GE(refused, 13u);
}

TEST_F(ImportData, NastyFilesAreRefusedForTheRightReason) {
  const std::pair<const char*, const char*> files[] = {
      {"BoxWithInfinites.glb", "vertex 0 is not finite"},
      {"empty.obj", "empty file"},
      {"../gltf/required_unknown.gltf", "extension 'EXT_foo'"},
      {"box_UTF16BE.obj", "text in UTF-16"},
      {"points.ply", "no triangles"},
      {"testline.obj", "no triangles"},
      {"nosurfaces.ac", "no known format"},
      {"IncorrectVertexArrays/Cube.bin", "no known format"}};
  for (const auto& [name, reason] : files) expect_refused(data / "nasty" / name, reason);
}

TEST_F(ImportData, OddFilesKeepWhatIsGood) {
  const std::pair<const char*, std::size_t> files[] = {{"malformed2.obj", 10},
                                                       {"IndexOutOfRange/IndexOutOfRange.gltf", 11},
                                                       {"testmixed.obj", 12},
                                                       {"IncorrectVertexArrays/Cube.gltf", 46},
                                                       {"triangle_with_empty_solid.stl", 1},
                                                       {"sphereWithHole.stl", 285},
                                                       {"Spider_ascii.stl", 1368},
                                                       {"human.zae", 28796}};
  for (const auto& [name, triangles] : files)
    EXPECT_EQ(import_character(data / "nasty" / name).report.triangles, triangles) << name;
}

}  // namespace
}  // namespace bch
