// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/character.hpp>

namespace bch {

/// Returns the built-in man. He is 1.88 m tall, the woman of default_female() 1.74 m. Each is one
/// closed skin of about 2 850 triangles with 27 joints and 212 s of walking, turning, side-stepping and idling. They stand
/// in for the two characters of the paper's table 1 and were tuned to its statistics: the smallest disc around a pose seen
/// from above has a mean radius of 0.42 m (man) and 0.34 m (woman) and a deviation of about 0.05 m.
///
/// Units:   metres, z up, facing +x at rest. Each call takes about ten milliseconds and returns the same bits.
///
/// Source:  body and motion after published measures (see layout/default_character: body_shape.hpp, walking.cpp, stepping.cpp,
///          idling.cpp); the paper is Stuvel et al., "Hierarchical structures for collision checking between
///          virtual characters", Computer Animation and Virtual Worlds 25, 2014.
Character default_male();
/// Returns the built-in woman; see default_male().
Character default_female();
/// Returns a bulky man. He is like default_male(), but with the volume that the means of the paper's table 1 imply for its man,
/// about 0.137 m3.
Character default_bulky_male();

/// Selects the sex of a pedestrian's body.
enum class Sex { female, male };

/// Gives the number of speeds at which pedestrians walk, from 0 to 2.19 m/s.
constexpr std::uint32_t pedestrian_speeds = 74;
/// Gives the step of these speeds, metres per second: clip k of a pedestrian walks at k steps.
constexpr double pedestrian_speed_step = 0.03;

/// Returns a pedestrian for recorded and simulated crowds: the built-in man or woman of a given stature. The pedestrian walks at every
/// speed, keeps the arms close, and stands under the head, which is what cameras track. Each clip is one stride at one speed: it
/// begins and ends with the left heel's contact, in the same pose, and can be repeated. Steps are taken at 1.3 Hz when people shuffle and at 0.5 Hz more for every metre per second:
/// about 2 Hz and 0.7 m at 1.4 m/s. The step length goes to 0 with the speed. `shoulders` is the angle of the shoulders to the
/// walking direction, counter-clockwise: people turn them when they pass each other closely.
/// Units:   metres, radians; a stature from 0.8 to 2.4, a turn from -1 to 1.
/// Source:  A. Pachi, T. Ji, "Frequency and velocity of people walking", The Structural Engineer 83, 2005 (2.0 Hz at 1.4 m/s, steps of
///          0.75 m of men and 0.67 m of women); A. Jelic, C. Appert-Rolland, S. Lemercier, J. Pettre, "Properties of pedestrians
///          walking in line: stepping behavior", Phys. Rev. E 86, 2012 (in lines, step lengths are proportional to the speed, and
///          durations vary much less).
/// Errors:  throws std::invalid_argument on another stature or turn.
Character default_pedestrian(Sex sex, double stature, double shoulders = 0);

/// Returns the number of strides, of two steps each, that a pedestrian takes in a second.
double pedestrian_strides_per_second(double metres_per_second);

}  // namespace bch
