# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

# %% [markdown]
# # A recording: who runs into whom?
#
# `bch.check()` puts a walking body on every row of a recording. It takes a file (JuPedSim, PeTrack, Pathfinder, TrajNet++, CSV ...), a dataframe, or arrays.
# Here the arrays are made up: two streams of 10 people meet in a corridor and make way for each other, but too late.

# %%
import bch
import matplotlib.pyplot as plt
import numpy as np

fps, frames, people = 10, 120, 20
random = np.random.default_rng(5)
frame, person = np.divmod(np.arange(frames * people), people)
way = np.where(np.arange(people) % 2 == 0, 1.0, -1.0)  # east or west
start = -way * (1 + 1.2 * (np.arange(people) // 2))
lane = random.uniform(-1.4, 1.4, people)
x = start[person] + way[person] * 1.3 * frame / fps
y = lane[person] + 0.35 * way[person] * np.exp(-((x / 3) ** 2))
walls = "POLYGON ((-20 -2.2, 20 -2.2, 20 2.2, -20 2.2))"  # the floor, whose edges are walls

# %%
found = bch.check(frame=frame, id=person, x=x, y=y, fps=fps, walls=walls)

# %% [markdown]
# How many person-frames overlap, and the deepest events: who, from when to when, by how many metres.

# %%
summary, events = found.summary, found.table("events")
print(f"{summary['overlapping']} of {summary['person_frames']} person-frames overlap")
for i in np.argsort(-events["depth"])[:5]:
    first, second, depth = events["first"][i], events["second"][i], events["depth"][i]
    print(f"{first} and {second}: {100 * depth:.0f} cm deep at {events['worst_seconds'][i]:.1f} s ({events['kind'][i]})")

# %% [markdown]
# When they overlap, and where.

# %%
figure, (above, below) = plt.subplots(2, 1, figsize=(8, 4), layout="constrained")
above.plot(found.frames["seconds"], found.frames["overlapping"], color="#e45756")
above.set(xlabel="time, s", ylabel="people who overlap")
below.scatter(events["x"], events["y"], s=400 * events["depth"], color="#e45756", alpha=0.5)
below.set(xlabel="x, m", ylabel="y, m", aspect="equal", ylim=(-2.2, 2.2));

# %% [markdown]
# The same as a gate for CI: the command `bch check FILE --fail-above 5` ends with exit code 1 where more than 5 % of person-seconds overlap.

# %%
assert summary["overlapping"] > 0
