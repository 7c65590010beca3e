/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 the bch authors */

#ifndef BCH_BCH_H
#define BCH_BCH_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

/** @file
 * Declares the C interface of bch, in C99, for programs of other compilers and languages. It offers what the
 * C++ headers offer; their comments say more about each answer.
 *
 * Results:  every function that can fail returns a bch_status and writes its results through its last
 *           arguments. Unless it returns BCH_OK, nothing has been written, and bch_last_error() says what is
 *           wrong.
 * Handles:  an object is a pointer that a function creates and that the free function of its kind frees;
 *           freeing NULL does nothing. A pointer that is not a live object of the right kind gives
 *           BCH_INVALID_ARGUMENT. If several threads free one object, one succeeds. A pointer that a getter
 *           returned is valid until its object is freed.
 * Structs:  those that begin with `size` may grow at their end in later versions: initialise them by the
 *           macro of their name, which fills in the size and the defaults. NULL in place of options means the
 *           defaults.
 * Arrays:   belong to the caller, are packed, and are read during the call only. An empty one may be NULL.
 * Units:    metres and radians, counter-clockwise. A heading of 0 does not turn a shape, and the built-in
 *           characters then face +x.
 * Threads:  functions may be called from any thread. While a function that takes an object without const
 *           runs, no other thread may use that object. Any number of threads may query a set or obstacles at
 *           the same time.
 * Memory:   a failed allocation gives BCH_NO_MEMORY. Queries of pairs allocate nothing, except clearances and
 *           times of impact of agents at different heights. No function throws, ends the program or prints.
 */

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32) && defined(BCH_EXPORTS)
#define BCH_API __declspec(dllexport)
#elif defined(_WIN32)
#define BCH_API __declspec(dllimport)
#elif defined(__GNUC__)
#define BCH_API __attribute__((visibility("default")))
#else
#define BCH_API
#endif

/* Basics ------------------------------------------------------------------------------------------------ */

/** Gives the version of this binary interface. A program that was built with one version runs with every
 * library of the same version. */
#define BCH_ABI_VERSION 1

/** Returns the version of the binary interface of the library that is loaded. */
BCH_API uint32_t bch_abi_version(void);
/** Returns the version of the library that is loaded, such as "0.4.0". */
BCH_API const char* bch_version(void);

/** Tells whether a function succeeded, and if not, why. Functions return it. */
typedef int32_t bch_status;
enum {
  BCH_OK = 0,
  BCH_INVALID_ARGUMENT =
      1, /**< an invalid argument; the message names it, an index and the value */
  BCH_OUT_OF_RANGE =
      2, /**< an index argument that is out of range; inside an array it is BCH_INVALID_ARGUMENT */
  BCH_TOO_LARGE = 3, /**< more than the library's limits allow */
  BCH_NO_MEMORY = 4,
  BCH_FILE_NOT_FOUND = 5,
  BCH_BAD_FILE = 6,  /**< a file that is malformed, or cannot be read or written */
  BCH_CANCELLED = 7, /**< a callback cancelled the function */
  BCH_INTERNAL = 8   /**< a bug of the library */
};
/** Returns the name of a status, "BCH_OK" for instance, or "unknown" for an unknown one. */
BCH_API const char* bch_status_name(bch_status status);
/** Returns what was wrong in the calling thread's last call that failed, as one line; empty if no call has
 * failed. The text stays until the next failure. */
BCH_API const char* bch_last_error(void);

/** Represents a point or vector of the ground plane. */
typedef struct bch_vec2 {
  float x, y;
} bch_vec2;
/** Represents a point of space; z is up. */
typedef struct bch_vec3 {
  float x, y, z;
} bch_vec3;
/** Represents a disc on the ground. */
typedef struct bch_disc {
  float x, y, radius;
} bch_disc;
/** Represents the points within a radius of a segment of the ground plane. */
typedef struct bch_capsule {
  bch_vec2 a, b;
  float radius;
} bch_capsule;
/** Holds the range of heights of a body, above the ground that its agent stands on. */
typedef struct bch_heights {
  float bottom, top;
} bch_heights;

/** Receives the progress of a function, on the caller's thread while the function works: `done` of `total`
 * parts are ready. If `total` is 0, it is not known. Returning anything but 0 cancels the function, which
 * then returns BCH_CANCELLED. */
typedef int32_t (*bch_progress)(void* user, uint64_t done, uint64_t total);

/** Says how functions that take long do their work: on how many threads, and with which callback. */
typedef struct bch_work {
  uint32_t size;         /**< sizeof(bch_work) */
  uint32_t threads;      /**< 0: one for each processor */
  bch_progress progress; /**< or NULL */
  void* user;            /**< for progress */
} bch_work;
#define BCH_WORK_INIT \
  { sizeof(bch_work), 0, NULL, NULL }

/* Characters -------------------------------------------------------------------------------------------- */

/** Holds a character: a mesh, a skeleton and clips. */
typedef struct bch_character bch_character;

/** Names the built-in characters. */
enum { BCH_MALE = 0, BCH_FEMALE = 1, BCH_BULKY_MALE = 2 };
/** Makes a built-in character, which needs no file. */
BCH_API bch_status bch_character_default(int32_t which, bch_character** character);

/** Names the sexes of pedestrians. */
enum { BCH_PEDESTRIAN_FEMALE = 0, BCH_PEDESTRIAN_MALE = 1 };
/** Makes a pedestrian of a stature in metres, for recorded and simulated crowds. Clip k is one stride at a
 * speed of k * BCH_PEDESTRIAN_SPEED_STEP metres per second, from 0 to 2.19. The origin of the shape is below
 * the head. `shoulders` is the angle between the direction that the shoulders face and the walking direction,
 * radians, counter-clockwise. */
BCH_API bch_status bch_character_pedestrian(int32_t sex, double stature, double shoulders,
                                            bch_character** character);
#define BCH_PEDESTRIAN_SPEED_STEP 0.03
/** Returns the number of strides, of two steps each, that a pedestrian takes in a second. */
BCH_API double bch_pedestrian_strides_per_second(double metres_per_second);

/** Represents an affine map, row-major: a 3 x 3 linear part, and the translation in column 3. */
typedef struct bch_affine3 {
  float rows[3][4];
} bch_affine3;
/** Holds the weight of a bone for a vertex. */
typedef struct bch_influence {
  uint32_t bone;
  float weight; /**< positive; those of a vertex sum to 1 */
} bch_influence;
enum {
  BCH_LINEAR = 0, /**< blends two keys, rotations spherically */
  BCH_STEP = 1,   /**< keeps the earlier key */
  BCH_CUBIC = 2   /**< a Hermite spline with tangents; rotations are normalised after they are blended */
};
/** Describes how a part of a joint's transform (positions, rotations or scales) moves: keys in order of time.
 * Without keys that part stays as it is at rest. */
typedef struct bch_curve {
  const float* times; /**< seconds from the start of the clip */
  /** One key after the other: x, y, z, and w of rotations, which are unit quaternions. */
  const float* values;
  /** Only of cubic curves: those before and after each key, per second, like values. */
  const float* tangents;
  size_t count; /**< of keys */
  int32_t interpolation; /**< BCH_LINEAR, BCH_STEP or BCH_CUBIC */
} bch_curve;
/** Describes the motion of one joint relative to its parent. */
typedef struct bch_channel {
  uint32_t joint;
  bch_curve positions, rotations, scales;
} bch_channel;
/** Describes a motion of a character. */
typedef struct bch_clip {
  const char* name; /**< or NULL */
  float seconds;
  const bch_channel* channels; /**< at most one per joint */
  size_t channel_count;
} bch_clip;
/** Describes a character in arrays of the caller. Joints are the nodes of the skeleton. Bones move vertices:
 * each has a joint, and its inverse bind matrix, from the vertices' frame into the joint's frame in the bind
 * pose. Without joints it is a rigid mesh at the agent's position. */
typedef struct bch_character_arrays {
  uint32_t size; /**< sizeof(bch_character_arrays) */
  /** The joint whose (x, y) is a shape's origin; -1: the centre of the mesh's bounding rectangle. */
  int32_t root_joint;
  const char* name; /**< or NULL */
  const bch_vec3* vertices;
  size_t vertex_count;
  const uint32_t* triangles; /**< three vertices each */
  size_t triangle_count;
  const int32_t* parents;         /**< of joints: an earlier joint, or -1 */
  const bch_affine3* rests;       /**< of joints, in the parent's frame; NULL: identities */
  const char* const* joint_names; /**< or NULL */
  size_t joint_count;
  const uint32_t* bone_joints;
  const bch_affine3* inverse_binds; /**< of bones; NULL: vertices are in the joints' frames */
  size_t bone_count;
  /** Vertex v follows the influences from influence_offsets[v] to before influence_offsets[v + 1]; NULL: all
   * follow the first bone. */
  const uint64_t* influence_offsets;
  const bch_influence* influences;
  const bch_clip* clips;
  size_t clip_count;
  /** From the character's frame, that of joints without a parent, to the ground: metres, z up; NULL: they are
   * the same. */
  const bch_affine3* to_ground;
} bch_character_arrays;
#define BCH_CHARACTER_ARRAYS_INIT                                                                       \
  {                                                                                                     \
    sizeof(bch_character_arrays), -1, NULL, NULL, 0, NULL, 0, NULL, NULL, NULL, 0, NULL, NULL, 0, NULL, \
        NULL, NULL, 0, NULL                                                                             \
  }
/** Makes a character from arrays, which are copied. */
BCH_API bch_status bch_character_create(const bch_character_arrays* arrays, bch_character** character);

/** Holds the sizes, names and notes of a character. */
typedef struct bch_character_info {
  uint32_t size; /**< sizeof(bch_character_info) */
  uint32_t joints;
  uint32_t clips;
  float height; /**< of an imported file's rest pose, metres; 0 for other characters */
  uint64_t vertices;
  uint64_t triangles;
  const char* name;  /**< lives as long as the character, like the next */
  const char* notes; /**< of the import: a line for every conversion, guess and repair */
} bch_character_info;
#define BCH_CHARACTER_INFO_INIT \
  { sizeof(bch_character_info), 0, 0, 0, 0, 0, NULL, NULL }
/** Gets the sizes, names and notes of a character. */
BCH_API bch_status bch_character_get_info(const bch_character* character, bch_character_info* info);
/** Gets the name and the length of a clip; either may be NULL. The name lives as long as the character. */
BCH_API bch_status bch_character_get_clip(const bch_character* character, uint32_t clip, const char** name,
                                          float* seconds);

/** Names a pose of a character: a time in one of its clips. */
typedef struct bch_pose {
  uint32_t clip; /**< or BCH_REST_POSE */
  float seconds; /**< from the start of the clip */
} bch_pose;
#define BCH_REST_POSE 0xffffffffu
/** Writes `count` poses spread evenly over all clips; those of a character without clips are the rest
 * pose. */
BCH_API bch_status bch_character_sample_poses(const bch_character* character, uint32_t count,
                                              bch_pose* poses);
/** Gets the name and the parent of a joint, -1 for one without; either may be NULL. The name lives as long as
 * the character. */
BCH_API bch_status bch_character_get_joint(const bch_character* character, uint32_t joint, const char** name,
                                           int32_t* parent);
/** Finds the one joint of a name. */
BCH_API bch_status bch_character_find_joint(const bch_character* character, const char* name,
                                            uint32_t* joint);

/** Selects the form of poses in bch_pose_arrays. */
enum {
  BCH_JOINTS_IN_PARENTS = 0, /**< the transforms of all joints, each in the frame of its parent */
  BCH_JOINTS_IN_WORLD =
      1, /**< the world transforms of all joints: metres, z up; the root joint's (x, y) is the origin */
  BCH_BONE_MATRICES =
      2, /**< skinning matrices of all bones: the joint's world transform times its inverse bind matrix */
  BCH_POSED_VERTICES =
      3 /**< the positions of all vertices, three floats each: metres, z up, relative to the shape's origin */
};
/** Selects how transforms are written. */
enum {
  BCH_FLOAT_ROWS = 0,    /**< float[12]: row-major 3 x 4, as bch_affine3 */
  BCH_FLOAT_COLUMNS = 1, /**< float[16]: column-major 4 x 4, as in OpenGL, glTF and glm */
  BCH_DOUBLE_ROWS = 2,   /**< double[12]: row-major */
  BCH_DOUBLE_COLUMNS = 3 /**< double[16]: column-major */
};
/** Refers to poses in an array of the caller, one pose after the other. */
typedef struct bch_pose_arrays {
  uint32_t size;    /**< sizeof(bch_pose_arrays) */
  int32_t kind;     /**< BCH_JOINTS_IN_PARENTS ... */
  int32_t layout;   /**< BCH_FLOAT_ROWS ...; has to be BCH_FLOAT_ROWS for vertices */
  const void* data; /**< the numbers */
  size_t count;     /**< of transforms or vertices in a pose */
  /** Numbers from one transform or vertex to the next, at least the size of one; 0: packed. */
  size_t stride;
  /** For bone matrices: x and y of each pose's origin in the world; NULL: (0, 0). */
  const double* origins;
} bch_pose_arrays;
#define BCH_POSE_ARRAYS_INIT \
  { sizeof(bch_pose_arrays), BCH_JOINTS_IN_PARENTS, BCH_FLOAT_ROWS, NULL, 0, 0, NULL }

/** Writes the transforms of all joints at a time of a clip, as BCH_DOUBLE_ROWS. `kind` is
 * BCH_JOINTS_IN_PARENTS or BCH_JOINTS_IN_WORLD. Passed back as a pose, they give the shape of the clip, bit
 * for bit. */
BCH_API bch_status bch_character_get_transforms(const bch_character* character, bch_pose pose, int32_t kind,
                                                double* rows);
/** Writes the transforms of all joints in the weighted mean of poses, each in the frame of the joint's
 * parent, as BCH_DOUBLE_ROWS. */
BCH_API bch_status bch_character_blend(const bch_character* character, const bch_pose* poses,
                                       const float* weights, size_t count, double* rows);
/** Writes the positions of all vertices at a time of a clip. */
BCH_API bch_status bch_character_get_vertices(const bch_character* character, bch_pose pose,
                                              bch_vec3* positions);
/** Frees a character. Shapers that were made from it stay valid. */
BCH_API bch_status bch_character_free(bch_character* character);

/* Sets of shapes ---------------------------------------------------------------------------------------- */

/** Holds shapes of bodies, ready to be queried. */
typedef struct bch_shape_set bch_shape_set;

/** Selects the deepest level of detail, as a depth in bch_plan: the leaves of a shape's tree of discs. */
#define BCH_ALL_DEPTHS 0xffffffffu

/** Says which levels and data a set stores for each shape. Nothing else is built. Over the outline of each
 * shape, seen from above, stands a binary tree of discs. A level of detail is the discs at one depth of the
 * tree, and the leaves above that depth. */
typedef struct bch_plan {
  uint32_t size;    /**< sizeof(bch_plan) */
  int32_t outlines; /**< not 0: keep outlines; without them discs decide whether agents collide */
  int32_t culling;  /**< not 0: keep data that lets queries skip most of their work; changes no answer */
  int32_t heights;  /**< not 0: keep the heights of bodies, for agents at different heights */
  const uint32_t* depths; /**< levels of detail, ascending; NULL: BCH_ALL_DEPTHS alone */
  size_t depth_count;
  float threshold; /**< the radius below which discs are not divided */
} bch_plan;
#define BCH_PLAN_INIT \
  { sizeof(bch_plan), 1, 1, 0, NULL, 0, 0.01f }

/** Selects how the bytes of a file are accessed. */
enum {
  BCH_READ = 0, /**< copied into memory: safe whatever happens to the file afterwards */
  BCH_MAP =
      1 /**< mapped without a copy: for files that no process writes to or shortens while the set lives */
};
/** Loads a set from a baked file. */
BCH_API bch_status bch_shape_set_load(const char* path, int32_t access, bch_shape_set** set);
/** Loads a set from the bytes of a baked file, which are copied. Error messages call the bytes `name`. */
BCH_API bch_status bch_shape_set_load_bytes(const void* bytes, size_t size, const char* name,
                                            bch_shape_set** set);
/** Writes a set to a baked file. After an error no partial file is left. */
BCH_API bch_status bch_shape_set_save(const bch_shape_set* set, const char* path);

/** Holds the sizes and levels of a set, and tells what it can be queried for. */
typedef struct bch_shape_set_info {
  uint32_t size; /**< sizeof(bch_shape_set_info) */
  uint32_t shapes;
  uint32_t levels;
  int32_t has_heights;  /**< not 0: agents may have a z */
  int32_t outlines;     /**< not 0: outlines are kept; 0: discs decide whether agents collide */
  int32_t exact_leaves; /**< not 0: some shape can be tested by the segments of its outline (BCH_SEGMENTS) */
  uint64_t bytes;
  const uint32_t* depths; /**< one per level; lives as long as the set */
} bch_shape_set_info;
#define BCH_SHAPE_SET_INFO_INIT \
  { sizeof(bch_shape_set_info), 0, 0, 0, 0, 0, 0, NULL }
/** Gets the sizes and levels of a set, and what it can be queried for. */
BCH_API bch_status bch_shape_set_get_info(const bch_shape_set* set, bch_shape_set_info* info);

/** Names the character and pose that a shape was made from. */
typedef struct bch_shape_origin {
  const char* character; /**< lives as long as the set, like the next; NULL if unknown */
  const char* clip;      /**< NULL: the rest pose */
  float seconds;         /**< from the start of the clip */
} bch_shape_origin;
/** Gets the character and pose that a shape was made from. */
BCH_API bch_status bch_shape_set_get_origin(const bch_shape_set* set, uint32_t shape,
                                            bch_shape_origin* origin);
/** Gets the radius of the circle about an agent's position that contains its shape at every level and
 * heading. */
BCH_API bch_status bch_shape_set_get_radius(const bch_shape_set* set, uint32_t shape, float* radius);
/** Gets the discs of a shape at a level, in the order in which queries number them. Writes at most `capacity`
 * discs, and to `count` the number of all. */
BCH_API bch_status bch_shape_set_get_discs(const bch_shape_set* set, uint32_t shape, uint32_t level,
                                           bch_disc* discs, size_t capacity, size_t* count);

/** Holds closed contours: contour i has points offsets[i] to offsets[i + 1]. The caller provides the arrays
 * and their capacities. */
typedef struct bch_outline {
  uint32_t size; /**< sizeof(bch_outline) */
  bch_vec2* points;
  size_t point_capacity;
  uint64_t* offsets;
  size_t offset_capacity;
  size_t point_count;  /**< the number of all points, whatever the capacity */
  size_t offset_count; /**< contours + 1 */
} bch_outline;
#define BCH_OUTLINE_INIT \
  { sizeof(bch_outline), NULL, 0, NULL, 0, 0, 0 }
/** Gets the outline of a shape. Writes as many points and offsets as fit, and the numbers of all. In a set
 * without outlines it is empty. */
BCH_API bch_status bch_shape_set_get_outline(const bch_shape_set* set, uint32_t shape, bch_outline* outline);

/** Receives one line for each difference that bch_shape_set_verify() finds. */
typedef void (*bch_inconsistency)(void* user, const char* line);
/** Checks a set from an untrusted file: recomputes all other stored data from discs and outlines, and
 * compares. Calls `inconsistency`, which may be NULL, for at most `most` differences, and writes their
 * number to `count`. */
BCH_API bch_status bch_shape_set_verify(const bch_shape_set* set, size_t most,
                                        bch_inconsistency inconsistency, void* user, size_t* count);
/** Frees a set. */
BCH_API bch_status bch_shape_set_free(bch_shape_set* set);

/* Building sets ----------------------------------------------------------------------------------------- */

/** Makes a set of characters, each in `poses` poses spread evenly over its clips, one character after the
 * other, on many threads. `plan` and `work` may be NULL. For chosen poses, and for polygons and the like, use
 * a bch_shape_set_builder. */
BCH_API bch_status bch_bake(const bch_character* const* characters, size_t character_count, uint32_t poses,
                            const bch_plan* plan, const bch_work* work, bch_shape_set** set);

/** Makes shapes of one character, one pose at a time. */
typedef struct bch_shape_builder bch_shape_builder;
/** Makes a shape builder of a character. `plan` is that of the sets that will take the shapes. */
BCH_API bch_status bch_shape_builder_create(const bch_character* character, const bch_plan* plan,
                                            bch_shape_builder** shape_builder);
/** Makes the shape of a pose. It replaces the previous one. */
BCH_API bch_status bch_shape_builder_make(bch_shape_builder* shape_builder, bch_pose pose);
/** Makes the shape of pose number `index` of arrays. It replaces the previous one. */
BCH_API bch_status bch_shape_builder_make_from_arrays(bch_shape_builder* shape_builder,
                                                      const bch_pose_arrays* poses, size_t index);
/** Gets the outline of the shape that was made last; see bch_shape_set_get_outline(). */
BCH_API bch_status bch_shape_builder_get_outline(const bch_shape_builder* shape_builder,
                                                 bch_outline* outline);
/** Frees a shape builder. */
BCH_API bch_status bch_shape_builder_free(bch_shape_builder* shape_builder);

/** Builds a set shape by shape. Shapes are numbered in the order in which they are added. */
typedef struct bch_shape_set_builder bch_shape_set_builder;
/** Makes an empty builder for a set with a plan. */
BCH_API bch_status bch_shape_set_builder_create(const bch_plan* plan, bch_shape_set_builder** builder);
/** Adds the shapes of a character in poses, on many threads. After an error or a cancellation none of these
 * shapes has been added. */
BCH_API bch_status bch_shape_set_builder_add_poses(bch_shape_set_builder* builder,
                                                   const bch_character* character, const bch_pose* poses,
                                                   size_t count, const bch_work* work);
/** Adds the shapes of a character in `count` poses given by arrays, as bch_shape_set_builder_add_poses() does
 * for poses of clips. bch_shape_set_get_origin() then reports the rest pose. */
BCH_API bch_status bch_shape_set_builder_add_pose_arrays(bch_shape_set_builder* builder,
                                                         const bch_character* character,
                                                         const bch_pose_arrays* poses, size_t count,
                                                         const bch_work* work);
/** Names the character and pose that a shape shows. */
typedef struct bch_pose_id {
  uint32_t character; /**< index in a list of characters */
  bch_pose at;
} bch_pose_id;
/** Adds the shapes of several characters in poses, as bch_shape_set_builder_add_poses() does for one
 * character. */
BCH_API bch_status bch_shape_set_builder_add_pose_ids(bch_shape_set_builder* builder,
                                                      const bch_character* const* characters,
                                                      size_t character_count, const bch_pose_id* pose_ids,
                                                      size_t count, const bch_work* work);
/** Adds the shape that a shape builder made last. */
BCH_API bch_status bch_shape_set_builder_add_shape(bch_shape_set_builder* builder,
                                                   const bch_shape_builder* shape_builder);
/** Adds a body of polygons: polygon i has corners offsets[i] to offsets[i + 1], in the agent's frame, in
 * either orientation. If `heights` is NULL, the body is infinitely high, also in the next functions. */
BCH_API bch_status bch_shape_set_builder_add_polygons(bch_shape_set_builder* builder, const bch_vec2* corners,
                                                      const uint64_t* offsets, size_t polygons,
                                                      const bch_heights* heights);
/** Adds a body of capsules. Its outline encloses the capsules, and protrudes from them by at most
 * `tolerance`, in metres. */
BCH_API bch_status bch_shape_set_builder_add_capsules(bch_shape_set_builder* builder,
                                                      const bch_capsule* capsules, size_t count,
                                                      float tolerance, const bch_heights* heights);
/** Adds a body of discs, which queries number in the given order. Discs and cylinders have no outlines;
 * capsules have. */
BCH_API bch_status bch_shape_set_builder_add_discs(bch_shape_set_builder* builder, const bch_disc* discs,
                                                   size_t count, const bch_heights* heights);
/** Adds a cylinder about the agent's position. */
BCH_API bch_status bch_shape_set_builder_add_cylinder(bch_shape_set_builder* builder, float radius,
                                                      const bch_heights* heights);
/** Adds a mesh as it is, z up. `triangles` has three indices of positions per triangle. */
BCH_API bch_status bch_shape_set_builder_add_mesh(bch_shape_set_builder* builder, const bch_vec3* positions,
                                                  size_t position_count, const uint32_t* triangles,
                                                  size_t triangle_count);
/** Makes the set of all shapes that were added. The builder is then empty and can build another set with the
 * same plan; after an error it is unchanged. */
BCH_API bch_status bch_shape_set_builder_finish(bch_shape_set_builder* builder, bch_shape_set** set);
/** Frees a builder. */
BCH_API bch_status bch_shape_set_builder_free(bch_shape_set_builder* builder);

/** Holds a set whose shapes can be replaced, for characters with new poses in every frame. */
typedef struct bch_dynamic_shape_set bch_dynamic_shape_set;
/** Copies a set into one whose shapes can be replaced. */
BCH_API bch_status bch_dynamic_shape_set_create(const bch_shape_set* start, bch_dynamic_shape_set** set);
/** Gets the current shapes, for queries. They belong to the dynamic set: do not free them. No query may run
 * while shapes are replaced. */
BCH_API bch_status bch_dynamic_shape_set_get_shapes(const bch_dynamic_shape_set* set,
                                                    const bch_shape_set** shapes);
/** Replaces a shape by the one that a shape builder made last. The shape builder has to have the set's
 * plan. */
BCH_API bch_status bch_dynamic_shape_set_replace(bch_dynamic_shape_set* set, uint32_t shape,
                                                 const bch_shape_builder* shape_builder);
/** Replaces many shapes by poses of a character, on many threads: shape shapes[i] by the pose poses[i]. No
 * shape may be named twice. `threshold` is as in bch_plan. After an error or a cancellation some shapes are
 * new, and others are unchanged. */
BCH_API bch_status bch_dynamic_shape_set_replace_poses(bch_dynamic_shape_set* set,
                                                       const bch_character* character, const uint32_t* shapes,
                                                       const bch_pose* poses, size_t count, float threshold,
                                                       const bch_work* work);
/** Replaces many shapes by poses given by arrays, as bch_dynamic_shape_set_replace_poses() does for poses of
 * clips. */
BCH_API bch_status bch_dynamic_shape_set_replace_pose_arrays(bch_dynamic_shape_set* set,
                                                             const bch_character* character,
                                                             const uint32_t* shapes,
                                                             const bch_pose_arrays* poses, size_t count,
                                                             float threshold, const bch_work* work);
/** Frees a dynamic set, and the set that bch_dynamic_shape_set_get_shapes() got. */
BCH_API bch_status bch_dynamic_shape_set_free(bch_dynamic_shape_set* set);

/* Outlines ---------------------------------------------------------------------------------------------- */

/** Holds outlines: what a mesh covers in poses, seen from above. */
typedef struct bch_outlines bch_outlines;
/** Says which parts of a mesh are outlined. */
typedef struct bch_outline_options {
  uint32_t size; /**< sizeof(bch_outline_options) */
  /** Not 0: also holes (clockwise contours after the contour around them), and parts inside holes. */
  int32_t holes;
  float bottom; /**< metres; the mesh below is cut off; -infinity: nothing is cut off */
  float top;    /**< metres; the mesh above is cut off; infinity: nothing is cut off */
} bch_outline_options;
#define BCH_OUTLINE_OPTIONS_INIT \
  { sizeof(bch_outline_options), 0, -INFINITY, INFINITY }
/** Finds the outlines of a mesh in poses: the exact union of the triangles. Each pose has `vertices`
 * positions, one pose after the other; `triangles` has three indices of vertices per triangle. The work
 * is divided among threads, pose by pose. */
BCH_API bch_status bch_outlines_of_mesh(const bch_vec3* positions, size_t vertices, size_t poses,
                                        const uint32_t* triangles, size_t triangle_count,
                                        const bch_outline_options* options, const bch_work* work,
                                        bch_outlines** outlines);
/** Finds the outlines of a character in poses, relative to the origin of its shapes. */
BCH_API bch_status bch_outlines_of_character(const bch_character* character, const bch_pose* poses,
                                             size_t count, const bch_outline_options* options,
                                             const bch_work* work, bch_outlines** outlines);
/** Gets the outline of a pose. Writes as many points and offsets as fit, and the numbers of all. */
BCH_API bch_status bch_outlines_get(const bch_outlines* outlines, size_t pose, bch_outline* outline);
/** Names the text formats of an outline. Both consist of polygons, so contours without area are left out. */
enum {
  BCH_WKT = 0,    /**< well-known text, a MULTIPOLYGON, which bch_obstacles_from_wkt() reads, too */
  BCH_GEOJSON = 1 /**< a geometry of RFC 7946, a MultiPolygon, in metres */
};
/** Gets the outline of a pose as text. Writes at most `capacity` characters, without a terminating zero, and
 * to `length` the number of all. */
BCH_API bch_status bch_outlines_get_text(const bch_outlines* outlines, size_t pose, int32_t format,
                                         char* text, size_t capacity, size_t* length);
/** Frees outlines. */
BCH_API bch_status bch_outlines_free(bch_outlines* outlines);

/* Queries of pairs -------------------------------------------------------------------------------------- */

enum {
  BCH_DOUBLES = 0, /**< numbers are of type double */
  BCH_FLOATS = 1   /**< numbers are of type float */
};
/** Views the agents of a crowd in the caller's memory: arrays with one value per agent, or members of
 * structs. A stride is the number of bytes from one agent's value to the next one's; 0 means a packed
 * array. */
typedef struct bch_agents {
  uint32_t size;         /**< sizeof(bch_agents) */
  const uint32_t* shape; /**< index into the set */
  const void* x;         /**< of the type `numbers`, like y, heading and z */
  const void* y;
  /** Counter-clockwise; 0 does not turn a shape. With heading_y: the x of a direction. */
  const void* heading;
  const uint8_t* level; /**< index into the set's depths; NULL: the last one for all */
  const void* z;        /**< height of the ground under each agent; NULL: the same for all */
  size_t count;
  int32_t numbers; /**< BCH_DOUBLES or BCH_FLOATS */
  size_t shape_stride, x_stride, y_stride, heading_stride, level_stride, z_stride;
  /** The y of directions: unit vectors (length 1 within 1e-3) along an agent's +x; NULL: headings are
   * angles. */
  const void* heading_y;
  size_t heading_y_stride;
} bch_agents;
#define BCH_AGENTS_INIT \
  { sizeof(bch_agents), NULL, NULL, NULL, NULL, NULL, NULL, 0, BCH_DOUBLES, 0, 0, 0, 0, 0, 0, NULL, 0 }

/** Names two agents by index. */
typedef struct bch_pair {
  uint32_t first, second;
} bch_pair;

enum {
  BCH_DISCS = 0,   /**< two leaves of the trees of discs collide if their discs overlap */
  BCH_SEGMENTS = 1 /**< at depth BCH_ALL_DEPTHS, segments of the two outlines must meet as well */
};
enum {
  BCH_OVERLAP_ZERO = 0,   /**< the clearance of overlapping agents is 0 */
  BCH_OVERLAP_DEEPEST = 1 /**< it is negative, the deepest overlap of two discs */
};
/** Holds the options of all queries. Initialise them by BCH_QUERY_OPTIONS_INIT: zeros are not the defaults.
 * Every query uses `threads` and `implementation`. Queries use the other options as follows, and ignore what
 * is not listed:
 * - bch_collide(), bch_nearest_free(), bch_obstacles_collide(), bch_crowd_collisions(), bch_crowd_contacts()
 *   and other collisions and contacts: `leaves`,
 * - bch_obstacles_within(): `distance_leaves`,
 * - bch_clearance() and bch_obstacles_clearance(): `max_distance`, `overlap` and `distance_leaves`,
 * - bch_crowd_clearances(): `overlap` and `distance_leaves`. */
typedef struct bch_query_options {
  uint32_t size;  /**< sizeof(bch_query_options) */
  int32_t leaves; /**< for collisions and contacts: BCH_SEGMENTS or BCH_DISCS */
  /** For clearance: BCH_DISCS or BCH_SEGMENTS; deepest overlaps are those of discs. */
  int32_t distance_leaves;
  int32_t overlap;     /**< for clearance: BCH_OVERLAP_ZERO or BCH_OVERLAP_DEEPEST */
  uint32_t threads;    /**< 0: one for each processor; the answer is the same for any number */
  double max_distance; /**< for clearance: farther pairs get an infinite distance */
  /** One of bch_implementation_name(); NULL: the best; the answer is the same for all. */
  const char* implementation;
} bch_query_options;
#define BCH_QUERY_OPTIONS_INIT \
  { sizeof(bch_query_options), BCH_SEGMENTS, BCH_DISCS, BCH_OVERLAP_ZERO, 0, (double)INFINITY, NULL }

/** Returns the name of the i-th implementation, such as "avx512", "avx2", "sse2" or "scalar"; the best is the
 * first. NULL if i is out of range. */
BCH_API const char* bch_implementation_name(uint32_t i);
/** Returns whether this processor runs the i-th implementation: 1 or 0. */
BCH_API int32_t bch_implementation_supported(uint32_t i);

/** Runs task number i of a call of bch_run_tasks. */
typedef void (*bch_task)(void* data, size_t i);
/** Calls task(data, i) once for each i from 0 to count - 1, on any threads and in any order, and returns when
 * all calls have returned. A task may itself call this function. */
typedef void (*bch_run_tasks)(void* user, size_t count, bch_task task, void* data);
/** Makes all later queries run their tasks on the caller's task system, which has `threads` threads, 1 to
 * 1024. If `run` is NULL, the library's own threads are used again. No query may run during the call. Answers
 * do not change. */
BCH_API bch_status bch_set_executor(bch_run_tasks run, void* user, uint32_t threads);

/** Checks agents and returns the errors that bch_collide() would return for them. */
BCH_API bch_status bch_validate_agents(const bch_shape_set* set, const bch_agents* agents);

/** Tests whether the agents of each pair collide, and writes 1 or 0 to `hits`, one per pair. */
BCH_API bch_status bch_collide(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                               size_t count, const bch_query_options* options, uint8_t* hits);
/** Tests whether the agents of each pair come within a distance of each other, and writes 1 or 0 to
 * `answers`. There is one distance for all pairs, or one each. */
BCH_API bch_status bch_within(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                              size_t count, const double* distances, size_t distance_count,
                              const bch_query_options* options, uint8_t* answers);

/** Names one disc of each agent of a pair, by its index among the discs of the agent's level (see
 * bch_shape_set_get_discs()). */
typedef struct bch_disc_pair {
  uint32_t first, second;
} bch_disc_pair;
/** The index that stands for no disc. */
#define BCH_NO_DISC 0xffffffffu
/** Holds the nearest points of two agents, each relative to its agent's position, in the world's axes. */
typedef struct bch_nearest_points {
  bch_vec2 first, second;
} bch_nearest_points;
/** Holds the output arrays of bch_clearance(), with one entry per pair. Arrays that are NULL are not
 * computed. */
typedef struct bch_clearance_out {
  uint32_t size;   /**< sizeof(bch_clearance_out) */
  float* distance; /**< metres; infinite beyond max_distance; required, not NULL */
  /** From the first agent's nearest point to the second's; (0, 0) where there is none. */
  bch_vec2* direction;
  bch_disc_pair* discs;       /**< the nearest discs, or leaves; BCH_NO_DISC where there are none */
  bch_nearest_points* points; /**< the nearest points; (0, 0) where there are none */
} bch_clearance_out;
#define BCH_CLEARANCE_OUT_INIT \
  { sizeof(bch_clearance_out), NULL, NULL, NULL, NULL }
/** Measures how far apart the agents of each pair are. */
BCH_API bch_status bch_clearance(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                                 size_t count, const bch_query_options* options,
                                 const bch_clearance_out* out);

/** Tells how far the first agent of a pair has to move to separate from the second, and in which direction, a
 * unit vector. */
typedef struct bch_penetration_depth {
  float depth;  /**< metres */
  float unused; /**< padding */
  double x, y;  /**< the direction in which the first agent moves, a unit vector */
} bch_penetration_depth;
/** Measures how far the first agent of each pair has to move until a straight line separates the discs of the
 * two, along the best of `directions` evenly spread directions: an even number from 2 to 256, usually 16 to
 * 32. */
BCH_API bch_status bch_penetration(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                                   size_t count, uint32_t directions, const bch_query_options* options,
                                   bch_penetration_depth* depths);
/** Tells where the two agents of a pair touch after a move of bch_nearest_free(): where they separate
 * last. */
typedef struct bch_touch {
  bch_vec3 point;  /**< relative to the first agent's position after the move, in the world's axes */
  bch_vec3 normal; /**< a unit vector from the second agent to the first; (0, 0, 0): the two do not collide */
} bch_touch;
/** Measures the shortest move, along the best of `directions` directions as in bch_penetration(), after which
 * bch_collide() with the same `leaves` answers 0. The two may then still be interlocked, so that no straight
 * line separates them. The depth is 0 if they do not collide. `touches` may be NULL. */
BCH_API bch_status bch_nearest_free(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                                    size_t count, uint32_t directions, const bch_query_options* options,
                                    bch_penetration_depth* depths, bch_touch* touches);
/** Measures the same as bch_penetration() along a given direction, which may have any length. */
BCH_API bch_status bch_penetration_along(const bch_shape_set* set, const bch_agents* agents,
                                         const bch_pair* pairs, size_t count, const bch_vec2* directions,
                                         const bch_query_options* options, bch_penetration_depth* depths);
/** Finds when discs of the agents of each pair first touch while the first moves by (x, y) relative to the
 * second: a time from 0 to 1, or infinity. */
BCH_API bch_status bch_time_of_impact(const bch_shape_set* set, const bch_agents* agents,
                                      const bch_pair* pairs, size_t count, const double* x, const double* y,
                                      const bch_query_options* options, float* times);

/* Queries of crowds ------------------------------------------------------------------------------------- */

/** Finds the pairs of a crowd that collide or are near each other: broad and narrow phase in one call.
 * Answers are valid until the next call for the same crowd. */
typedef struct bch_crowd bch_crowd;
/** Holds the options of all queries of a crowd. */
typedef struct bch_crowd_options {
  uint32_t size;      /**< sizeof(bch_crowd_options) */
  double period_x;    /**< period of periodic boundaries along x, metres; 0: not periodic */
  double period_y;    /**< likewise along y */
  uint64_t max_pairs; /**< more candidate pairs than this are an error */
} bch_crowd_options;
#define BCH_CROWD_OPTIONS_INIT \
  { sizeof(bch_crowd_options), 0, 0, UINT64_MAX }
/** Selects pairs as physics engines do: two agents are a pair if each one's mask has a bit of the other's
 * category. */
typedef struct bch_pair_filter {
  uint32_t size;            /**< sizeof(bch_pair_filter) */
  const uint32_t* category; /**< one per agent; NULL: 1 for all */
  const uint32_t* mask;     /**< one per agent; NULL: all bits */
  const bch_pair* excluded; /**< pairs to leave out, in any order; may be NULL */
  size_t excluded_count;
} bch_pair_filter;
#define BCH_PAIR_FILTER_INIT \
  { sizeof(bch_pair_filter), NULL, NULL, NULL, 0 }

/** Holds obstacles that do not move. */
typedef struct bch_obstacles bch_obstacles;

/** Views rows of numbers in one array: row i is values[offsets[i]] to values[offsets[i + 1]]. */
typedef struct bch_index_rows {
  size_t rows;
  const uint64_t* offsets;
  const uint32_t* values;
} bch_index_rows;
/** Names the other agent of a pair. */
typedef struct bch_neighbour {
  uint32_t agent;
  uint32_t pair; /**< the pair's index in the answer */
} bch_neighbour;
/** Views rows of neighbours in one array, one row per agent, ascending. */
typedef struct bch_neighbour_rows {
  size_t rows;
  const uint64_t* offsets;
  const bch_neighbour* values;
} bch_neighbour_rows;
/** Views rows of pairs of discs, one row per pair of agents. */
typedef struct bch_contact_rows {
  size_t rows;
  const bch_pair* pairs; /**< one per row */
  const uint64_t* offsets;
  const bch_disc_pair* values;
} bch_contact_rows;
/** Views the pairs of a crowd that are near each other, and arrays with one value per pair, as
 * bch_clearance_out has them. */
typedef struct bch_crowd_clearance_view {
  size_t count;
  const bch_pair* pairs;
  const float* distance;
  const bch_vec2* direction;
  const bch_disc_pair* discs;
  const bch_nearest_points* points;
} bch_crowd_clearance_view;
/** Views the pairs of a crowd that collide, and the depth of each. */
typedef struct bch_crowd_penetration_view {
  size_t count;
  const bch_pair* pairs;
  const bch_penetration_depth* depths;
} bch_crowd_penetration_view;

/** Makes a crowd, which keeps its memory from call to call. `options` may be NULL. */
BCH_API bch_status bch_crowd_create(const bch_crowd_options* options, bch_crowd** crowd);
/** Finds every pair of agents whose root discs (the discs around whole shapes) come within a margin of each
 * other. Each pair is returned once, with first < second. `filter` may be NULL here and below. */
BCH_API bch_status bch_crowd_candidates(bch_crowd* crowd, const bch_shape_set* set, const bch_agents* agents,
                                        double margin, const bch_pair_filter* filter,
                                        const bch_query_options* options, const bch_pair** pairs,
                                        size_t* count);
/** Finds the pairs that collide, each once, with first < second. */
BCH_API bch_status bch_crowd_collisions(bch_crowd* crowd, const bch_shape_set* set, const bch_agents* agents,
                                        const bch_pair_filter* filter, const bch_query_options* options,
                                        const bch_pair** pairs, size_t* count);
/** Finds the pairs of discs that make agents collide, one row for each pair of agents that has any. */
BCH_API bch_status bch_crowd_contacts(bch_crowd* crowd, const bch_shape_set* set, const bch_agents* agents,
                                      const bch_pair_filter* filter, const bch_query_options* options,
                                      bch_contact_rows* contacts);
/** Finds the pairs of discs that make the agents of given pairs collide, one row per given pair, which may be
 * empty. `contacts->pairs` is `pairs`. */
BCH_API bch_status bch_crowd_contacts_of(bch_crowd* crowd, const bch_shape_set* set, const bch_agents* agents,
                                         const bch_pair* pairs, size_t count,
                                         const bch_query_options* options, bch_contact_rows* contacts);
/** Finds the pairs whose clearance is at most `within` metres. */
BCH_API bch_status bch_crowd_clearances(bch_crowd* crowd, const bch_shape_set* set, const bch_agents* agents,
                                        double within, const bch_pair_filter* filter,
                                        const bch_query_options* options,
                                        bch_crowd_clearance_view* clearances);
/** Finds the pairs that collide, and their depths as bch_penetration() measures them. */
BCH_API bch_status bch_crowd_penetrations(bch_crowd* crowd, const bch_shape_set* set,
                                          const bch_agents* agents, uint32_t directions,
                                          const bch_pair_filter* filter, const bch_query_options* options,
                                          bch_crowd_penetration_view* penetrations);
/** Returns, for each agent, the others that it is paired with in the last answer: one row per agent. */
BCH_API bch_status bch_crowd_by_agent(bch_crowd* crowd, bch_neighbour_rows* neighbours);
/** Returns the nearest others of each agent, at most `max_count`, nearest first, as crowd models such as ORCA
 * need them. The crowd's last answer has to be from bch_crowd_clearances() or bch_crowd_body_clearances();
 * "nearest" is by the distances of that answer, not by those of centres. */
BCH_API bch_status bch_crowd_nearest(bch_crowd* crowd, uint32_t max_count, bch_neighbour_rows* neighbours);
/** Computes, for each agent, the radius of a disc that stands for its body in a simulator of discs. It is
 * half the distance of positions at which two bodies would touch, as a mean over the agent's pairs, in which
 * near pairs weigh more. Agents without a pair get `alone`, metres. The crowd's last answer has to be from
 * bch_crowd_clearances() or bch_crowd_body_clearances() of the same agents, with BCH_OVERLAP_DEEPEST. `radii`
 * gets one value per agent. */
BCH_API bch_status bch_crowd_disc_radii(const bch_crowd* crowd, const bch_agents* agents, double alone,
                                        double* radii);
/** Finds the obstacles that each agent collides with: one row of obstacle indices per agent, ascending. */
BCH_API bch_status bch_crowd_obstacles(bch_crowd* crowd, const bch_shape_set* set, const bch_agents* agents,
                                       const bch_obstacles* obstacles, const bch_query_options* options,
                                       bch_index_rows* touched);
/** Frees a crowd and its answers. */
BCH_API bch_status bch_crowd_free(bch_crowd* crowd);

/* Bodies of spheres ------------------------------------------------------------------------------------- */

/** Represents a ball. */
typedef struct bch_sphere {
  float x, y, z, radius;
} bch_sphere;
/** Holds bodies of spheres in space, for queries. Agents name bodies by `shape`, may stand at any `z`, and
 * have no levels. */
typedef struct bch_body_set bch_body_set;
/** Makes bodies of given spheres, in the agents' frames: body i has spheres offsets[i] to offsets[i + 1]. */
BCH_API bch_status bch_body_set_create(const bch_sphere* spheres, const uint64_t* offsets, size_t count,
                                       bch_body_set** set);
/** Represents the points within a radius of a segment in space. */
typedef struct bch_space_capsule {
  bch_vec3 a, b;
  float radius;
} bch_space_capsule;
/** Gets spheres, at most 4096, that together enclose capsules and protrude from them by at most `error`, in
 * metres. Writes at most `capacity` spheres, and to `count` the number of all. */
BCH_API bch_status bch_spheres_from_capsules(const bch_space_capsule* capsules, size_t capsule_count,
                                             float error, bch_sphere* spheres, size_t capacity,
                                             size_t* count);
/** Gets spheres that together enclose upright prisms over polygons, as bch_spheres_from_capsules() does for
 * capsules. Polygon i has corners offsets[i] to offsets[i + 1]; all prisms have the same heights. */
BCH_API bch_status bch_spheres_from_polygons(const bch_vec2* corners, const uint64_t* offsets,
                                             size_t polygons, const bch_heights* heights, float error,
                                             bch_sphere* spheres, size_t capacity, size_t* count);
/** Holds the size of a set of bodies. */
typedef struct bch_body_set_info {
  uint32_t size; /**< sizeof(bch_body_set_info) */
  uint32_t bodies;
  uint64_t bytes;
} bch_body_set_info;
#define BCH_BODY_SET_INFO_INIT \
  { sizeof(bch_body_set_info), 0, 0 }
/** Gets the size of a set. */
BCH_API bch_status bch_body_set_get_info(const bch_body_set* set, bch_body_set_info* info);
/** Gets the spheres of a body as queries use them. Writes at most `capacity` spheres, and to `count` the
 * number of all. */
BCH_API bch_status bch_body_set_get_spheres(const bch_body_set* set, uint32_t body, bch_sphere* spheres,
                                            size_t capacity, size_t* count);
/** Frees a set. */
BCH_API bch_status bch_body_set_free(bch_body_set* set);

/** Holds a character as spheres that move with its skeleton. */
typedef struct bch_body_model bch_body_model;
/** Says how a model is made. */
typedef struct bch_body_options {
  uint32_t size;    /**< sizeof(bch_body_options) */
  uint32_t spheres; /**< at most 4096 */
  int32_t draft;    /**< not 0: made in seconds, but protrudes about twice as far from the skin */
} bch_body_options;
#define BCH_BODY_OPTIONS_INIT \
  { sizeof(bch_body_options), 256, 0 }
/** Makes the model of a character, on the caller's thread: up to a minute. Progress is in thousandths. */
BCH_API bch_status bch_body_model_make(const bch_character* character, const bch_body_options* options,
                                       const bch_work* work, bch_body_model** model);
/** Makes, in milliseconds, the model that comes with the library for a built-in character: 64, 128, 256 or
 * 512 spheres of the default man or woman, or of a pedestrian. Others give BCH_INVALID_ARGUMENT. */
BCH_API bch_status bch_body_model_default(const bch_character* character, uint32_t spheres,
                                          bch_body_model** model);
/** Makes the model of a rigid body of given spheres. Its poses are the rest pose, or transforms of its only
 * joint. */
BCH_API bch_status bch_body_model_from_spheres(const bch_sphere* spheres, size_t count,
                                               bch_body_model** model);
/** Writes models, with their characters, to a baked file without shapes. */
BCH_API bch_status bch_body_models_save(const bch_body_model* const* models, size_t model_count,
                                        const char* path);
/** Reads model number `index` of a baked file, and writes the number of models to `count`. If there is no
 * such model, it writes NULL to `model`. */
BCH_API bch_status bch_body_model_load(const char* path, size_t index, size_t* count, bch_body_model** model);
/** Gets the number of spheres of a model, which may be slightly less than requested. */
BCH_API bch_status bch_body_model_get_sphere_count(const bch_body_model* model, uint32_t* count);
/** Frees a model. */
BCH_API bch_status bch_body_model_free(bch_body_model* model);

/** Makes a set of models, each in `poses` poses spread evenly over its clips, one model after the other, on
 * many threads. `work` may be NULL. */
BCH_API bch_status bch_bake_bodies(const bch_body_model* const* models, size_t model_count, uint32_t poses,
                                   const bch_work* work, bch_body_set** set);

/** Holds one body per agent, each in a new pose of its own in every frame. */
typedef struct bch_live_bodies bch_live_bodies;
/** Makes bodies in the rest pose: body i is one of models[model_of_body[i]]. Models are copied. */
BCH_API bch_status bch_live_bodies_create(const bch_body_model* const* models, size_t model_count,
                                          const uint32_t* model_of_body, size_t count,
                                          bch_live_bodies** bodies);
/** Poses all bodies at times of clips, one pose per body, on `threads` threads; 0: one for each processor. No
 * query may run during the call. */
BCH_API bch_status bch_live_bodies_pose(bch_live_bodies* bodies, const bch_pose* poses, uint32_t threads);
/** Poses all bodies by transforms, one pose per body, as bch_live_bodies_pose() does at times of clips.
 * BCH_POSED_VERTICES is an error, because vertices do not tell where bones are. */
BCH_API bch_status bch_live_bodies_pose_from_arrays(bch_live_bodies* bodies, const bch_pose_arrays* poses,
                                                    uint32_t threads);
/** Gets the bodies as a set, for queries. It belongs to `bodies`: do not free it. */
BCH_API bch_status bch_live_bodies_get_set(const bch_live_bodies* bodies, const bch_body_set** set);
/** Frees bodies, and the set that bch_live_bodies_get_set() got. */
BCH_API bch_status bch_live_bodies_free(bch_live_bodies* bodies);

/** Tests whether the bodies of each pair's agents have a point in common, and writes 1 or 0 to `hits`.
 * Queries of bodies use the options `threads` and `implementation`. Clearances also use `overlap`, and
 * bch_clearance_bodies() `max_distance`. The other options are ignored. */
BCH_API bch_status bch_collide_bodies(const bch_body_set* set, const bch_agents* agents,
                                      const bch_pair* pairs, size_t count, const bch_query_options* options,
                                      uint8_t* hits);
/** Tests whether the bodies of each pair's agents come within a distance of each other, and writes 1 or 0 to
 * `answers`. There is one distance for all pairs, or one each. */
BCH_API bch_status bch_within_bodies(const bch_body_set* set, const bch_agents* agents, const bch_pair* pairs,
                                     size_t count, const double* distances, size_t distance_count,
                                     const bch_query_options* options, uint8_t* answers);
/** Finds when the bodies of each pair's agents first touch in space while the first moves by (x, y, z)
 * relative to the second: a time from 0 to 1, or infinity. `z` may be NULL: then nobody moves up or down. */
BCH_API bch_status bch_time_of_impact_bodies(const bch_body_set* set, const bch_agents* agents,
                                             const bch_pair* pairs, size_t count, const double* x,
                                             const double* y, const double* z,
                                             const bch_query_options* options, float* times);
/** Measures how far the first agent of each pair has to move on the ground until a straight line separates
 * the two bodies, as seen from above; otherwise as bch_penetration(). */
BCH_API bch_status bch_penetration_bodies(const bch_body_set* set, const bch_agents* agents,
                                          const bch_pair* pairs, size_t count, uint32_t directions,
                                          const bch_query_options* options, bch_penetration_depth* depths);
/** Measures the shortest move on the ground, along the best of `directions` directions, after which no sphere
 * of one body overlaps one of the other. The two may then still be interlocked, so that no straight line
 * separates them. The depth is 0 if they do not collide. */
BCH_API bch_status bch_nearest_free_bodies(const bch_body_set* set, const bch_agents* agents,
                                           const bch_pair* pairs, size_t count, uint32_t directions,
                                           const bch_query_options* options, bch_penetration_depth* depths);
/** Measures the same as bch_nearest_free_bodies(), and gets where the two touch after the move: a point in
 * space on a sphere of the first agent. */
BCH_API bch_status bch_nearest_free_bodies_touches(const bch_body_set* set, const bch_agents* agents,
                                                   const bch_pair* pairs, size_t count, uint32_t directions,
                                                   const bch_query_options* options,
                                                   bch_penetration_depth* depths, bch_touch* touches);
/** Measures how far the first agent of each pair has to move along a given direction, as
 * bch_penetration_along() does. */
BCH_API bch_status bch_penetration_along_bodies(const bch_body_set* set, const bch_agents* agents,
                                                const bch_pair* pairs, size_t count,
                                                const bch_vec2* directions, const bch_query_options* options,
                                                bch_penetration_depth* depths);
/** Holds the nearest points of two bodies, each relative to its agent's position, in the world's axes. */
typedef struct bch_nearest_space_points {
  bch_vec3 first, second;
} bch_nearest_space_points;
/** Holds the output arrays of bch_clearance_bodies(), as bch_clearance_out does, in space. */
typedef struct bch_body_clearance_out {
  uint32_t size;                    /**< sizeof(bch_body_clearance_out) */
  float* distance;                  /**< required, not NULL */
  bch_vec3* direction;              /**< from the first agent's nearest point to the second's */
  bch_disc_pair* spheres;           /**< the indices of the nearest spheres, or BCH_NO_DISC */
  bch_nearest_space_points* points; /**< the nearest points */
} bch_body_clearance_out;
#define BCH_BODY_CLEARANCE_OUT_INIT \
  { sizeof(bch_body_clearance_out), NULL, NULL, NULL, NULL }
/** Measures how far apart in space the bodies of each pair's agents are. */
BCH_API bch_status bch_clearance_bodies(const bch_body_set* set, const bch_agents* agents,
                                        const bch_pair* pairs, size_t count, const bch_query_options* options,
                                        const bch_body_clearance_out* out);
/** Finds every pair of agents whose bodies may collide or come within a margin, judged by their enclosing
 * discs, seen from above, and their heights. */
BCH_API bch_status bch_crowd_body_candidates(bch_crowd* crowd, const bch_body_set* set,
                                             const bch_agents* agents, double margin,
                                             const bch_pair_filter* filter, const bch_query_options* options,
                                             const bch_pair** pairs, size_t* count);
/** Finds the pairs whose bodies collide, each once, with first < second. */
BCH_API bch_status bch_crowd_body_collisions(bch_crowd* crowd, const bch_body_set* set,
                                             const bch_agents* agents, const bch_pair_filter* filter,
                                             const bch_query_options* options, const bch_pair** pairs,
                                             size_t* count);
/** Views the pairs of a crowd whose bodies are near each other, and arrays with one value per pair, as
 * bch_body_clearance_out has them. */
typedef struct bch_crowd_body_clearance_view {
  size_t count;
  const bch_pair* pairs;
  const float* distance;
  const bch_vec3* direction;
  const bch_disc_pair* spheres;
  const bch_nearest_space_points* points;
} bch_crowd_body_clearance_view;
/** Finds the pairs whose bodies have a clearance of at most `within` metres. */
BCH_API bch_status bch_crowd_body_clearances(bch_crowd* crowd, const bch_body_set* set,
                                             const bch_agents* agents, double within,
                                             const bch_pair_filter* filter, const bch_query_options* options,
                                             bch_crowd_body_clearance_view* clearances);
/** Finds the pairs whose bodies collide, and their depths as bch_penetration_bodies() measures them. */
BCH_API bch_status bch_crowd_body_penetrations(bch_crowd* crowd, const bch_body_set* set,
                                               const bch_agents* agents, uint32_t directions,
                                               const bch_pair_filter* filter,
                                               const bch_query_options* options,
                                               bch_crowd_penetration_view* penetrations);
/** Represents an overlap of two spheres, in space. Moving the second agent by depth * normal separates the
 * two spheres. */
typedef struct bch_sphere_contact {
  bch_disc_pair spheres; /**< the indices of the spheres */
  /** Of the first sphere, the deepest in the second; relative to the first agent's position. */
  bch_vec3 point;
  bch_vec3 normal; /**< a unit vector from the first sphere to the second */
  float depth;     /**< metres */
} bch_sphere_contact;
/** Views rows of contacts, one row per pair of agents. */
typedef struct bch_sphere_contact_rows {
  size_t rows;
  const bch_pair* pairs; /**< one per row */
  const uint64_t* offsets;
  const bch_sphere_contact* values;
} bch_sphere_contact_rows;
/** Finds the spheres that overlap, one row for each pair of agents that collides. */
BCH_API bch_status bch_crowd_body_contacts(bch_crowd* crowd, const bch_body_set* set,
                                           const bch_agents* agents, const bch_pair_filter* filter,
                                           const bch_query_options* options,
                                           bch_sphere_contact_rows* contacts);
/** Finds the spheres of given pairs that overlap, one row per pair, which may be empty. `contacts->pairs` is
 * `pairs`. */
BCH_API bch_status bch_crowd_body_contacts_of(bch_crowd* crowd, const bch_body_set* set,
                                              const bch_agents* agents, const bch_pair* pairs, size_t count,
                                              const bch_query_options* options,
                                              bch_sphere_contact_rows* contacts);

/* Obstacles --------------------------------------------------------------------------------------------- */

/** Holds obstacles in arrays: polylines of points, and obstacles of polylines, as offsets. */
typedef struct bch_obstacle_arrays {
  uint32_t size;   /**< sizeof(bch_obstacle_arrays) */
  const double* x; /**< the points of all polylines */
  const double* y;
  const uint64_t* polyline_offsets; /**< polyline p has points [p] to [p + 1] */
  size_t polyline_count;
  const uint64_t* obstacle_offsets; /**< obstacle o has polylines [o] to [o + 1]; NULL: one polyline each */
  size_t obstacle_count;            /**< without offsets the number of polylines */
  const uint8_t* is_area;           /**< 1: an area, which its polylines enclose as rings; NULL: no areas */
  const double* bottom;             /**< per obstacle, metres; may be infinite; NULL: all are */
  const double* top; /**< like bottom; bodies with heights collide only where heights overlap */
} bch_obstacle_arrays;
#define BCH_OBSTACLE_ARRAYS_INIT \
  { sizeof(bch_obstacle_arrays), NULL, NULL, NULL, 0, NULL, 0, NULL, NULL, NULL }
/** Makes obstacles from arrays. */
BCH_API bch_status bch_obstacles_create(const bch_obstacle_arrays* arrays, bch_obstacles** obstacles);
/** Makes obstacles from well-known text. If `walkable` is not 0, polygons are the floor, and their rings are
 * walls. All reach from `bottom` to `top`, in metres; pass -HUGE_VAL and HUGE_VAL for infinite ones. */
BCH_API bch_status bch_obstacles_from_wkt(const char* text, int32_t walkable, double bottom, double top,
                                          bch_obstacles** obstacles);
/** Gets the numbers of obstacles and segments. Either may be NULL. */
BCH_API bch_status bch_obstacles_get_counts(const bch_obstacles* obstacles, uint32_t* obstacle_count,
                                            uint32_t* segment_count);
/** Gets the obstacle that a segment belongs to. */
BCH_API bch_status bch_obstacles_get_owner(const bch_obstacles* obstacles, uint32_t segment,
                                           uint32_t* obstacle);
/** Frees obstacles. */
BCH_API bch_status bch_obstacles_free(bch_obstacles* obstacles);

/* Each of the next functions answers, for each agent and the obstacles, what the query of the same name
 * answers for each pair of agents. */

/** Tests whether each agent collides with an obstacle, and writes 1 or 0 to `hits`. */
BCH_API bch_status bch_obstacles_collide(const bch_shape_set* set, const bch_agents* agents,
                                         const bch_obstacles* obstacles, const bch_query_options* options,
                                         uint8_t* hits);
/** Tests whether an obstacle is within a distance of each agent, and writes 1 or 0 to `answers`. There is one
 * distance for all agents, or one each. */
BCH_API bch_status bch_obstacles_within(const bch_shape_set* set, const bch_agents* agents,
                                        const bch_obstacles* obstacles, const double* distances,
                                        size_t distance_count, const bch_query_options* options,
                                        uint8_t* answers);
/** Measures how far each agent is from the nearest obstacle. `discs` are the agent's disc and the obstacle's
 * segment. */
BCH_API bch_status bch_obstacles_clearance(const bch_shape_set* set, const bch_agents* agents,
                                           const bch_obstacles* obstacles, const bch_query_options* options,
                                           const bch_clearance_out* out);
/** Measures how far each agent has to move to leave an obstacle. */
BCH_API bch_status bch_obstacles_penetration(const bch_shape_set* set, const bch_agents* agents,
                                             const bch_obstacles* obstacles, const bch_query_options* options,
                                             bch_penetration_depth* depths);
/** Finds when each agent first touches an obstacle while it moves by (x, y): a time from 0 to 1, or
 * infinity. */
BCH_API bch_status bch_obstacles_time_of_impact(const bch_shape_set* set, const bch_agents* agents,
                                                const bch_obstacles* obstacles, const double* x,
                                                const double* y, const bch_query_options* options,
                                                float* times);

/* The same for bodies of spheres, in space: an obstacle stands upright from its bottom to its top. */

/** Tests whether some sphere of each agent touches an obstacle, and writes 1 or 0 to `hits`. */
BCH_API bch_status bch_obstacles_collide_bodies(const bch_body_set* set, const bch_agents* agents,
                                                const bch_obstacles* obstacles,
                                                const bch_query_options* options, uint8_t* hits);
/** Tests whether an obstacle is within a distance of each agent's spheres, and writes 1 or 0 to `answers`. */
BCH_API bch_status bch_obstacles_within_bodies(const bch_body_set* set, const bch_agents* agents,
                                               const bch_obstacles* obstacles, const double* distances,
                                               size_t distance_count, const bch_query_options* options,
                                               uint8_t* answers);
/** Measures how far each agent's spheres are from the nearest obstacle. `spheres` are the agent's sphere and
 * the obstacle's segment, which is BCH_NO_DISC above, in and below an area. */
BCH_API bch_status bch_obstacles_clearance_bodies(const bch_body_set* set, const bch_agents* agents,
                                                  const bch_obstacles* obstacles,
                                                  const bch_query_options* options,
                                                  const bch_body_clearance_out* out);
/** Measures how far each agent has to move on the ground until it is free of all its neighbours and of all
 * obstacles at once, if only this agent moves. `neighbours` are pairs of an agent and another one that may be
 * in its way, in any order; `obstacles` may be NULL. If nobody else moves, bch_collide() of these pairs and
 * bch_obstacles_collide() answer 0 afterwards. `depths` has one entry per agent, and so has `touches`, which
 * may be NULL. Directions and answers are as for bch_nearest_free(). */
BCH_API bch_status bch_nearest_free_of_all(const bch_shape_set* set, const bch_agents* agents,
                                           const bch_pair* neighbours, size_t count,
                                           const bch_obstacles* obstacles, uint32_t directions,
                                           const bch_query_options* options, bch_penetration_depth* depths,
                                           bch_touch* touches);
/** Measures the same of bodies of spheres. */
BCH_API bch_status bch_nearest_free_of_all_bodies(const bch_body_set* set, const bch_agents* agents,
                                                  const bch_pair* neighbours, size_t count,
                                                  const bch_obstacles* obstacles, uint32_t directions,
                                                  const bch_query_options* options,
                                                  bch_penetration_depth* depths, bch_touch* touches);
/** Finds the obstacles that each agent's spheres touch: one row of obstacle indices per agent, ascending. */
BCH_API bch_status bch_crowd_body_obstacles(bch_crowd* crowd, const bch_body_set* set,
                                            const bch_agents* agents, const bch_obstacles* obstacles,
                                            const bch_query_options* options, bch_index_rows* touched);

/** Says how agents are moved. */
typedef struct bch_resolve_options {
  uint32_t size;                  /**< sizeof(bch_resolve_options) */
  uint32_t directions;            /**< as for bch_nearest_free_bodies() */
  uint32_t sweeps;                /**< the largest number of sweeps */
  double gap;                     /**< metres, clearance to leave between two agents that were separated */
  double largest_step;            /**< metres, the largest displacement of an agent in one sweep */
  double largest_shift;           /**< metres, the largest displacement of an agent in all sweeps */
  const double* mobility;         /**< one per agent, from 0 (fixed) to 1; NULL: 1 for all */
  const bch_obstacles* obstacles; /**< which bodies must not touch; may be NULL */
  double largest_turn;            /**< radians, from an agent's first heading; 0: headings do not change */
} bch_resolve_options;
#define BCH_RESOLVE_OPTIONS_INIT \
  { sizeof(bch_resolve_options), 16, 100, 0.001, 0.05, HUGE_VAL, NULL, NULL, 0 }
/** Views the new positions, and the collisions that are left. */
typedef struct bch_resolved_view {
  size_t count;    /**< of agents */
  const double* x; /**< one per agent */
  const double* y; /**< one per agent */
  size_t left_count;
  const bch_pair* left; /**< pairs that still collide */
  size_t agents_at_walls_count;
  const uint32_t* agents_at_walls; /**< agents that still touch an obstacle, ascending */
  uint32_t sweeps;             /**< the number of sweeps made */
  const double* turn;          /**< radians to add to headings, one per agent; NULL: largest_turn is 0 */
} bch_resolved_view;
/** Moves agents on the ground, as little as possible, until no two bodies collide and nobody touches an
 * obstacle. `resolve_options` may be NULL. */
BCH_API bch_status bch_crowd_body_resolve(bch_crowd* crowd, const bch_body_set* set, const bch_agents* agents,
                                          const bch_resolve_options* resolve_options,
                                          const bch_pair_filter* filter, const bch_query_options* options,
                                          bch_resolved_view* resolved);

/* Motions ----------------------------------------------------------------------------------------------- */

/** Represents an animated body: discs whose centres and radii are linear in time from key to key, or spheres,
 * which have heights. It has a shape at every time. Times outside the clip are clamped or, if the clip loops,
 * wrap around. */
typedef struct bch_animated_shape bch_animated_shape;

/** Says how moving spheres of a clip are made. */
typedef struct bch_animate_options {
  uint32_t size; /**< sizeof(bch_animate_options) */
  float error;   /**< metres: how far moving spheres may protrude from the posed spheres between keys */
  int32_t loops; /**< 1: the clip repeats; 0: it ends; -1: it repeats if its last pose is its first */
} bch_animate_options;
#define BCH_ANIMATE_OPTIONS_INIT \
  { sizeof(bch_animate_options), 0.005f, -1 }
/** Makes moving spheres that enclose a model's character at every time of a clip. */
BCH_API bch_status bch_animated_shape_animate(const bch_body_model* model, uint32_t clip,
                                              const bch_animate_options* options, bch_animated_shape** shape);

/** Holds moving discs in arrays of the caller: chunks that follow one another in time, each with discs of its
 * own. */
typedef struct bch_animated_arrays {
  uint32_t size;              /**< sizeof(bch_animated_arrays) */
  int32_t loops;              /**< not 0: the clip repeats; it then lasts at least 1 ms */
  const uint32_t* key_counts; /**< one per chunk, like the next one */
  const uint32_t* disc_counts;
  size_t chunk_count;
  const double* times; /**< of the keys of all chunks, seconds; a chunk begins when the one before it ends */
  const bch_disc* discs; /**< of the chunks, key by key */
  const float* z;        /**< the heights of the centres of spheres, as many as discs, or NULL */
} bch_animated_arrays;
#define BCH_ANIMATED_ARRAYS_INIT \
  { sizeof(bch_animated_arrays), 0, NULL, NULL, 0, NULL, NULL, NULL }
/** Makes a body from moving discs. */
BCH_API bch_status bch_animated_shape_create(const bch_animated_arrays* arrays, bch_animated_shape** shape);

/** Holds the times and sizes of an animated body. */
typedef struct bch_animated_shape_info {
  uint32_t size; /**< sizeof(bch_animated_shape_info) */
  int32_t loops;
  double begin, end; /**< seconds of the clip */
  double bounding_radius; /**< the radius that encloses all discs at every time, metres */
  uint64_t bytes;
  uint64_t chunks;
  uint64_t keys; /**< of all chunks */
} bch_animated_shape_info;
#define BCH_ANIMATED_SHAPE_INFO_INIT \
  { sizeof(bch_animated_shape_info), 0, 0, 0, 0, 0, 0, 0 }
/** Gets the times and sizes of a body. */
BCH_API bch_status bch_animated_shape_get_info(const bch_animated_shape* shape,
                                               bch_animated_shape_info* info);
/** Gets the discs at a time; for spheres, their discs as seen from above. Writes at most `capacity` discs,
 * and to `count` the number of all. */
BCH_API bch_status bch_animated_shape_get_discs(const bch_animated_shape* shape, double seconds,
                                                bch_disc* discs, size_t capacity, size_t* count);
/** Gets the spheres at a time, as bch_animated_shape_get_discs() gets discs; a body of discs has none. */
BCH_API bch_status bch_animated_shape_get_spheres(const bch_animated_shape* shape, double seconds,
                                                  bch_sphere* spheres, size_t capacity, size_t* count);
/** Frees a body. */
BCH_API bch_status bch_animated_shape_free(bch_animated_shape* shape);
/** Adds the shape that an animated body has at a time. */
BCH_API bch_status bch_shape_set_builder_add_animated_shape(bch_shape_set_builder* builder,
                                                            const bch_animated_shape* shape,
                                                            double seconds);

/** Stores an animated body in a set, to be saved with it. If `clip` is NULL, the body has no clip name. */
BCH_API bch_status bch_shape_set_add_clip(bch_shape_set* set, const bch_animated_shape* shape,
                                          const char* character, const char* clip);
/** Gets the number of animated bodies in a set: those that were loaded with it and those that were added to
 * it. */
BCH_API bch_status bch_shape_set_get_clip_count(const bch_shape_set* set, size_t* count);
/** Gets the names of animated body i, which live as long as the set, and makes the body. Each of the last
 * three arguments may be NULL. */
BCH_API bch_status bch_shape_set_get_clip(const bch_shape_set* set, size_t i, const char** character,
                                          const char** clip, bch_animated_shape** shape);

/** Holds a key of a path: where an agent is at a time. From key to key it moves straight and turns evenly. */
typedef struct bch_path_key {
  double time, x, y, heading; /**< seconds, metres, radians */
  double z; /**< the height of the agent's ground, metres; used only between bodies of spheres */
} bch_path_key;
/** Describes an agent that moves along a path and plays a clip. Before the first key and after the last one
 * the agent stands at that key. */
typedef struct bch_motion {
  const bch_animated_shape* shape;
  const bch_path_key* path; /**< at least one key, ascending */
  size_t path_count;
  double clip_begin; /**< the time at which the clip begins, seconds */
} bch_motion;
/** Finds when the two motions of each pair first touch, between the times `from` and `to`, both included, in
 * seconds; infinity if they do not touch. Two bodies of spheres are compared in space, others as seen from
 * above. The time is never too late. It is too early by at most the time in which the two come closer by
 * `tolerance` metres, for instance 0.005. `threads` 0: one for each processor. */
BCH_API bch_status bch_first_contact(const bch_motion* motions, size_t motion_count, const bch_pair* pairs,
                                     size_t count, double from, double to, double tolerance, uint32_t threads,
                                     double* times);
/** Finds when each motion first touches an obstacle, as bch_first_contact() does for pairs. Bodies count as
 * seen from above, and obstacles at all heights. */
BCH_API bch_status bch_obstacles_first_contact(const bch_motion* motions, size_t motion_count,
                                               const bch_obstacles* obstacles, double from, double to,
                                               double tolerance, uint32_t threads, double* times);
/** Finds when a motion first touches one of the others: the earliest time that bch_first_contact() finds for
 * it and each of them. */
BCH_API bch_status bch_free_until(const bch_motion* motion, const bch_motion* others, size_t count,
                                  double from, double to, double tolerance, double* time);

/* Scenes ------------------------------------------------------------------------------------------------ */

/** Measures the density around each agent, in people per square metre: the number of agents within a radius,
 * divided by the area of that circle. */
BCH_API bch_status bch_local_densities(const double* x, const double* y, size_t count, double radius,
                                       double* densities);
/** Finds the depth of disc trees to use at a density of people: 0, a single cylinder per shape, if false
 * collisions of the cylinders stop a walker at most once a second at that density, else BCH_ALL_DEPTHS. */
BCH_API bch_status bch_depth_at_density(double people_per_square_metre, uint32_t* depth);

/** Describes the agents of a scene to plan, with one entry per agent in each array. */
typedef struct bch_scene_agents {
  uint32_t size;             /**< sizeof(bch_scene_agents) */
  const uint32_t* character; /**< index in a list of characters; NULL: all are the first */
  const bch_pose* poses;
  const uint32_t* depth; /**< level of detail: the depth that an agent needs; NULL: BCH_ALL_DEPTHS */
  size_t count;
} bch_scene_agents;
#define BCH_SCENE_AGENTS_INIT \
  { sizeof(bch_scene_agents), NULL, NULL, NULL, 0 }
/** Describes the queries and levels of detail that a scene is planned for. */
typedef struct bch_scene_requirements {
  uint32_t size;          /**< sizeof(bch_scene_requirements) */
  int32_t outlines;       /**< not 0: keep outlines, as bch_plan does */
  int32_t heights;        /**< not 0: agents stand at different heights */
  double pairs_per_shape; /**< expected number of pairs tested per shape in its lifetime */
  /** Seconds: times are rounded down to multiples of it, so that agents share shapes; 0: not rounded. */
  float pose_step;
} bch_scene_requirements;
#define BCH_SCENE_REQUIREMENTS_INIT \
  { sizeof(bch_scene_requirements), 1, 0, (double)INFINITY, 0 }
/** Lists the shapes to build for a scene, each once, and the shape and level of each agent. */
typedef struct bch_scene_plan bch_scene_plan;
/** Finds which shapes a scene needs, at which depths and with which other data. */
BCH_API bch_status bch_scene_plan_create(const bch_scene_agents* agents,
                                         const bch_scene_requirements* requirements, bch_scene_plan** plan);
/** Gets the plan of the set to build. Its arrays, and those of the next two functions, live as long as the
 * scene plan. */
BCH_API bch_status bch_scene_plan_get_set(const bch_scene_plan* plan, bch_plan* set);
/** Gets the shapes to build, for bch_shape_set_builder_add_pose_ids(). */
BCH_API bch_status bch_scene_plan_get_shapes(const bch_scene_plan* plan, const bch_pose_id** shapes,
                                             size_t* count);
/** Gets the shape and the level of each agent, for bch_agents. */
BCH_API bch_status bch_scene_plan_get_agents(const bch_scene_plan* plan, const uint32_t** shape,
                                             const uint8_t** level, size_t* count);
/** Frees a plan. */
BCH_API bch_status bch_scene_plan_free(bch_scene_plan* plan);

#ifdef __cplusplus
}
#endif

#endif
