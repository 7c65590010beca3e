// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <assimp/anim.h>

#include <memory>
#include <string>
#include <vector>

#include "layout/import/fbx_chain.hpp"

// Private to the importer: the keys of one node as assimp's types hold them.

namespace bch::detail::importing {

/// Returns what is shown between two keys.
FbxTransform blend(const FbxTransform& a, const FbxTransform& b, double fraction);

/// Returns what a channel shows at a time in ticks, of a node that rests so.
FbxTransform shown_by(const aiNodeAnim& channel, double ticks, const FbxTransform& rest);

/// Adds up the keys of a channel as it is made.
class ChannelMaker {
 public:
  ChannelMaker(const FbxFile& file, std::string place) : file_(file), place_(std::move(place)) {}

  /// Errors:  throws ImportError if the transform is sheared.
  void add(double ticks, const FbxTransform& pose);
  std::unique_ptr<aiNodeAnim> channel() const;

 private:
  const FbxFile& file_;
  std::string place_;
  std::vector<aiVectorKey> positions_, scales_;
  std::vector<aiQuatKey> rotations_;
};

}  // namespace bch::detail::importing
