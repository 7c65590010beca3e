// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace tbb {

struct task_group_context {  // NOLINT(readability-identifier-naming): TBB's name
  enum Kind { isolated };
  explicit task_group_context(Kind) {}
};

}  // namespace tbb
