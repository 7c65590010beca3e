// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/import.hpp>

#include <new>
#include <set>

#include "layout/base/floating_point_state.hpp"
#include "layout/import/clips.hpp"
#include "layout/import/mesh.hpp"
#include "layout/import/scene.hpp"
#include "layout/import/units.hpp"

namespace bch {

using namespace detail;

namespace {

using namespace detail::importing;

/// The joints of the bones and the joints above them; cameras and helpers go. The bones are renumbered.
std::vector<Joint> carrying_joints(const std::vector<Joint>& joints, std::vector<Bone>& bones) {
  std::vector<bool> carries(joints.size());
  for (const Bone& bone : bones) carries[bone.joint] = true;
  for (std::size_t j = joints.size(); j-- > 0;)
    if (carries[j] && joints[j].parent >= 0) carries[static_cast<std::size_t>(joints[j].parent)] = true;

  std::vector<std::uint32_t> new_index(joints.size());
  std::vector<Joint> kept;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!carries[j]) continue;
    new_index[j] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(joints[j]);
    std::int32_t& parent = kept.back().parent;
    if (parent >= 0) parent = static_cast<std::int32_t>(new_index[static_cast<std::size_t>(parent)]);
  }
  for (Bone& bone : bones) bone.joint = new_index[bone.joint];
  return kept;
}

/// A joint counts once, although several skins may bind it differently.
std::size_t bone_joints(const Character& character) {
  std::set<std::uint32_t> joints;
  for (const Bone& bone : character.bones) joints.insert(bone.joint);
  return joints.size();
}

/// Reads a file, so that every error is an ImportError that names it.
template <class Read>
auto naming(const std::filesystem::path& file, Read read) {
  try {
    return read();
  } catch (const ImportError&) {
    throw;
  } catch (const std::bad_alloc&) {
    reject(file, "needs more memory than there is");
  } catch (const std::exception& error) {
    // This also catches errors of validate() and the skinning, as a further line of defence.
    reject(file, error.what());
  }
}

}  // namespace

ImportedCharacter importing::character_of(const SceneFile& file, const ImportOptions& options) {
  ImportedCharacter result;
  auto& [character, report] = result;
  report.format = file.format;
  character.name = one_line(file.path.stem().string());
  if (file.format == "Inter-Quake Model Importer")
    report.notes.emplace_back("of this format the rest pose alone is read, without bones and clips");
  if (!file.gltf.posed_morphs.empty()) file.reject(file.gltf.posed_morphs);
  report.notes.insert(report.notes.end(), file.notes.begin(), file.notes.end());

  const NodeList nodes = read_nodes(file);
  const std::vector<bool> bone_is_skin = read_meshes(file, nodes, character, report);
  weld_vertices(character, report);
  character.joints = carrying_joints(nodes.joints, character.bones);
  validate(character);

  const Direction up = settle_frame(file, declared_frame(file), options, character, report);
  add_own_clips(file, nodes, character, report);
  const std::size_t own_clips = character.clips.size();
  for (const std::filesystem::path& clip_file : options.clip_files)
    naming(clip_file, [&] { add_clips_of(clip_file, options, up, result.character, result.report); });
  character.root_joint = find_root_joint(character, bone_is_skin);
  validate(character);
  check_poses(file, character);
  note_far_poses(character, own_clips, report);

  report.vertices = character.vertices.size();
  report.triangles = character.triangles.size();
  report.bones = bone_joints(character);
  report.height = rest_height(character);
  return result;
}

ImportedCharacter import_character(const std::filesystem::path& file, const ImportOptions& options) {
  const FloatingPointStateGuard floats;
  return naming(file, [&] { return character_of(SceneFile(file, options), options); });
}

}  // namespace bch
