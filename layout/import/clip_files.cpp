// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cctype>
#include <cmath>

#include "layout/base/shortest.hpp"
#include "layout/import/clip_match.hpp"
#include "layout/import/clips.hpp"

namespace bch::detail::importing {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// A joint's name without what tools put before it: "mixamorig:Hips", "mixamorig1_Hips", "Armature|Hips".
std::string bare_name(const std::string& name) {
  std::string bare = name.substr(name.find_last_of(":|") + 1);
  const std::string prefix = "mixamorig";
  if (bare.starts_with(prefix)) {
    std::size_t end = prefix.size();
    while (end < bare.size() && std::isdigit(static_cast<unsigned char>(bare[end]))) ++end;
    if (end < bare.size() && bare[end] == '_') ++end;
    if (end < bare.size()) bare.erase(0, end);
  }
  return bare;
}

/// The joints of a character by full name and by bare name; a bare name that two joints share finds none.
class JointNames {
 public:
  explicit JointNames(const std::vector<Joint>& joints) {
    for (std::uint32_t j = 0; j < joints.size(); ++j) {
      full_.try_emplace(joints[j].name, j);
      const auto [place, added] = bare_.try_emplace(bare_name(joints[j].name), j);
      if (!added) place->second = none;
    }
  }

  std::uint32_t find(const std::string& name) const {
    if (name.empty()) return none;
    if (const auto place = full_.find(name); place != full_.end()) return place->second;
    const auto place = bare_.find(bare_name(name));
    return place == bare_.end() ? none : place->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t> full_, bare_;
};

double scale_of(const Eigen::Affine3d& transform) {
  return std::cbrt(std::abs(transform.linear().determinant()));
}

/// The skeletons of a character and of a clip file side by side.
struct Pairing {
  std::vector<std::uint32_t> joint_of_node;  ///< or none
  std::vector<Eigen::Affine3d> joint_to_file, node_to_file;
  std::vector<Eigen::Vector3d> node_offset;  ///< a node's position under its parent while the clip plays
  std::vector<bool> in_motion;               ///< nodes that have a channel or stand below one that has

  Pairing(const Character& character, const NodeList& nodes, const SourceClip& clip)
      : joint_to_file(rest_to_file(character.joints)), node_to_file(rest_to_file(nodes.joints)) {
    const JointNames names(character.joints);
    for (const Joint& node : nodes.joints) {
      joint_of_node.push_back(names.find(node.name));
      node_offset.push_back(to_eigen(node.rest).translation().cast<double>());
    }
    in_motion.resize(nodes.joints.size());
    for (const SourceChannel& channel : clip.channels) {
      const auto node = nodes.by_name.find(channel.node);
      if (node == nodes.by_name.end()) continue;
      in_motion[node->second] = true;
      // Some formats (md5anim) hold the skeleton's measures in the keys alone.
      if (!channel.motion.positions.empty())
        node_offset[node->second] = to_eigen(channel.motion.positions.front().value).cast<double>();
    }
    for (std::size_t n = 0; n < nodes.joints.size(); ++n)
      if (nodes.joints[n].parent >= 0 && in_motion[static_cast<std::size_t>(nodes.joints[n].parent)])
        in_motion[n] = true;
  }
};

struct Comparison {
  std::size_t bones = 0;             ///< that join the same two joints in both skeletons
  double alignment = 1;              ///< mean cosine between those that move, by length; 1 where none does
  std::optional<double> size_ratio;  ///< median of their lengths, character over clip, in units of the files
};

/// Compares the bones whose both ends are in both skeletons, below what the clip moves: above, files differ
/// in how they turn and scale a whole skeleton. A bone's direction in its upper joint's frame does not depend
/// on the pose, so it tells whether the joints of two skeletons are turned alike.
Comparison compare(const Character& character, const NodeList& nodes, const Pairing& pairing) {
  Comparison result;
  double agreement = 0;
  double total = 0;
  std::vector<double> ratios;
  for (std::size_t n = 0; n < nodes.joints.size(); ++n) {
    const std::int32_t parent = nodes.joints[n].parent;
    if (parent < 0 || pairing.joint_of_node[n] == none) continue;
    const std::uint32_t upper = pairing.joint_of_node[static_cast<std::size_t>(parent)];
    const Joint& joint = character.joints[pairing.joint_of_node[n]];
    if (upper == none || joint.parent != static_cast<std::int32_t>(upper)) continue;
    ++result.bones;
    if (!pairing.in_motion[static_cast<std::size_t>(parent)]) continue;

    const Eigen::Vector3d ours =
        to_eigen(joint.rest).translation().cast<double>() * scale_of(pairing.joint_to_file[upper]);
    const Eigen::Vector3d theirs =
        pairing.node_offset[n] * scale_of(pairing.node_to_file[static_cast<std::size_t>(parent)]);
    if (!(ours.norm() > 0 && theirs.norm() > 0)) continue;
    ratios.push_back(ours.norm() / theirs.norm());
    // Weighted by our length alone: their unit may be another one.
    agreement += ours.dot(theirs) / theirs.norm();
    total += ours.norm();
  }
  if (ratios.empty()) return result;
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2),
                   ratios.end());
  result.size_ratio = ratios[ratios.size() / 2];
  result.alignment = agreement / total;
  return result;
}

/// Says what the skeletons have in common, once the channels are sorted into those that match and the rest.
ClipMatch describe(const Character& character, const Pairing& pairing, const Comparison& comparison) {
  ClipMatch match{{}, {}, character.joints.size(), 0, 0, comparison.bones, comparison.alignment};
  std::vector<bool> found(character.joints.size());
  for (const std::uint32_t joint : pairing.joint_of_node)
    if (joint != none) found[joint] = true;
  match.joints_in_file = static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
  for (const Joint& joint : character.joints) match.bones += joint.parent >= 0;
  return match;
}

/// What leads from the frame above the clip's topmost joint to the frame above the character's, through the
/// ground.
struct RootChange {
  Eigen::Affine3d transform;
  Eigen::Quaterniond rotation;

  RootChange(const Eigen::Affine3d& above_theirs, const Eigen::Affine3d& above_ours,
             const Eigen::Matrix3d& file_to_file, double ratio) {
    transform = above_ours.inverse() * Eigen::Affine3d(ratio * file_to_file) * above_theirs;
    Eigen::Matrix3d turn;
    Eigen::Matrix3d stretch;
    transform.computeRotationScaling(&turn, &stretch);
    rotation = Eigen::Quaterniond(turn);
  }

  void apply(Channel& channel) const {
    for (auto& key : channel.positions)
      key.value = vec3((transform * to_eigen(key.value).cast<double>()).cast<float>());
    for (auto& key : channel.rotations)
      key.value = quaternion((rotation * to_eigen(key.value).cast<double>()).normalized().cast<float>());
    for (auto& tangents : channel.position_curve.tangents)
      for (Vec3* tangent : {&tangents.in, &tangents.out})
        *tangent = vec3((transform.linear() * to_eigen(*tangent).cast<double>()).cast<float>());
    for (auto& tangents : channel.rotation_curve.tangents)
      for (Quaternion* tangent : {&tangents.in, &tangents.out})
        *tangent = quaternion((rotation * to_eigen(*tangent).cast<double>()).cast<float>());
  }
};

class ClipFile {
 public:
  ClipFile(const std::filesystem::path& path, const ImportOptions& options, Direction character_up)
      : file_(path, options),
        nodes_(read_nodes(file_)),
        declared_(declared_frame(file_)),
        forced_(options.force_clips) {
    const Direction up = declared_.up.value_or(character_up);
    file_to_file_ = (upright(character_up).transpose() * upright(up)).cast<double>();
  }

  const SceneFile& file() const { return file_; }

  Clip fit(SourceClip source, const Character& character, std::vector<std::string>& notes) const {
    const Pairing pairing(character, nodes_, source);
    const Comparison comparison = compare(character, nodes_, pairing);
    ClipMatch match = describe(character, pairing, comparison);
    Clip clip{source.name, source.seconds, {}};
    std::vector<bool> taken(character.joints.size());
    std::vector<std::uint32_t> node_of_channel;
    for (SourceChannel& channel : source.channels) {
      const auto node = nodes_.by_name.find(channel.node);
      const std::uint32_t joint = node == nodes_.by_name.end() ? none : pairing.joint_of_node[node->second];
      const bool matches = joint != none && !taken[joint];
      (matches ? match.matched : match.unmatched).push_back(channel.node);
      if (!matches) continue;
      taken[joint] = true;
      channel.motion.joint = joint;
      clip.channels.push_back(std::move(channel.motion));
      node_of_channel.push_back(node->second);
    }
    if (clip.channels.empty())
      file_.reject("clip '" + source.name + "' moves no joint that the character has");
    require_match(source.name, match, notes);
    const double ratio = size_ratio(comparison, character);
    for (std::size_t c = 0; c < clip.channels.size(); ++c)
      adapt(clip.channels[c], node_of_channel[c], taken, character, pairing, ratio);
    note_ratio(source.name, ratio, notes);
    return clip;
  }

 private:
  SceneFile file_;
  NodeList nodes_;
  DeclaredFrame declared_;
  bool forced_;
  Eigen::Matrix3d file_to_file_;

  void require_match(const std::string& name, const ClipMatch& match, std::vector<std::string>& notes) const {
    const std::string reason = mismatch(match);
    if (reason.empty()) return;
    const std::string what = "clip '" + name + "' belongs to another skeleton";
    if (!forced_) file_.reject(what + " (--force-clips takes it all the same): " + reason);
    notes.push_back(what + ", but --force-clips takes it: " + reason);
  }

  /// Returns the ratio of the skeletons' sizes in units of the files, or that of the units alone where no
  /// bone can be compared.
  double size_ratio(const Comparison& comparison, const Character& character) const {
    if (comparison.size_ratio) return *comparison.size_ratio;
    const double ours = scale_of(to_eigen(character.to_ground).cast<double>());
    return declared_.scale ? static_cast<double>(*declared_.scale) / ours : 1.0;
  }

  static void note_ratio(const std::string& name, double ratio, std::vector<std::string>& notes) {
    if (std::abs(ratio - 1) < 1e-3) return;
    notes.push_back("clip '" + name + "': positions scaled by " + shortest(ratio) +
                    ", the ratio of the skeletons' sizes");
  }

  void adapt(Channel& channel, std::uint32_t node, const std::vector<bool>& taken, const Character& character,
             const Pairing& pairing, double ratio) const {
    channel.scales.clear();
    channel.scale_curve = {};
    const std::int32_t above = character.joints[channel.joint].parent;
    for (std::int32_t j = above; j >= 0; j = character.joints[static_cast<std::size_t>(j)].parent) {
      if (!taken[static_cast<std::size_t>(j)]) continue;
      channel.positions.clear();  // not the topmost: it keeps the character's own bone length
      channel.position_curve = {};
      return;
    }
    const std::int32_t node_above = nodes_.joints[node].parent;
    const Eigen::Affine3d identity = Eigen::Affine3d::Identity();
    RootChange(node_above < 0 ? identity : pairing.node_to_file[static_cast<std::size_t>(node_above)],
               above < 0 ? identity : pairing.joint_to_file[static_cast<std::size_t>(above)], file_to_file_,
               ratio)
        .apply(channel);
  }
};

}  // namespace

void add_clips_of(const std::filesystem::path& clip_file, const ImportOptions& options, Direction up,
                  Character& character, ImportReport& report) {
  const ClipFile source(clip_file, options, up);
  for (const std::string& note : source.file().notes)
    report.notes.push_back(one_line(clip_file.filename().string()) + ": " + note);
  std::vector<SourceClip> clips = read_clips(source.file(), report.notes);
  if (clips.empty()) source.file().reject("no clips");
  const std::string stem = one_line(clip_file.stem().string());
  for (SourceClip& clip : clips) {
    const std::size_t channels = clip.channels.size();
    // Tools call every clip "Take 001" or "mixamo.com": the file's name says more.
    clip.name = clips.size() == 1 ? stem : stem + ":" + clip.name;
    Clip fitted = source.fit(std::move(clip), character, report.notes);
    report.clips.push_back({fitted.name, fitted.seconds, fitted.channels.size(), channels});
    character.clips.push_back(std::move(fitted));
  }
}

}  // namespace bch::detail::importing
