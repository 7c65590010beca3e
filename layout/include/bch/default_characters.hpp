// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/character.hpp>

namespace bch {

/// Returns the built-in man, who needs no file. He is 1.88 m tall, the woman of default_female() 1.74 m. Each is one
/// closed skin of about 2 850 triangles with 27 joints and 212 s of walking, turning, side-stepping and idling. They stand
/// in for the two characters of the paper's table 1 and were tuned to its statistics: the smallest disc around a pose seen
/// from above has a mean radius of 0.42 m (man) and 0.34 m (woman) and a deviation of about 0.05 m.
///
/// Units:   metres, z up, facing +x at rest. The same bits at each call. Takes about ten milliseconds.
///
/// Source:  body and motion after published measures (see layout/default_character: body_shape.hpp, walking.cpp, stepping.cpp,
///          idling.cpp); the paper is Stuvel et al., "Hierarchical structures for collision checking between
///          virtual characters", Computer Animation and Virtual Worlds 25, 2014.
Character default_male();
/// Returns the built-in woman; see default_male().
Character default_female();
/// Returns a bulky man: like default_male(), but with the volume that the means of the paper's table 1 imply of its man,
/// about 0.137 m3.
Character default_bulky_male();

}  // namespace bch
