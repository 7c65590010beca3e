// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Prints answers of the package bch, which answers.py prints with the Python package: the same bits are the same lines.

import assert from "node:assert";
import * as bch from "bch";

let state = 12345n;
const random = () => Number((state = (state * 1103515245n + 12345n) & 0x7fffffffn)) / 0x7fffffff;
const many = (Type, count, of) => Type.from({ length: count }, of);

/** FNV-1a of the bytes of numbers. */
function hash(numbers) {
  let h = 0x811c9dc5;
  for (const byte of new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength)) h = Math.imul(h ^ byte, 0x01000193) >>> 0;
  return h.toString(16);
}

const n = 600;
const people = bch.bake([bch.defaultMale(), bch.defaultFemale(), bch.defaultBulkyMale()], { poses: 20 });
const agents = {
  shape: many(Uint32Array, n, () => Math.floor(random() * 60)),
  x: many(Float64Array, n, () => random() * 14),
  y: many(Float64Array, n, () => random() * 14),
  heading: many(Float64Array, n, () => random() * 6),
};
const crowd = new bch.Crowd();
console.log("shapes", people.length);
const chosen = bch.bakePoses([bch.defaultMale(), bch.defaultFemale()], { character: [0, 1, 1], clip: [0, 2, 0], seconds: [0.5, 1, 3.25] });
const near_agents = { shape: [0, 1, 2], x: [0, 0.5, 0.9], y: [0, 0.1, 0.2], heading: [0, 1, 2] };
console.log("chosen", hash(bch.clearance(chosen, near_agents, [0, 1, 1, 2, 0, 2])), bch.defaultMale().clips.map((c) => `${c.name} ${c.seconds}`).join(", "));
console.log("collisions", hash(crowd.collisions(people, agents).copy()));
console.log("discs", hash(crowd.collisions(people, agents, { leaves: "discs" }).copy()));
const near = crowd.clearances(people, agents, 0.4);
console.log("clearances", near.pairs.length, hash(near.pairs.copy()), hash(near.distance.slice()), hash(near.direction.slice()));
const deep = crowd.penetrations(people, agents);
console.log("penetrations", hash(deep.depth), hash(deep.x), hash(deep.y));
const candidates = crowd.candidates(people, agents, { margin: 0.2 }).copy();
console.log("pairs", candidates.length, hash(bch.collide(people, agents, candidates)), hash(bch.clearance(people, agents, candidates)));
const walls = bch.ObstacleSet.fromWkt("LINESTRING(0 7, 14 6.5, 3 1)");
console.log("walls", hash(crowd.obstacles(people, agents, walls).values.slice()));

const models = [bch.defaultMale(), bch.defaultFemale()].flatMap((c) => [64, 128, 256, 512].map((s) => bch.defaultBody(c, s)));
const live = new bch.LiveBodies(models, many(Uint32Array, n, (_, i) => i % 8));
live.poseByClips(new Uint32Array(n), many(Float32Array, n, (_, i) => i / 512));
const bodies = { ...agents, shape: many(Uint32Array, n, (_, i) => i) };
console.log("spheres", [0, 1, 2, 3, 4, 5, 6, 7].map((i) => hash(live.set.spheres(i))).join(" "));
console.log("bodies", hash(crowd.collisions(live.set, bodies).copy()), hash(crowd.clearances(live.set, bodies, 0.3).distance.slice()));

// What has no line in Python: arrays in the library's memory, filters, own characters and matrices, errors, and freeing.
const own = new bch.Agents(n);
for (const name of ["shape", "x", "y", "heading"]) own[name].set(agents[name]);
const pairs = crowd.collisions(people, agents).copy();
assert.deepEqual(crowd.collisions(people, own).copy(), pairs);
assert.deepEqual([...crowd.collisions(people, own)].flat(), [...pairs]);
const first = [pairs[0], pairs[1]];
assert.equal(crowd.collisions(people, own, { excluded: [first] }).length, pairs.length / 2 - 1);
assert.equal(crowd.collisions(people, own, { category: new Uint32Array(n).fill(1), mask: new Uint32Array(n).fill(2) }).length, 0);
const box = bch.Character.from({
  vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1],
  triangles: [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3],
  parents: [-1],
  boneJoints: [0],
  influenceOffsets: [0, 1, 2, 3, 4],
  bones: [0, 0, 0, 0],
  weights: [1, 1, 1, 1],
  rootJoint: 0,
});
const boxes = new bch.LiveBodies([bch.makeBody(box, { spheres: 8, draft: true })], [0, 0]);
const at = (x) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];
boxes.pose([...at(0), ...at(5)]);
const [left, right] = [boxes.set.spheres(0), boxes.set.spheres(1)];
assert.ok(Math.abs(right[0] - left[0] - 5) < 1e-5);
const two = (x) => ({ shape: [0, 1], x: [0, x], y: [0, 0], heading: [0, 0] });
assert.deepEqual([...bch.collide(boxes.set, two(-5), [0, 1])], [1]);
assert.deepEqual([...bch.collide(boxes.set, two(0), [0, 1])], [0]);
const round = { shape: [0, 1], x: [0, 0.7], y: [0, 0], heading: [0, Math.PI / 2] };
assert.deepEqual([...bch.collide(bch.ShapeSet.fromCylinders([0.3, 0.41]), round, [0, 1])], [1]);
assert.deepEqual([...bch.collide(bch.ShapeSet.fromCylinders([0.3, 0.39]), round, [0, 1])], [0]);
const capsules = bch.ShapeSet.fromCapsules([[[0, -0.2, 0, 0.2, 0.1]], [[0, -0.2, 0, 0.2, 0.1]]]);
assert.ok(Math.abs(bch.clearance(capsules, round, [0, 1])[0] - 0.3) < 0.02);
const squares = bch.ShapeSet.fromPolygons([[[[-1, -1], [1, -1], [1, 1], [-1, 1]]]]);
assert.equal(squares.length, 1);
assert.deepEqual([...bch.collide(squares, { shape: [0, 0], x: [0, 1.9], y: [0, 0], heading: [0, 0] }, [0, 1])], [1]);
const corridor = new bch.Crowd({ period: [10, 10] });
assert.equal(corridor.collisions(squares, { shape: [0, 0], x: [0.5, 9.5], y: [0, 0], heading: [0, 0] }).length, 1);
assert.throws(() => bch.collide(people, agents, [0, n]), { message: `pair 0: expected one of ${n} agents, found ${n}` });
assert.throws(() => crowd.collisions(people, { ...agents, y: [1] }), RangeError);
assert.throws(() => crowd.collisions(people, own, { leaves: "disks" }), { message: "leaves: expected discs or segments, found disks" });
assert.throws(() => live.poseByClips([0], [0]), RangeError);
assert.throws(() => boxes.pose([1, 2, 3]), RangeError);
assert.throws(() => boxes.pose([...at(0), ...at(5), ...at(0), ...at(5)]), bch.BchError);
assert.deepEqual(crowd.collisions(people, { shape: own.shape, x: own.x, y: own.y, heading: own.heading }).copy(), pairs);
assert.throws(() => bch.ShapeSet.load(new Uint8Array(10)), bch.BchError);
squares.free();
squares.free();
