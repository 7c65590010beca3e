# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

# %% [markdown]
# # Robots among people
#
# A delivery robot drives through people who walk. Its body is a cart of 0.6 x 0.5 x 0.9 m, and people are bodies of spheres, so an arm above the
# cart is no contact. In each step the robot asks when it would touch whom if all went on straight, and slows down in time.

# %%
import bch
import matplotlib.pyplot as plt
import numpy as np

n, step, ahead = 30, 0.1, 2.0  # people; seconds
random = np.random.default_rng(4)
cart = bch.spheres_from_polygons([[(-0.3, -0.25), (0.3, -0.25), (0.3, 0.25), (-0.3, 0.25)]], heights=(0.05, 0.95))
man = bch.default_male()
walk = next(i for i, clip in enumerate(man.clips) if clip.name == "walk")
models = [bch.default_body(man, 128), bch.BodyModel.from_spheres(cart)]
bodies = bch.LiveBodies(models, np.array([0] * n + [1], np.uint32))
robot = n  # its number

# %% [markdown]
# People walk across the robot's way.


# %%
def drive(careful):
    """Return the robot's positions, its speeds, and its clearance in each step."""
    random = np.random.default_rng(4)
    x = np.append(random.uniform(2, 12, n), 0.0)
    y = np.append(random.uniform(-8, 8, n), 0.0)
    heading = np.append(np.where(y[:n] > 0, -np.pi / 2, np.pi / 2), 0.0)
    speed = np.append(random.uniform(0.9, 1.4, n), 1.2)
    phase = random.uniform(0, 1, n)
    agents = bch.Agents(np.arange(n + 1, dtype=np.uint32), x, y, heading)
    pairs = np.array([(robot, i) for i in range(n)], np.uint32)
    found = []
    for time in np.arange(0, 15, step):
        bodies.pose([(walk, (p + time) % 1.0) for p in phase] + [(bch.REST_POSE, 0.0)])
        vx, vy = speed * np.cos(heading), speed * np.sin(heading)
        if careful:  # as fast as it may be to touch nobody within two seconds, and not faster than 1.2 m/s
            for wanted in (1.2, 0.8, 0.4, 0.0):
                way_x, way_y = ahead * (wanted - vx[:n]), ahead * -vy[:n]
                if np.isinf(bch.time_of_impact(bodies.bodies, agents, pairs, way_x, way_y)).all():
                    break
            speed[robot] = vx[robot] = wanted
        x += step * vx
        y += step * vy
        found.append((x[robot], speed[robot], bch.clearance(bodies.bodies, agents, pairs).min()))
    return np.array(found).T


# %%
careless, careful = drive(False), drive(True)
for name, (place, _, clearance) in (("careless", careless), ("careful", careful)):
    print(f"{name}: {place[-1]:.1f} m in 15 s, {(clearance == 0).sum()} steps with a contact, nearest {clearance.min():.2f} m")

# %%
times = np.arange(0, 15, step)
figure, (above, below) = plt.subplots(2, 1, figsize=(8, 4), sharex=True, layout="constrained")
for name, (_, speed, clearance), colour in (("careless", careless, "#e45756"), ("careful", careful, "#4c78a8")):
    above.plot(times, speed, label=name, color=colour)
    below.plot(times, np.minimum(clearance, 3), color=colour)
above.set(ylabel="speed, m/s")
above.legend()
below.set(xlabel="time, s", ylabel="clearance, m");

# %%
assert (careless[2] == 0).any() and (careful[2] == 0).sum() < (careless[2] == 0).sum()
