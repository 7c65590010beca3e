// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Collision checks between characters in dense crowds, in WebAssembly: a thin layer over the C interface, bch.h, which says more of each call.

import { Struct, call, callPointer, array, text, view, withScratch, memory } from "./wasm.js";

export { BchError, version } from "./wasm.js";

const freed = new FinalizationRegistry(({ pointer, free }) => call(free, pointer));

/** An object of the library. It is freed when it is collected, or by free(). */
class Handle {
  constructor(pointer, free) {
    this.pointer = pointer;
    if (free) {
      this._free = free;
      freed.register(this, { pointer, free }, this);
    }
  }
  /** Frees the object now. */
  free() {
    if (!this._free || !this.pointer) return;
    freed.unregister(this);
    call(this._free, this.pointer);
    this.pointer = 0;
  }
}

function made(Class, create, ...given) {
  return new Class(callPointer(create, ...given));
}

/** Copies structs of a number and a float each. */
function numbersAndFloats(numbers, floats) {
  const count = numbers.length;
  const to = array(Uint32Array, 2 * count);
  const asNumbers = view(Uint32Array, to, 2 * count), asFloats = view(Float32Array, to, 2 * count);
  for (let i = 0; i < count; ++i) (asNumbers[2 * i] = numbers[i]), (asFloats[2 * i + 1] = floats[i]);
  return to;
}

/** The form in which you pass poses. */
export const kinds = { jointsInParents: 0, jointsInWorld: 1, boneMatrices: 2 };
const layouts = { 12: 0, 16: 1 }; // of transforms, by their numbers: float rows, float columns

/** A mesh on a skeleton, with clips. */
export class Character extends Handle {
  constructor(pointer) {
    super(pointer, "bch_character_free");
  }
  /** Makes a character of arrays, see bch_character_create(): vertices and triangles, and of a skeleton parents, rests, boneJoints,
   * inverseBinds (12 numbers a transform, three rows), influenceOffsets, bones and weights. */
  static from(given) {
    return withScratch(() => {
      const { vertices, triangles, parents = [], rests, boneJoints = [], inverseBinds } = given;
      const { influenceOffsets, bones = [], weights = [], rootJoint = -1, toGround } = given;
      const arrays = new Struct("bch_character_arrays", {
        root_joint: rootJoint,
        vertices: array(Float32Array, vertices),
        vertex_count: vertices.length / 3,
        triangles: array(Uint32Array, triangles),
        triangle_count: triangles.length / 3,
        parents: array(Int32Array, parents),
        rests: rests ? array(Float32Array, rests) : 0,
        joint_count: parents.length,
        bone_joints: array(Uint32Array, boneJoints),
        inverse_binds: inverseBinds ? array(Float32Array, inverseBinds) : 0,
        bone_count: boneJoints.length,
        influence_offsets: influenceOffsets ? array(BigUint64Array, Array.from(influenceOffsets, BigInt)) : 0,
        influences: bones.length > 0 ? numbersAndFloats(bones, weights) : 0,
        to_ground: toGround ? array(Float32Array, toGround) : 0,
      });
      return made(Character, "bch_character_create", arrays.pointer);
    });
  }
  get info() {
    return withScratch(() => {
      const info = new Struct("bch_character_info");
      call("bch_character_get_info", this.pointer, info.pointer);
      return { joints: info.get("joints"), clips: info.get("clips"), vertices: Number(info.get("vertices")), name: text(info.get("name")) };
    });
  }
  /** The names of all clips, and how long they are. */
  get clips() {
    return withScratch(() =>
      Array.from({ length: this.info.clips }, (_, clip) => {
        const name = array(Uint32Array, 2); // and the length
        call("bch_character_get_clip", this.pointer, clip, name, name + 4);
        return { name: text(view(Uint32Array, name, 1)[0]), seconds: view(Float32Array, name + 4, 1)[0] };
      }),
    );
  }
  /** The transforms of all joints at a time of a clip, 12 numbers each. */
  transforms(clip, seconds, kind = kinds.jointsInWorld) {
    return withScratch(() => {
      const count = 12 * this.info.joints;
      const to = array(Float64Array, count);
      const pose = new Struct("bch_pose", { clip, seconds });
      call("bch_character_get_transforms", this.pointer, pose.pointer, kind, to);
      return view(Float64Array, to, count).slice();
    });
  }
}

const builtIn = (which) => () => made(Character, "bch_character_default", which);
export const defaultMale = builtIn(0);
export const defaultFemale = builtIn(1);
export const defaultBulkyMale = builtIn(2);
/** A person who walks at any speed, see bch_character_pedestrian(). */
export function defaultPedestrian(isFemale, stature, shoulders = 0) {
  return made(Character, "bch_character_pedestrian", isFemale ? 0 : 1, stature, shoulders);
}

const pointers = (objects) => array(Uint32Array, Array.from(objects, (object) => object.pointer));

/** Shapes of bodies as seen from above, for all queries. */
export class ShapeSet extends Handle {
  constructor(pointer) {
    super(pointer, "bch_shape_set_free");
  }
  /** Reads what `bch bake` wrote. */
  static load(bytes, name = "bytes") {
    return withScratch(() => made(ShapeSet, "bch_shape_set_load_bytes", array(Uint8Array, bytes), bytes.length, text.of(name)));
  }
  /** Makes a set of polygons, a body each: lists of contours, whose corners are [x, y]. */
  static fromPolygons(bodies) {
    return built({}, (builder) => {
      for (const contours of bodies) {
        const offsets = [0n];
        for (const contour of contours) offsets.push(offsets.at(-1) + BigInt(contour.length));
        call("bch_shape_set_builder_add_polygons", builder, array(Float32Array, contours.flat(2)), array(BigUint64Array, offsets), contours.length, 0);
      }
    });
  }
  /** Makes a set of bodies of capsules seen from above: lists of [x, y, x, y, radius], two ends and a radius. */
  static fromCapsules(bodies, { tolerance = 0.001 } = {}) {
    return built({}, (builder) => {
      for (const capsules of bodies) call("bch_shape_set_builder_add_capsules", builder, array(Float32Array, capsules.flat()), capsules.length, tolerance, 0);
    });
  }
  /** Makes a set of cylinders about the agents' positions. */
  static fromCylinders(radii) {
    return built({}, (builder) => radii.forEach((radius) => call("bch_shape_set_builder_add_cylinder", builder, radius, 0)));
  }
  get length() {
    return withScratch(() => {
      const info = new Struct("bch_shape_set_info");
      call("bch_shape_set_get_info", this.pointer, info.pointer);
      return info.get("shapes");
    });
  }
}
class Builder extends Handle {
  constructor(pointer) {
    super(pointer, "bch_shape_set_builder_free");
  }
}
function built(plan, add) {
  return withScratch(() => {
    const builder = made(Builder, "bch_shape_set_builder_create", new Struct("bch_plan", plans(plan)).pointer);
    add(builder.pointer);
    return made(ShapeSet, "bch_shape_set_builder_finish", builder.pointer);
  });
}
const plans = ({ outlines = true, culling = true, heights = false, threshold = 0.01 } = {}) => ({
  outlines: +outlines, culling: +culling, heights: +heights, threshold,
});

/** Makes a set of characters, each in so many poses that are spread evenly over its clips. */
export function bake(characters, { poses = 100, ...plan } = {}) {
  return withScratch(() => {
    const how = new Struct("bch_plan", plans(plan));
    return made(ShapeSet, "bch_bake", pointers(characters), characters.length, poses, how.pointer, 0);
  });
}
/** Makes a set of chosen poses: of characters[character[i]] at seconds[i] of its clip[i]. */
export function bakePoses(characters, { character, clip, seconds }, plan = {}) {
  return built(plan, (builder) => {
    const sources = array(Uint32Array, 3 * clip.length);
    const numbers = view(Uint32Array, sources, 3 * clip.length), floats = view(Float32Array, sources, 3 * clip.length);
    for (let i = 0; i < clip.length; ++i) (numbers[3 * i] = character[i]), (numbers[3 * i + 1] = clip[i]), (floats[3 * i + 2] = seconds[i]);
    call("bch_shape_set_builder_add_pose_ids", builder, pointers(characters), characters.length, sources, clip.length, 0);
  });
}

/** Spheres on a skeleton that hold the skin in every pose. */
export class BodyModel extends Handle {
  constructor(pointer) {
    super(pointer, "bch_body_model_free");
  }
}
/** The model of a built-in character that comes with the library: 64, 128, 256 or 512 spheres. */
export function defaultBody(character, spheres = 256) {
  return made(BodyModel, "bch_body_model_default", character.pointer, spheres);
}
/** Makes a model of a character, in up to a minute; a draft in seconds. */
export function makeBody(character, { spheres = 256, draft = false } = {}) {
  return withScratch(() => {
    const options = new Struct("bch_body_options", { spheres, draft: +draft });
    return made(BodyModel, "bch_body_model_make", character.pointer, options.pointer, 0);
  });
}

/** Bodies of spheres, for all queries. */
export class BodySet extends Handle {
  constructor(pointer, isLent = false) {
    super(pointer, isLent ? undefined : "bch_body_set_free");
  }
  get length() {
    return withScratch(() => {
      const info = new Struct("bch_body_set_info");
      call("bch_body_set_get_info", this.pointer, info.pointer);
      return info.get("bodies");
    });
  }
  /** The spheres of a body: x, y, z, radius each. */
  spheres(body, most = 4096) {
    return withScratch(() => {
      const to = array(Float32Array, 4 * most);
      const count = array(Uint32Array, 1);
      call("bch_body_set_get_spheres", this.pointer, body, to, most, count);
      return view(Float32Array, to, 4 * view(Uint32Array, count, 1)[0]).slice();
    });
  }
}
/** Makes a set of models, each in so many poses that are spread evenly over its clips. */
export function bakeBodies(models, { poses = 100 } = {}) {
  return withScratch(() => made(BodySet, "bch_bake_bodies", pointers(models), models.length, poses, 0));
}

/** A body for each of many agents, who all have poses of their own in every frame. */
export class LiveBodies extends Handle {
  /** Body i is one of models[modelOfBody[i]]. */
  constructor(models, modelOfBody) {
    const make = () =>
      callPointer("bch_live_bodies_create", pointers(models), models.length, array(Uint32Array, modelOfBody), modelOfBody.length);
    super(withScratch(make), "bch_live_bodies_free");
    this.count = modelOfBody.length;
    /** The bodies in their last poses. */
    this.set = new BodySet(callPointer("bch_live_bodies_get_set", this.pointer), true);
    this.set.owner = this; // which frees it
  }
  /** Poses all bodies at times of clips. */
  poseByClips(clips, seconds) {
    for (const [name, given] of Object.entries({ clips, seconds }))
      if (given.length !== this.count) throw new RangeError(`${name}: expected ${this.count} values, one a body, found ${given.length}`);
    withScratch(() => call("bch_live_bodies_pose", this.pointer, numbersAndFloats(clips, seconds), 0));
  }
  /** Poses all bodies by transforms, one pose after the other: column-major 4 x 4, as in three.js and glTF, or row-major 3 x 4. */
  pose(transforms, { kind = kinds.boneMatrices, numbers = 16, origins } = {}) {
    withScratch(() => {
      const count = transforms.length / numbers / this.count;
      if (!(numbers in layouts) || !Number.isInteger(count))
        throw new RangeError(`pose: expected transforms of 12 or 16 numbers for each of ${this.count} bodies, found ${transforms.length} numbers`);
      const poses = new Struct("bch_pose_arrays", {
        kind,
        layout: layouts[numbers],
        data: array(Float32Array, transforms),
        count,
        origins: origins ? array(Float64Array, origins) : 0,
      });
      call("bch_live_bodies_pose_from_arrays", this.pointer, poses.pointer, 0);
    });
  }
}

/** Walls, and areas that nobody may enter. */
export class ObstacleSet extends Handle {
  constructor(pointer) {
    super(pointer, "bch_obstacles_free");
  }
  /** Reads well-known text. With `walkable`, polygons are where people may walk. */
  static fromWkt(wkt, { walkable = false, bottom = -Infinity, top = Infinity } = {}) {
    return withScratch(() => made(ObstacleSet, "bch_obstacles_from_wkt", text.of(wkt), +walkable, bottom, top));
  }
}

const arraysOfAgents = { shape: Uint32Array, x: Float64Array, y: Float64Array, heading: Float64Array, headingY: Float64Array, level: Uint8Array, z: Float64Array };
const memberOf = (name) => (name === "headingY" ? "heading_y" : name);

/** Agents whose arrays are in the library's memory, so that no query copies them. Ask for an array anew in each frame: memory may move. */
export class Agents {
  constructor(count, { directions = false, z = false, level = false } = {}) {
    const names = ["shape", "x", "y", "heading", ...(directions ? ["headingY"] : []), ...(z ? ["z"] : []), ...(level ? ["level"] : [])];
    this.count = count;
    this.arrays = {};
    for (const name of names) {
      const Type = arraysOfAgents[name];
      this.arrays[name] = memory.allocate(Math.max(1, count) * Type.BYTES_PER_ELEMENT);
      view(Type, this.arrays[name], count).fill(0);
      Object.defineProperty(this, name, { get: () => view(Type, this.arrays[name], count), enumerable: true });
    }
    this._blocks = new Blocks(Object.values(this.arrays));
  }
}
class Blocks {
  constructor(pointers) {
    blocks.register(this, pointers);
  }
}
const blocks = new FinalizationRegistry((pointers) => pointers.forEach(memory.free));

/** Views agents, copying arrays that are not in the library's memory. */
function agentsOf(agents) {
  const count = agents.count ?? agents.x.length;
  const values = { count };
  for (const [name, Type] of Object.entries(arraysOfAgents)) {
    const given = agents.arrays ? agents.arrays[name] : agents[name];
    if (given === undefined) continue;
    if (!agents.arrays && given.length !== count) throw new RangeError(`agents.${name}: expected ${count} values, as x has, found ${given.length}`);
    values[memberOf(name)] = agents.arrays ? given : array(Type, given);
  }
  return new Struct("bch_agents", values).pointer;
}

function filterOf({ category, mask, excluded = [] }) {
  if (!category && !mask && excluded.length === 0) return 0;
  const flat = excluded.flat();
  return new Struct("bch_pair_filter", {
    category: category ? array(Uint32Array, category) : 0,
    mask: mask ? array(Uint32Array, mask) : 0,
    excluded: array(Uint32Array, flat),
    excluded_count: flat.length / 2,
  }).pointer;
}

/** The number of one of some words. */
function numberOf(words, option, given) {
  const number = words.indexOf(given);
  if (number < 0) throw new RangeError(`${option}: expected ${words.join(" or ")}, found ${given}`);
  return number;
}
const leafWords = ["discs", "segments"];
function optionsOf({ leaves = "segments", distanceLeaves = "discs", overlap = "zero", maxDistance = Infinity } = {}) {
  return new Struct("bch_query_options", {
    leaves: numberOf(leafWords, "leaves", leaves),
    distance_leaves: numberOf(leafWords, "distanceLeaves", distanceLeaves),
    overlap: numberOf(["zero", "deepest"], "overlap", overlap),
    max_distance: maxDistance,
  }).pointer;
}

/** Pairs of agents: `array` has two numbers a pair. Answers of a Crowd are views, valid until its next call; copy() keeps them. */
export class Pairs {
  constructor(pointer, count) {
    this.pointer = pointer;
    this.length = count;
  }
  get array() {
    return view(Uint32Array, this.pointer, 2 * this.length);
  }
  copy() {
    return this.array.slice();
  }
  *[Symbol.iterator]() {
    const kept = this.copy(); // memory may grow meanwhile
    for (let i = 0; i < kept.length; i += 2) yield [kept[i], kept[i + 1]];
  }
}

const of = (set, shapes, bodies) => (set instanceof BodySet ? bodies : shapes);

/** Finds who is near whom among all agents, and keeps its memory from call to call. */
export class Crowd extends Handle {
  /** The ground repeats after `period` metres along x and y; 0: never. */
  constructor({ period: [period_x, period_y] = [0, 0] } = {}) {
    const make = () => {
      const options = new Struct("bch_crowd_options", { period_x, period_y, max_pairs: 2n ** 64n - 1n });
      return callPointer("bch_crowd_create", options.pointer);
    };
    super(withScratch(make), "bch_crowd_free");
  }
  _pairs(name, ...given) {
    const pairs = array(Uint32Array, 2);
    call(name, this.pointer, ...given, pairs, pairs + 4);
    return new Pairs(...view(Uint32Array, pairs, 2));
  }
  /** The pairs whose bounds come within `margin` metres. */
  candidates(set, agents, { margin = 0, ...options } = {}) {
    return withScratch(() =>
      this._pairs(of(set, "bch_crowd_candidates", "bch_crowd_body_candidates"), set.pointer, agentsOf(agents), margin, filterOf(options), optionsOf(options)));
  }
  /** The pairs that collide. */
  collisions(set, agents, options = {}) {
    return withScratch(() =>
      this._pairs(of(set, "bch_crowd_collisions", "bch_crowd_body_collisions"), set.pointer, agentsOf(agents), filterOf(options), optionsOf(options)));
  }
  /** The pairs within a distance: `pairs`, and for each the distance and the direction from the first to the second. */
  clearances(set, agents, within, options = {}) {
    return withScratch(() => {
      const inSpace = set instanceof BodySet;
      const found = new Struct(inSpace ? "bch_crowd_body_clearance_view" : "bch_crowd_clearance_view");
      const name = inSpace ? "bch_crowd_body_clearances" : "bch_crowd_clearances";
      call(name, this.pointer, set.pointer, agentsOf(agents), within, filterOf(options), optionsOf(options), found.pointer);
      const count = found.get("count");
      return {
        pairs: new Pairs(found.get("pairs"), count),
        distance: view(Float32Array, found.get("distance"), count),
        direction: view(Float32Array, found.get("direction"), (inSpace ? 3 : 2) * count),
      };
    });
  }
  /** The pairs that collide, and for each how far the first agent has to move: depth, x, y. */
  penetrations(set, agents, { directions = 16, ...options } = {}) {
    return withScratch(() => {
      const found = new Struct("bch_crowd_penetration_view");
      const name = of(set, "bch_crowd_penetrations", "bch_crowd_body_penetrations");
      call(name, this.pointer, set.pointer, agentsOf(agents), directions, filterOf(options), optionsOf(options), found.pointer);
      const count = found.get("count");
      const floats = view(Float32Array, found.get("depths"), 6 * count);
      const doubles = view(Float64Array, found.get("depths"), 3 * count);
      const every = (numbers, step, at) => numbers.constructor.from({ length: count }, (_, i) => numbers[step * i + at]);
      return { pairs: new Pairs(found.get("pairs"), count), depth: every(floats, 6, 0), x: every(doubles, 3, 1), y: every(doubles, 3, 2) };
    });
  }
  /** The obstacles that each agent collides with: those of agent i are values[offsets[i]] to values[offsets[i + 1]]. */
  obstacles(set, agents, obstacles, options = {}) {
    return withScratch(() => {
      const found = new Struct("bch_index_rows");
      const name = of(set, "bch_crowd_obstacles", "bch_crowd_body_obstacles");
      call(name, this.pointer, set.pointer, agentsOf(agents), obstacles.pointer, optionsOf(options), found.pointer);
      const offsets = Uint32Array.from(view(BigUint64Array, found.get("offsets"), found.get("rows") + 1), Number);
      return { offsets, values: view(Uint32Array, found.get("values"), offsets.at(-1)) };
    });
  }
}

/** Whether the two agents of each pair collide: 1 or 0. `pairs` has two numbers a pair. */
export function collide(set, agents, pairs, options = {}) {
  return withScratch(() => {
    const count = pairs.length / 2;
    const hits = array(Uint8Array, count);
    const name = of(set, "bch_collide", "bch_collide_bodies");
    call(name, set.pointer, agentsOf(agents), array(Uint32Array, pairs), count, optionsOf(options), hits);
    return view(Uint8Array, hits, count).slice();
  });
}
/** How far apart the two agents of each pair are, metres. */
export function clearance(set, agents, pairs, options = {}) {
  return withScratch(() => {
    const count = pairs.length / 2;
    const distance = array(Float32Array, count);
    const inSpace = set instanceof BodySet;
    const out = new Struct(inSpace ? "bch_body_clearance_out" : "bch_clearance_out", { distance });
    const name = inSpace ? "bch_clearance_bodies" : "bch_clearance";
    call(name, set.pointer, agentsOf(agents), array(Uint32Array, pairs), count, optionsOf(options), out.pointer);
    return view(Float32Array, distance, count).slice();
  });
}
