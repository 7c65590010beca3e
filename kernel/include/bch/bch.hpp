// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// Includes all headers of the installed components.

#include <bch/agents.hpp>
#include <bch/body_set.hpp>
#include <bch/geometry.hpp>
#include <bch/hierarchy.hpp>
#include <bch/outline.hpp>
#include <bch/shape_set.hpp>
#include <bch/shape_set_builder.hpp>
#include <bch/verify.hpp>
#include <bch/version.hpp>

// The component kernel.
#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/crowd.hpp>
#include <bch/obstacles.hpp>
#include <bch/query.hpp>
#include <bch/time_of_impact.hpp>

// The component baked.
#if __has_include(<bch/baked.hpp>)
#include <bch/baked.hpp>
#endif

// The component characters.
#if __has_include(<bch/character.hpp>)
#include <bch/bodies.hpp>
#include <bch/character.hpp>
#include <bch/default_characters.hpp>
#include <bch/outline_builder.hpp>
#include <bch/pose_shape.hpp>
#include <bch/scene_plan.hpp>
#endif

// The component import.
#if __has_include(<bch/import.hpp>)
#include <bch/import.hpp>
#endif
