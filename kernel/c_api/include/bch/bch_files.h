/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 the bch authors */

#ifndef BCH_BCH_FILES_H
#define BCH_BCH_FILES_H

#include <bch/bch.h>

/** @file
 * Declares the part of the C interface that reads files of other programs: characters, and recordings of
 * people, which it also checks. These functions are in a separate library, libbch_files, because it needs
 * more packages. Link it in addition to libbch of the same version. Results, handles, structs, arrays,
 * threads and memory are as <bch/bch.h> says.
 */

#ifdef __cplusplus
extern "C" {
#endif

/* Characters -------------------------------------------------------------------------------------------- */

/** Holds the options of an import: values that override those of the file, and limits. */
typedef struct bch_import_options {
  uint32_t size;                 /**< sizeof(bch_import_options) */
  /** The axis that points up: 0, 1 or 2 for x, y or z; -1: what the file states, or a guess. */
  int32_t up;
  float scale;                   /**< metres per unit of the file; 0: what the file states, or a guess */
  int32_t force_clips;           /**< not 0: also accepts clips that belong to another skeleton */
  const char* const* clip_files; /**< paths of files whose clips follow those of the character's own file */
  size_t clip_file_count;
  uint64_t max_triangles; /**< files with more are an error */
  double seconds;          /**< the longest time that reading may take */
  uint64_t memory;         /**< the most memory that reading may take, bytes */
  bch_progress progress;   /**< or NULL; called with 0 of 0 parts, and can cancel */
  void* user;              /**< for progress */
} bch_import_options;
#define BCH_IMPORT_OPTIONS_INIT \
  { sizeof(bch_import_options), -1, 0, 0, NULL, 0, 0x7fffffff, 60, (uint64_t)2 << 30, NULL, NULL }
/** Reads a character from a file (glTF 2, FBX, Collada, MD5, IQM, OBJ, PLY, STL). It does so in a child
 * process and within limits, so that a malformed file cannot harm this process. */
BCH_API bch_status bch_character_import(const char* path, const bch_import_options* options,
                                        bch_character** character);

/* Recordings -------------------------------------------------------------------------------------------- */

/** Holds an open recording of people, from which their positions are read frame by frame. */
typedef struct bch_trajectory bch_trajectory;
/** Holds values that override those of the file. */
typedef struct bch_trajectory_options {
  uint32_t size;         /**< sizeof(bch_trajectory_options) */
  double fps;            /**< frames per second; 0: what the file states */
  double unit;           /**< metres per unit of the file; 0: what the file states */
  /** For text and CSV: the column names in order, such as "frame,id,x,y"; NULL: what the file states. */
  const char* columns;
  /** Or NULL; called with 0 of 0 parts while the recording is opened, and can cancel. */
  bch_progress progress;
  void* user;            /**< for progress */
} bch_trajectory_options;
#define BCH_TRAJECTORY_OPTIONS_INIT \
  { sizeof(bch_trajectory_options), 0, 0, NULL, NULL, NULL }
/** Opens a recording, whose format is recognised by its content: JuPedSim's SQLite and HDF5, PeTrack's and
 * Juelich's text, the Pedestrian Dynamics Data Archive's HDF5, Pathfinder's CSV, TrajNet++ and ETH/UCY, CSV
 * with a header. */
BCH_API bch_status bch_trajectory_open(const char* path, const bch_trajectory_options* options,
                                       bch_trajectory** trajectory);
/** Selects the type of a column's values. */
enum {
  BCH_COLUMN_DOUBLE = 0, /**< double */
  BCH_COLUMN_FLOAT = 1,  /**< float */
  BCH_COLUMN_INT64 = 2,  /**< int64_t */
  BCH_COLUMN_INT32 = 3,  /**< int32_t */
  BCH_COLUMN_TEXT = 4    /**< const char*; NULL is an empty text */
};
/** Refers to a column of the caller's table, with one value per row: an array, or a member of structs. */
typedef struct bch_column {
  const char* name;   /**< as in the header of CSV: "frame", "x [cm]", "heading [deg]" */
  const void* values; /**< or NULL: the column is not read */
  size_t stride;      /**< bytes from one value to the next; 0: packed */
  int32_t type;       /**< BCH_COLUMN_DOUBLE ... */
  int32_t unused;
} bch_column;
/** Opens a recording in memory: rows of named columns, which give the same results as a CSV file with this
 * header and these rows. The values are not copied: do not change or free them before the recording is freed.
 * Messages count rows from 0. Invalid values give BCH_INVALID_ARGUMENT. `options->columns` has to be NULL. */
BCH_API bch_status bch_trajectory_from_columns(const bch_column* columns, size_t column_count,
                                               size_t row_count, const bch_trajectory_options* options,
                                               bch_trajectory** trajectory);
/** Holds the format, size and assumptions of a recording. */
typedef struct bch_trajectory_info {
  uint32_t size; /**< sizeof(bch_trajectory_info) */
  double fps;    /**< frames per second */
  uint64_t rows;
  uint64_t people; /**< the number of different ids; 0 if they are too many to be counted */
  int64_t first_frame;
  int64_t last_frame;
  /** Such as "JuPedSim SQLite, version 2"; lives as long as the trajectory, like the next. */
  const char* format;
  const char* geometry;    /**< the walkable area as well-known text, or empty */
  const char* assumptions; /**< a line for each thing that the file does not state, and what is assumed */
  /** A line for each thing that seems to be wrong: columns that are not read, values of another unit. */
  const char* notes;
} bch_trajectory_info;
#define BCH_TRAJECTORY_INFO_INIT \
  { sizeof(bch_trajectory_info), 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL }
/** Gets the format, size and assumptions of a recording. */
BCH_API bch_status bch_trajectory_get_info(const bch_trajectory* trajectory, bch_trajectory_info* info);
/** Holds the names of a character and a clip that rows of a recording give. One of the two may be empty. */
typedef struct bch_named_motion {
  const char* character;
  const char* clip;
} bch_named_motion;
/** Gets all pairs of a character and a clip that rows name, in the order of the file. They live as long as
 * the trajectory. */
BCH_API bch_status bch_trajectory_get_motions(const bch_trajectory* trajectory,
                                              const bch_named_motion** motions, size_t* count);
/** Describes the body that rows have instead of a walking person's, such as a cart. */
typedef struct bch_named_body {
  /** Such as "box", or a name of bch_check_options::footprints; empty if the motion is a person's. */
  const char* kind;
  float length, width; /**< metres; 0 if rows do not state it */
} bch_named_body;
/** Gets one body per motion, in the order of bch_trajectory_get_motions(); motions of bodies that do not walk
 * have neither a character nor a clip. They live as long as the trajectory. */
BCH_API bch_status bch_trajectory_get_bodies(const bch_trajectory* trajectory, const bch_named_body** bodies,
                                             size_t* count);
/** The motion of rows that name neither a body nor a clip. */
#define BCH_NO_MOTION 0xffffffffu
/** Describes a person in a frame, and the motion that the person's row names. */
typedef struct bch_tracked_person {
  int64_t frame;
  int64_t id;
  double x, y;        /**< metres */
  float heading;      /**< radians; NaN if unknown */
  float stature;      /**< the person's height, metres; NaN if unknown */
  uint32_t motion;    /**< index into the result of bch_trajectory_get_motions(), or BCH_NO_MOTION */
  float clip_seconds; /**< the time in the motion's clip; NaN if unknown */
} bch_tracked_person;
/** Reads the people of the next frames: as many whole frames as fit into `capacity` people. A frame with more
 * people gives BCH_INVALID_ARGUMENT. At the end `count` is 0. */
BCH_API bch_status bch_trajectory_read(bch_trajectory* trajectory, bch_tracked_person* people,
                                       size_t capacity, size_t* count);
/** Frees a recording. */
BCH_API bch_status bch_trajectory_free(bch_trajectory* trajectory);

/** Holds the results of a check of a recording: who runs into whom. */
typedef struct bch_check bch_check;
/** Says how fast people walk in all clips of a name. */
typedef struct bch_clip_speed {
  const char* clip;
  double speed; /**< metres per second; 0: they stand */
} bch_clip_speed;
/** Describes the page of a check, HTML that plays the recording without a network. The page omits what is
 * NULL. */
typedef struct bch_page {
  const char* title;   /**< such as the file's name */
  const char* date;    /**< of the recording */
  const char* options; /**< that the results depend on */
} bch_page;
/** Describes what a kind of body that rows of a recording name covers on the ground. */
typedef struct bch_footprint {
  const char* name;
  const char* wkt; /**< polygons in metres, about the body's position, facing +x; holes are filled */
} bch_footprint;
/** Holds the options of a check. */
typedef struct bch_check_options {
  uint32_t size;              /**< sizeof(bch_check_options) */
  uint32_t threads;           /**< 0: one for each processor */
  double max_distance;        /**< gaps up to this distance are reported, metres; 0: only overlaps */
  const bch_obstacles* walls; /**< NULL: the walls of the recording */
  int32_t without_walls;      /**< not 0: walls are not checked */
  bch_progress progress;      /**< or NULL */
  void* user;                 /**< for progress */
  uint32_t depth;             /**< the depth of the bodies' hierarchies */
  int32_t leaves;             /**< BCH_SEGMENTS or BCH_DISCS: what is compared at BCH_ALL_DEPTHS */
  /** The people's bodies, assigned by id; each has a clip that walks straight on. */
  const bch_character* const* characters;
  size_t character_count;                 /**< 0: built-in pedestrians */
  /** Or NULL: a loaded or baked set; its shapes, at the last level, are the people's bodies, instead of
   * characters. */
  const bch_shape_set* baked;
  /** For a baked set, which does not state how fast people walk in its clips. */
  const bch_clip_speed* clip_speeds;
  size_t clip_speed_count;
  double facing; /**< for a baked set: the direction that people face, radians from +x */
  /** The largest number of pairs of people near each other, in a frame or in the frames of a task (about
   * 4096 rows); more give BCH_TOO_LARGE. 0: 4 million plus 100 per person. */
  size_t max_pairs;
  /** The number of spheres of each body: 64, 128, 256 or 512; up to 4096 for characters that are not built
   * in. Bodies are then posed anew in every frame and compared in space; a baked set, and another depth or
   * leaves, are errors. 0: outlines, seen from above. */
  uint32_t spheres;
  uint32_t unused;  /**< 0 */
  /** Not 0: also finds the results of bch_check_get_measures() and bch_check_get_conflicts(). */
  int32_t measures;
  /** Kinds of bodies that rows may name beside disc, box, ellipse, wheelchair, bicycle, trolley and robot.
   * If rows have such bodies, spheres and a baked set are errors. */
  const bch_footprint* footprints;
  size_t footprint_count;
  const bch_page* page; /**< or NULL: no page is made for bch_check_get_page(), of up to 30 MB */
  /** Or NULL: what people truly did, if the recording is a prediction, with the same ids, frames and frame
   * rate. It must not have been read from, nor be the trajectory that is checked. */
  bch_trajectory* truth;
} bch_check_options;
#define BCH_CHECK_OPTIONS_INIT \
  { sizeof(bch_check_options), 0, 0, NULL, 0, NULL, NULL, BCH_ALL_DEPTHS, BCH_SEGMENTS, NULL, 0, NULL, \
    NULL, 0, 0, 0, 0, 0, 0, NULL, 0, NULL, NULL }
/** Finds who runs into whom in a recording: each row becomes a walking person, or the body that the row
 * names. The recording must not have been read from. */
BCH_API bch_status bch_check_run(bch_trajectory* trajectory, const bch_check_options* options,
                                 bch_check** check);
/** Holds the summary of a whole recording. */
typedef struct bch_check_summary {
  uint32_t size;   /**< sizeof(bch_check_summary) */
  uint32_t shapes; /**< the number of different poses; 0 for bodies of spheres */
  double fps;
  uint64_t frames;
  uint64_t people;
  uint64_t person_frames;
  uint64_t overlapping;            /**< person-frames in which the person overlaps somebody */
  uint64_t in_walls;               /**< person-frames in which the person overlaps a wall */
  uint64_t guessed_headings;       /**< person-frames whose heading is taken from an earlier frame */
  uint64_t near_pairs;             /**< pairs of a frame within 1.2 m */
  uint64_t overlapping_near_pairs; /**< those of these pairs that overlap */
  /** People who overlap or pass anybody at any time; only with `measures`. */
  uint64_t colliding_people;
  uint64_t disc_colliding_people;  /**< the same for discs of radius 0.1 m */
  uint64_t overlap_events, pass_events, wall_events; /**< the number of events of each kind */
  uint64_t truth_frames;           /**< frames of both recordings; only with `truth` */
  /** People whose body overlaps that of another who moves as in `truth`. */
  uint64_t truth_colliding_people;
  uint64_t truth_disc_colliding_people; /**< the same for discs of radius 0.1 m */
} bch_check_summary;
#define BCH_CHECK_SUMMARY_INIT \
  { sizeof(bch_check_summary), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }
/** Gets the summary of a check. */
BCH_API bch_status bch_check_get_summary(const bch_check* check, bch_check_summary* summary);
/** Counts the person-frames of a class of density. */
typedef struct bch_check_density {
  /** People per square metre within a metre of the person; to the `from` of the next class, or any more. */
  double from;
  uint64_t person_frames; /**< these and the next are counted as in bch_check_summary */
  uint64_t overlapping, in_walls, near_pairs, overlapping_near_pairs;
} bch_check_density;
/** Gets the counts of all classes of density, from the lowest on; they live as long as the check. */
BCH_API bch_status bch_check_get_densities(const bch_check* check, const bch_check_density** densities,
                                           size_t* count);
/** Gets what was assumed because the recording does not state it, and what was found about the characters,
 * one line each. The text lives as long as the check. */
BCH_API bch_status bch_check_get_assumptions(const bch_check* check, const char** assumptions);
/** Gets what seems to be wrong with the recording, one line each: its own notes, people too fast or too slow
 * to be people, walls without a segment. The text lives as long as the check. */
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
  /** How far the first has to move to separate, metres; for spheres in a wall: how deep the deepest is. */
  float depth;
  /** Their distance in this frame, metres; 0 also if discs overlap and their ancestors do not. */
  float gap;
  float x, y;            /**< the direction in which the first has to move */
  int32_t kind;          /**< BCH_CHECK_OVERLAP ... */
  int32_t unused;
} bch_check_pair;
/** Describes two people, or a person and a wall, who overlap in consecutive frames, or two people who pass
 * once. */
typedef struct bch_check_event {
  int64_t first, second;   /**< ids */
  /** The first and the last frame, and that of the deepest overlap; for a pass: the frame before it. */
  int64_t from, to, worst;
  double x, y;             /**< the position of the first at `worst`, metres */
  float depth;             /**< the depth of the overlap at `worst`, metres */
  uint32_t frames;
  int32_t kind; /**< BCH_CHECK_OVERLAP, BCH_CHECK_PASS or BCH_CHECK_WALL */
  float after;  /**< for a pass: how long after `worst` they touch, in frames; else 0 */
} bch_check_event;
/** Gets all frames; they live as long as the check, like the next. */
BCH_API bch_status bch_check_get_frames(const bch_check* check, const bch_check_frame** frames,
                                        size_t* count);
/** Gets all pairs, frame after frame. */
BCH_API bch_status bch_check_get_pairs(const bch_check* check, const bch_check_pair** pairs, size_t* count);
/** Gets all events, ordered by their first frames. */
BCH_API bch_status bch_check_get_events(const bch_check* check, const bch_check_event** events,
                                        size_t* count);
/** Holds the measures of a person in a frame, which bench/README.md defines. Members with `disc_` are for
 * discs of radius 0.1 m, the others for bodies. Least values are over all other people of the frame, and
 * infinite if nobody is within the measured range. */
typedef struct bch_check_measure {
  int64_t frame, id;
  float density;                   /**< people per square metre within a metre */
  float voronoi_density;           /**< one over the area of the person's Voronoi cell, square metres */
  float clearance, disc_clearance; /**< the least, metres; negative: minus the depth of an overlap */
  float ttc, disc_ttc;             /**< the least time to a collision at present velocities, seconds */
  float pet; /**< post-encroachment time: seconds since another person's disc was where this one's is now */
  float intrusion, disc_intrusion; /**< the intrusion number of Cordes et al. 2024 */
  float avoidance, disc_avoidance; /**< the avoidance number of Cordes et al. 2024 */
  float unused;
  uint32_t intimate, personal;     /**< others within 0.45 m and within 1.2 m, between centres */
  /** 1: with somebody in this frame or before the next; for discs: in this frame or halfway to the next. */
  int32_t collides, disc_collides;
} bch_check_measure;
/** Describes two people of a frame who overlap, as bodies or as discs, or will do so within 5 s at present
 * velocities. */
typedef struct bch_check_conflict {
  int64_t frame;
  int64_t first, second;                          /**< ids */
  float distance;                                 /**< between centres, metres */
  float clearance, disc_clearance, ttc, disc_ttc; /**< as in bch_check_measure, of these two */
  float unused;
} bch_check_conflict;
/** Gets the measures of all people, frame after frame; none without bch_check_options::measures. They live as
 * long as the check. */
BCH_API bch_status bch_check_get_measures(const bch_check* check, const bch_check_measure** measures,
                                          size_t* count);
/** Gets the measures of pairs, frame after frame; none without bch_check_options::measures. They live as long
 * as the check. */
BCH_API bch_status bch_check_get_conflicts(const bch_check* check, const bch_check_conflict** pairs,
                                           size_t* count);
/** Gets the page, an empty text without bch_check_options::page. It lives as long as the check. */
BCH_API bch_status bch_check_get_page(const bch_check* check, const char** html, size_t* size);
/** Frees a check. */
BCH_API bch_status bch_check_free(bch_check* check);

#ifdef __cplusplus
}
#endif

#endif
