// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// A BVH file of a chain of joints, each at an offset from the one before. Its root stands 100 units up and goes 300 along x in two
/// seconds, while the last joint turns by a right angle about y.
struct BvhFile {
  std::vector<std::string> joints = {"hips", "head"};
  static constexpr const char* turning = "Zrotation Xrotation Yrotation";
  std::string offset = "0 50 0", channels = std::string("3 ") + turning, frames = "3";
  std::string motion = {};  ///< in place of that way

  std::string text() const {
    std::string below = "End Site\n{\nOFFSET 0 10 0\n}\n", turns;
    for (std::size_t i = joints.size(); i-- > 0;)
      below = (i == 0 ? "ROOT " + joints[i] + "\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition " +
                            turning
                      : "JOINT " + joints[i] + "\n{\nOFFSET " + offset + "\nCHANNELS " + channels) +
              "\n" + below + "}\n";
    for (std::size_t i = 1; i < joints.size(); ++i) turns += " 0 0 0";
    const std::string way =
        "0 100 0" + turns + " 0 0 0\n100 100 0" + turns + " 0 0 45\n300 100 0" + turns + " 0 0 90\n";
    return "HIERARCHY\n" + below + "MOTION\nFrames: " + frames + "\nFrame Time: 1\n" +
           (motion.empty() ? way : motion);
  }
};

}  // namespace bch::test
