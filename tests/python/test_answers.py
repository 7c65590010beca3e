# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""What the package answers is what the C++ library does, bit by bit. BCH_EXPECTED: the program that writes that."""

import os
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import bch
import numpy as np

WALLS = "LINESTRING(-40 0, 40 1) POLYGON((-9 -9, 9 -9, 9 9, -9 9))"


class Answers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        subprocess.run([os.environ["BCH_EXPECTED"], cls.folder.name], check=True)
        cls.shapes = bch.ShapeSet.load(Path(cls.folder.name) / "set.bch")
        read = cls.read
        cls.agents = bch.Agents(
            read("shape", "u4"), read("x", "f8"), read("y", "f8"), read("heading", "f8"), read("level", "u1")
        )
        cls.pairs = read("pairs", "u4", 2)
        cls.walls = bch.Obstacles.from_wkt(WALLS)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def read(cls, name, dtype, *shape):
        array = np.fromfile(Path(cls.folder.name) / name, dtype)
        return array.reshape(-1, *shape) if shape else array

    def expect(self, found, name, *shape):
        """Compares bits, so that a NaN or a sign of 0 is seen."""
        expected = self.read(name, found.dtype, *shape)
        self.assertEqual(found.shape, expected.shape, name)
        self.assertEqual(found.tobytes(), expected.tobytes(), name)

    def expect_depths(self, found, name):
        expected = self.read(name, "f8", 3)
        for i, part in enumerate(("depth", "x", "y")):
            np.testing.assert_array_equal(found[part].astype("f8"), expected[:, i], name)

    def test_pairs(self):
        of = (self.shapes, self.agents, self.pairs)
        self.expect(bch.candidate_pairs(self.shapes, self.agents, margin=0.4), "pairs", 2)
        for threads in (0, 1, 2):
            with self.subTest(threads=threads):
                self.expect(bch.collide(*of, threads=threads), "collide")
                self.expect(bch.collide(*of, semantics="solid", leaves="discs", threads=threads), "collide_solid_discs")
                self.expect(bch.within(*of, 0.2, threads=threads), "within")
                self.expect(bch.within(*of, np.full(len(self.pairs), 0.2), threads=threads), "within")
                deepest = bch.clearance(*of, max_distance=0.3, overlap="deepest", threads=threads)
                self.expect(deepest, "clearance_deepest")
                self.expect(bch.clearance(*of, leaves="segments", threads=threads), "clearance")
                nearest = bch.nearest(*of, leaves="segments", threads=threads)
                self.expect(nearest.distance, "clearance")
                self.expect(nearest.direction, "direction", 2)
                self.expect(nearest.discs, "discs", 2)
                self.expect(nearest.points, "points", 2, 2)
                self.expect_depths(bch.penetration(*of, threads=threads), "penetration")
                directions = self.read("directions", "f4", 2)
                self.expect_depths(bch.penetration(*of, directions, threads=threads), "penetration_along")
                ways = self.read("way_x", "f8"), self.read("way_y", "f8")
                self.expect(bch.time_of_impact(*of, *ways, threads=threads), "time_of_impact")
        self.assertGreater(bch.collide(*of).mean(), 0.05)

    def test_implementations(self):
        for name in bch.implementations():
            self.expect(bch.collide(self.shapes, self.agents, self.pairs, implementation=name), "collide")

    def test_crowds(self):
        collider = bch.CrowdCollider()
        rows, touched = collider.collide_all(self.shapes, self.agents, self.walls, semantics="solid")
        for found in (rows, bch.collide_all(self.shapes, self.agents, semantics="solid")):
            self.expect(found.offsets, "neighbour_offsets")
            self.expect(found.values, "neighbours")
        self.expect(touched.offsets, "touched_offsets")
        self.expect(touched.values, "touched")
        np.testing.assert_array_equal(rows[7], rows.values[rows.offsets[7] : rows.offsets[8]])
        np.testing.assert_array_equal(rows[-1], rows[len(rows) - 1])
        np.testing.assert_array_equal(rows.counts, [len(row) for row in rows])
        self.assertEqual(len(rows), len(self.agents))
        contacts = bch.contacts(self.shapes, self.agents)
        self.expect(contacts.pairs, "contact_pairs", 2)
        self.expect(contacts.discs.offsets, "contact_offsets")
        self.expect(contacts.discs.values, "contacts", 2)
        of_pairs = bch.contacts(self.shapes, self.agents, contacts.pairs)
        np.testing.assert_array_equal(of_pairs.discs.values, contacts.discs.values)

    def test_obstacles(self):
        of = (self.shapes, self.agents, self.walls)
        n = len(self.agents)
        self.expect(bch.collide(*of), "wall_collide")
        self.expect(bch.within(*of, 0.25), "wall_within")
        self.expect(bch.clearance(*of), "wall_clearance")
        self.expect(bch.nearest(*of).distance, "wall_clearance")
        self.expect_depths(bch.penetration(*of), "wall_penetration")
        self.expect(bch.time_of_impact(*of, np.full(n, 1.5), np.full(n, -0.5)), "wall_time_of_impact")
        same = bch.Obstacles(
            np.array([-40.0, 40, -9, 9, 9, -9]),
            np.array([0.0, 1, -9, -9, 9, 9]),
            np.array([0, 2, 6], np.uint64),
            is_area=np.array([0, 1], np.uint8),
        )
        self.assertEqual((len(same), same.segment_count, same.owner(3)), (2, 5, 1))
        self.expect(bch.collide(self.shapes, self.agents, same), "wall_collide")

    def expect_set(self, found, name):
        expected = bch.ShapeSet.load(Path(self.folder.name) / name)
        self.assertEqual((len(found), found.depths, found.slices), (len(expected), expected.depths, expected.slices))
        for shape in range(len(found)):
            for level in range(len(found.depths)):
                np.testing.assert_array_equal(found.discs(shape, level), expected.discs(shape, level))
            for one, other in zip(found.outline(shape), expected.outline(shape)):
                np.testing.assert_array_equal(one, other)

    def test_characters_of_arrays(self):
        up = np.eye(4)[:3]
        up[2, 3] = 1
        down = up.copy()
        down[2, 3] = -1
        bend = bch.Channel(
            1,
            positions=bch.Curve([0, 1], [(0, 0, 1), (0, 0.5, 1)], "cubic", [[(0, 0, 0), (1, 0, 0)], [(0, 1, 0), (0, 0, 0)]]),
            rotations=bch.Curve([0, 1], [(0, 0, 0, 1), (0, 0.6, 0, 0.8)]),
            scales=bch.Curve([0, 0.5], [(1, 1, 1), (1, 2, 1)], "step"),
        )
        post = bch.make_character(
            [(-0.25, 0, 0), (0.25, 0, 0), (0.25, 0.125, 1), (-0.25, 0.125, 1), (0, 0.25, 2)],
            [(0, 1, 2), (0, 2, 3), (3, 2, 4)],
            name="post",
            joints=[bch.Joint("foot"), bch.Joint("knee", 0, up)],
            bones=[bch.Bone(0), bch.Bone(1, down)],
            vertex_bones=[(0, 1)] * 5,
            weights=[(1, 0), (1, 0), (0.5, 0.5), (0.25, 0.75), (0, 1)],
            motions=[bch.Motion("bend", 1.0, [bend])],
            root_joint=0,
        )
        self.assertEqual((post.name, post.joints, post.clips), ("post", 2, [bch.Clip("bend", 1.0)]))
        self.expect_set(bch.bake(post, [(bch.REST_POSE, 0), (0, 0.25), (0, 0.75)]), "posts.bch")

    def test_scenes(self):
        i = np.arange(100)
        poses = np.empty(100, bch.POSE)
        poses["clip"], poses["seconds"] = i % 3, 0.25 * (i % 7)
        plan = bch.plan_scene(
            poses,
            character=(i % 2).astype(np.uint32),
            distance=0.3 * i,
            depth=bch.depth_at_density(0.05 * i),
            slices=bch.standing_slices(3),
            whole_from=20,
            pose_step=0.5,
            pairs_per_shape=20,
        )
        self.expect(plan.shape, "agent_shape")
        self.expect(plan.level, "agent_level")
        people = [bch.default_male(), bch.default_female()]
        made = plan.build(people)
        self.expect_set(made, "scene.bch")
        self.assertEqual({made.origin(k).character for k in range(len(made))}, {"default:male", "default:female"})
        best = bch.best_slices(people, self.read("planes", "f4"), 3, poses=5)
        self.expect(np.array(best, "f4"), "best_slices")

    def test_arrays_of_the_caller(self):
        """Results go into `out` itself, and agents that move are seen."""
        n = len(self.pairs)
        out = np.empty(n, bool)
        self.assertIs(bch.collide(self.shapes, self.agents, self.pairs, out=out), out)
        self.expect(out, "collide")
        nearest = bch.Nearest(
            np.empty(n, "f4"), np.empty((n, 2), "f4"), np.empty((n, 2), "u4"), np.empty((n, 2, 2), "f4")
        )
        found = bch.nearest(self.shapes, self.agents, self.pairs, leaves="segments", out=nearest)
        self.assertIs(found.points, nearest.points)
        self.expect(nearest.points, "points", 2, 2)
        x = self.agents.x.copy()
        moving = bch.Agents(self.agents.shape, x, self.agents.y, self.agents.heading, self.agents.level)
        x += 1e6 * np.arange(len(x))
        self.assertFalse(bch.collide(self.shapes, moving, self.pairs).any())
        self.expect(bch.BroadPhase().find(self.shapes, self.agents, 0.4), "pairs", 2)

    def test_threads(self):
        failures = []

        def ask():
            for _ in range(20):
                hits = bch.collide(self.shapes, self.agents, self.pairs, threads=1)
                if hits.tobytes() != self.read("collide", "u1").tobytes():
                    failures.append("another answer")

        asking = [threading.Thread(target=ask) for _ in range(4)]
        for thread in asking:
            thread.start()
        for thread in asking:
            thread.join()
        self.assertEqual(failures, [])


if __name__ == "__main__":
    unittest.main()
