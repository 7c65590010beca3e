# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Prints answers of the Python package, which answers.mjs prints with the one for JavaScript: the same bits are the same lines."""

import sys
from pathlib import Path

import bch
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from repeatable_numbers import fnv, random

n = 600
people = bch.bake([bch.default_male(), bch.default_female(), bch.default_bulky_male()], poses=20)
shape = np.array([int(random() * 60) for _ in range(n)], np.uint32)
x, y = (np.array([random() * 14 for _ in range(n)]) for _ in range(2))
heading = np.array([random() * 6 for _ in range(n)])
agents = bch.Agents(shape=shape, x=x, y=y, heading=heading)
crowd = bch.Crowd()
print("shapes", len(people))
chosen = bch.ShapeSetBuilder()
for character, clip, seconds in ((bch.default_male(), 0, 0.5), (bch.default_female(), 2, 1), (bch.default_female(), 0, 3.25)):
    chosen.add_poses(character, [(clip, seconds)])
near = bch.Agents(shape=np.arange(3), x=np.array([0, 0.5, 0.9]), y=np.array([0, 0.1, 0.2]), heading=np.array([0.0, 1, 2]))
gaps = bch.clearance(chosen.finish(), near, np.array([[0, 1], [1, 2], [0, 2]], np.uint32))
print("chosen", fnv(gaps), ", ".join(f"{clip.name} {clip.seconds:g}" for clip in bch.default_male().clips))
print("collisions", fnv(crowd.collisions(people, agents)))
print("discs", fnv(crowd.collisions(people, agents, leaves="discs")))
near = crowd.clearances(people, agents, within=0.4)
print("clearances", len(near.pairs), fnv(near.pairs), fnv(near.distance), fnv(near.direction))
deep = crowd.penetrations(people, agents)
print("penetrations", *(fnv(deep.penetrations[name]) for name in ("depth", "x", "y")))
candidates = np.array(crowd.candidates(people, agents, margin=0.2))
print("pairs", candidates.size, fnv(bch.collide(people, agents, candidates)), fnv(bch.clearance(people, agents, candidates)))
walls = bch.Obstacles.from_wkt("LINESTRING(0 7, 14 6.5, 3 1)")
print("walls", fnv(crowd.obstacles(people, agents, walls).values))

models = [bch.default_body(character, spheres) for character in (bch.default_male(), bch.default_female()) for spheres in (64, 128, 256, 512)]
live = bch.LiveBodies(models, np.arange(n, dtype=np.uint32) % 8)
poses = np.zeros(n, [("clip", np.uint32), ("seconds", np.float32)])
poses["seconds"] = np.arange(n) / 512
live.pose(poses)
bodies = bch.Agents(shape=np.arange(n, dtype=np.uint32), x=x, y=y, heading=heading)
print("spheres", *(fnv(live.bodies.spheres(i)) for i in range(8)))
print("bodies", fnv(crowd.collisions(live.bodies, bodies)), fnv(crowd.clearances(live.bodies, bodies, within=0.3).distance))
