// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <span>
#include <stdexcept>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/skinning.hpp"
#include "layout/import/clips.hpp"

namespace bch::detail::importing {
namespace {

constexpr float farthest = 1e6f;

/// What is true of every file of a format, as assimp 5.2 hands it over: its Collada, Doom and Quake readers
/// turn the root node so that y is up, and its Collada reader scales it to metres.
struct Format {
  const char* name;
  bool y_up;
  std::optional<float> scale;
  const char* scale_source;
};
constexpr Format formats[] = {
    {"glTF2 Importer", true, 1.0f, "glTF"},
    {"Collada Importer", true, 1.0f, "Collada, converted to metres as the file declares"},
    {"Doom 3 / MD5 Mesh Importer", true, {}, ""},
    {"Inter-Quake Model Importer", true, {}, ""},
    {"BVH Importer (MoCap)", true, {}, ""},
};

DeclaredFrame declared_by_fbx(const SceneFile& file) {
  DeclaredFrame frame;
  frame.up = Direction{ImportOptions::UpAxis::y, false};
  const aiMetadata* metadata = file.scene->mMetaData;
  std::int32_t axis = 1;
  std::int32_t sign = 1;
  float factor = 1;
  if (metadata != nullptr) {
    metadata->Get("UpAxis", axis);
    metadata->Get("UpAxisSign", sign);
    metadata->Get("UnitScaleFactor", factor);
  }
  if (axis < 0 || axis > 2) file.reject("FBX up axis " + std::to_string(axis) + " is none of 0, 1, 2");
  if (!is_finite(factor) || factor <= 0)
    file.reject("FBX unit scale factor " + shortest(factor) + " is not a positive number");
  frame.up = Direction{static_cast<ImportOptions::UpAxis>(axis), sign < 0};
  frame.scale = factor * 0.01f;
  char text[64];
  std::snprintf(text, sizeof text, "FBX unit scale factor %g", static_cast<double>(factor));
  frame.scale_source = text;
  return frame;
}

/// What a Collada file declares: its reader turns the root node so that this becomes y.
std::optional<Direction> up_before_reader(const aiMatrix4x4& root) {
  const Eigen::Vector3f row = Eigen::Vector3f(root.b1, root.b2, root.b3).normalized();
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(row[axis]) > 0.999f)
      return Direction{static_cast<ImportOptions::UpAxis>(axis), row[axis] < 0};
  return std::nullopt;
}

Eigen::AlignedBox3f box_of(std::span<const Vec3> positions) {
  Eigen::AlignedBox3f box;
  for (const Vec3& position : positions) box.extend(to_eigen(position));
  return box;
}

Eigen::AlignedBox3f rest_box(const Character& character) {
  return box_of(Skinner(character).pose(PoseTime{}));
}

struct Unit {
  float scale;
  const char* name;
};

/// The unit in which a person is that tall.
std::optional<Unit> guess_unit(float height) {
  struct Range {
    float low, high;
    Unit unit;
  };
  // Between 40 and 90 a small centimetre figure and an inch-sized one look alike; game formats in
  // inches are the far more common.
  constexpr Range ranges[] = {{0.4f, 3.0f, {1.0f, "metres"}},
                              {20.0f, 90.0f, {0.0254f, "inches"}},
                              {90.0f, 300.0f, {0.01f, "centimetres"}},
                              {400.0f, 3000.0f, {0.001f, "millimetres"}}};
  for (const Range& range : ranges)
    if (height >= range.low && height <= range.high) return range.unit;
  return std::nullopt;
}

std::string name_of_scale(float scale) {
  constexpr Unit known[] = {
      {1.0f, "metres"}, {0.0254f, "inches"}, {0.01f, "centimetres"}, {0.001f, "millimetres"}};
  for (const Unit& unit : known)
    if (std::abs(scale / unit.scale - 1) < 1e-5f) return unit.name;
  char text[48];
  std::snprintf(text, sizeof text, "units of %g m", static_cast<double>(scale));
  return text;
}

std::string name_of(Direction up) {
  return std::string(up.opposite ? "-" : "") + "xyz"[static_cast<std::size_t>(up.axis)];
}

Direction choose_up(const DeclaredFrame& declared, const ImportOptions& options,
                    const Eigen::AlignedBox3f& rest, ImportReport& report) {
  Direction up;
  std::string source;
  if (options.up) {
    up.axis = *options.up;
    source = ", as the caller says";
  } else if (declared.up) {
    up = *declared.up;
  } else {
    // A standing person is less deep than tall; the width says nothing, as arms may be stretched out.
    up.axis = rest.sizes().y() >= rest.sizes().z() ? ImportOptions::UpAxis::y : ImportOptions::UpAxis::z;
    source = ", guessed from the rest pose (set the up axis to override)";
  }
  const bool reader_turned = !options.up && declared.reported_up;
  const std::string name = name_of(reader_turned ? *declared.reported_up : up);
  report.notes.push_back((name == "z" ? "z up" : name + " up -> z up") + source);
  return up;
}

float choose_scale(const SceneFile& file, const DeclaredFrame& declared, const ImportOptions& options,
                   float height, ImportReport& report) {
  float scale = 1;
  std::string source;
  char text[96];
  std::snprintf(text, sizeof text, "from the height of the rest pose, %g units (set the scale to override)",
                static_cast<double>(height));
  if (options.scale) {
    scale = *options.scale;
    if (!is_finite(scale) || scale <= 0)
      file.reject("scale " + shortest(scale) + " is not a positive number");
    source = ", as the caller says";
  } else if (declared.scale) {
    scale = *declared.scale;
    source = " (" + declared.scale_source + ")";
  } else if (const std::optional<Unit> unit = guess_unit(height)) {
    scale = unit->scale;
    source = std::string(", guessed ") + text;
  } else {
    source = std::string(", as no unit can be guessed ") + text;
  }
  const std::string name = name_of_scale(scale);
  report.notes.push_back((name == "metres" ? name : name + " -> metres") + source);
  return scale;
}

/// A pose is relative to its root joint, so it does not show how far a clip takes the root.
void check_displacements(const SceneFile& file, const Character& character) {
  const std::vector<double> scales = metres_above(character);
  for (const Clip& clip : character.clips)
    for (const Channel& channel : clip.channels)
      for (const Eigen::Vector3d& position : hull_of_positions(channel))
        if (!(position.norm() * scales[channel.joint] <= static_cast<double>(farthest)))
          file.reject("clip '" + clip.name + "' takes joint '" + character.joints[channel.joint].name +
                      "' absurdly far away");
}

}  // namespace

std::vector<double> metres_above(const Character& character) {
  const auto scale_of = [](const Eigen::Affine3d& transform) {
    return std::cbrt(std::abs(transform.linear().determinant()));
  };
  const double unit = scale_of(to_eigen(character.to_ground).cast<double>());
  const std::vector<Eigen::Affine3d> to_file = rest_to_file(character.joints);
  std::vector<double> scales;
  for (const Joint& joint : character.joints)
    scales.push_back(joint.parent < 0 ? unit
                                      : unit * scale_of(to_file[static_cast<std::size_t>(joint.parent)]));
  return scales;
}

DeclaredFrame declared_frame(const SceneFile& file) {
  if (file.is_fbx()) return declared_by_fbx(file);
  DeclaredFrame frame;
  for (const Format& format : formats) {
    if (file.format != format.name) continue;
    if (format.y_up) frame.up = Direction{ImportOptions::UpAxis::y, false};
    frame.scale = format.scale;
    frame.scale_source = format.scale_source;
  }
  if (file.format == "Collada Importer")
    frame.reported_up = up_before_reader(file.scene->mRootNode->mTransformation);
  return frame;
}

Eigen::Matrix3f upright(Direction up) {
  Eigen::Matrix3f rotation;
  switch (up.axis) {
    case ImportOptions::UpAxis::x:
      rotation << 0, 0, -1, 0, 1, 0, 1, 0, 0;
      break;
    case ImportOptions::UpAxis::y:
      rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
      break;
    case ImportOptions::UpAxis::z:
      rotation.setIdentity();
      break;
  }
  // Half a turn about the ground's x axis exchanges up and down.
  if (up.opposite) rotation = Eigen::Vector3f(1, -1, -1).asDiagonal() * rotation;
  return rotation;
}

Direction settle_frame(const SceneFile& file, const DeclaredFrame& declared, const ImportOptions& options,
                       Character& character, ImportReport& report) {
  character.to_ground = {};
  const Eigen::AlignedBox3f rest = rest_box(character);
  const Direction up = choose_up(declared, options, rest, report);
  const float height = rest.sizes()[static_cast<Eigen::Index>(up.axis)];
  const float scale = choose_scale(file, declared, options, height, report);
  character.to_ground = affine3(Eigen::Affine3f(upright(up) * scale));
  return up;
}

void check_poses(const SceneFile& file, const Character& character) {
  check_displacements(file, character);
  Skinner skinner(character);
  const auto check = [&](PoseTime at, const std::string& name) {
    std::span<const Vec3> positions;
    try {
      positions = skinner.pose(at);
    } catch (const std::domain_error& error) {
      file.reject(name + ": " + error.what());
    }
    for (std::size_t v = 0; v < positions.size(); ++v)
      if (to_eigen(positions[v]).cwiseAbs().maxCoeff() > farthest)
        file.reject(name + ": vertex " + std::to_string(v) + " is absurdly far away");
  };
  check(PoseTime{}, "rest pose");
  constexpr std::array<float, 5> fractions = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f};
  for (std::uint32_t c = 0; c < character.clips.size(); ++c)
    for (const float fraction : fractions)
      check({c, fraction * character.clips[c].seconds}, "clip '" + character.clips[c].name + "'");
}

float rest_height(const Character& character) {
  return rest_box(character).sizes().z();
}

}  // namespace bch::detail::importing
