// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/obstacles.hpp>

#include "kernel/c_api/handles.hpp"

struct bch_obstacles {
  bch::ObstacleSet set;
};
