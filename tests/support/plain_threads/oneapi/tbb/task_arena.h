// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace tbb::this_task_arena {

template <class Work>
decltype(auto) isolate(const Work& work) {
  return work();
}

}  // namespace tbb::this_task_arena
