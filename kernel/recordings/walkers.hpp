// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <vector>

#include "layout/base/mixed_hash.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::detail {

/// Describes a person of a recording in a frame, and how the person walks.
struct Walker {
  std::int64_t id;
  double x, y;     ///< metres
  double heading;  ///< radians, the rotation of the person's shape
  double speed;    ///< metres per second, smoothed
  double phase;    ///< fraction of the stride done, 0 to 1, from the contact of the left heel
  double stature;  ///< metres
  bool is_female;
  bool is_guessed;     ///< the heading is neither from the file nor the direction of walking
  double way = 0;      ///< distance walked, metres, plus an offset by person
  double seconds = 0;  ///< time, plus an offset by person
  std::uint32_t motion = TrackedPerson::no_motion;  ///< index of the character and clip that the row names
  float clip_seconds =
      std::numeric_limits<float>::quiet_NaN();  ///< time in the clip of that motion; NaN if the file has none
  double velocity_x = 0, velocity_y = 0;        ///< metres per second, smoothed like the speed
  bool comes_or_goes = false;                   ///< the person is missing in a frame within 0.4 s
};

/// Holds the people of a frame, by ascending id.
struct WalkerFrame {
  std::int64_t frame = 0;
  std::vector<Walker> people;
};

/// Holds statistics of speeds from row to row of each person.
struct Speeds {
  double way = 0, seconds = 0;         ///< distance and time, summed over all people; metres
  double fastest = 0;                  ///< metres per second
  std::int64_t person = 0, frame = 0;  ///< the person with that speed, and the frame at its end

  double mean() const noexcept { return seconds > 0 ? way / seconds : 0; }
};

/// Reads a recording and derives how its people walk.
///
/// Speed:   from the positions 0.4 s before and after, or the next ones if there are none within 0.4 s.
/// Heading: from the file, or the direction of walking, or the last heading of a person who stands. A person
///          who stands at first faces where the first step goes, which is searched up to 10 s ahead.
/// Phase:   advances with the distance.
/// Memory:  grows with the people of the frames within 0.4 s; if somebody stands at first, of the frames
///          within 10 s, up to 200 000 rows; and by about 100 bytes per person who has left.
/// Errors:  throws TrajectoryError on what the reader rejects, and on a person who jumps by 100 m or more
///          from one row to the next.
class WalkerReader {
 public:
  /// Keeps a reference to `reader`. `facing`: the direction in which unrotated shapes face, radians.
  explicit WalkerReader(TrajectoryReader& reader, double facing = 0);

  /// Reads the next frame. Returns false at the end.
  bool next(WalkerFrame& frame);
  /// Returns the statistics of speeds of all frames read so far.
  const Speeds& speeds() const noexcept { return speeds_; }
  /// Returns the number of different people read so far.
  std::size_t people() const noexcept { return tracks_.size() + left_.size(); }

 private:
  struct Place {
    std::int64_t frame;
    double x, y;
  };
  /// Holds the last positions of a person, and how the person walked last.
  struct Track {
    std::deque<Place> places;
    double heading = 0, phase = 0, way = 0, stature = 0;  ///< stature: if the file has none
    std::int64_t last_frame = 0;
    bool is_female = false, has_heading = false, has_walked = false;
  };
  /// Holds the state of a person who has left, to continue if the person comes back.
  struct Left {
    Place last;
    double heading, phase, way;
    bool has_heading;
  };
  struct Frame {
    std::int64_t frame;
    std::vector<TrackedPerson> people;
    std::vector<Track*> tracks;  ///< of the people
  };

  bool read_one();
  Track& track_of(std::int64_t id);
  void let_go(std::int64_t frame);
  void read_window();
  void find_first_step(const TrackedPerson& person, Track& track, std::int64_t frame);
  void measure(const Place& from, const TrackedPerson& to, std::int64_t frame);
  Walker walk(const TrackedPerson& person, Track& track, std::int64_t frame) const;
  void face_the_crowd(WalkerFrame& frame, const std::vector<Track*>& tracks) const;

  TrajectoryReader& reader_;
  const double fps_;
  const std::int64_t window_;  ///< frames before and after
  const double facing_;
  Speeds speeds_;
  bool at_end_ = false;
  std::deque<Frame> ahead_;
  std::size_t rows_ahead_ = 0;
  std::deque<std::int64_t> before_;  ///< frames within the window, before the current one
  std::int64_t window_begin_ = 0,
               window_end_ = 0;  ///< the first and the last frame within the window
  std::unordered_map<std::int64_t, Track, MixedHash> tracks_;
  std::unordered_map<std::int64_t, Left, MixedHash> left_;
  std::size_t many_tracks_ = 0;  ///< at this number, tracks of people who have left are removed
};

/// Return a stature for a person if the file has none, and whether the body is a woman's. Both depend only on
/// the id.
double stature_by_id(std::int64_t id, bool is_female);
bool is_female_by_id(std::int64_t id);

}  // namespace bch::detail
