# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Outlines of meshes and characters, as arrays, text and mappings."""

import json
import unittest

import bch
import numpy as np


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
        shaper = bch.PoseShaper(man)
        for pose, each in zip(poses, found):
            expected = shaper.outline(int(pose["clip"]), float(pose["seconds"]))
            self.assertTrue(all(np.array_equal(a, b) for a, b in zip(each.contours, expected, strict=True)))
        alone = bch.outline(man, poses=(int(poses[0]["clip"]), float(poses[0]["seconds"])))
        np.testing.assert_array_equal(alone.contours[0], found[0].contours[0])
        np.testing.assert_array_equal(bch.outline(man).contours[0], shaper.outline()[0])
        walls = bch.Obstacles.from_wkt(alone.wkt)
        self.assertEqual(walls.segment_count, sum(map(len, alone.contours)))

    def test_errors(self):
        vertices, triangles = frame()
        with self.assertRaisesRegex(bch.RangeError, "no indices"):
            bch.outline(vertices, triangles - 1)
        with self.assertRaisesRegex(bch.ArgumentError, "pose 0: outline: triangle|triangle 0 names vertex 99"):
            bch.outline(vertices, triangles + 99)
        with self.assertRaisesRegex(bch.ArrayError, r"wanted is \(n, 3\)"):
            bch.outline(vertices[:, :2], triangles)
        with self.assertRaisesRegex(bch.ArgumentError, "between 1 and 0 m there is nothing"):
            bch.outline(vertices, triangles, heights=(1, 0))
        with self.assertRaisesRegex(bch.ArrayError, "a bch.Character has its own"):
            bch.outline(bch.default_male(), triangles)


if __name__ == "__main__":
    unittest.main()
