# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

# %% [markdown]
# # A simulation of a few lines, with bodies
#
# Most simulators move discs. These lines do, too; then bodies of spheres take their place: `Crowd.collisions()` says who collides in three dimensions, and
# `Crowd.resolve()` moves people apart, as little as possible.

# %%
import bch
import matplotlib.pyplot as plt
import numpy as np

n, step = 60, 0.1
random = np.random.default_rng(2)
side = 6.0
x, y = random.uniform(0, side, (2, n))
goal = random.uniform(0, side, (n, 2))
heading = random.uniform(-np.pi, np.pi, n)

# %% [markdown]
# Half of the people are women. Each walks a stride a second, at a phase of its own.

# %%
characters = [bch.default_male(), bch.default_female()]
walk = next(i for i, clip in enumerate(characters[0].clips) if clip.name == "walk")
bodies = bch.LiveBodies([bch.default_body(each, 128) for each in characters], np.arange(n, dtype=np.uint32) % 2)
agents = bch.Agents(np.arange(n, dtype=np.uint32), x, y, heading)  # views the arrays
crowd = bch.Crowd()
phase = random.uniform(0, 1, n)


def walk_on(time):
    """Walk towards the goals, and pose the bodies."""
    way = goal - np.stack([x, y], axis=1)
    far = np.linalg.norm(way, axis=1)
    heading[:] = np.arctan2(way[:, 1], way[:, 0])
    length = np.minimum(far, 1.3 * step)
    x[:] += length * np.cos(heading)
    y[:] += length * np.sin(heading)
    goal[far < 0.5] = random.uniform(0, side, ((far < 0.5).sum(), 2))
    bodies.pose([(walk, (p + time) % 1.0) for p in phase])


# %%
before, after, moved = [], [], []
for time in np.arange(0, 6, step):
    walk_on(time)
    before.append(len(crowd.collisions(bodies.bodies, agents)))
    free = crowd.resolve(bodies.bodies, agents)
    moved.append(np.hypot(free.x - x, free.y - y).mean())
    x[:], y[:] = free.x, free.y
    after.append(len(free.left))
print(f"pairs that collide: {np.mean(before):.1f} in a step, {np.mean(after):.1f} after resolve()")
print(f"which moves a person by {100 * np.mean(moved):.1f} cm on average")

# %%
figure, ax = plt.subplots(figsize=(8, 2.6), layout="constrained")
ax.plot(np.arange(0, 6, step), before, label="as they walk", color="#e45756")
ax.plot(np.arange(0, 6, step), after, label="after resolve()", color="#4c78a8")
ax.set(xlabel="time, s", ylabel="pairs that collide")
ax.legend();

# %%
assert np.sum(after) < 0.1 * np.sum(before)
