# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Prints answers of the Python package, which Answers.cs prints with Bch.cs: the same bits are the same lines."""

import sys
from pathlib import Path

import bch
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from repeatable_numbers import fnv, random

print("version", bch.__version__)
n = 600
people = bch.bake([bch.default_male(), bch.default_female()], poses=20)
shape = [int(random() * 40) for _ in range(n)]
x, y = ([random() * 14 for _ in range(n)] for _ in range(2))
agents = bch.Agents(shape, x, y, [random() * 6 for _ in range(n)])
pairs = np.array(bch.Crowd().collisions(people, agents))
print(f"shapes {len(people)}, collisions {len(pairs)} {fnv(pairs)}")
depths = bch.Crowd().penetrations(people, agents).penetrations["depth"]
print("penetrations", len(depths), fnv(depths))

n = 400
models = [bch.default_body(bch.default_pedestrian("male", 1.78), 64), bch.default_body(bch.default_pedestrian("female", 1.66), 128)]
live = bch.LiveBodies(models, np.arange(n, dtype=np.uint32) % 2)
poses = np.zeros(n, bch.POSE)
poses["clip"], poses["seconds"] = 30 + np.arange(n) % 20, np.arange(n) / 512
live.pose(poses)
i = np.arange(n)
to_side = (i % 20 * np.float32(0.45)).astype(np.float32).astype(float)
place = bch.Agents(i, i // 20 * 0.5, -to_side, -np.float64(7 * i) * np.pi / 180, z=i % 3 * 0.25)
pairs = np.array(bch.Crowd(period=(12, 12)).collisions(live.bodies, place))
print("bodies", n, len(pairs), fnv(pairs))
print("spheres", fnv(live.bodies.spheres(0)), fnv(live.bodies.spheres(1)))
