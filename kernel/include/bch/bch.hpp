// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// Includes all headers of the installed components.

#include <bch/agents.hpp>
#include <bch/body_set.hpp>
#include <bch/geometry.hpp>
#include <bch/hierarchy.hpp>
#include <bch/outline.hpp>
#include <bch/shapes.hpp>
#include <bch/version.hpp>

// The component kernel.
#include <bch/crowd.hpp>
#include <bch/motion.hpp>
#include <bch/obstacles.hpp>
#include <bch/pairs.hpp>
#include <bch/query.hpp>

// The component baked.
#if __has_include(<bch/files.hpp>)
#include <bch/files.hpp>
#endif

// The component characters.
#if __has_include(<bch/characters.hpp>)
#include <bch/bodies.hpp>
#include <bch/characters.hpp>
#include <bch/outline_builder.hpp>
#include <bch/poses.hpp>
#include <bch/scene_plan.hpp>
#endif

// The component import.
#if __has_include(<bch/import.hpp>)
#include <bch/import.hpp>
#endif
