// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

/** An error of the library. The message names the argument, an index and the value. */
export class BchError extends Error {}
export const version: string;

type Numbers = ArrayLike<number>;

/** An object of the library. It is freed when it is collected, or by free(). */
interface Freed {
  free(): void;
}

export const kinds: { jointsInParents: 0; jointsInWorld: 1; boneMatrices: 2 };

export interface CharacterArrays {
  vertices: Numbers;
  triangles: Numbers;
  /** Of joints: an earlier joint, or -1. */
  parents?: Numbers;
  /** Of joints, in the parent's frame: 12 numbers a transform, three rows. */
  rests?: Numbers;
  boneJoints?: Numbers;
  /** Of bones, likewise. */
  inverseBinds?: Numbers;
  /** Vertex v follows influences [v] to [v + 1]. */
  influenceOffsets?: Numbers;
  bones?: Numbers;
  weights?: Numbers;
  rootJoint?: number;
  /** From the joints' frame to metres, z up. */
  toGround?: Numbers;
}
/** A mesh on a skeleton, with clips. */
export class Character implements Freed {
  static from(arrays: CharacterArrays): Character;
  readonly info: { joints: number; clips: number; vertices: number; name: string };
  readonly clips: { name: string; seconds: number }[];
  transforms(clip: number, seconds: number, kind?: 0 | 1): Float64Array;
  free(): void;
}
export function defaultMale(): Character;
export function defaultFemale(): Character;
export function defaultBulkyMale(): Character;
export function defaultPedestrian(isFemale: boolean, stature: number, shoulders?: number): Character;

export interface Plan {
  outlines?: boolean;
  culling?: boolean;
  heights?: boolean;
  threshold?: number;
}
/** Shapes of bodies as seen from above. */
export class ShapeSet implements Freed {
  static load(bytes: Uint8Array, name?: string): ShapeSet;
  static fromPolygons(bodies: [number, number][][][]): ShapeSet;
  /** Bodies of capsules: two ends and a radius each. */
  static fromCapsules(bodies: [number, number, number, number, number][][], options?: { tolerance?: number }): ShapeSet;
  static fromCylinders(radii: number[]): ShapeSet;
  readonly length: number;
  free(): void;
}
export function bake(characters: Character[], options?: { poses?: number } & Plan): ShapeSet;

/** Makes shapes of chosen poses: of characters[character[i]] at seconds[i] of its clip[i]. */
export function bakePoses(characters: Character[], poses: { character: Numbers; clip: Numbers; seconds: Numbers }, plan?: Plan): ShapeSet;

/** Spheres on a skeleton that hold the skin in every pose. */
export class BodyModel implements Freed {
  free(): void;
}
export function defaultBody(character: Character, spheres?: 64 | 128 | 256 | 512): BodyModel;
export function makeBody(character: Character, options?: { spheres?: number; draft?: boolean }): BodyModel;

/** Bodies of spheres. */
export class BodySet implements Freed {
  readonly length: number;
  /** x, y, z, radius each. */
  spheres(body: number, most?: number): Float32Array;
  free(): void;
}
export function bakeBodies(models: BodyModel[], options?: { poses?: number }): BodySet;

/** A body for each of many agents, who all have poses of their own in every frame. */
export class LiveBodies implements Freed {
  constructor(models: BodyModel[], modelOfBody: Numbers);
  readonly set: BodySet;
  poseByClips(clips: Numbers, seconds: Numbers): void;
  pose(transforms: Numbers, options?: { kind?: 0 | 1 | 2; numbers?: 12 | 16; origins?: Numbers }): void;
  free(): void;
}

/** Walls, and areas that nobody may enter. */
export class ObstacleSet implements Freed {
  static fromWkt(wkt: string, options?: { walkable?: boolean; bottom?: number; top?: number }): ObstacleSet;
  free(): void;
}

export interface AgentArrays {
  shape: Numbers;
  x: Numbers;
  y: Numbers;
  /** Radians, counter-clockwise; with headingY the x of a direction. */
  heading: Numbers;
  headingY?: Numbers;
  level?: Numbers;
  z?: Numbers;
}
/** Agents whose arrays are in the library's memory, so that no query copies them. */
export class Agents {
  constructor(count: number, options?: { directions?: boolean; z?: boolean; level?: boolean });
  readonly count: number;
  readonly shape: Uint32Array;
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly heading: Float64Array;
  readonly headingY?: Float64Array;
  readonly level?: Uint8Array;
  readonly z?: Float64Array;
}

export interface Filter {
  category?: Numbers;
  mask?: Numbers;
  excluded?: [number, number][];
}
export interface Options {
  leaves?: "discs" | "segments";
  distanceLeaves?: "discs" | "segments";
  overlap?: "zero" | "deepest";
  maxDistance?: number;
}
/** Pairs of agents, valid until the next call of the Crowd; copy() keeps them. */
export class Pairs implements Iterable<[number, number]> {
  readonly length: number;
  readonly array: Uint32Array;
  copy(): Uint32Array;
  [Symbol.iterator](): Iterator<[number, number]>;
}
type Bodies = ShapeSet | BodySet;
type Crowded = AgentArrays | Agents;

/** Finds who is near whom among all agents, and keeps its memory from call to call. */
export class Crowd implements Freed {
  constructor(options?: { period?: [number, number] });
  candidates(set: Bodies, agents: Crowded, options?: { margin?: number } & Filter & Options): Pairs;
  collisions(set: Bodies, agents: Crowded, options?: Filter & Options): Pairs;
  clearances(set: Bodies, agents: Crowded, within: number, options?: Filter & Options): { pairs: Pairs; distance: Float32Array; direction: Float32Array };
  penetrations(set: Bodies, agents: Crowded, options?: { directions?: number } & Filter & Options): { pairs: Pairs; depth: Float32Array; x: Float64Array; y: Float64Array };
  obstacles(set: Bodies, agents: Crowded, obstacles: ObstacleSet, options?: Options): { offsets: Uint32Array; values: Uint32Array };
  free(): void;
}

/** Whether the two agents of each pair collide: 1 or 0. `pairs` has two numbers a pair. */
export function collide(set: Bodies, agents: Crowded, pairs: Numbers, options?: Options): Uint8Array;
/** How far apart the two agents of each pair are, metres. */
export function clearance(set: Bodies, agents: Crowded, pairs: Numbers, options?: Options): Float32Array;
