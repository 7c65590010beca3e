// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "layout/import/scene.hpp"

// Private to the importer: which way is up in a file, and how long its unit is.

namespace bch::detail::importing {

/// Represents an axis of the file's frame, or its opposite.
struct Direction {
  ImportOptions::UpAxis axis = ImportOptions::UpAxis::y;
  bool opposite = false;
};

/// Holds what a format or a file declares about itself.
struct DeclaredFrame {
  std::optional<Direction> up;
  std::optional<Direction> reported_up;  ///< what the file declares, where the reader has turned that to `up`
  std::optional<float> scale;            ///< metres per unit
  std::string scale_source;              ///< for the note, such as "FBX unit scale factor 1"
};

DeclaredFrame declared_frame(const SceneFile& file);

/// Returns the rotation that brings a direction to z; never a mirroring.
Eigen::Matrix3f upright(Direction up);

/// Sets the transform to the ground from the options, else from the declaration, else from the rest pose.
/// Returns: the direction taken for up.
/// Errors:  throws ImportError on an option that is not a positive number.
Direction settle_frame(const SceneFile& file, const DeclaredFrame& declared, const ImportOptions& options,
                       Character& character, ImportReport& report);

/// Returns for every joint how many metres one unit of its position keys is, at rest.
std::vector<double> metres_above(const Character& character);

/// Checks the size of poses.
/// Errors:  throws ImportError if a pose leaves the range of 1000 km or is not finite.
void check_poses(const SceneFile& file, const Character& character);

/// Returns the height of the rest pose, in metres, once the frame is settled.
float rest_height(const Character& character);

}  // namespace bch::detail::importing
