# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Shapes from polygons: wheelchairs and trolleys among people. Writes polygons.png."""

import bch
import matplotlib.pyplot as plt
import numpy as np

# A person, and footprints.
woman = bch.default_female()
builder = bch.ShapeSetBuilder()
builder.add_poses(woman, [(bch.REST_POSE, 0.0)])
wheelchair = [[(-0.55, -0.3), (0.45, -0.3), (0.6, -0.15), (0.6, 0.15), (0.45, 0.3), (-0.55, 0.3)]]
builder.add_polygons(wheelchair)
trolley = [[(-0.5, -0.28), (0.5, -0.28), (0.5, 0.28), (-0.5, 0.28)]]
builder.add_polygons(trolley)
shapes = builder.finish()
names = ["person", "wheelchair", "trolley"]

n = 24
random = np.random.default_rng(11)
agents = bch.Agents(
    shape=random.permutation(n).astype(np.uint32) % 3,
    x=1.2 * (np.arange(n) % 6) + random.uniform(-0.3, 0.3, n),
    y=1.2 * (np.arange(n) // 6) + random.uniform(-0.3, 0.3, n),
    heading=random.uniform(-np.pi, np.pi, n),
)
for first, second in bch.Crowd().collisions(shapes, agents)[:5]:
    print(f"{names[agents.shape[first]]} {first} collides with {names[agents.shape[second]]} {second}")

figure, ax = plt.subplots(figsize=(7, 6), layout="constrained")
bch.plot.crowd(ax, shapes, agents, numbers=True)
ax.set_title("people, wheelchairs and trolleys")
figure.savefig("polygons.png", dpi=120)
