/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 the bch authors */

#ifndef BCH_BCH_FILES_H
#define BCH_BCH_FILES_H

#include <bch/bch.h>

/** @file
 * Declares what the C interface reads from files of others: characters, and recordings of people with their checks. These functions are in
 * a library of their own, libbch_files, which needs the packages that read such files; it is linked in addition to libbch, of the same
 * version. Results, handles, structs, arrays, threads and memory are as <bch/bch.h> says.
 */

#ifdef __cplusplus
extern "C" {
#endif

/* Characters -------------------------------------------------------------------------------------------------------- */

/** Holds the options of an import: values that override those of the file, and limits. */
typedef struct bch_import_options {
  uint32_t size;                 /**< sizeof(bch_import_options) */
  int32_t up;                    /**< the axis that points up, 0, 1 or 2 for x, y or z; -1: what the file says, or a guess */
  float scale;                   /**< metres for a unit of the file; 0: what the file says, or a guess */
  int32_t force_clips;           /**< not 0: also takes clips that belong to another skeleton */
  const char* const* clip_files; /**< paths of files whose clips follow those of the character's own file */
  size_t clip_file_count;
  uint64_t max_triangles; /**< files of more are refused */
  double seconds;          /**< the longest time that reading may take */
  uint64_t memory;         /**< bytes that reading may take */
  bch_progress progress;   /**< or NULL; called with 0 of 0 parts, and can cancel */
  void* user;              /**< for progress */
} bch_import_options;
#define BCH_IMPORT_OPTIONS_INIT \
  { sizeof(bch_import_options), -1, 0, 0, NULL, 0, 0x7fffffff, 60, (uint64_t)2 << 30, NULL, NULL }
/** Reads a character from a file (glTF 2, FBX, Collada, MD5, IQM, OBJ, PLY, STL). It does so in a child process and within limits, so
 * that a malformed file cannot harm this process. */
BCH_API bch_status bch_character_import(const char* path, const bch_import_options* options,
                                        bch_character** character);

/* Recordings -------------------------------------------------------------------------------------------------------- */

/** Reads a recording of people: their positions, frame by frame. */
typedef struct bch_trajectory bch_trajectory;
/** Holds values that override those of the file. */
typedef struct bch_trajectory_options {
  uint32_t size;         /**< sizeof(bch_trajectory_options) */
  double fps;            /**< frames a second; 0: what the file says */
  double unit;           /**< metres for a unit of the file; 0: what the file says */
  const char* columns;   /**< of text and CSV: the names of their columns in order, as "frame,id,x,y"; NULL: what the file says */
  bch_progress progress; /**< or NULL; called with 0 of 0 parts while the recording is opened, and can cancel */
  void* user;            /**< for progress */
} bch_trajectory_options;
#define BCH_TRAJECTORY_OPTIONS_INIT \
  { sizeof(bch_trajectory_options), 0, 0, NULL, NULL, NULL }
/** Opens a recording, whose format is recognised by its content: JuPedSim's SQLite and HDF5, PeTrack's and Juelich's text, the Pedestrian
 * Dynamics Data Archive's HDF5, Pathfinder's CSV, TrajNet++ and ETH/UCY, CSV with a header. */
BCH_API bch_status bch_trajectory_open(const char* path, const bch_trajectory_options* options,
                                       bch_trajectory** trajectory);
/** Selects what the values of a column are. */
enum {
  BCH_COLUMN_DOUBLE = 0, /**< double */
  BCH_COLUMN_FLOAT = 1,  /**< float */
  BCH_COLUMN_INT64 = 2,  /**< int64_t */
  BCH_COLUMN_INT32 = 3,  /**< int32_t */
  BCH_COLUMN_TEXT = 4    /**< const char*, of which NULL is an empty text */
};
/** Refers to a column of a table of the caller, with a value for each row: an array, or a member of structs. */
typedef struct bch_column {
  const char* name;   /**< as in the header of CSV: "frame", "x [cm]", "heading [deg]" */
  const void* values; /**< or NULL where the column is not read */
  size_t stride;      /**< bytes from a value to the next; 0: one follows the other */
  int32_t type;       /**< BCH_COLUMN_DOUBLE ... */
  int32_t unused;
} bch_column;
/** Opens a recording that is in memory, as rows of named columns. It is the same as a CSV file with that header and those rows, which messages
 * number from 0. The values are not copied: they have to stay as they are until the recording is freed. What is wrong with them is
 * BCH_INVALID_ARGUMENT. `options->columns` is NULL. */
BCH_API bch_status bch_trajectory_from_columns(const bch_column* columns, size_t column_count, size_t row_count,
                                               const bch_trajectory_options* options, bch_trajectory** trajectory);
/** Holds the format, size and assumptions of a recording. */
typedef struct bch_trajectory_info {
  uint32_t size; /**< sizeof(bch_trajectory_info) */
  double fps;    /**< frames a second */
  uint64_t rows;
  uint64_t people; /**< the number of different ids; 0 where they are too many to be counted */
  int64_t first_frame;
  int64_t last_frame;
  const char* format;      /**< such as "JuPedSim SQLite, version 2"; lives as long as the trajectory, like the next */
  const char* geometry;    /**< the walkable area as well-known text, or empty */
  const char* assumptions; /**< a line for each thing that the file does not say, and what was assumed for it */
  const char* notes;       /**< a line for each thing that seems to be wrong: columns that are not read, values of another unit */
} bch_trajectory_info;
#define BCH_TRAJECTORY_INFO_INIT \
  { sizeof(bch_trajectory_info), 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL }
/** Gets the format, size and assumptions of a recording. */
BCH_API bch_status bch_trajectory_get_info(const bch_trajectory* trajectory, bch_trajectory_info* info);
/** Names the body that rows of a recording name, and the clip that it plays; one of the two may be empty. */
typedef struct bch_named_motion {
  const char* character;
  const char* clip;
} bch_named_motion;
/** Gets all motions that rows name, in the order of the file. They live as long as the trajectory. */
BCH_API bch_status bch_trajectory_get_motions(const bch_trajectory* trajectory, const bch_named_motion** motions,
                                              size_t* count);
/** Describes the body that rows have in place of a walking person's. */
typedef struct bch_named_body {
  const char* kind; /**< such as "box", or a name of bch_check_options::footprints; empty where the motion is a person's */
  float length, width; /**< metres; 0 where rows do not say it */
} bch_named_body;
/** Gets the bodies of all motions that rows name, in the order of bch_trajectory_get_motions(), where a body that does not walk has neither a
 * character nor a clip. They live as long as the trajectory. */
BCH_API bch_status bch_trajectory_get_bodies(const bch_trajectory* trajectory, const bch_named_body** bodies,
                                             size_t* count);
/** Stands for the motion of a row that names neither a body nor a clip. */
#define BCH_NO_MOTION 0xffffffffu
/** Describes a person in a frame, and the motion that the person's row names. */
typedef struct bch_tracked_person {
  int64_t frame;
  int64_t id;
  double x, y;        /**< metres */
  float heading;      /**< radians; NaN where the file does not say */
  float stature;      /**< the person's height, metres; NaN where the file does not say */
  uint32_t motion;    /**< index into those of bch_trajectory_get_motions(), or BCH_NO_MOTION */
  float clip_seconds; /**< the time in the motion's clip; NaN where the file does not say */
} bch_tracked_person;
/** Reads the people of the next frames, as many whole frames as fit; a frame that is larger than `capacity` is an invalid argument.
 * At the end it reads none. */
BCH_API bch_status bch_trajectory_read(bch_trajectory* trajectory, bch_tracked_person* people, size_t capacity,
                                       size_t* count);
/** Frees a recording. */
BCH_API bch_status bch_trajectory_free(bch_trajectory* trajectory);

/** Holds the results of a check of a recording: who runs into whom. */
typedef struct bch_check bch_check;
/** Says how fast people walk in the clips of a name. */
typedef struct bch_clip_speed {
  const char* clip;
  double speed; /**< metres per second; 0: they stand */
} bch_clip_speed;
/** Describes what a body that does not walk covers on the ground, which rows of a recording name. */
typedef struct bch_footprint {
  const char* name;
  const char* wkt; /**< polygons in metres, about the body's position, facing +x; holes are filled */
} bch_footprint;
/** Holds the options of a check. */
typedef struct bch_check_options {
  uint32_t size;              /**< sizeof(bch_check_options) */
  uint32_t threads;           /**< 0: one for each processor */
  double max_distance;        /**< gaps up to this distance are reported, metres; 0: only overlaps */
  const bch_obstacles* walls; /**< NULL: those of the recording */
  int32_t without_walls;      /**< not 0: walls are not checked */
  bch_progress progress;      /**< or NULL */
  void* user;                 /**< for progress */
  uint32_t depth;             /**< the depth of the bodies' hierarchies */
  int32_t leaves;             /**< BCH_SEGMENTS or BCH_DISCS: what decides at BCH_ALL_DEPTHS */
  const bch_character* const* characters; /**< the bodies that people have, by their ids; each has a clip that walks straight on */
  size_t character_count;                 /**< 0: built-in pedestrians */
  const bch_shape_set* baked; /**< or NULL: a loaded or baked set, whose shapes people have, at its last level; no characters then */
  const bch_clip_speed* clip_speeds; /**< of the baked set, which does not say how fast people walk in its clips */
  size_t clip_speed_count;
  double facing; /**< of the baked set: the direction that people face, radians from +x */
  /** The most pairs of people near each other, in a frame or in the frames of a task (about 4096 rows); more are BCH_TOO_LARGE.
   * 0: 4 million and 100 a person. */
  size_t max_pairs;
  /** Of a body, of people who have bodies of spheres in place of outlines, posed at their times and compared in space: 64, 128, 256 or 512, and of
   * characters that the library has no models of up to 4096. 0: outlines. There is neither a baked set nor another depth or leaves then. */
  uint32_t spheres;
  uint32_t unused;  /**< 0 */
  int32_t measures; /**< not 0: people and pairs are measured, for bch_check_get_measures() and bch_check_get_conflicts() */
  /** What rows name beside disc, box, ellipse, wheelchair, bicycle, trolley and robot. Where rows have such bodies there are neither spheres nor a
   * baked set. */
  const bch_footprint* footprints;
  size_t footprint_count;
} bch_check_options;
#define BCH_CHECK_OPTIONS_INIT \
  { sizeof(bch_check_options), 0, 0, NULL, 0, NULL, NULL, BCH_ALL_DEPTHS, BCH_SEGMENTS, NULL, 0, NULL, NULL, 0, 0, 0, 0, 0, 0, NULL, 0 }
/** Puts a walking person on every row of a recording that has not been read from, or the body that the row has, and finds who runs into whom. */
BCH_API bch_status bch_check_run(bch_trajectory* trajectory, const bch_check_options* options, bch_check** check);
/** Holds the summary of a whole recording. */
typedef struct bch_check_summary {
  uint32_t size;   /**< sizeof(bch_check_summary) */
  uint32_t shapes; /**< different poses; 0 of bodies of spheres */
  double fps;
  uint64_t frames;
  uint64_t people;
  uint64_t person_frames;
  uint64_t overlapping;            /**< person-frames that overlap somebody */
  uint64_t in_walls;               /**< person-frames that overlap a wall */
  uint64_t guessed_headings;       /**< person-frames whose heading is that of before */
  uint64_t near_pairs;             /**< pairs of a frame within 1.2 m */
  uint64_t overlapping_near_pairs; /**< those of these pairs that overlap */
  uint64_t colliding_people;       /**< people who overlap or pass anybody at any time, where measures are asked for */
  uint64_t disc_colliding_people;  /**< the same of discs of 0.1 m */
  uint64_t overlap_events, pass_events, wall_events; /**< all events, by their kinds */
} bch_check_summary;
#define BCH_CHECK_SUMMARY_INIT \
  { sizeof(bch_check_summary), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }
/** Gets the summary of a check. */
BCH_API bch_status bch_check_get_summary(const bch_check* check, bch_check_summary* summary);
/** Counts the person-frames of a class of density. */
typedef struct bch_check_density {
  double from;            /**< people per square metre within a metre of the person; to the `from` of the next class, or any more */
  uint64_t person_frames; /**< these and the next are counted as in bch_check_summary */
  uint64_t overlapping, in_walls, near_pairs, overlapping_near_pairs;
} bch_check_density;
/** Gets the counts of all classes of density, from the lowest on; they live as long as the check. */
BCH_API bch_status bch_check_get_densities(const bch_check* check, const bch_check_density** densities, size_t* count);
/** Gets what was assumed for what the recording does not say, and what was found out about characters, one line each. The text lives as
 * long as the check. */
BCH_API bch_status bch_check_get_assumptions(const bch_check* check, const char** assumptions);
/** Gets what seems to be wrong with the recording, one line each: its own notes, people too fast or too slow to be people, walls without a
 * segment. The text lives as long as the check. */
BCH_API bch_status bch_check_get_notes(const bch_check* check, const char** notes);

enum {
  BCH_CHECK_NEAR = 0,    /**< two people within the largest distance */
  BCH_CHECK_OVERLAP = 1, /**< two people who overlap */
  BCH_CHECK_PASS = 2,    /**< two people who overlap between this frame and the next, and in neither */
  BCH_CHECK_WALL = 3     /**< a person and a wall */
};
/** Describes a frame of a check. */
typedef struct bch_check_frame {
  int64_t frame;
  double seconds;
  uint32_t people, overlapping, overlapping_pairs, in_walls;
  float density; /**< the mean of people per square metre within a metre of each */
  float unused;
} bch_check_frame;
/** Describes two people of a frame, or a person and a wall. */
typedef struct bch_check_pair {
  int64_t frame;
  int64_t first, second; /**< ids; `second` is the number of a wall */
  float depth;           /**< how far the first has to move to be free; of spheres in a wall, how deep one is; metres */
  float gap;             /**< how far they are apart in this frame, metres; 0 also where discs overlap, but not their ancestors */
  float x, y;            /**< the direction in which the first has to move */
  int32_t kind;          /**< BCH_CHECK_OVERLAP ... */
  int32_t unused;
} bch_check_pair;
/** Describes two people, or a person and a wall, who overlap in consecutive frames, or two people who pass once. */
typedef struct bch_check_event {
  int64_t first, second;   /**< ids */
  int64_t from, to, worst; /**< the first and the last frame, and the one in which they overlap the deepest; of a pass the frame before it */
  double x, y;             /**< where the first is then, metres */
  float depth;             /**< how deep they overlap in that frame, metres */
  uint32_t frames;
  int32_t kind; /**< BCH_CHECK_OVERLAP, BCH_CHECK_PASS or BCH_CHECK_WALL */
  float after;  /**< of a pass: how long after that frame they touch, in frames; else 0 */
} bch_check_event;
/** Gets all frames; they live as long as the check, like the next. */
BCH_API bch_status bch_check_get_frames(const bch_check* check, const bch_check_frame** frames, size_t* count);
/** Gets all pairs, frame after frame. */
BCH_API bch_status bch_check_get_pairs(const bch_check* check, const bch_check_pair** pairs, size_t* count);
/** Gets all events, ordered by their first frames. */
BCH_API bch_status bch_check_get_events(const bch_check* check, const bch_check_event** events, size_t* count);
/** Describes what is measured of a person of a frame. bench/README.md defines it. Members of discs are about discs of 0.1 m, the others about
 * bodies. Least values are over all others of the frame, and infinite beyond what is measured. */
typedef struct bch_check_measure {
  int64_t frame, id;
  float density;                   /**< people per square metre within a metre */
  float voronoi_density;           /**< one over the area of the person's Voronoi cell, square metres */
  float clearance, disc_clearance; /**< the least, metres; below 0: minus the depth of an overlap */
  float ttc, disc_ttc;             /**< the least time to a collision at present velocities, seconds */
  float pet; /**< seconds since the disc of another person touched the disc of this one, where it now is */
  float intrusion, disc_intrusion; /**< the intrusion number of Cordes et al. 2024 */
  float avoidance, disc_avoidance; /**< the avoidance number of Cordes et al. 2024 */
  float unused;
  uint32_t intimate, personal;     /**< others within 0.45 m and within 1.2 m, between centres */
  int32_t collides, disc_collides; /**< 1: with somebody in this frame or before the next; discs: in this frame or halfway to the next */
} bch_check_measure;
/** Describes two people of a frame who overlap, as bodies or as discs, or will do so within 5 s at present velocities. */
typedef struct bch_check_conflict {
  int64_t frame;
  int64_t first, second;                          /**< ids */
  float distance;                                 /**< between centres, metres */
  float clearance, disc_clearance, ttc, disc_ttc; /**< as in bch_check_measure, of these two */
  float unused;
} bch_check_conflict;
/** Gets what is measured of all people, frame after frame; nothing where it was not asked for. It lives as long as the check. */
BCH_API bch_status bch_check_get_measures(const bch_check* check, const bch_check_measure** measures, size_t* count);
/** Gets what is measured of pairs, frame after frame; nothing where it was not asked for. It lives as long as the check. */
BCH_API bch_status bch_check_get_conflicts(const bch_check* check, const bch_check_conflict** pairs, size_t* count);
/** Frees a check. */
BCH_API bch_status bch_check_free(bch_check* check);

#ifdef __cplusplus
}
#endif

#endif
