// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/scene.hpp"

#include <assimp/config.h>
#include <assimp/importerdesc.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <new>

#include "layout/import/collada.hpp"
#include "layout/import/fbx.hpp"
#include "layout/import/files.hpp"
#include "layout/import/gltf_file.hpp"
#include "layout/import/ply.hpp"
#include "layout/import/text.hpp"

namespace bch::detail::importing {
namespace {

constexpr std::size_t max_nodes = std::size_t{1} << 20;

void check_readable(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) reject(file, "no such file");
  if (std::filesystem::is_directory(status)) reject(file, "is a directory");
  // A pipe or a device could block for ever.
  if (!std::filesystem::is_regular_file(status)) reject(file, "is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) reject(file, error.message());
  if (size == 0) reject(file, "empty file");
  if (size > largest_file) reject(file, "larger than " + count(largest_file >> 30, "GiB", "GiB"));
}

std::string first_two_bytes(const std::filesystem::path& file) {
  std::string start(2, '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), 2);
  return start;
}

bool is_archive(const std::filesystem::path& file) {
  return first_two_bytes(file) == "PK";
}

bool is_utf16(const std::filesystem::path& file) {
  const std::string mark = first_two_bytes(file);
  return mark == "\xFE\xFF" || mark == "\xFF\xFE";
}

/// Lets assimp read text of formats in which its readers lose something without that, or notes what they lose.
void settle_text(const std::filesystem::path& file, FileAndSiblings& files, std::vector<std::string>& notes) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (is_utf16(file)) return;
  if (ending == ".obj") files.replace_text(plain_obj(file, files.read(file)));
  if (ending == ".bvh")
    if (const std::string note = check_bvh(file, files.read(file)); !note.empty()) notes.push_back(note);
}

void set_up(Assimp::Importer& importer, FileAndSiblings* files, const ImportOptions& options) {
  keep_supported_formats(importer);
  importer.SetIOHandler(files);  // which the importer owns from here on
  // Otherwise a joint becomes a chain of helper nodes, and channels no longer carry its name.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  // A file with a skeleton alone (BVH) would get a made-up mesh of pyramids.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  if (options.up) importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
}

std::string reason_of_failure(const Assimp::Importer& importer) {
  const std::string reason = one_line(importer.GetErrorString());
  if (reason.find("bad_alloc") != std::string::npos) return "needs more memory than there is";
  if (reason.find("No suitable reader") != std::string::npos)
    return "damaged, or of no known format (glTF 2, FBX, Collada, MD5, IQM, OBJ, PLY, STL, and BVH for "
           "clips)";
  return reason.empty() ? "cannot be read" : reason;
}

}  // namespace

std::string one_line(const std::string& text) {
  constexpr std::size_t longest = 1000;
  std::string line;
  for (const char c : text.substr(0, longest)) {
    const bool blank = static_cast<unsigned char>(c) <= 0x20 || c == 0x7f;
    if (!blank)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

void reject(const std::filesystem::path& file, const std::string& reason) {
  throw ImportError(one_line(file.string()) + ": " + one_line(reason));
}

std::string count(std::size_t number, const std::string& noun, const std::string& plural) {
  return std::to_string(number) + " " + (number == 1 ? noun : plural.empty() ? noun + "s" : plural);
}

std::string to_string(const aiString& text) {
  return std::string(text.data, std::min<std::size_t>(text.length, sizeof text.data - 1));
}

SceneFile::SceneFile(const std::filesystem::path& file, const ImportOptions& options)
    : path(file), max_triangles(options.max_triangles) {
  check_readable(file);
  if (is_gltf(file)) {
    gltf = read_gltf(file);
    scene = gltf.scene.get();
    format = "glTF2 Importer";
    notes = gltf.notes;
    return;
  }
  if (is_ply(file)) {
    ply = read_ply(file);
    scene = ply.get();
    format = "Stanford Polygon Library (PLY) Importer";
    return;
  }
  auto files = std::make_unique<FileAndSiblings>(file);
  settle_text(file, *files, notes);
  std::string collada = rewritten_collada(file);
  const bool rewritten = !collada.empty();
  if (rewritten) files->replace_text(std::move(collada));
  set_up(importer, files.release(), options);
  // Nothing of assimp's post-processing: joining vertices merges them without regard to their weights, triangles are cut across
  // corners that lie on their edges, and each step is a further place to fail on a damaged file.
  scene = importer.ReadFile(file.string(), 0);
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* description =
      index < 0 ? nullptr : importer.GetImporterInfo(static_cast<std::size_t>(index));
  if (description != nullptr && description->mName != nullptr) format = description->mName;
  // Some readers know UTF-16; the one of OBJ finds an empty scene in it.
  if ((scene == nullptr || format == "Wavefront Object Importer") && is_utf16(file))
    reject("text in UTF-16, which is not read in this format: convert it to UTF-8");
  if (scene == nullptr) reject(reason_of_failure(importer));
  if (scene->mRootNode == nullptr) reject("no scene");
  aiScene& ours = const_cast<aiScene&>(*scene);  // it is the importer's, which is ours
  if (rewritten) restore_jumps(ours);
  if (format == "Collada Importer" && ours.mNumAnimations > 0 && (is_archive(file) || is_utf16(file)))
    notes.emplace_back(
        "of a Collada file that is packed or in UTF-16 keys are taken for linear; unpacked and in UTF-8, "
        "they are read as they are");
  if (is_fbx()) notes = correct_fbx(file, ours);
}

Affine3 read_matrix(const SceneFile& file, const aiMatrix4x4& m, const std::string& what) {
  constexpr float tolerance = 1e-4f;
  Eigen::Matrix4f matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  if (!matrix.allFinite()) file.reject(what + " has a transform that is not finite");
  if (matrix.cwiseAbs().maxCoeff() > largest_number) file.reject(what + " has an absurd transform");
  if (matrix.row(3).head<3>().cwiseAbs().maxCoeff() > tolerance || std::abs(matrix(3, 3) - 1) > tolerance)
    file.reject(what + " has a transform that is not affine");
  matrix.row(3) << 0, 0, 0, 1;
  return affine3(Eigen::Affine3f(matrix));
}

/// Reads the nodes depth first and in the order of the file, with a stack of our own, because a file chooses
/// its depth.
NodeList read_nodes(const SceneFile& file) {
  struct Pending {
    const aiNode* node;
    std::int32_t parent;
  };
  NodeList list;
  std::vector<Pending> stack{{file.scene->mRootNode, -1}};
  while (!stack.empty()) {
    const auto [node, parent] = stack.back();
    stack.pop_back();
    if (node == nullptr) file.reject("the scene has a missing node");
    if (list.nodes.size() == max_nodes) file.reject("more than " + count(max_nodes, "node"));

    Joint joint{to_string(node->mName), parent, {}};
    joint.rest = read_matrix(file, node->mTransformation, "node '" + joint.name + "'");
    // Some versions of assimp turn the root of an FBX file as its axes ask, others leave it alone; the axes
    // are applied here, so they must not be applied twice.
    if (parent < 0 && file.is_fbx()) joint.rest = {};
    const auto index = static_cast<std::uint32_t>(list.nodes.size());
    if (!list.by_name.try_emplace(joint.name, index).second) list.shared_names.insert(joint.name);
    list.joints.push_back(std::move(joint));
    list.nodes.push_back(node);

    if (node->mNumChildren > 0 && node->mChildren == nullptr) file.reject("the scene has a missing node");
    for (unsigned c = node->mNumChildren; c > 0; --c)
      stack.push_back({node->mChildren[c - 1], static_cast<std::int32_t>(index)});
  }
  return list;
}

void note_if_shared(const NodeList& nodes, const std::string& name, ImportReport& report) {
  if (!nodes.shared_names.contains(name)) return;
  const std::string note = "several nodes are named '" + one_line(name) + "': bones and clips take the first";
  if (std::find(report.notes.begin(), report.notes.end(), note) == report.notes.end())
    report.notes.push_back(note);
}

std::vector<Eigen::Affine3d> rest_to_file(const std::vector<Joint>& joints) {
  std::vector<Eigen::Affine3d> transforms(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    transforms[j] = to_eigen(joints[j].rest).cast<double>();
    if (joints[j].parent >= 0)
      transforms[j] = transforms[static_cast<std::size_t>(joints[j].parent)] * transforms[j];
  }
  return transforms;
}

}  // namespace bch::detail::importing
