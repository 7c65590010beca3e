# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Distances for a social force step: bodies repel each other and walls. Writes social_force.png."""

import bch
import matplotlib.pyplot as plt
import numpy as np

people = bch.bake([bch.default_male(), bch.default_female()], poses=20)
corridor = bch.Obstacles.from_wkt("LINESTRING(-20 -2, 20 -2) LINESTRING(-20 2, 20 2) POLYGON((0 -1, 1 0, 0 1, -1 0))")

n = 24
random = np.random.default_rng(3)
column, row = np.divmod(np.arange(n), 3)
x, y = -9.0 + 0.9 * column, 1.1 * (row - 1.0) + random.uniform(-0.1, 0.1, n)
velocity = np.zeros((n, 2))
heading = np.zeros(n)
agents = bch.Agents(random.integers(len(people), size=n), x, y, heading)
crowd = bch.Crowd()

mass, relaxation, strength, reach, step = 80.0, 0.5, 800.0, 0.15, 0.02  # kg, s, N, m, s
wanted = np.array([1.2, 0.0])


def forces():
    """Return the forces on people, in newtons, after Helbing and Molnar 1995, with distances between the outlines' discs."""
    force = mass * (wanted - velocity) / relaxation
    near = crowd.clearances(people, agents, 4 * reach, overlap="deepest")
    push = strength * np.exp(-near.distance / reach)[:, None] * near.direction
    np.add.at(force, near.pairs[:, 0], -push)
    np.add.at(force, near.pairs[:, 1], push)
    walls = bch.nearest(people, agents, corridor, max_distance=4 * reach, overlap="deepest")
    force -= strength * np.exp(-walls.distance / reach)[:, None] * walls.direction
    return force


track = []
for _ in range(500):
    velocity += forces() / mass * step
    speed = np.linalg.norm(velocity, axis=1)
    velocity *= np.minimum(1, 2.0 / np.maximum(speed, 1e-9))[:, None]
    x += velocity[:, 0] * step
    y += velocity[:, 1] * step
    leave = bch.penetration(people, agents, corridor)  # moves people out of walls
    x += leave["depth"] * leave["x"]
    y += leave["depth"] * leave["y"]
    heading[:] = np.arctan2(velocity[:, 1], velocity[:, 0])
    track.append(np.stack([x, y], axis=1))

touching = bch.collide(people, agents, corridor).sum()
print(f"{(x > 1).sum()} of {n} people are past the pillar after 10 s, {touching} touch a wall")

figure, ax = plt.subplots(figsize=(10, 3.4), layout="constrained")
ax.plot(*np.swapaxes(track, 0, 2).transpose(0, 2, 1), color="#9aa5b1", linewidth=0.6)
bch.plot.crowd(ax, people, agents)
for wall in (-2, 2):
    ax.axhline(wall, color="black")
ax.fill([0, 1, 0, -1], [-1, 0, 1, 0], color="#52606d")
ax.set(title="after 10 s, and the ways there", xlim=(-10, 10), ylim=(-2.5, 2.5))
figure.savefig("social_force.png", dpi=120)
