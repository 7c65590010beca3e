# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Arguments of every call arrive in the library, and its answers come back: by squares, whose answers are known, and by
outlines of meshes and characters."""

import json
import tempfile
import threading
import unittest

import bch
import numpy as np

SQUARES = [[[(-k, -k), (k, -k), (k, k), (-k, k)]] for k in (0.5, 1.0)]
SHAPES = bch.ShapeSet.from_polygons(SQUARES, plan=bch.Plan(depths=(0, bch.ALL_DEPTHS)))
WALL = bch.Obstacles.from_wkt("LINESTRING(3 -1, 3 1)")
# Squares of 1 m on a line: the first two overlap by 0.1 m, the third is 1.1 m behind them and on the wall.
LINE = bch.Agents(np.zeros(3, np.uint32), np.array([0, 0.9, 3]), np.zeros(3), np.array([0, np.pi / 2, 0]))
PAIRS = np.array([[0, 1], [1, 2], [0, 2]], np.uint32)

def two(distance, shape=(0, 0), heading=0.0, level=None):
    """Two agents side by side, as the first arguments of a query."""
    level = None if level is None else np.full(2, level, np.uint8)
    agents = bch.Agents(np.array(shape, np.uint32), np.array([0.0, distance]), np.zeros(2), np.array([heading, 0.0]), level)
    return SHAPES, agents, PAIRS[:1]

class Pairs(unittest.TestCase):
    def near(self, found, expected, atol=1e-5):
        np.testing.assert_allclose(found, expected, rtol=0, atol=atol)

    def test_collide(self):
        for threads in (0, 1, 2):
            self.assertEqual(bch.collide(SHAPES, LINE, PAIRS, threads=threads).tolist(), [True, False, False])
        for name in bch.implementations():
            self.assertEqual(bch.collide(SHAPES, LINE, PAIRS, implementation=name).tolist(), [True, False, False])
        self.assertEqual(bch.collide(*two(1.1, heading=np.pi / 4)).tolist(), [True])  # a corner reaches 0.71 m
        self.assertEqual(bch.collide(*two(1.2, level=0)).tolist(), [True])  # so do roots
        self.assertEqual(bch.collide(*two(1.2, level=1)).tolist(), [False])
        self.assertEqual(bch.collide(*two(1.6, shape=(0, 1))).tolist(), [False])
        self.assertEqual(bch.collide(*two(0, shape=(0, 1))).tolist(), [True])  # one inside the other
        beside = two(1.001)
        self.assertEqual([bch.collide(*beside)[0], bch.collide(*beside, leaves="discs")[0]], [False, True])

    def test_within(self):
        self.assertEqual(bch.within(SHAPES, LINE, PAIRS, 1.2).tolist(), [True, True, False])
        self.assertEqual(bch.within(SHAPES, LINE, PAIRS, np.array([0, 1.0, 2.5])).tolist(), [True, False, True])
        self.assertEqual(bch.within(*two(0, shape=(0, 1)), 0).tolist(), [True])

    def test_distances(self):
        exact = dict(leaves="segments")
        self.near(bch.clearance(SHAPES, LINE, PAIRS, **exact), [0, 1.1, 2])
        self.near(bch.clearance(SHAPES, LINE, PAIRS), [0, 1.1, 2], 0.03)  # discs protrude
        self.near(bch.clearance(SHAPES, LINE, PAIRS, max_distance=1.5, **exact), [0, 1.1, np.inf])
        deepest = bch.clearance(SHAPES, LINE, PAIRS, overlap="deepest")
        self.assertTrue(deepest[0] < 0 < deepest[1])
        found = bch.nearest(SHAPES, LINE, PAIRS, **exact)
        self.near(found.distance, [0, 1.1, 2])
        self.near(found.direction[1:], [(1, 0)] * 2)
        self.near(found.points[1:, :, 0], [(0.5, -0.5)] * 2)
        self.assertTrue((found.discs[1:] < 2**32 - 1).all())

    def test_directions(self):
        directions = np.stack([np.cos(LINE.heading), np.sin(LINE.heading)], 1)
        agents = bch.Agents(LINE.shape, LINE.x, LINE.y, directions)
        self.assertEqual(bch.collide(SHAPES, agents, PAIRS).tolist(), [True, False, False])
        self.near(bch.clearance(SHAPES, agents, PAIRS), [0, 1.1, 2], 0.03)
        directions *= 1.1
        with self.assertRaisesRegex(ValueError, r"agent 0: expected a direction of length 0\.999 to 1\.001, found \(1\.1, 0\)"):
            bch.collide(SHAPES, agents, PAIRS)

    def test_penetration(self):
        depths = bch.penetration(SHAPES, LINE, PAIRS, 16)
        self.near([depths[part][0] for part in ("depth", "x", "y")], [0.1, -1, 0], 0.03)
        self.assertEqual(depths["depth"][1:].tolist(), [0, 0])
        along = bch.penetration(SHAPES, LINE, PAIRS, np.array([(0, 2), (1, 0), (1, 0)], np.float32))
        self.near([along[part][0] for part in ("depth", "x", "y")], [1, 0, 1], 0.03)

    def test_nearest_free(self):
        free = bch.nearest_free(SHAPES, LINE, PAIRS)
        self.near([free[part][0] for part in ("depth", "x", "y")], [0.1, -1, 0], 1e-4)
        self.assertEqual(free["depth"][1:].tolist(), [0, 0])
        discs = bch.nearest_free(SHAPES, LINE, PAIRS, leaves="discs", directions=4, threads=1)
        self.assertTrue(0.1 < discs["depth"][0] < 0.13)
        touches = np.empty(3, bch.TOUCH)
        np.testing.assert_array_equal(bch.nearest_free(SHAPES, LINE, PAIRS, touches=touches), free)
        self.near(touches["normal"], [(-1, 0, 0), (0, 0, 0), (0, 0, 0)], 1e-6)
        self.near(touches["point"][0, 0], 0.5, 1e-4)
        with self.assertRaisesRegex(bch.ArrayError, "touches .* bch.TOUCH"):
            bch.nearest_free(SHAPES, LINE, PAIRS, touches=free)
        with self.assertRaisesRegex(bch.ArrayError, "expected an array of pairs"):
            bch.nearest_free(SHAPES, LINE, WALL)

    def test_nearest_free_of_all(self):
        both = np.array([(0, 1), (1, 0), (1, 2)], np.uint32)
        touches = np.empty(len(LINE), bch.TOUCH)
        free = bch.nearest_free_of_all(SHAPES, LINE, both, WALL, touches=touches)
        self.assertEqual(len(free), len(LINE))
        moved = bch.Agents(LINE.shape, LINE.x + free["depth"] * free["x"], LINE.y + free["depth"] * free["y"], LINE.heading)
        self.assertFalse(bch.collide(SHAPES, moved, WALL).any())
        alone = bch.nearest_free(SHAPES, LINE, both[:1])
        np.testing.assert_array_equal(bch.nearest_free_of_all(SHAPES, LINE, both[:1])[:1], alone)
        self.near(np.linalg.norm(touches["normal"], axis=1), (free["depth"] > 0).astype(float), 1e-6)
        with self.assertRaisesRegex(bch.ArrayError, "touches .* bch.TOUCH"):
            bch.nearest_free_of_all(SHAPES, LINE, both, touches=free)

    def test_time_of_impact(self):
        times = bch.time_of_impact(SHAPES, LINE, PAIRS, np.array([0, 2.2, 0]), np.array([0, 0, 5.0]))
        self.near(times, [0, 0.5, np.inf], 0.02)

    def test_arrays_of_the_caller(self):
        """Results go into `out` itself, and agents that move are seen."""
        out = np.empty(3, bool)
        self.assertIs(bch.collide(SHAPES, LINE, PAIRS, out=out), out)
        self.assertEqual(out.tolist(), [True, False, False])
        nearest = bch.Nearest(np.empty(3, "f4"), np.empty((3, 2), "f4"), np.empty((3, 2), "u4"), np.empty((3, 2, 2), "f4"))
        self.assertIs(bch.nearest(SHAPES, LINE, PAIRS, leaves="segments", out=nearest).points, nearest.points)
        self.near(nearest.points[1, :, 0], (0.5, -0.5))
        x = LINE.x.copy()
        moving = bch.Agents(LINE.shape, x, LINE.y, LINE.heading)
        x += 5 * np.arange(3)
        self.assertFalse(bch.collide(SHAPES, moving, PAIRS).any())

    def test_threads(self):
        hits = []
        asking = [threading.Thread(target=lambda: hits.extend(bch.collide(SHAPES, LINE, PAIRS, threads=1))) for _ in range(8)]
        for thread in asking:
            thread.start()
        for thread in asking:
            thread.join()
        self.assertEqual([bool(hit) for hit in hits], [True, False, False] * 8)

class AgentArrays(unittest.TestCase):
    def test_are_taken_as_they_are(self):
        random = np.random.default_rng(3)
        n = 60
        shape, x, y, heading = random.integers(len(SHAPES), size=n), 4 * random.random(n), 4 * random.random(n), 6 * random.random(n)
        x, y, heading = (np.float32(values).astype(float) for values in (x, y, heading))
        found = bch.Crowd().collisions(SHAPES, bch.Agents(shape.astype(np.uint32), x, y, heading))
        self.assertGreater(len(found), 10)
        table = np.zeros(n, np.dtype([("who", "u1"), ("x", "f4"), ("shape", "u4"), ("y", "f4"), ("heading", "f4"), ("pad", "f4")], align=True))
        doubles = np.zeros((n, 5))
        for name, values in (("shape", shape), ("x", x), ("y", y), ("heading", heading)):
            table[name] = values
        doubles[:, 4], doubles[:, 1], doubles[:, 2] = x, y, heading
        tall = bch.ShapeSet.from_polygons(SQUARES, plan=bch.Plan(depths=(0, bch.ALL_DEPTHS), heights=True))
        ones, zero = np.ones(n, np.int64), np.zeros(1)
        for agents in (
            bch.Agents(table["shape"], table["x"], table["y"], table["heading"]),
            bch.Agents(shape, doubles[:, 4], doubles[:, 1], doubles[:, 2]),
            bch.Agents(shape.astype(np.int8), doubles[:, 4], y, heading, ones, 0 * ones),
            bch.Agents(shape.tolist(), x.tolist(), y.tolist(), heading.tolist()),
            bch.Agents(shape[::-1][::-1], x[::-1][::-1], y, heading, z=np.broadcast_to(zero, n)),
        ):
            np.testing.assert_array_equal(bch.Crowd().collisions(tall, agents), found)
        directions = np.zeros((n, 3), np.float32)
        directions[:, 1], directions[:, 2] = np.cos(heading), np.sin(heading)
        np.testing.assert_array_equal(bch.Crowd().collisions(SHAPES, bch.Agents(table["shape"], table["x"], table["y"], directions[:, 1:])), found)
        viewed = bch.Agents(table["shape"], table["x"], table["y"], table["heading"])
        table["x"] += 100 * np.arange(n)
        self.assertEqual(len(bch.Crowd().collisions(SHAPES, viewed)), 0)


class Crowds(unittest.TestCase):
    def test_candidates(self):
        self.assertEqual(bch.Crowd().candidates(SHAPES, LINE).tolist(), [[0, 1]])
        self.assertEqual(bch.Crowd().candidates(SHAPES, LINE, margin=1.0).tolist(), [[0, 1], [1, 2]])
        self.assertEqual(bch.Crowd(max_pairs=1).candidates(SHAPES, LINE).tolist(), [[0, 1]])
        with self.assertRaisesRegex(OverflowError, "at most 0 pairs"):
            bch.Crowd(max_pairs=0).candidates(SHAPES, LINE)

    def test_collisions(self):
        crowd = bch.Crowd()
        self.assertEqual(crowd.collisions(SHAPES, LINE).tolist(), [[0, 1]])
        rows = crowd.by_agent()
        self.assertEqual([row.tolist() for row in rows], [[1], [0], []])
        self.assertEqual((len(rows), rows.counts.tolist(), rows[-2].tolist(), rows.pairs.tolist()), (3, [1, 1, 0], [0], [0, 0]))
        self.assertEqual([row.tolist() for row in crowd.obstacles(SHAPES, LINE, WALL)], [[], [], [0]])
        self.assertEqual(len(crowd.collisions(*two(1.001)[:2], leaves="discs")), 1)

    def test_filters_and_periods(self):
        mask = np.array([1, 2, 3], np.uint32)
        self.assertEqual(len(bch.Crowd().collisions(SHAPES, LINE, mask=mask)), 0)
        self.assertEqual(len(bch.Crowd().collisions(SHAPES, LINE, category=mask, mask=np.array([3, 1, 3], np.uint32))), 1)
        self.assertEqual(len(bch.Crowd().collisions(SHAPES, LINE, excluded=np.array([[1, 0]], np.uint32))), 0)
        apart = two(99.5)[:2]
        self.assertEqual(len(bch.Crowd().collisions(*apart)), 0)
        self.assertEqual(bch.Crowd(period=(100, 0)).collisions(*apart).tolist(), [[0, 1]])

    def test_measures(self):
        near = bch.Crowd().clearances(SHAPES, LINE, 1.2)
        alone = bch.nearest(SHAPES, LINE, near.pairs, max_distance=1.2)
        self.assertEqual(near.pairs.tolist(), [[0, 1], [1, 2]])
        for name in alone._fields:
            np.testing.assert_array_equal(getattr(near, name), getattr(alone, name))
        apart = bch.Crowd().penetrations(SHAPES, LINE, 8)
        np.testing.assert_array_equal(apart.penetrations, bch.penetration(SHAPES, LINE, apart.pairs, 8))

    def test_contacts(self):
        found = bch.Crowd().contacts(SHAPES, LINE, leaves="discs")
        self.assertEqual((found.pairs.tolist(), len(found.discs)), ([[0, 1]], 1))
        discs = SHAPES.discs(0)
        first, second = discs[found.discs[0][:, 0]], discs[found.discs[0][:, 1]]
        distance = np.hypot(first["x"] - 0.9 + second["y"], first["y"] - second["x"])  # the second one is turned
        self.assertTrue((distance <= first["radius"] + second["radius"] + 1e-5).all())
        of_pairs = bch.Crowd().contacts(SHAPES, LINE, PAIRS, leaves="discs")
        self.assertEqual(of_pairs.discs.counts.tolist(), [len(found.discs[0]), 0, 0])

    def test_obstacles(self):
        of, exact = (SHAPES, LINE, WALL), dict(leaves="segments")
        self.assertEqual(bch.collide(*of).tolist(), [False, False, True])
        self.assertEqual(bch.within(*of, 2, **exact).tolist(), [False, True, True])
        for found in (bch.clearance(*of, **exact), bch.nearest(*of, **exact).distance):
            np.testing.assert_allclose(found, [2.5, 1.6, 0], atol=1e-5)
        depths = bch.penetration(*of)
        np.testing.assert_allclose(depths["depth"], [0, 0, 0.5], atol=0.03)
        times = bch.time_of_impact(*of, np.array([5.0, 1, 0]), np.zeros(3))
        np.testing.assert_allclose(times, [0.5, np.inf, 0], atol=0.02)
        corners = np.array([3.0, 3, -9, 9, 9, -9]), np.array([-1.0, 1, -9, -9, 9, 9])
        same = bch.Obstacles(*corners, np.array([0, 2, 6], np.uint64), is_area=np.array([0, 1], np.uint8))
        self.assertEqual((len(same), same.segment_count, same.owner(1)), (2, 5, 1))
        self.assertTrue(bch.collide(SHAPES, LINE, same).all())

class Scenes(unittest.TestCase):
    def test_characters_of_arrays(self):
        move = lambda *values: bch.Channel(1, positions=bch.Curve([0, 1], *values))
        turned = bch.Curve([0, 1], [(0, 0, 0, 1), (0, 0, 0.5**0.5, 0.5**0.5)])
        made = bch.make_character(
            [(0, 0, 0), (100, 0, 0), (0, 200, 100)],
            [(0, 1, 2)],
            name="post",
            joints=[bch.Joint("foot"), bch.Joint("knee", 0, np.eye(4)[:3])],
            bones=[bch.Bone(0), bch.Bone(1, np.eye(4))],
            vertex_bones=[(1, 0)] * 3,
            weights=[(1, 0), (1, 0), (0.5, 0.5)],
            motions=[
                bch.Motion("slide", 1.0, [move([(0, 0, 0), (200, 0, 0)])]),
                bch.Motion("swing", 1.0, [move([(0, 0, 0), (0, 0, 0)], "cubic", [[(0, 0, 0), (800, 0, 0)], [(0, 0, 0)] * 2])]),
                bch.Motion("turn", 1.0, [bch.Channel(1, rotations=turned)]),
                bch.Motion("grow", 1.0, [bch.Channel(1, scales=bch.Curve([0, 0.5], [(1, 1, 1), (3, 1, 1)], "step"))]),
            ],
            root_joint=0,
            to_ground=np.diag([0.01, 0.01, 0.01, 1]),
        )
        self.assertEqual((made.name, made.joints, made.triangles, made.clips[2]), ("post", 2, 1, bch.Clip("turn", 1.0)))
        shapes = bch.bake(made, [(bch.REST_POSE, 0), (0, 0.5), (1, 0.5), (2, 1.0), (3, 0.4), (3, 0.6)])
        expected = [
            [(0, 0), (1, 0), (0, 2)],
            [(1, 0), (2, 0), (0.5, 2)],  # the last one follows the knee by half
            [(1, 0), (2, 0), (0.5, 2)],
            [(0, 0), (0, 1), (-1, 1)],
            [(0, 0), (1, 0), (0, 2)],
            [(0, 0), (3, 0), (0, 2)],
        ]
        for shape, corners in enumerate(expected):
            (contour,) = shapes.outline(shape)
            np.testing.assert_allclose(sorted(contour.round(4).tolist()), sorted(corners), atol=1e-4, err_msg=str(shape))

    def test_bodies(self):
        """A snowman beside another one, on the first one's head, and above it."""
        snowman = [[0, 0, 0.5, 0.5], [0, 0, 1.25, 0.35], [0, 0, 1.75, 0.25]]
        bodies = bch.BodySet([snowman, snowman[:1]])
        self.assertEqual((len(bodies), len(bodies.spheres(0)), len(bodies.spheres(1))), (2, 3, 1))
        np.testing.assert_allclose(bodies.spheres(1).tolist()[0], snowman[0], atol=1e-5)
        agents = bch.Agents(np.array([0, 0, 1, 1], np.uint32), np.array([0.0, 0.9, 0, 0]), np.zeros(4), np.zeros(4), z=np.array([0, 0, 1.9, 2.1]))
        pairs = np.array([[0, 1], [0, 2], [0, 3], [1, 2]], np.uint32)
        for name in bch.implementations():
            self.assertEqual(bch.collide(bodies, agents, pairs, implementation=name).tolist(), [True, True, False, False])
            near = bch.within(bodies, agents, pairs, 0.101, implementation=name)
            self.assertEqual(near.tolist(), [True, True, True, False])
            gaps = bch.clearance(bodies, agents, pairs, implementation=name)
            np.testing.assert_allclose(gaps, [0, 0, 0.1, np.hypot(0.9, 0.65) - 0.75], atol=1e-4)
            moved = (np.zeros(4), np.zeros(4))
            self.assertEqual(bch.time_of_impact(bodies, agents, pairs, *moved, implementation=name).tolist(), [0, 0, np.inf, np.inf])
            times = bch.time_of_impact(bodies, agents, pairs, *moved, dz=np.array([0, 0, 0.4, -1.0]), implementation=name)
            np.testing.assert_allclose(times, [0, 0, 0.25, np.inf], atol=1e-4)
        with self.assertRaisesRegex(bch.ArrayError, "dz is given; expected a bch.BodySet"):
            bch.time_of_impact(SHAPES, LINE, PAIRS, np.zeros(3), np.zeros(3), dz=np.zeros(3))
        nearest = bch.nearest(bodies, agents, pairs, max_distance=0.2, overlap="deepest")
        np.testing.assert_allclose(nearest.distance[:3], [-0.1, -0.1, 0.1], atol=1e-4)
        np.testing.assert_allclose(nearest.direction[1:3], [[0, 0, 1]] * 2, atol=1e-6)
        self.assertEqual(nearest.discs[1:].tolist(), [[2, 0], [2, 0], [2**32 - 1] * 2])
        np.testing.assert_allclose(nearest.points[2], [[0, 0, 2], [0, 0, 0]], atol=1e-4)
        crowd = bch.Crowd()
        apart = crowd.clearances(bodies, agents, 0.15, overlap="deepest")
        of_pair = {tuple(pair): i for i, pair in enumerate(apart.pairs.tolist())}
        self.assertEqual(set(of_pair), {(0, 1), (0, 2), (0, 3), (2, 3)})
        kept = of_pair[(0, 3)]
        self.assertEqual([len(row) for row in crowd.nearest(2)], [2, 1, 2, 2])
        self.assertEqual(crowd.nearest(1)[3].tolist(), [2])
        # Agents 0, 2 and 3 stand at one place, so their bodies touch without a move on the ground, and only 0 and 1 say more.
        weight = {tuple(pair): (max(gap, 0) + 0.1) ** -2 for pair, gap in zip(apart.pairs.tolist(), apart.distance.tolist())}
        radii = crowd.disc_radii(agents, 0.3)
        np.testing.assert_allclose(radii[1], (0.9 + 0.1) / 2, atol=1e-4)
        np.testing.assert_allclose(radii[0], (1.0 * weight[0, 1] + 0.1 * weight[0, 2]) / 2 / sum(weight[0, i] for i in (1, 2, 3)), atol=1e-4)
        with self.assertRaisesRegex(ValueError, "disc_radii: expected the 4 agents of the clearances, found 3"):
            crowd.disc_radii(LINE)
        for name in ("distance", "direction", "discs", "points"):
            np.testing.assert_array_equal(getattr(apart, name)[kept], getattr(nearest, name)[2])
        found = {tuple(pair) for pair in crowd.collisions(bodies, agents).tolist()}
        self.assertEqual(found, {(0, 1), (0, 2), (2, 3)})
        self.assertEqual(crowd.by_agent()[0].tolist(), [1, 2])
        self.assertRaisesRegex(ValueError, "expected clearances as its last answer", crowd.nearest, 2)
        self.assertRaisesRegex(ValueError, "expected clearances as its last answer", crowd.disc_radii, agents)
        mask = np.array([1, 1, 2, 2], np.uint32)
        self.assertEqual(len(crowd.collisions(bodies, agents, mask=mask)), 1)
        with self.assertRaisesRegex(bch.ArgumentError, "body 0: expected finite spheres"):
            bch.BodySet([[[0, 0, 0, -1]]])
        parted = bch.penetration(bodies, agents, pairs)
        touches = np.empty(len(pairs), bch.TOUCH)
        free = bch.nearest_free(bodies, agents, pairs, touches=touches)
        np.testing.assert_allclose(np.linalg.norm(touches["normal"], axis=1), free["depth"] > 0, atol=1e-6)
        np.testing.assert_array_equal(free["depth"] > 0, bch.collide(bodies, agents, pairs) == 1)
        self.assertTrue((free["depth"] <= parted["depth"] + 1e-5).all())
        np.testing.assert_allclose(parted["depth"], [0.1, 1, 0, 0.1], atol=1e-4)
        np.testing.assert_array_equal(bch.penetration(bodies, agents, pairs, np.tile(np.float32([-2, 0]), (4, 1)))["depth"][:1], parted["depth"][:1])
        contacts = crowd.contacts(bodies, agents)
        row = contacts.discs[contacts.pairs.tolist().index([0, 2])]
        self.assertEqual(row["spheres"].tolist(), [[2, 0]])
        np.testing.assert_allclose([*row["point"][0], *row["normal"][0], row["depth"][0]], [0, 0, 2, 0, 0, 1, 0.1], atol=1e-4)
        given = crowd.contacts(bodies, agents, pairs)
        self.assertEqual(given.discs.counts.tolist(), [1, 1, 0, 0])
        pushed = crowd.penetrations(bodies, agents)
        self.assertEqual(pushed.pairs.tolist(), contacts.pairs.tolist())
        found = crowd.resolve(bodies, agents, mobility=np.array([0.0] + [1.0] * (len(agents) - 1)), largest_step=0.5)
        self.assertEqual((found.left.tolist(), found.agents_at_walls.tolist(), found.x[0]), ([], [], agents.x[0]))
        self.assertEqual(len(crowd.collisions(bodies, bch.Agents(agents.shape, found.x, found.y, agents.heading, z=agents.z))), 0)
        self.assertEqual(crowd.resolve(bodies, agents, sweeps=0).left.tolist(), contacts.pairs.tolist())
        self.assertEqual(found.turn.tolist(), [0] * len(agents))
        apart = bch.Agents(np.array([0, 0], np.uint32), np.array([0.0, 0.9]), np.array([0.0, 0.3]), np.zeros(2))
        turned = crowd.resolve(bodies, apart, largest_turn=0.3)
        self.assertEqual(len(turned.left), 0)
        self.assertGreater(np.abs(turned.turn).max(), 0.01)
        self.assertLessEqual(np.abs(turned.turn).max(), 0.3)
        np.testing.assert_array_equal(pushed.penetrations["depth"][:1], bch.penetration(bodies, agents, pushed.pairs)["depth"][:1])

    def test_bodies_and_obstacles(self):
        """A ball in front of a low wall."""
        bodies, wall = bch.BodySet([[[0, 0, 0.5, 0.5]]]), "LINESTRING (0.4 -1, 0.4 1)"
        agents = bch.Agents(np.zeros(2, np.uint32), np.array([0.0, -0.1]), np.zeros(2), np.zeros(2))
        high, low = (bch.Obstacles.from_wkt(wall, heights=(0, top)) for top in (0.3, 0.1))
        self.assertEqual(bch.collide(bodies, agents, high).tolist(), [True, False])
        self.assertEqual(bch.collide(bodies, agents, low).tolist(), [False, False])
        self.assertEqual(bch.within(bodies, agents, low, 0.07).tolist(), [True, False])
        gap = np.hypot(0.4, 0.4) - 0.5
        np.testing.assert_allclose(bch.clearance(bodies, agents, low)[0], gap, atol=1e-4)
        nearest = bch.nearest(bodies, agents, low)
        np.testing.assert_allclose(nearest.points[0][1], [0.4, 0, 0.1], atol=1e-4)
        self.assertEqual([row.tolist() for row in bch.Crowd().obstacles(bodies, agents, high)], [[0], []])
        with self.assertRaisesRegex(bch.ArrayError, "pairs"):
            bch.penetration(bodies, agents, high)

    def test_live_bodies(self):
        man = bch.default_male()
        model = bch.BodyModel(man, 64, draft=True)
        self.assertTrue(50 < len(model) <= 64)
        people = bch.LiveBodies([model], np.zeros(2, np.uint32))
        resting = people.bodies.spheres(0)
        self.assertTrue(resting["z"].max() > 1.6 and np.array_equal(resting, people.bodies.spheres(1)))
        poses = [(0, 0.5), (1, 2.0)]
        people.pose(poses)
        by_clips = [people.bodies.spheres(body) for body in range(2)]
        self.assertFalse(np.array_equal(*by_clips))
        for threads in (1, 2):
            people.pose(bch.Transforms(man.transforms(poses), space="parent"), threads=threads)
            self.assertTrue(all(np.array_equal(people.bodies.spheres(body), by_clips[body]) for body in range(2)))
        near, far = np.array([0.0, 0.2]), np.array([0.0, 2.5])
        for x, hit in ((near, True), (far, False)):
            agents = bch.Agents(np.array([0, 1], np.uint32), x, np.zeros(2), np.zeros(2))
            self.assertEqual(len(bch.Crowd().collisions(people.bodies, agents)), hit)
        with self.assertRaises(bch.ArrayError):
            people.pose(poses[:1])
        with self.assertRaisesRegex(bch.ArgumentError, "body 0: .*vertices"):
            people.pose(bch.Vertices(np.zeros((2, 3, 3), np.float32)))
        with self.assertRaisesRegex(bch.ArgumentError, "model 1 |1 models, found 1 of body 1"):
            bch.LiveBodies(model, np.array([0, 1], np.uint32))

    def test_models_of_the_library(self):
        man, woman = bch.default_body(bch.default_male(), 64), bch.default_body(bch.default_female(), 128)
        self.assertTrue(62 <= len(man) <= 64 and 124 <= len(woman) <= 128)
        with self.assertRaisesRegex(bch.ArgumentError, "expected 64, 128, 256 or 512 spheres, found 65"):
            bch.default_body(bch.default_male(), 65)
        with self.assertRaisesRegex(bch.ArgumentError, "whose model make_body.. makes"):
            bch.default_body(bch.default_bulky_male())
        with tempfile.TemporaryDirectory() as folder:
            bch.save_models(f"{folder}/people.bch", [man, woman])
            again = bch.load_models(f"{folder}/people.bch")
            self.assertEqual([len(model) for model in again], [len(man), len(woman)])
            self.assertEqual(len(bch.ShapeSet.load(f"{folder}/people.bch")), 0)
            bch.ShapeSet.from_polygons([[[(0, 0), (1, 0), (0, 1)]]]).save(f"{folder}/shape.bch")
            self.assertEqual(bch.load_models(f"{folder}/shape.bch"), [])
        for models in ([man, woman], again):
            baked = bch.bake(models, poses=5)
            self.assertEqual((type(baked), len(baked)), (bch.BodySet, 10))
            same = bch.bake(models, [m.sample_poses(5) for m in (bch.default_male(), bch.default_female())])
            self.assertTrue(all(np.array_equal(baked.spheres(i), same.spheres(i)) for i in range(10)))
        world = bch.Transforms(bch.default_male().transforms([(3, 0.5)], space="world"), "world")
        self.assertTrue(np.array_equal(bch.bake(man, world).spheres(0), bch.bake(man, [(3, 0.5)]).spheres(0)))
        for wrong in ({"plan": bch.Plan()}, {"path": "a.bch"}):
            with self.assertRaisesRegex(bch.ArgumentError, "are for shapes"):
                bch.bake(man, **wrong)
        with self.assertRaisesRegex(bch.ArgumentError, "those of 1 models, and there are 2"):
            bch.bake([man, woman], [[(0, 0.5)]])

    def test_plans(self):
        plan = bch.plan_scene(
            [(0, 0.1), (0, 0.4), (0, 0.6), (0, 0.6)],
            character=np.array([0, 0, 1, 0], np.uint32),
            depth=np.array([0, bch.ALL_DEPTHS, 0, 0], np.uint32),
            heights=True,
            pose_step=0.5,
            pairs_per_shape=20,
        )
        self.assertTrue(plan.plan.heights)
        self.assertEqual(plan.shape.tolist(), [0, 0, 1, 2])
        depth = [plan.plan.depths[level] for level in plan.level]
        self.assertEqual(depth, [0, bch.ALL_DEPTHS, 0, 0])
        made = plan.build([bch.default_male(), bch.default_female()])
        origins = [made.origin(shape) for shape in range(3)]
        self.assertEqual([origin.character for origin in origins], ["default:male", "default:female", "default:male"])
        self.assertEqual([origin.seconds for origin in origins], [0, 0.5, 0.5])

def frame():
    """Four bars with a hole between them."""
    vertices, triangles = [], []
    for x0, y0, x1, y1 in ((0, 0, 4, 1), (0, 3, 4, 4), (0, 0, 1, 4), (3, 0, 4, 4)):
        n = len(vertices)
        vertices += [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
        triangles += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
    return np.array(vertices, np.float32), np.array(triangles)

class Outlines(unittest.TestCase):
    outer = [[0, 0], [4, 0], [4, 4], [0, 4]]
    inner = [[1, 1], [1, 3], [3, 3], [3, 1]]

    def test_holes(self):
        vertices, triangles = frame()
        found = bch.outline(vertices, triangles, holes=True)
        self.assertEqual([contour.tolist() for contour in found.contours], [self.outer, self.inner])
        self.assertEqual(found.wkt, "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1)))")
        rings = [[*ring, ring[0]] for ring in (self.outer, self.inner)]
        self.assertEqual(found.__geo_interface__, {"type": "MultiPolygon", "coordinates": [rings]})
        self.assertEqual(json.loads(found.geojson), found.__geo_interface__)
        self.assertEqual([c.tolist() for c in bch.outline(vertices, triangles).contours], [self.outer])

    def test_batch_and_heights(self):
        vertices, triangles = frame()
        batch = np.stack([vertices, 2 * vertices, vertices + np.float32([0, 0, 1])])
        found = bch.outline(batch, triangles, threads=2)
        self.assertEqual(len(found), 3)
        np.testing.assert_array_equal(found[1].contours[0], 2 * np.array(self.outer))
        low = bch.outline(batch, triangles, heights=(-0.5, 0.5))
        self.assertEqual([len(each.contours) for each in low], [1, 1, 0])
        self.assertEqual(low[2].wkt, "MULTIPOLYGON EMPTY")

    def test_characters(self):
        man = bch.default_male()
        poses = man.sample_poses(3)
        found = bch.outline(man, poses=poses)
        shape_builder = bch.ShapeBuilder(man)
        for pose, each in zip(poses, found):
            expected = shape_builder.outline(int(pose["clip"]), float(pose["seconds"]))
            self.assertTrue(all(np.array_equal(a, b) for a, b in zip(each.contours, expected, strict=True)))
        alone = bch.outline(man, poses=(int(poses[0]["clip"]), float(poses[0]["seconds"])))
        np.testing.assert_array_equal(alone.contours[0], found[0].contours[0])
        np.testing.assert_array_equal(bch.outline(man).contours[0], shape_builder.outline()[0])
        walls = bch.Obstacles.from_wkt(alone.wkt)
        self.assertEqual(walls.segment_count, sum(map(len, alone.contours)))

    def test_errors(self):
        vertices, triangles = frame()
        with self.assertRaisesRegex(bch.RangeError, "no indices"):
            bch.outline(vertices, triangles - 1)
        with self.assertRaisesRegex(bch.ArgumentError, "pose 0: outline: triangle|triangle 0 names vertex 99"):
            bch.outline(vertices, triangles + 99)
        with self.assertRaisesRegex(bch.ArrayError, r"expected \(n, 3\)"):
            bch.outline(vertices[:, :2], triangles)
        with self.assertRaisesRegex(bch.ArgumentError, "between 1 and 0 m there is nothing"):
            bch.outline(vertices, triangles, heights=(1, 0))
        with self.assertRaisesRegex(bch.ArrayError, "a bch.Character has its own"):
            bch.outline(bch.default_male(), triangles)

if __name__ == "__main__":
    unittest.main()
