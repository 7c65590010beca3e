// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <vector>

#include "layout/import/scene.hpp"
#include "layout/import/units.hpp"

// Private to the importer: aiAnimation -> Clip.

namespace bch::detail::importing {

struct SourceChannel {
  std::string node;
  Channel motion;  ///< its joint is not set yet
};

struct SourceClip {
  std::string name;
  float seconds = 0;
  std::vector<SourceChannel> channels;
};

/// Returns the animations of a file with times in seconds from 0, in order; quaternions of norm 1.
std::vector<SourceClip> read_clips(const SceneFile& file, std::vector<std::string>& notes);

/// Adds the character's own clips: channels belong to the joints of their name.
void add_own_clips(const SceneFile& file, const NodeList& nodes, Character& character, ImportReport& report);

/// Adds the clips of another file, in the way that import_character() documents.
/// `up` is the direction taken for up in the character's own file.
void add_clips_of(const std::filesystem::path& clip_file, const ImportOptions& options, Direction up,
                  Character& character, ImportReport& report);

/// Returns positions between which a channel's positions stay: its keys, and of a cubic part the inner control points
/// of each segment as a Bezier curve.
std::vector<Eigen::Vector3d> hull_of_positions(const Channel& channel);

/// Adds a note for every clip from `first_clip` on in which a pose reaches farther from its origin than 1.5 times the
/// rest pose does, seen from above.
void note_far_poses(const Character& character, std::size_t first_clip, ImportReport& report);

/// Returns the joint whose point on the ground is a shape's origin: see the source.
std::int32_t find_root_joint(const Character& character, const std::vector<bool>& bone_is_skin);

}  // namespace bch::detail::importing
