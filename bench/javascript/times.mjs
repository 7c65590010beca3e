// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Times of the package for JavaScript, in a folder where it is installed, such as build/wasm/empty after .ci/wasm. times.py has the same of the
// Python package, on one thread and with SSE2.

import * as bch from "bch";

let state = 12345n;
const random = () => Number((state = (state * 1103515245n + 12345n) & 0x7fffffffn)) / 0x7fffffff;
const many = (Type, count, of) => Type.from({ length: count }, of);
function best(call, runs = 15) {
  let least = Infinity;
  for (let i = 0; i < runs; ++i) {
    const begin = performance.now();
    call();
    least = Math.min(least, performance.now() - begin);
  }
  return least;
}

const n = 4000, side = Math.sqrt(n / 3);
const people = bch.bake([bch.defaultMale(), bch.defaultFemale()], { poses: 50 });
const agents = {
  shape: many(Uint32Array, n, () => Math.floor(random() * 100)),
  x: many(Float64Array, n, () => random() * side),
  y: many(Float64Array, n, () => random() * side),
  heading: many(Float64Array, n, () => random() * 6),
};
const crowd = new bch.Crowd();
const pairs = crowd.candidates(people, agents).copy();
console.log("collide()", ((best(() => bch.collide(people, agents, pairs)) / pairs.length) * 2e6).toFixed(0), "ns a pair");
const live = new bch.LiveBodies([bch.defaultBody(bch.defaultMale(), 256)], new Uint32Array(n));
const clips = new Uint32Array(n), seconds = many(Float32Array, n, (_, i) => i / 2048);
console.log("posing", ((best(() => live.poseByClips(clips, seconds)) / n) * 1e3).toFixed(1), "us a body of 256 spheres");
