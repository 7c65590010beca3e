// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// A crowd that walks through each other, and bodies of four kinds to check it with. Nothing here draws.

import * as bch from "bch";

const statures = [1.78, 1.66]; // metres, of men and women
const clips = [36, 42, 48]; // of pedestrians: one for each 0.03 m/s
const speedOfClip = 0.03; // metres per second
const phases = 32; // of a stride, that outlines and pictures have
const density = 1.1; // people per square metre

const characters = statures.map((stature, i) => bch.defaultPedestrian(i === 1, stature));
const strideOf = characters.map((character) => clips.map((clip) => character.clips[clip].seconds));

/** The poses of pictures and outlines: every character, at every speed, in every phase. */
export const poses = { character: [], clip: [], seconds: [] };
characters.forEach((_, character) =>
  clips.forEach((clip, speed) => {
    for (let phase = 0; phase < phases; ++phase) {
      poses.character.push(character), poses.clip.push(clip);
      poses.seconds.push(((phase + 0.5) / phases) * strideOf[character][speed]);
    }
  }),
);

/** The spheres of all those poses, for pictures: x, y, z, radius each. */
export function spheresOfPoses(count = 64) {
  const bodies = new bch.LiveBodies(characters.map((character) => bch.defaultBody(character, count)), poses.character);
  bodies.poseByClips(poses.clip, poses.seconds);
  return poses.clip.map((_, pose) => bodies.set.spheres(pose));
}

/** Numbers from 0 to 1, the same ones for the same seed. */
function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** People on a square that repeats: who leaves it on one side comes back on the other. */
export class People {
  constructor(count, seed = 1) {
    const random = randomNumbers(seed);
    this.count = count;
    this.side = Math.sqrt(count / density);
    this.agents = new bch.Agents(count);
    this.character = new Uint32Array(count);
    this.speed = new Uint32Array(count); // of clips
    this.phase = new Float64Array(count); // from 0 to 1
    this.turn = new Float64Array(count); // radians per second
    this.held = -1; // who is dragged
    const { x, y, heading } = this.agents;
    for (let i = 0; i < count; ++i) {
      this.character[i] = Math.floor(random() * characters.length);
      this.speed[i] = Math.floor(random() * clips.length);
      this.phase[i] = random();
      x[i] = random() * this.side;
      y[i] = random() * this.side;
      heading[i] = (2 * random() - 1) * Math.PI;
      this.turn[i] = (2 * random() - 1) * 0.25;
    }
  }

  /** Everybody walks on for so many seconds. */
  step(seconds) {
    const { x, y, heading } = this.agents;
    const inside = (at) => at - this.side * Math.floor(at / this.side);
    for (let i = 0; i < this.count; ++i) {
      const way = clips[this.speed[i]] * speedOfClip * seconds;
      this.phase[i] = (this.phase[i] + seconds / strideOf[this.character[i]][this.speed[i]]) % 1;
      if (i === this.held) continue;
      heading[i] += this.turn[i] * seconds;
      if (Math.abs(heading[i]) > Math.PI) heading[i] -= 2 * Math.PI * Math.sign(heading[i]);
      x[i] = inside(x[i] + way * Math.cos(heading[i]));
      y[i] = inside(y[i] + way * Math.sin(heading[i]));
    }
  }

  /** The pose in pictures and outlines. */
  pose(i) {
    return (this.character[i] * clips.length + this.speed[i]) * phases + Math.floor(this.phase[i] * phases);
  }

  /** Clips and seconds of everybody, as they are. */
  times() {
    const clip = Uint32Array.from(this.speed, (speed) => clips[speed]);
    return { clip, seconds: Float32Array.from(this.phase, (phase, i) => phase * strideOf[this.character[i]][this.speed[i]]) };
  }
}

const oneShape = (make) => () => ({ set: make(), shapes: (people, shape) => shape.fill(0) });
const spheres = (count) => (people) => {
  const models = characters.map((character) => bch.defaultBody(character, count));
  const bodies = new bch.LiveBodies(models, people.character);
  const shapes = (_, shape) => shape.forEach((_, i) => (shape[i] = i));
  const pose = () => {
    const { clip, seconds } = people.times();
    bodies.poseByClips(clip, seconds);
  };
  return { set: bodies.set, shapes, pose };
};

/** Bodies to check people with, and how each is made for a crowd. */
export const kinds = {
  cylinder: { title: "cylinders, 25 cm", make: oneShape(() => bch.ShapeSet.fromCylinders([0.25])) },
  capsule: { title: "capsules across the shoulders", make: oneShape(() => bch.ShapeSet.fromCapsules([[[0, -0.12, 0, 0.12, 0.16]]])) },
  spheres64: { title: "64 spheres, in space", make: spheres(64) },
  spheres256: { title: "256 spheres, in space", make: spheres(256) },
  outlines: {
    title: "outlines, from above",
    make: () => ({ set: bch.bakePoses(characters, poses), shapes: (people, shape) => shape.forEach((_, i) => (shape[i] = people.pose(i))) }),
  },
};

/** Checks people frame by frame with one kind of body. */
export class Check {
  constructor(people, kind) {
    this.people = people;
    this.bodies = kinds[kind].make(people);
    this.crowd = new bch.Crowd({ period: [people.side, people.side] });
    this.collides = new Uint8Array(people.count);
  }

  /** Finds who collides now. Returns the pairs, and what posing and finding took, milliseconds. */
  run() {
    const begin = performance.now();
    this.bodies.pose?.();
    this.bodies.shapes(this.people, this.people.agents.shape);
    const posed = performance.now();
    const pairs = this.crowd.collisions(this.bodies.set, this.people.agents).copy();
    const found = performance.now();
    this.collides.fill(0);
    for (const agent of pairs) this.collides[agent] = 1;
    return { pairs, posing: posed - begin, finding: found - posed };
  }

  free() {
    this.crowd.free();
  }
}
