# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""A crowd over time: two groups walk through each other. When and where do people collide? Writes crowd_over_time.png."""

import bch
import matplotlib.pyplot as plt
import numpy as np

# A walking man in 32 phases of his stride, which takes a second.
man = bch.default_male()
walk = next(i for i, clip in enumerate(man.clips) if clip.name == "walk")
phases, stride = 32, 1.0
poses = [(walk, stride * k / phases) for k in range(phases)]
people = bch.bake(man, poses=poses)

# 30 people walk east, and 30 west.
n, speed, step = 60, 1.3, 0.1
random = np.random.default_rng(7)
east = np.arange(n) < n // 2
column, row = np.divmod(np.arange(n) % (n // 2), 5)
x = np.where(east, -3 - 1.7 * column, 3 + 1.7 * column) + random.uniform(-0.2, 0.2, n)
y = 1.3 * (row - 2) + np.where(east, 0.2, -0.2) + random.uniform(-0.1, 0.1, n)
heading = np.where(east, 0.0, np.pi)
phase = random.uniform(0, phases, n)
shape = np.zeros(n, np.uint32)
agents = bch.Agents(shape, x, y, heading)  # views the arrays, so queries see the changes below

crowd = bch.Crowd()
times = np.arange(0, 12, step)
colliding, where = [], []
for time in times:
    shape[:] = (phase + time / stride * phases) % phases
    who = np.unique(crowd.collisions(people, agents))
    colliding.append(len(who))
    where.append(np.stack([x[who], y[who]], axis=1))
    if abs(time - 5) < step / 2:
        snapshot = bch.Agents(shape.copy(), x.copy(), y.copy(), heading.copy())
    x += np.where(east, speed, -speed) * step

print(f"at most {max(colliding)} of {n} people collide at the same time, after {times[np.argmax(colliding)]:.1f} s")

figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(9, 8), height_ratios=[1.5, 1, 1.1], layout="constrained")
bch.plot.crowd(top, people, snapshot)
top.set(title="after 5 s; who collides is red", xlim=(-9, 9))
middle.plot(times, colliding, color="#e45756")
middle.set(xlabel="time, s", ylabel="people who collide", xlim=(0, times[-1]), ylim=(0, None))
places = np.concatenate(where)
bottom.hist2d(places[:, 0], places[:, 1], bins=(60, 20), range=((-12, 12), (-3, 3)), cmap="Reds")
bottom.set(title="where they do", xlabel="x, m", ylabel="y, m", aspect="equal")
figure.savefig("crowd_over_time.png", dpi=120)
