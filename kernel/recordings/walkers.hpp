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

/// Describes a person of a recording in a frame, and how he walks.
struct Walker {
  std::int64_t id;
  double x, y;     ///< metres
  double heading;  ///< radians, by which his shape is turned
  double speed;    ///< metres a second, smoothed
  double phase;    ///< share of a stride, 0 to 1, from the left heel's contact on
  double stature;  ///< metres
  bool is_female;
  bool is_guessed;     ///< the heading is neither of the file nor of a person who walks
  double way = 0;      ///< metres that he has walked, from a place of his own on
  double seconds = 0;  ///< from a time of his own on
  std::uint32_t motion = TrackedPerson::no_motion;  ///< that the file names
  float clip_seconds =
      std::numeric_limits<float>::quiet_NaN();  ///< of its clip; NaN where the file does not say
  double velocity_x = 0, velocity_y = 0;        ///< metres a second, smoothed as the speed is
  bool comes_or_goes = false;                   ///< within 0.4 s of this frame there are frames without him
};

/// Holds the people of a frame, by ascending id.
struct WalkerFrame {
  std::int64_t frame = 0;
  std::vector<Walker> people;
};

/// Holds how fast people are, from row to row of each.
struct Speeds {
  double way = 0, seconds = 0;         ///< of all people together; metres
  double fastest = 0;                  ///< metres a second
  std::int64_t person = 0, frame = 0;  ///< who is that fast, and where he then gets

  double mean() const noexcept { return seconds > 0 ? way / seconds : 0; }
};

/// Reads a recording and finds how its people walk: speeds from positions 0.4 s before and after,
/// or from the next ones where there are none so near, headings from the file or from the
/// way of a person who walks, held while he stands, and strides that go on with the distance. Who stands at first faces the way of his first
/// step, which is looked for up to 10 s ahead. Memory grows with the people of the frames within 0.4 s, or of those 10 s, up to 200 000 rows,
/// where somebody stands at first; and by about 100 bytes for each person who has left.
/// Errors:  throws TrajectoryError on what the reader rejects, and on a person who is 100 m away a moment later.
class WalkerReader {
 public:
  /// Takes `reader`, which has to live as long as this.
  /// `facing`: where shapes face that are not turned, radians.
  explicit WalkerReader(TrajectoryReader& reader, double facing = 0);

  /// Reads the next frame. Returns false at the end.
  bool next(WalkerFrame& frame);
  /// Returns how fast people were until now.
  const Speeds& speeds() const noexcept { return speeds_; }
  /// Returns how many different people were read.
  std::size_t people() const noexcept { return tracks_.size() + left_.size(); }

 private:
  struct Place {
    std::int64_t frame;
    double x, y;
  };
  /// Holds what is known of a person: his last places, and how he walked last.
  struct Track {
    std::deque<Place> places;
    double heading = 0, phase = 0, way = 0, stature = 0;  ///< the latter where the file has none
    std::int64_t last_frame = 0;
    bool is_female = false, has_heading = false, has_walked = false;
  };
  /// Holds what is kept of a person who has left: so much that he goes on as before if he comes back.
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
  std::deque<std::int64_t> before_;  ///< frames within the window before the one that is read
  std::int64_t window_begin_ = 0,
               window_end_ = 0;  ///< the first and the last frame within the window of that one
  std::unordered_map<std::int64_t, Track, MixedHash> tracks_;
  std::unordered_map<std::int64_t, Left, MixedHash> left_;
  std::size_t many_tracks_ = 0;  ///< from so many on, those who have left are looked for
};

/// Returns a stature for a person whose file has none, and whether the body is a woman's, both by the id: the same in every run.
double stature_by_id(std::int64_t id, bool is_female);
bool is_female_by_id(std::int64_t id);

}  // namespace bch::detail
