// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/default_character/body_shape.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail {
namespace {

using enum BodyJoint;

/// The outline of trunk and head of the man. Heights: crotch 0.47, iliac crest 0.56, waist 0.62, nipple 0.72,
/// acromion 0.818, chin 0.870, eye 0.936 of the stature (Drillis and Contini).
std::vector<TrunkSection> male_trunk() {
  return {
      {0.488, 0.492, 0.480, 0.175, 0.106, 0.122, 0.90, 0, pelvis},
      {0.518, 0.522, 0.515, 0.173, 0.110, 0.132, 0.88, 0, pelvis},
      {0.548, 0.552, 0.550, 0.166, 0.110, 0.122, 0.88, 0, pelvis},
      {0.585, 0.587, 0.587, 0.161, 0.108, 0.100, 0.88, 0, spine},
      {0.622, 0.622, 0.622, 0.156, 0.107, 0.092, 0.90, 0, spine},
      {0.658, 0.658, 0.660, 0.163, 0.111, 0.100, 0.88, 0, spine},
      {0.692, 0.690, 0.694, 0.175, 0.117, 0.113, 0.86, 0, chest},
      {0.722, 0.720, 0.727, 0.186, 0.123, 0.122, 0.84, 0, chest},
      {0.750, 0.744, 0.757, 0.189, 0.122, 0.126, 0.84, 0, chest},
      {0.778, 0.782, 0.790, 0.190, 0.110, 0.124, 0.84, 0, chest},
      {0.801, 0.818, 0.820, 0.174, 0.084, 0.110, 0.88, 0, clavicle},
      {0.815, 0.837, 0.838, 0.116, 0.060, 0.094, 0.95, 0, clavicle},
      {0.828, 0.851, 0.853, 0.071, 0.044, 0.080, 1.00, 0, neck},
      {0.847, 0.864, 0.869, 0.063, 0.048, 0.070, 1.00, 0, neck},
      {0.863, 0.874, 0.884, 0.062, 0.066, 0.068, 1.00, 0.10, neck},
      {0.870, 0.884, 0.896, 0.065, 0.104, 0.072, 0.90, 0.22, head},
      {0.886, 0.896, 0.907, 0.070, 0.111, 0.080, 0.88, 0.18, head},
      {0.902, 0.908, 0.917, 0.073, 0.113, 0.086, 0.88, 0.12, head},
      {0.918, 0.921, 0.928, 0.075, 0.112, 0.090, 0.88, 0.08, head},
      {0.934, 0.936, 0.940, 0.0765, 0.110, 0.091, 0.88, 0.06, head},
      {0.949, 0.950, 0.952, 0.0780, 0.115, 0.091, 0.88, 0.05, head},
      {0.965, 0.966, 0.967, 0.0770, 0.110, 0.087, 0.88, 0.04, head},
      {0.981, 0.982, 0.982, 0.0680, 0.094, 0.074, 0.95, 0.05, head},
      {0.993, 0.994, 0.993, 0.0500, 0.066, 0.050, 1.00, 0, head},
      {0.999, 0.999, 0.999, 0.0260, 0.034, 0.024, 1.00, 0, head},
  };
}

/// The woman's: narrower waist and shoulders, wider hips, and hair that covers ears and nape.
std::vector<TrunkSection> female_trunk() {
  return {
      {0.488, 0.492, 0.480, 0.181, 0.098, 0.122, 0.92, 0, pelvis},
      {0.518, 0.522, 0.515, 0.183, 0.101, 0.134, 0.90, 0, pelvis},
      {0.548, 0.552, 0.550, 0.170, 0.101, 0.125, 0.92, 0, pelvis},
      {0.585, 0.587, 0.587, 0.145, 0.096, 0.098, 0.95, 0, spine},
      {0.622, 0.622, 0.622, 0.124, 0.088, 0.082, 0.95, 0, spine},
      {0.658, 0.658, 0.660, 0.125, 0.087, 0.083, 0.95, 0, spine},
      {0.692, 0.690, 0.694, 0.134, 0.092, 0.094, 0.92, 0, chest},
      {0.722, 0.720, 0.727, 0.142, 0.096, 0.102, 0.90, 0, chest},
      {0.750, 0.744, 0.757, 0.146, 0.098, 0.104, 0.88, 0, chest},
      {0.778, 0.782, 0.790, 0.152, 0.090, 0.101, 0.88, 0, chest},
      {0.801, 0.819, 0.820, 0.142, 0.070, 0.090, 0.90, 0, clavicle},
      {0.817, 0.834, 0.838, 0.088, 0.048, 0.076, 0.97, 0, clavicle},
      {0.830, 0.848, 0.853, 0.056, 0.036, 0.066, 1.00, 0, neck},
      {0.848, 0.864, 0.868, 0.050, 0.039, 0.066, 1.00, 0, neck},
      {0.863, 0.870, 0.868, 0.062, 0.056, 0.092, 0.95, 0.30, neck},
      {0.870, 0.882, 0.884, 0.076, 0.093, 0.104, 0.90, 0.48, head},
      {0.886, 0.895, 0.900, 0.081, 0.100, 0.108, 0.90, 0.42, head},
      {0.902, 0.908, 0.914, 0.084, 0.103, 0.110, 0.90, 0.36, head},
      {0.918, 0.921, 0.926, 0.085, 0.103, 0.111, 0.90, 0.30, head},
      {0.934, 0.936, 0.940, 0.085, 0.102, 0.110, 0.90, 0.24, head},
      {0.949, 0.950, 0.952, 0.084, 0.108, 0.107, 0.90, 0.14, head},
      {0.965, 0.966, 0.967, 0.079, 0.107, 0.099, 0.90, 0.08, head},
      {0.981, 0.982, 0.982, 0.066, 0.089, 0.081, 0.94, 0.05, head},
      {0.993, 0.994, 0.993, 0.049, 0.062, 0.053, 1.00, 0, head},
      {0.999, 0.999, 0.999, 0.026, 0.032, 0.026, 1.00, 0, head},
  };
}

/// The bulky man's: a belly before a broad trunk, a thick neck, and the man's head.
std::vector<TrunkSection> bulky_trunk() {
  const std::vector<TrunkSection> below_the_head = {
      {0.488, 0.492, 0.480, 0.221, 0.149, 0.161, 0.90, 0, pelvis},
      {0.516, 0.522, 0.515, 0.224, 0.183, 0.173, 0.88, 0, pelvis},
      {0.546, 0.552, 0.550, 0.225, 0.212, 0.161, 0.88, 0, pelvis},
      {0.584, 0.587, 0.587, 0.225, 0.229, 0.144, 0.88, 0, spine},
      {0.622, 0.622, 0.622, 0.224, 0.233, 0.138, 0.90, 0, spine},
      {0.658, 0.658, 0.660, 0.225, 0.222, 0.142, 0.88, 0, spine},
      {0.692, 0.690, 0.694, 0.229, 0.198, 0.151, 0.86, 0, chest},
      {0.722, 0.720, 0.727, 0.231, 0.181, 0.157, 0.84, 0, chest},
      {0.750, 0.744, 0.757, 0.230, 0.166, 0.159, 0.84, 0, chest},
      {0.778, 0.782, 0.790, 0.227, 0.142, 0.155, 0.84, 0, chest},
      {0.801, 0.818, 0.820, 0.198, 0.101, 0.132, 0.88, 0, clavicle},
      {0.815, 0.837, 0.838, 0.134, 0.072, 0.109, 0.95, 0, clavicle},
      {0.828, 0.851, 0.853, 0.087, 0.056, 0.093, 1.00, 0, neck},
      {0.847, 0.864, 0.869, 0.077, 0.059, 0.082, 1.00, 0, neck},
      {0.863, 0.874, 0.884, 0.073, 0.075, 0.078, 1.00, 0.10, neck},
  };
  std::vector<TrunkSection> trunk = male_trunk();
  std::copy(below_the_head.begin(), below_the_head.end(), trunk.begin());
  return trunk;
}

/// Arm of the man, `along` as a fraction of the way from shoulder (0) over elbow (1) to wrist (2).
std::vector<LimbSection> unit_arm() {
  return {
      {0.06, 0.064, 0.068, 0.040, 0.058, clavicle, shoulder, 0.6},
      {0.24, 0.063, 0.065, 0.060, 0.055, shoulder, shoulder},
      {0.46, 0.057, 0.056, 0.053, 0.051, upper_arm, upper_arm},
      {0.67, 0.050, 0.050, 0.045, 0.047, upper_arm, upper_arm},
      {0.87, 0.043, 0.045, 0.041, 0.042, upper_arm, elbow, 0.15},
      {1.00, 0.041, 0.045, 0.040, 0.042, upper_arm, elbow, 0.5},
      {1.14, 0.044, 0.045, 0.041, 0.043, upper_arm, elbow, 0.85},
      {1.36, 0.043, 0.043, 0.039, 0.041, elbow, elbow},
      {1.62, 0.037, 0.036, 0.032, 0.033, forearm, forearm},
      {1.86, 0.031, 0.030, 0.025, 0.025, forearm, forearm},
      {2.00, 0.030, 0.029, 0.022, 0.022, forearm, wrist, 0.5},
  };
}

/// Leg of the man. The calf stands out behind the shin, the knee before it.
std::vector<LimbSection> unit_leg() {
  return {
      {0.450, 0.090, 0.098, 0.086, 0.086, hip, hip, 0, 0.000},
      {0.408, 0.088, 0.087, 0.082, 0.079, hip, hip, 0, 0.004},
      {0.360, 0.080, 0.076, 0.074, 0.070, hip, hip, 0, 0.009},
      {0.315, 0.069, 0.063, 0.062, 0.060, hip, knee, 0.1, 0.010},
      {0.284, 0.065, 0.056, 0.056, 0.057, hip, knee, 0.5, 0.008},
      {0.256, 0.057, 0.059, 0.055, 0.056, hip, knee, 0.9, 0.002},
      {0.220, 0.053, 0.070, 0.058, 0.056, knee, knee, 0, -0.004},
      {0.180, 0.048, 0.070, 0.055, 0.052, knee, knee, 0, -0.008},
      {0.140, 0.042, 0.055, 0.046, 0.044, knee, knee, 0, -0.010},
      {0.102, 0.038, 0.043, 0.038, 0.037, knee, knee, 0, -0.010},
      {0.071, 0.040, 0.041, 0.036, 0.036, knee, ankle, 0.2, -0.009},
      {0.049, 0.050, 0.044, 0.038, 0.038, knee, ankle, 0.6, -0.006},
  };
}

/// A foot of the man, from above the heel to the tips of the toes, x from the ankle.
std::vector<FootSection> unit_feet() {
  return {
      {0.062, 0.080, -0.070, 0.036, 0.036, 0.035, 0},   {0.082, 0.070, -0.060, 0.000, 0.038, 0.036, 0},
      {0.108, 0.056, 0.020, 0.004, 0.041, 0.037, 0},    {0.148, 0.041, 0.105, 0.001, 0.050, 0.045, 0.15},
      {0.178, 0.031, 0.160, 0.000, 0.051, 0.048, 0.75}, {0.209, 0.022, 0.211, 0.003, 0.041, 0.042, 1},
  };
}

/// Scales what is across a limb and leaves its length.
std::vector<LimbSection> scaled(std::vector<LimbSection> limb, double thickness) {
  for (LimbSection& s : limb) {
    s.front *= thickness;
    s.back *= thickness;
    s.outer *= thickness;
    s.inner *= thickness;
    s.forward *= thickness;
  }
  return limb;
}

void lay_out_arm(BodyShape& shape) {
  for (LimbSection& s : shape.arm)
    s.along = s.along <= 1 ? s.along * shape.upper_arm : shape.upper_arm + (s.along - 1) * shape.forearm;
}

/// Segment lengths that are fractions of the stature.
BodyShape by_stature(double stature) {
  BodyShape shape{};
  shape.stature = stature;
  shape.upper_arm = 0.186 * stature;
  shape.forearm = 0.146 * stature;
  shape.hand = 0.108 * stature;
  shape.foot = 0.152 * stature;
  shape.arm_angle = 0.70;
  return shape;
}

}  // namespace

BodyShape male_shape() {
  BodyShape shape = by_stature(1.88);
  const double h = shape.stature;
  shape.shoulder_half_breadth = 0.198;
  shape.hip_half_breadth = 0.092;
  shape.trunk = male_trunk();
  shape.arm = unit_arm();
  lay_out_arm(shape);
  shape.leg = unit_leg();
  shape.feet = unit_feet();
  shape.bulges = {
      {{0.112, 0.000, 0.909 * h}, {0.027, 0, -0.004}, {0.05, 0.010, 0.014}},  // tip of the nose
      {{0.112, 0.000, 0.925 * h}, {0.012, 0, 0}, {0.05, 0.009, 0.016}},       // its bridge
      {{0.100, 0.036, 0.935 * h}, {-0.007, 0, 0}, {0.04, 0.018, 0.012}},      // eye socket
      {{0.110, 0.000, 0.873 * h}, {0.010, 0, 0}, {0.03, 0.022, 0.014}},       // chin
      {{0.002, 0.075, 0.924 * h}, {-0.004, 0.012, 0}, {0.022, 0.03, 0.022}},  // ear
      {{0.120, 0.085, 0.742 * h}, {0.009, 0, 0}, {0.08, 0.050, 0.045}},       // pectoral
      {{-0.130, 0.075, 0.505 * h}, {-0.012, 0, 0}, {0.06, 0.050, 0.060}},     // buttock
      {{-0.120, 0.085, 0.765 * h}, {-0.010, 0, 0}, {0.05, 0.045, 0.060}},     // shoulder blade
      {{-0.100, 0.000, 0.620 * h}, {0.010, 0, 0}, {0.05, 0.025, 0.150}},      // furrow of the spine
  };
  return shape;
}

BodyShape bulky_male_shape() {
  BodyShape shape = male_shape();
  const double h = shape.stature;
  shape.shoulder_half_breadth = 0.222;
  shape.hip_half_breadth = 0.114;
  shape.trunk = bulky_trunk();
  shape.arm = scaled(unit_arm(), 1.28);
  lay_out_arm(shape);
  shape.leg = scaled(unit_leg(), 1.26);
  // The belly and the back have no muscles to show.
  std::erase_if(shape.bulges, [&](const Bulge& bulge) { return bulge.centre.z() < 0.85 * h; });
  shape.bulges.push_back({{0.155, 0.095, 0.742 * h}, {0.016, 0, -0.004}, {0.08, 0.055, 0.045}});  // breast
  shape.bulges.push_back({{-0.158, 0.085, 0.505 * h}, {-0.012, 0, 0}, {0.06, 0.055, 0.060}});     // buttock
  return shape;
}

BodyShape female_shape() {
  BodyShape shape = by_stature(1.74);
  const double h = shape.stature;
  shape.shoulder_half_breadth = 0.163;
  shape.hip_half_breadth = 0.090;
  shape.trunk = female_trunk();
  shape.arm = scaled(unit_arm(), 0.79);
  lay_out_arm(shape);
  shape.leg = scaled(unit_leg(), 0.90);
  // Thighs do not thin with the bones: they carry on the wider hips.
  for (std::size_t i = 0; i < 4; ++i) {
    shape.leg[i].outer *= 1.10 - 0.02 * static_cast<double>(i);
    shape.leg[i].inner *= 1.06 - 0.01 * static_cast<double>(i);
    shape.leg[i].back *= 1.06 - 0.01 * static_cast<double>(i);
  }
  shape.feet = unit_feet();
  for (FootSection& s : shape.feet)
    for (double* value : {&s.top_x, &s.top_z, &s.sole_x, &s.sole_z, &s.outer, &s.inner}) *value *= 0.90;
  shape.bulges = {
      {{0.103, 0.000, 0.909 * h}, {0.022, 0, -0.004}, {0.05, 0.009, 0.013}},  // tip of the nose
      {{0.103, 0.000, 0.925 * h}, {0.008, 0, 0}, {0.05, 0.008, 0.015}},       // its bridge
      {{0.092, 0.034, 0.935 * h}, {-0.006, 0, 0}, {0.04, 0.017, 0.012}},      // eye socket
      {{0.100, 0.000, 0.873 * h}, {0.007, 0, 0}, {0.03, 0.018, 0.012}},       // chin
      {{0.110, 0.070, 0.722 * h}, {0.040, 0.004, 0}, {0.08, 0.030, 0.042}},   // breast
      {{-0.130, 0.078, 0.508 * h}, {-0.014, 0, 0}, {0.06, 0.050, 0.060}},     // buttock
      {{-0.105, 0.070, 0.770 * h}, {-0.006, 0, 0}, {0.05, 0.040, 0.050}},     // shoulder blade
      {{-0.090, 0.000, 0.620 * h}, {0.008, 0, 0}, {0.05, 0.022, 0.140}},      // furrow of the spine
  };
  return shape;
}

JointPositions joint_positions(const BodyShape& shape) {
  const double h = shape.stature;
  JointPositions at;
  // Hip and shoulder turn a little below the landmarks that the table measures, trochanter and acromion.
  at[joint_index(pelvis)] = {0, 0, 0.530 * h};
  at[joint_index(spine)] = {-0.010, 0, 0.590 * h};
  at[joint_index(chest)] = {-0.015, 0, 0.680 * h};
  at[joint_index(neck)] = {-0.020, 0, 0.840 * h};
  at[joint_index(head)] = {0.005, 0, 0.888 * h};

  const Eigen::Vector3d arm(0, std::sin(shape.arm_angle), -std::cos(shape.arm_angle));
  const Eigen::Vector3d shoulder_at(-0.015, shape.shoulder_half_breadth, 0.796 * h);
  at[joint_index(clavicle)] = {0.005, 0.025, 0.815 * h};
  at[joint_index(shoulder)] = shoulder_at;
  at[joint_index(upper_arm)] = shoulder_at + 0.45 * shape.upper_arm * arm;
  at[joint_index(elbow)] = shoulder_at + shape.upper_arm * arm;
  at[joint_index(forearm)] = shoulder_at + (shape.upper_arm + 0.5 * shape.forearm) * arm;
  at[joint_index(wrist)] = shoulder_at + (shape.upper_arm + shape.forearm) * arm;
  at[joint_index(fingers)] = at[joint_index(wrist)] + 0.48 * shape.hand * arm;

  const double foot_scale = shape.foot / 0.286;
  at[joint_index(hip)] = {0, shape.hip_half_breadth, 0.520 * h};
  at[joint_index(knee)] = {0.004, shape.hip_half_breadth, 0.285 * h};
  at[joint_index(ankle)] = {-0.006, shape.hip_half_breadth, 0.039 * h};
  at[joint_index(toes)] = {-0.006 + 0.140 * foot_scale, shape.hip_half_breadth + 0.012, 0.020};

  for (std::uint32_t i = midline_joints; i < midline_joints + side_joints; ++i)
    at[i + side_joints] = at[i].cwiseProduct(Eigen::Vector3d(1, -1, 1));
  return at;
}

}  // namespace bch::detail
