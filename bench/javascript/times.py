# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Times of the Python package on one thread and with SSE2, which times.mjs has of the one for JavaScript. Posing takes the best instructions."""

import time

import bch
import numpy as np

state = 12345


def random():
    global state
    state = (state * 1103515245 + 12345) & 0x7FFFFFFF
    return state / 0x7FFFFFFF


def best(call, runs=15):
    least = np.inf
    for _ in range(runs):
        begin = time.perf_counter()
        call()
        least = min(least, time.perf_counter() - begin)
    return least


n = 4000
side = (n / 3) ** 0.5
people = bch.bake([bch.default_male(), bch.default_female()], poses=50)
shape = np.array([int(random() * 100) for _ in range(n)], np.uint32)
x, y = (np.array([random() * side for _ in range(n)]) for _ in range(2))
agents = bch.Agents(shape=shape, x=x, y=y, heading=np.array([random() * 6 for _ in range(n)]))
pairs = np.array(bch.Crowd().candidates(people, agents))
collide = best(lambda: bch.collide(people, agents, pairs, threads=1, implementation="sse2"))
print(f"collide() {collide / len(pairs) * 1e9:.0f} ns a pair")
live = bch.LiveBodies([bch.default_body(bch.default_male(), 256)], np.zeros(n, np.uint32))
poses = np.zeros(n, [("clip", np.uint32), ("seconds", np.float32)])
poses["seconds"] = np.arange(n) / 2048
print(f"posing {best(lambda: live.pose(poses, threads=1)) / n * 1e6:.1f} us a body of 256 spheres")
