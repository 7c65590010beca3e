// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include "baselines/cut_lists.hpp"
#include "baselines/cut_tree.hpp"
#include "baselines/reference.hpp"

namespace bch::baselines {

/// Times of contact pair by pair and disc by disc, written apart from the kernel, which has to give the same bits.
class ContactTimeReference {
 public:
  ContactTimeReference(std::span<const Shape> shapes, const ShapeSetPlan& plan)
      : trees_(shapes, plan), cuts_(shapes, plan) {}

  /// As contact_time(): the first agent moves by (x, y) relative to the second. 0 where discs of the cuts overlap at the
  /// start; but of a way that is zero as floats, 0 where the two collide, and never elsewhere. Not for two threads at a
  /// time.
  /// `depth_first` goes to the child that is met sooner first and leaves out what is met later than the first so far.
  float query(const Agents& agents, Pair pair, double x, double y, Method method);

 private:
  CutTrees trees_;
  CutLists cuts_;
  std::vector<OpenPair> open_;
};

}  // namespace bch::baselines
