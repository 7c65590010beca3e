# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Manners of the package: errors, sets and characters, interrupts, memory, documentation."""

import ctypes
import gc
import inspect
import os
import pty
import signal
import subprocess
import sys
import tempfile
import pickle
import textwrap
import threading
import time
import tracemalloc
import unittest
from pathlib import Path
from unittest import mock

import bch
import numpy as np

def squares(n=2):
    """A set of squares of 1, 2 ... metres, and n agents on a line."""
    bodies = [[[(-k, -k), (k, -k), (k, k), (-k, k)]] for k in (0.5, 1.0)]
    shapes = bch.ShapeSet.from_polygons(bodies, plan=bch.Plan(heights=True), heights=[(0.0, 1.0), (0.0, 2.0)])
    agents = bch.Agents(np.zeros(n, np.uint32), 0.9 * np.arange(n), np.zeros(n), np.zeros(n))
    return shapes, agents

class Errors(unittest.TestCase):
    def setUp(self):
        self.shapes, self.agents = squares()
        self.pairs = np.array([[0, 1]], np.uint32)

    def expect(self, kind, words, call, *arguments, **named):
        with self.assertRaises(kind) as caught:
            call(*arguments, **named)
        self.assertIsInstance(caught.exception, bch.Error)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_arrays(self):
        collide = lambda pairs, **more: bch.collide(self.shapes, self.agents, pairs, **more)
        for wrong, words in (
            (self.pairs.astype(np.int64), ["pairs is an array of int64", "(1, 2)", "uint32", "(n, 2)"]),
            (np.zeros((4, 3), np.uint32), ["(4, 3)"]),
            (np.zeros((4, 4), np.uint32)[:, ::2], ["not contiguous"]),
            (np.ma.masked_array(self.pairs, mask=True), ["masked"]),
            (np.frombuffer(bytes(9), np.uint32, 2, 1).reshape(1, 2), ["not aligned"]),
            ([[0, 1]], ["a list"]),
        ):
            self.expect(TypeError, words, collide, wrong)
        self.expect(TypeError, ["out is an array of uint8"], collide, self.pairs, out=np.empty(1, np.uint8))
        read_only = np.empty(1, bool)
        read_only.flags.writeable = False
        self.expect(TypeError, ["out is read-only"], collide, self.pairs, out=read_only)
        x = np.zeros(2)
        self.expect(TypeError, ["heading", "float32"], bch.Agents, self.agents.shape, x, x, x.astype(np.float32))
        self.expect(TypeError, ["y", "(3,)", "(2,)"], bch.Agents, self.agents.shape, x, np.zeros(3), x)
        for shape, words in (([0.5, 1], "integers with shape (n,)"), ([0, -1], "shape[1] is -1; expected an index from 0 to 4294967295"), ([2**32, 0], "shape[0] is 4294967296")):
            self.expect((TypeError, IndexError), [words], bch.Agents, shape, x, x, x)
        self.expect(IndexError, ["level[0] is 256; expected an index from 0 to 255"], bch.Agents, [0, 0], x, x, x, [256, 0])
        self.expect(TypeError, ["x is a list; expected numbers with shape (2,)"], bch.Agents, [0, 0], ["a", "b"], x, x)

    def test_values(self):
        collide = lambda **more: bch.collide(self.shapes, self.agents, self.pairs, **more)
        self.expect(ValueError, ["leaves is 'round'", "'segments'"], collide, leaves="round")
        self.expect(ValueError, ["threads is -1"], collide, threads=-1)
        self.expect(ValueError, ["mmx"], collide, implementation="mmx")
        self.agents.x[1] = np.nan
        self.expect(ValueError, ["agent 1"], collide)
        self.agents.x[1] = 0
        self.agents.shape[0] = 9
        self.expect(ValueError, ["9"], collide)
        self.expect(IndexError, ["7"], self.shapes.discs, 7)
        self.expect(IndexError, ["7"], self.shapes.outline, 7)
        self.expect(ValueError, ["directions is 300"], bch.penetration, self.shapes, self.agents, self.pairs, 300)
        self.expect(IndexError, ["shape is 4294967296"], self.shapes.discs, 2**32)
        self.expect(ValueError, ["depths[0] is -1"], bch.ShapeSetBuilder, bch.Plan([-1]))

    def test_characters_and_scenes(self):
        mesh = ([(0, 0, 0), (1, 0, 0), (1, 1, 1)], [(0, 1, 2)])
        make = lambda **more: bch.make_character(*mesh, **more)
        self.assertEqual(make().triangles, 1)
        self.expect(TypeError, ["vertices"], bch.make_character, [(0, 0)], mesh[1])
        self.expect(ValueError, ["weights", "None"], make, weights=np.ones((3, 1)))
        self.expect(TypeError, ["weights has 2 rows", "3 vertices"], make, weights=np.ones((2, 1)), vertex_bones=[[0], [0]])
        self.expect(ValueError, ["vertex 0", "sum to 0.5"], make, weights=np.full((3, 1), 0.5), vertex_bones=[[0]] * 3)
        self.expect(TypeError, ["the rest of joint 0", "(2, 2)"], make, joints=[bch.Joint(rest=np.eye(2))])
        bent = lambda *curve: [bch.Motion("a", 1.0, [bch.Channel(0, bch.Curve(*curve))])]
        self.expect(ValueError, ["interpolation is 'round'"], make, motions=bent([0], [(0, 0, 0)], "round"))
        self.expect(TypeError, ["tangents", "(1, 2, 3)"], make, motions=bent([0], [(0, 0, 0)], "cubic"))
        self.expect(TypeError, ["times", "(2,)"], make, motions=bent([0, 1], [(0, 0, 0)]))
        self.expect(ValueError, ["out of order"], make, motions=bent([1, 0], [(0, 0, 0)] * 2))
        self.expect(TypeError, ["depth", "uint32"], bch.plan_scene, [(0, 0.0)], depth=np.zeros(1, "f4"))
        self.expect(ValueError, ["agent 0", "nan"], bch.plan_scene, [(0, np.nan)])
        plan = bch.plan_scene([(0, 0.0)], character=np.array([1], np.uint32))
        self.expect(IndexError, ["pose_ids[0].character is 1 of 1"], plan.build, [make()])
        self.expect(ValueError, ["NUL"], bch.Obstacles.from_wkt, "LINESTRING(0 0, 1 1)\0")
        self.expect(ValueError, ["NUL"], self.shapes.save, "a\0b")
        self.expect(ValueError, ["nan"], bch.depth_at_density, float("nan"))
        with self.assertRaises(TypeError):
            bch.ShapeSetBuilder(bch.Plan([1.7]))
        self.expect(ValueError, ["LINE"], bch.Obstacles.from_wkt, "LINE")

    def test_other_objects(self):
        dynamic = bch.DynamicShapeSet(self.shapes)
        self.expect(TypeError, ["agents is a ShapeSet", "bch.Agents"], bch.collide, self.shapes, self.shapes, self.pairs)
        self.expect(TypeError, ["shapes is a DynamicShapeSet", ".shapes"], bch.collide, dynamic, self.agents, self.pairs)
        self.expect(TypeError, ["obstacles is a str"], bch.Crowd().obstacles, self.shapes, self.agents, "POLYGON")
        with self.assertRaises(AttributeError):
            self.agents.x = np.zeros(2)
        walls = bch.Obstacles.from_wkt("LINESTRING(0 0, 1 1)")
        self.expect(ValueError, ["directions are for pairs"], bch.penetration, self.shapes, self.agents, walls, 8)
        exact = {"leaves": "segments"}
        self.expect(ValueError, ["leaves are for obstacles"], bch.within, self.shapes, self.agents, self.pairs, 1, **exact)

    def test_every_argument_of_a_wrong_class(self):
        """What is no such thing is a TypeError or a ValueError that names the argument."""
        man = bch.default_male()
        discs = np.zeros((2, 1, 3)) + (0, 0, 0.2)
        body = bch.AnimatedShape([0, 1], discs)
        mover = bch.Mover(body, [(0, 0, 0, 0)])
        walls = bch.Obstacles.from_wkt("LINESTRING(0 0, 1 1)")
        crowd = {"shapes": self.shapes, "agents": self.agents}
        asked = {**crowd, "pairs": self.pairs}
        poses, which = [(0, 0.0)], np.zeros(1, np.uint32)
        points = {"x": np.zeros(2), "y": np.zeros(2)}
        mesh = {"vertices": np.eye(3), "triangles": [(0, 1, 2)]}
        builder, tall = bch.ShapeSetBuilder(), bch.ShapeSetBuilder(bch.Plan(heights=True))
        table = [
            (bch.Agents, {"shape": which, "x": np.zeros(1), "y": np.zeros(1), "heading": np.zeros(1)}),
            (bch.AnimatedShape, {"times": [0, 1], "discs": discs}),
            (body.discs, {"seconds": 0.5}),
            (bch.Mover, {"shape": body, "path": [(0, 0, 0, 0)], "clip_begin": 0}),
            (bch.first_contact, {"movers": [mover], "pairs": walls, "interval": (0, 1), "tolerance": 0.1, "threads": 1}),
            (bch.free_until, {"mover": mover, "others": [mover], "interval": (0, 1), "tolerance": 0.1}),
            (bch.animate, {"model": bch.BodyModel(man, 16, draft=True), "clip": 99, "error": 0.1}),
            (bch.Obstacles, {**points, "polyline_offsets": np.array([0, 2], np.uint64)}),
            (bch.Obstacles.from_wkt, {"text": "LINESTRING(0 0, 1 1)", "heights": (0, 1)}),
            (walls.owner, {"segment": 0}),
            (bch.collide, {**asked, "leaves": "discs", "threads": 1, "implementation": "scalar"}),
            (bch.within, {**asked, "distance": 1.0, "threads": 1}),
            (bch.clearance, {**asked, "max_distance": 1, "leaves": "discs", "overlap": "zero"}),
            (bch.nearest, {**asked, "max_distance": 1, "out": None}),
            (bch.penetration, {**asked, "directions": 16}),
            (bch.time_of_impact, {**asked, "dx": np.zeros(1), "dy": np.zeros(1)}),
            (bch.local_densities, {**points, "radius": 2}),
            (bch.Crowd().candidates, {**crowd, "margin": 0, "threads": 1}),
            (bch.Crowd().collisions, {**crowd, "leaves": "discs", "threads": 1}),
            (bch.Crowd().obstacles, {**crowd, "obstacles": walls, "leaves": "discs", "threads": 1}),
            (bch.Crowd().contacts, {**asked, "leaves": "discs", "threads": 1}),
            (bch.read_trajectory, {"path": "/nowhere.csv", "fps": 1, "unit": 1, "columns": "id,frame,x,y"}),
            (
                bch.check,
                {"recording": "/nowhere.csv", "characters": [man], "clip_speeds": {}, "facing": 0, "depth": 0}
                | {"leaves": "discs", "max_distance": 1, "walls": walls, "fps": 1, "unit": 1, "threads": 1},
            ),
            (
                bch.plan_scene,
                {"poses": poses, "character": which, "depth": which, "outlines": False}
                | {"pose_step": 1, "pairs_per_shape": 1},
            ),
            (bch.dataframe, {"records": bch.Trajectory(np.empty(0, bch.TRACKED), 1, "", "", [], [])}),
            (bch.depth_at_density, {"people_per_square_metre": 1}),
            (man.sample_poses, {"count": 1}),
            (man.transforms, {"poses": [(0, 0.0)], "space": "world"}),
            (man.blend, {"poses": [(0, 0.0)], "weights": [1]}),
            (man.posed_vertices, {"poses": [(0, 0.0)]}),
            (man.joint, {"name": "pelvis"}),
            (bch.Transforms, {"transforms": np.eye(4), "space": "world", "origins": None}),
            (bch.Vertices, {"positions": np.eye(3)}),
            (bch.default_pedestrian, {"sex": "male", "stature": 1.7, "shoulders": 0}),
            (bch.pedestrian_strides_per_second, {"speed": 1}),
            (
                bch.import_character,
                {"path": "/nowhere.glb", "up": "z", "scale": 1, "clip_files": [], "max_triangles": 1}
                | {"timeout": 1, "memory_limit": 2**30},
            ),
            (bch.make_character, {**mesh, "name": "a", "joints": [], "bones": [], "motions": [], "root_joint": -1}),
            (bch.make_character, {**mesh, "to_ground": np.eye(4), "weights": None, "vertex_bones": None}),
            (bch.ShapeBuilder, {"character": man}),
            (bch.ShapeBuilder(man).outline, {"clip": 0, "seconds": 0}),
            (bch.ShapeSetBuilder, {"plan": bch.Plan()}),
            (lambda depths: bch.ShapeSetBuilder(bch.Plan(depths=depths)), {"depths": [0]}),
            (lambda threshold: bch.ShapeSetBuilder(bch.Plan(threshold=threshold)), {"threshold": 0.5}),
            (builder.add_poses, {"character": man, "poses": [], "threads": 1}),
            (builder.add_pose_ids, {"characters": [man], "pose_ids": np.empty(0, bch.POSE_ID), "threads": 1}),
            (tall.add_polygons, {"polygons": [[(0, 0), (1, 0), (0, 1)]], "heights": (0, 1)}),
            (tall.add_capsules, {"capsules": [(0, 0, 1, 0, 1)], "tolerance": 0.1, "heights": (0, 1)}),
            (tall.add_discs, {"discs": [(0, 0, 1)], "heights": (0, 1)}),
            (tall.add_cylinder, {"radius": 1, "heights": (0, 1)}),
            (builder.add_mesh, {"positions": np.eye(3), "triangles": [(0, 1, 2)]}),
            (builder.add_animated_shape, {"shape": body, "seconds": 0}),
            (bch.bake, {"characters": man, "poses": 0, "plan": bch.Plan(), "path": None, "threads": 1}),
            (bch.DynamicShapeSet, {"start": self.shapes}),
            (
                bch.DynamicShapeSet(self.shapes).replace,
                {"character": man, "shapes": which[:0], "poses": [], "threshold": 0.1, "threads": 1},
            ),
            (bch.ShapeSet.load, {"path": "/nowhere.bch"}),
            (bch.ShapeSet.from_polygons, {"bodies": [[[(0, 0), (1, 0), (0, 1)]]], "heights": None, "plan": bch.Plan()}),
            (self.shapes.save, {"path": "/nowhere/a.bch"}),
            (self.shapes.discs, {"shape": 0, "level": 0}),
            (self.shapes.outline, {"shape": 0}),
            (self.shapes.radius, {"shape": 0}),
            (self.shapes.origin, {"shape": 0}),
            (self.shapes.keep_clip, {"shape": body, "character": "man", "clip": "walk"}),
            (self.shapes.verify, {"most": 1}),
        ]
        for call, good in table:
            for name in good:
                for wrong in (object(), "cm", [1], [object()], {1: 2}, 1j, 10**400, np.zeros(3, "c16")):
                    if isinstance(wrong, type(good[name])):
                        continue
                    with self.subTest(call=getattr(call, "__qualname__", call), argument=name, value=repr(wrong)[:40]):
                        try:
                            call(**{**good, name: wrong})
                        except (TypeError, ValueError) as error:
                            self.assertIn(name, str(error))
                        except (FileNotFoundError, IndexError, OverflowError) as error:  # a name, an index, a size
                            self.assertIsInstance(error, bch.Error)

    def test_arguments_are_named_as_arguments(self):
        """Not as options of the command-line program."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "walk--fps.txt"
            path.write_text("1 2 3 4\n2 3 4 5\n")
            self.expect(OSError, ["columns has to"], bch.read_trajectory, path)
            path.write_text("id frame x y\n1 2 3 4\n1 3 4 5\n")
            with self.assertRaises(OSError) as caught:
                bch.read_trajectory(path)
            self.assertIn("fps has to", str(caught.exception))
            self.assertNotIn(" --", str(caught.exception))
            self.assertIn("walk--fps.txt", str(caught.exception))
        cm = lambda **named: bch.read_trajectory("/nowhere.csv", **named)
        self.expect(TypeError, ["unit is a str", "a number"], cm, unit="cm")
        self.expect(TypeError, ["clip is a str", "a whole number"], bch.animate, bch.default_male(), "walk")
        self.expect(TypeError, ["distance is a list"], bch.within, self.shapes, self.agents, self.pairs, [1])

    def test_bodies(self):
        builder = bch.ShapeSetBuilder()
        for add, wrong in (
            (builder.add_discs, np.zeros((3, 2))),
            (builder.add_discs, [1.0, 2.0, 3.0]),
            (lambda value: builder.add_polygons([value]), np.zeros((4, 3))),
            (lambda value: builder.add_mesh(np.zeros((3, 3)), value), [(0, 1, 2, 3)]),
            (lambda value: builder.add_mesh(np.zeros((3, 3)), value), [(0, 1.9, 2.2)]),
            (lambda value: builder.add_poses(bch.default_male(), value), [0, 1, 2]),
        ):
            self.expect(TypeError, [], add, wrong)
        self.expect(ValueError, ["heights"], builder.add_cylinder, 0.3, heights=(0, 1))
        self.assertEqual(len(builder.finish()), 0)

    def test_objects_of_other_threads(self):
        """Two threads that use one crowd get answers or an error, and no crash."""
        shapes, agents = squares(3000)
        crowd, results = bch.Crowd(), []

        def ask():
            for _ in range(30):
                try:
                    results.append(len(crowd.collisions(shapes, agents)))
                except bch.Error as error:
                    results.append(str(error))

        asking = [threading.Thread(target=ask) for _ in range(4)]
        for thread in asking:
            thread.start()
        for thread in asking:
            thread.join()
        expected = len(bch.Crowd().collisions(shapes, agents))
        busy = "this Crowd is in use by another thread; each thread needs one of its own"
        self.assertLessEqual(set(results), {expected, busy})
        self.assertIn(expected, results)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            missing, wrong = Path(folder) / "a.bch", Path(folder) / "b.bch"
            wrong.write_text("not a set")
            self.expect(FileNotFoundError, ["a.bch"], bch.ShapeSet.load, missing)
            self.expect(OSError, ["b.bch"], bch.ShapeSet.load, wrong)
            self.expect(FileNotFoundError, ["a.glb"], bch.import_character, Path(folder) / "a.glb")
            self.expect(OSError, ["b.bch"], bch.import_character, wrong)
            self.expect(OSError, ["nowhere"], self.shapes.save, Path(folder) / "nowhere" / "c.bch")

class Libraries(unittest.TestCase):
    """libbch is loaded with the package, and libbch_files, which needs many packages, when a file is read."""

    def run_script(self, script, **environment):
        environment = dict(os.environ, **environment)
        command = [sys.executable, "-W", "error", "-c", textwrap.dedent(script)]
        return subprocess.run(command, env=environment, capture_output=True, text=True)

    def test_one_that_is_not_there(self):
        ended = self.run_script("import bch", BCH_LIBRARY="/nowhere/libbch.so")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("ImportError: bch: /nowhere/libbch.so", ended.stderr)

    def test_files_are_loaded_when_they_are_read(self):
        ended = self.run_script("""
            import bch, pathlib
            maps = pathlib.Path("/proc/self/maps")
            loaded = lambda: [name for name in ("libbch_files", "libassimp", "libsqlite3") if name in maps.read_text()]
            bch.bake(bch.default_male(), poses=2)
            print(loaded())
            try:
                bch.import_character("/nowhere.glb")
            except FileNotFoundError:
                print(loaded())
        """)
        self.assertEqual((ended.stdout, ended.stderr), ("[]\n['libbch_files', 'libassimp', 'libsqlite3']\n", ""))

    def test_files_without_their_library(self):
        script = """
            import bch
            assert len(bch.bake(bch.default_male(), poses=2)) == 2
            for read in (bch.import_character, bch.read_trajectory, bch.check):
                try:
                    read("a.file")
                except ImportError as error:
                    print(error)
        """
        package = Path(bch.__file__).parent
        private = f"BCH_PRIVATE_{bch.__version__}"
        with tempfile.TemporaryDirectory() as folder:
            first, files = Path(folder) / "libbch.so.1", Path(folder) / "libbch_files.so.1"

            def expect(words):
                ended = self.run_script(script, BCH_LIBRARY=str(first))
                self.assertEqual(ended.stderr, "")
                lines = [line for line in ended.stdout.splitlines() if words in line and "need Debian's libassimp5, " in line]
                self.assertEqual(len(lines), 3, ended.stdout)

            first.write_bytes((package / first.name).read_bytes())
            expect("libbch_files.so.1: cannot open shared object file")
            files.write_bytes((package / files.name).read_bytes().replace(b"libassimp.so.5", b"libassimp.so.x"))
            expect("libassimp.so.x: cannot open shared object file")
            # Nor does the loader take two of different releases.
            files.write_bytes((package / files.name).read_bytes())
            first.write_bytes(first.read_bytes().replace(private.encode(), private[:-1].encode() + b"x"))
            expect(f"version `{private}' not found")

class Sets(unittest.TestCase):
    def test_own_bodies(self):
        shapes, _ = squares()
        self.assertEqual((len(shapes), shapes.depths, shapes.has_heights), (2, (bch.ALL_DEPTHS,), True))
        (contour,) = shapes.outline(1)
        self.assertEqual(sorted(map(tuple, contour.tolist())), [(-1, -1), (-1, 1), (1, -1), (1, 1)])
        self.assertAlmostEqual(shapes.radius(1), 2**0.5, places=2)
        self.assertEqual(shapes.discs(0).dtype, bch.ShapeSet.discs(shapes, 0).dtype)
        self.assertEqual(shapes.verify(), [])
        builder = bch.ShapeSetBuilder()
        builder.add_discs([(0, 0, 0.2), (0.3, 0, 0.1)])
        builder.add_cylinder(0.25)
        builder.add_capsules([(-0.2, 0, 0.2, 0, 0.1)])
        builder.add_mesh([(0, 0, 0), (1, 0, 0), (1, 1, 1)], [(0, 1, 2)])
        own = builder.finish()
        np.testing.assert_allclose(own.discs(0)["x"], [0, 0.3], atol=1e-6)
        self.assertEqual([own.origin(i).character for i in range(4)], ["discs", "cylinder", "capsules", "mesh"])
        self.assertEqual(len(builder.finish()), 0)

    def test_own_spheres(self):
        cart = bch.spheres_from_polygons([[(-0.3, -0.2), (0.3, -0.2), (0.3, 0.2), (-0.3, 0.2)]], (0, 1))
        arm = bch.spheres_from_capsules([(0, -0.4, 1.3, 0, 0.4, 1.3, 0.05)])
        self.assertEqual((cart.shape[1], arm.shape[1], cart.dtype), (4, 4, np.float32))
        bodies = bch.BodySet([cart, arm])
        agents = bch.Agents(np.array([0, 1], np.uint32), np.zeros(2), np.zeros(2), np.zeros(2), z=np.array([0.0, 0.0]))
        self.assertEqual(len(bch.Crowd().collisions(bodies, agents)), 0)
        below = bch.Agents(agents.shape, agents.x, agents.y, agents.heading, z=np.array([0.0, -0.4]))
        self.assertEqual(len(bch.Crowd().collisions(bodies, below)), 1)
        live = bch.LiveBodies([bch.BodyModel.from_spheres(cart)], 1)
        self.assertEqual(len(live.bodies.spheres(0)), len(cart))

    def test_heights(self):
        shapes, agents = squares()
        pairs = np.array([[0, 1]], np.uint32)
        above = bch.Agents(agents.shape, agents.x, agents.y, agents.heading, z=np.array([0.0, 1.5]))
        self.assertTrue(bch.collide(shapes, agents, pairs)[0])
        self.assertFalse(bch.collide(shapes, above, pairs)[0])

    def test_obstacles_with_heights(self):
        box = bch.ShapeSet.from_polygons([[[(0, 0), (1, 0), (1, 1), (0, 1)]]], plan=bch.Plan(heights=True), heights=[(0.0, 1.5)])
        agents = bch.Agents(np.zeros(3, np.uint32), np.zeros(3), np.zeros(3), np.zeros(3), z=np.array([0.0, 2, 9]))
        points = np.array([0.5, 0.5, 2, 2]), np.array([-1.0, 2, -1, 2])
        walls = bch.Obstacles(*points, np.array([0, 2, 4], np.uint64), heights=np.array([(1.0, 3.0), (-np.inf, np.inf)]))
        np.testing.assert_array_equal(bch.collide(box, agents, walls), [1, 1, 0])
        np.testing.assert_allclose(bch.clearance(box, agents, walls, leaves="segments"), [0, 0, 1], atol=1e-5)
        with self.assertRaisesRegex(bch.ArrayError, "heights is .*float64 with shape \\(2, 2\\)"):
            bch.Obstacles(*points, np.array([0, 2, 4], np.uint64), heights=np.zeros(2))
        with self.assertRaisesRegex(ValueError, "obstacle 1: expected a bottom below the top, found 3 to 2 m"):
            bch.Obstacles(*points, np.array([0, 2, 4], np.uint64), heights=np.array([(0.0, 1), (3, 2)]))
        wall = "LINESTRING(-1 0.5, 2 0.5)"
        for heights, hits in (((1.0, 3.0), [1, 1, 0]), ((1.6, 3.0), [0, 1, 0]), ((-np.inf, np.inf), [1, 1, 1])):
            self.assertEqual(bch.collide(box, agents, bch.Obstacles.from_wkt(wall, heights=heights)).tolist(), hits)
        self.assertEqual(bch.collide(box, agents, bch.Obstacles.from_wkt(wall)).tolist(), [1, 1, 1])
        with self.assertRaisesRegex(ValueError, "obstacle 0: expected a bottom below the top, found 3 to 2 m"):
            bch.Obstacles.from_wkt(wall, heights=(3, 2))

    def test_baking(self):
        female = bch.default_female()
        self.assertEqual(female.clips[0].name, "walk")
        plan = bch.Plan(depths=(0, 3, bch.ALL_DEPTHS), heights=True)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "women.bch"
            made = bch.bake(female, poses=8, plan=plan, path=path)
            loaded = bch.ShapeSet.load(path)
            self.assertEqual(os.listdir(folder), ["women.bch"])
        self.assertEqual(loaded.origin(5), made.origin(5))
        self.assertEqual(made.origin(5).character, "default:female")
        self.assertEqual((loaded.depths, loaded.has_heights), (plan.depths, True))
        poses = female.sample_poses(8)
        outline = bch.ShapeBuilder(female).outline(int(poses[2]["clip"]), float(poses[2]["seconds"]))
        np.testing.assert_array_equal(outline[0], bch.bake(female, poses=poses[2:3]).outline(0)[0])

    def test_poses_of_ones_own(self):
        man = bch.default_male()
        poses = man.sample_poses(4)
        local, world, vertices = man.transforms(poses), man.transforms(poses, "world"), man.posed_vertices(poses)
        self.assertEqual((local.shape, vertices.shape), ((4, man.joints, 3, 4), (4, man.vertices, 3)))
        square = np.zeros((4, man.joints, 4, 4), np.longdouble)
        square[:, :, :3] = world
        square[:, :, 3, 3] = 1
        strided = np.zeros((4, 2 * man.vertices, 3))
        strided[:, ::2] = vertices
        expected = bch.bake(man, poses)
        ways = [bch.Transforms(local, "parent"), bch.Transforms(world), bch.Transforms(square), bch.Vertices(vertices)]
        for way in [*ways, bch.Vertices(strided[:, ::2])]:
            made = bch.bake(man, way)
            dynamic = bch.DynamicShapeSet(bch.bake(man, 4))
            dynamic.replace(man, np.arange(4, dtype=np.uint32), way)
            for shape in range(4):
                for other in (made, dynamic.shapes):
                    np.testing.assert_array_equal(other.discs(shape), expected.discs(shape))
        both = bch.bake([man, bch.default_female()], [bch.Vertices(vertices), [(0, 1.0)]])
        self.assertEqual(len(both), 5)
        self.assertEqual(man.joint_names[man.joint("left ankle")], "left ankle")
        np.testing.assert_array_equal(man.blend(poses[:2], [0, 2]), local[1])
        for bad, message in [
            (bch.Transforms(local[:, 1:], "parent"), r"poses\[[0-3]\]: shape: expected 27 joint transforms, found 26"),
            (bch.Transforms(local[0], "parent"), r"transforms is .*; expected an array of floats with shape \(frames, n, 3, 4\)"),
            (bch.Transforms(local.astype(int)), "expected an array of floats"),
            (bch.Transforms(local, "bones"), "space is 'bones'"),
            (bch.Transforms(local, "palette", np.zeros((3, 2))), r"origins is .*shape \(4, 2\)"),
            (bch.Vertices(vertices[:, :9]), "posed vertices, found 9"),
        ]:
            with self.assertRaisesRegex(bch.Error, message):
                bch.bake(man, bad)

    def test_palettes_of_ones_own(self):
        """Matrices of bones, of which one stands elsewhere: where it stands does not count, how it is turned does."""
        mesh = [(0, 0, 0), (1, 0, 0), (0, 1, 1)], [(0, 1, 2)]
        bones = {"joints": [bch.Joint()], "bones": [bch.Bone(0)], "root_joint": 0}
        bones |= {"vertex_bones": [[0]] * 3, "weights": np.ones((3, 1))}
        turned = np.array([(0, -1, 0, 5), (1, 0, 0, 7), (0, 0, 1, 0), (0, 0, 0, 1)], float)
        palette = np.stack([np.eye(4), turned])[:, None]
        made = bch.bake(bch.make_character(*mesh, **bones), bch.Transforms(palette, "palette", np.array([(0.0, 0), (5, 7)])))
        for shape, corners in enumerate(([(0, 0), (0, 1), (1, 0)], [(-1, 0), (0, 0), (0, 1)])):
            (contour,) = made.outline(shape)
            np.testing.assert_allclose(sorted(contour.round(4).tolist()), corners, atol=1e-4)

    def test_replacing(self):
        male = bch.default_male()
        poses = male.sample_poses(6)
        dynamic = bch.DynamicShapeSet(bch.bake(male, poses=poses[:3]))
        dynamic.replace(male, np.array([2, 0, 1], np.uint32), poses[3:])
        later = bch.bake(male, poses=poses[3:])
        for shape, of in ((2, 0), (0, 1), (1, 2)):
            np.testing.assert_array_equal(dynamic.shapes.discs(shape), later.discs(of))
        with self.assertRaisesRegex(ValueError, "as one before"):
            dynamic.replace(male, np.array([1, 1], np.uint32), poses[:2])
        shapes = dynamic.shapes
        del dynamic
        self.assertEqual(len(shapes.outline(0)), len(later.outline(1)))  # it keeps what it stands on

    def test_numbers_of_numpy(self):
        shapes, agents = squares()
        pairs = np.array([[0, 1]], np.uint32)
        self.assertEqual(len(bch.bake(bch.default_male(), poses=np.int64(3))), 3)
        self.assertTrue(bch.within(shapes, agents, pairs, np.float32(0.1))[0])
        self.assertEqual(len(bch.penetration(shapes, agents, pairs, np.int64(8))), 1)
        male = bch.default_male()
        self.assertEqual(len(bch.bake(male, poses=male.sample_poses(4))), 4)
        self.assertEqual(len(bch.bake(male, poses=[(0, 0.5), (0, 0.7)])), 2)
        with self.assertRaisesRegex(ValueError, "of 1 characters, and there are 2"):
            bch.bake([male, male], poses=[male.sample_poses(2)])
        self.assertEqual(len(bch.Obstacles(np.empty(0), np.empty(0), np.zeros(1, np.uint64))), 0)

    def test_copies(self):
        shapes, agents = squares(5)
        again = pickle.loads(pickle.dumps(agents))
        np.testing.assert_array_equal(again.x, agents.x)
        with self.assertRaisesRegex(TypeError, "save"):
            pickle.dumps(shapes)

    def test_pedestrians(self):
        woman = bch.default_pedestrian("female", 1.62)
        self.assertEqual((woman.name, len(woman.clips)), ("pedestrian:female", 74))
        self.assertEqual(woman.clips[46].name, "walk 1.38 m/s")
        self.assertAlmostEqual(bch.pedestrian_strides_per_second(1.4), 1.0)
        with self.assertRaisesRegex(ValueError, "stature"):
            bch.default_pedestrian("male", 5.0)

    def test_motions(self):
        # A disc of 0.2 m that swings from 0 to 0.5 m and back, and another one that stands.
        swing = bch.AnimatedShape([0, 1, 2], [[[0, 0, 0.2]], [[0.5, 0, 0.2]], [[0, 0, 0.2]]], loops=True)
        still = bch.AnimatedShape([0, 1], [[[0, 0, 0.2], [0.1, 0, 0.2]]] * 2)
        self.assertEqual((swing.begin, swing.end, swing.loops, swing.key_count), (0, 2, True, 3))
        self.assertAlmostEqual(float(swing.discs(4.5)["x"][0]), 0.25, 6)
        self.assertEqual(len(still.discs(7)), 2)
        movers = [bch.Mover(swing, [(0, 0, 0, 0)]), bch.Mover(still, [(0, 3, 0, 0), (3, 0, 0, 0)], clip_begin=0.3)]
        # They touch in the second round, when 0.5 (t - 2) + 0.2 = 3 - t - 0.2.
        pairs = np.array([[0, 1], [1, 0]], np.uint32)
        times = bch.first_contact(movers, pairs, (0, 10), tolerance=1e-4)
        self.assertEqual(times[0], times[1])
        self.assertTrue(2.4 - 1e-3 < times[0] <= 2.4 + 1e-9, times)
        self.assertEqual(bch.free_until(movers[0], movers[1:], (0, 10), tolerance=1e-4), times[0])
        self.assertEqual(bch.free_until(movers[0], [], (0, 10)), np.inf)
        wall = bch.Obstacles.from_wkt("LINESTRING(0.6 -1, 0.6 1)")  # reached when 0.5 t + 0.2 = 0.6, and when 3 - t - 0.2 = 0.6
        touched = bch.first_contact(movers, wall, (0, 10), tolerance=1e-4)
        np.testing.assert_allclose(touched, [0.8, 2.2], atol=1e-3)
        # Spheres meet in space: one comes over another one, whose ground is 1 m below, and one comes lower.
        ball = bch.AnimatedShape([0, 1], [[[0, 0, 0.5, 0.2]]] * 2)
        self.assertEqual(ball.spheres(0.5).tolist(), [(0.0, 0.0, 0.5, 0.20001220703125)])
        self.assertEqual(len(still.spheres(0)), 0)
        comes = lambda z: bch.Mover(ball, [(0, 3, 0, 0, z), (3, 0, 0, 0, z)])  # noqa: E731
        stands = bch.Mover(ball, [(0, 0, 0, 0)])
        in_space = bch.first_contact([stands, comes(1), comes(0.3)], np.array([[0, 1], [0, 2]], np.uint32), (0, 10), tolerance=1e-4)
        self.assertEqual(in_space[0], np.inf)
        self.assertAlmostEqual(float(in_space[1]), 3 - (0.4**2 - 0.3**2) ** 0.5, 3)
        out = np.empty(2)
        self.assertIs(bch.first_contact(movers, pairs, (0, 1), out=out), out)
        self.assertTrue(np.isinf(out).all())
        with self.assertRaises(bch.ArgumentError):
            bch.first_contact(movers, pairs, (1, 0))
        with self.assertRaises(bch.ArrayError):
            bch.first_contact([swing], pairs, (0, 1))
        with self.assertRaises(bch.ArrayError):
            bch.AnimatedShape([0, 1], [[0, 0, 0.2]])
        with self.assertRaisesRegex(bch.ArgumentError, "chunk 0: expected a key after 1 s, found 0"):
            bch.AnimatedShape([1, 0], [[[0, 0, 0.2]]] * 2)

    def test_clips_of_sets(self):
        walker = bch.default_pedestrian(stature=1.7)
        model = bch.BodyModel(walker, 64, draft=True)
        clip = bch.animate(model, 40)
        self.assertTrue(clip.loops and clip.bounding_radius < 0.7, clip)
        self.assertAlmostEqual(clip.end * bch.pedestrian_strides_per_second(1.2), 1, places=6)  # one stride
        for loops in (False, True):
            self.assertEqual(bch.animate(model, 40, loops=loops).loops, loops)
        shapes, _ = squares()
        shapes.keep_clip(clip, "walker", walker.clips[40].name)
        shapes.keep_clip(clip, "nobody")
        with tempfile.TemporaryDirectory() as folder:
            shapes.save(Path(folder) / "a.bch")
            kept = bch.ShapeSet.load(Path(folder) / "a.bch").clips
        self.assertEqual([(each.character, each.clip) for each in kept], [("walker", walker.clips[40].name), ("nobody", None)])
        self.assertEqual(kept[0].shape.discs(0.4).tolist(), clip.discs(0.4).tolist())
        builder = bch.ShapeSetBuilder()
        builder.add_animated_shape(clip, 0.4)
        self.assertEqual(len(builder.finish().discs(0)), len(clip.discs(0.4)))

    def test_densities(self):
        x = np.array([0.0, 1.0, 50.0])
        np.testing.assert_allclose(bch.local_densities(x, np.zeros(3)), np.array([2, 2, 1]) / (4 * np.pi))
        self.assertGreaterEqual(bch.depth_at_density(0.1), 0)

class Recordings(unittest.TestCase):
    """Two people who walk through each other."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name) / "two.csv"
        lines = ["id,time,x,y"]
        for k in range(100):
            lines += [f"7,{k / 25},{-2.4 + 0.048 * k:.4f},0", f"5,{k / 25},{2.4 - 0.048 * k:.4f},0.1"]
        cls.path.write_text("\n".join(lines) + "\n")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_reading(self):
        trajectory = bch.read_trajectory(self.path, unit=1)
        self.assertEqual((len(trajectory.rows), trajectory.rows.dtype, trajectory.fps), (200, bch.TRACKED, 25.0))
        self.assertEqual(trajectory.rows["id"][:4].tolist(), [5, 7, 5, 7])
        self.assertAlmostEqual(trajectory.rows["x"][1], -2.4)
        self.assertTrue(np.isnan(trajectory.rows["heading"]).all())
        self.assertEqual((trajectory.motions, set(trajectory.rows["motion"])), ([], {-1}))
        self.assertTrue((trajectory.character == "").all() and np.isnan(trajectory.rows["clip_time"]).all())
        with self.assertRaises(FileNotFoundError):
            bch.read_trajectory("/nowhere.txt")

    def test_reading_is_interrupted(self):
        from bch import _progress

        for read in (bch.read_trajectory, bch.check):
            with mock.patch.object(_progress.Watched, "_advance", lambda *_: 1), self.assertRaises(KeyboardInterrupt):
                read(self.path)

    def test_reading_what_rows_name(self):
        path = Path(self.folder.name) / "named.csv"
        path.write_text("frame,id,x,y,character,clip,clip_time\n0,1,0,0,man,walk,0.25\n0,2,5,0,,,\n1,1,0.1,0,man,,\n1,2,5,0,,idle,\n")
        trajectory = bch.read_trajectory(path, fps=10, unit=1)
        self.assertEqual(trajectory.motions, [("man", "walk"), ("man", ""), ("", "idle")])
        self.assertEqual(trajectory.rows["motion"].tolist(), [0, -1, 1, 2])
        self.assertEqual(trajectory.character.tolist(), ["man", "", "man", ""])
        self.assertEqual(trajectory.clip.tolist(), ["walk", "", "", "idle"])
        np.testing.assert_array_equal(trajectory.rows["clip_time"], np.array([0.25, np.nan, np.nan, np.nan], np.float32))
        from bch import _library, _recordings

        handle = _recordings._open(path, 10, 1, None)
        rows, count = np.empty(4, bch.TRACKED), ctypes.c_size_t()
        _library.check(_library.lib.bch_trajectory_read(handle.pointer, rows.ctypes.data, 4, ctypes.byref(count)))
        with self.assertRaisesRegex(ValueError, "has been read from"):
            _library.Handle("check", "run", handle.pointer, ctypes.byref(_library.CheckOptions()))
        try:
            import pandas  # noqa: F401
        except ImportError:
            return
        table = bch.dataframe(trajectory)
        self.assertEqual(table["clip"].tolist(), ["walk", "", "", "idle"])
        self.assertNotIn("motion", table.columns)

    def test_checking(self):
        found = bch.check(self.path, unit=1, max_distance=0.5)
        worst = found.events[np.argmax(found.events["depth"])]
        self.assertEqual((worst["first"], worst["second"], worst["kind"]), (5, 7, bch.OVERLAP))
        self.assertLess(abs(worst["worst"] - 50), 5)
        self.assertEqual((len(found.frames), found.summary["person_frames"]), (100, 200))
        self.assertEqual(found.frames["overlapping"].sum(), found.summary["overlapping"])
        gaps = found.pairs[found.pairs["kind"] == bch.NEAR]
        self.assertTrue((gaps["gap"] <= 0.5).all() and len(gaps) > 5)
        passing = Path(self.folder.name) / "passing.csv"
        rows = [f"1,{k},{8997 + 2 * k},5\n2,{k},{9003 - 2 * k},5\n" for k in range(4)]
        passing.write_text("id,frame,x,y\n" + "".join(rows))
        (seen,) = bch.check(passing, fps=1, unit=1, threads=1).events
        self.assertEqual((seen["kind"], seen["worst"], seen["y"]), (bch.PASS, 1, 5))
        self.assertTrue(0.2 < seen["after"] < 0.5)
        self.assertAlmostEqual(seen["x"], 8999 + 2 * float(seen["after"]), 4)

    def test_measures(self):
        columns = self.columns()
        found = bch.check(**columns, fps=25, measures=True)
        self.assertEqual((len(found.measures), set(found.measures["collides"])), (len(columns["x"]), {0, 1}))
        frame = found.measures["frame"][0]
        people, pairs = (rows[rows["frame"] == frame] for rows in (found.measures, found.conflicts))
        now = columns["frame"] == frame
        places = {id: (x, y) for id, x, y in zip(columns["id"][now], columns["x"][now], columns["y"][now])}
        for person in people:
            others = [place for id, place in places.items() if id != person["id"]]
            distance = np.linalg.norm(np.subtract(others, places[person["id"]]), axis=1)
            intrusion = np.where(distance > 0.2, (0.6 / (distance - 0.2)) ** 2, np.inf)[distance <= 2.4].sum()
            np.testing.assert_allclose(person["disc_intrusion"], intrusion, 1e-5)
            np.testing.assert_allclose(person["disc_clearance"], distance.min() - 0.2, 1e-4)
            self.assertEqual(person["personal"], (distance <= 1.2).sum())
            own = (pairs["first"] == person["id"]) | (pairs["second"] == person["id"])
            self.assertEqual(person["ttc"], pairs["ttc"][own].min(initial=np.inf))
            np.testing.assert_allclose(person["avoidance"], np.float32(3) / np.float64(person["ttc"]) if person["ttc"] else np.inf, 1e-6)
        self.assertTrue((pairs["clearance"] < 0).any())
        self.assertGreaterEqual(found.summary["colliding_people"], 2)
        self.assertEqual(found.table("measures")["seconds"][0], frame / 25)
        self.assertEqual(len(bch.check(**columns, fps=25).measures), 0)

    def test_pages(self):
        """The page is that of the program, which is beside the interpreter where the package has it."""
        path, out = (Path(self.folder.name) / name for name in ("walk.csv", "walk.html"))
        rows = [f"{k / 10},{id},{0.1 * k * way},{0.05 * way}\n" for k in range(-20, 20) for id, way in ((5, 1), (7, -1))]
        path.write_text("time,id,x_m,y_m\n" + "".join(rows))
        found = bch.check(path, page=True)
        found.html(out)
        html = out.read_bytes()
        self.assertTrue(html.startswith(b"<!DOCTYPE html>") and b"<title>walk.csv</title>" in html)
        self.assertEqual(html.count(b'["events","1 in overlap'), 1)
        program = Path(sys.executable).with_name("bch")
        if program.exists():
            subprocess.run([program, "check", path, "--html", out], check=True, stdout=subprocess.DEVNULL)
            self.assertEqual(out.read_bytes(), html)
        spheres = bch.check(path, bodies="spheres", spheres=64, page=True).page
        self.assertIn(b"[\"options\",\"bodies='spheres' spheres=64\"]", spheres)
        self.assertIn(b"<title>recording</title>", bch.check(**self.columns(), fps=25, page=True).page)
        with self.assertRaisesRegex(ValueError, "page=True"):
            bch.check(path).html(out)

    def test_predictions(self):
        """TrajNet++'s Col-II, by its formula: in frames, and halfway to the next."""
        truth = self.columns()
        predicted = {**truth, "y": truth["y"] + 0.08 * truth["frame"] * np.sin(truth["id"])}
        found = bch.check(**predicted, fps=25, truth=truth).summary
        places = np.zeros((2, predicted["frame"].max() + 1, 12, 2))
        for to, columns in zip(places, (predicted, truth)):
            to[columns["frame"], columns["id"]] = np.c_[columns["x"], columns["y"]]
        places = places[:, predicted["frame"].min() :]
        halfway = (places[:, 1:] + places[:, :-1]) / 2
        distance = np.concatenate([np.linalg.norm(own[:, :, None] - others[:, None], axis=3) for own, others in (places, halfway)])
        distance[:, np.arange(12), np.arange(12)] = np.inf
        self.assertEqual(found["truth_disc_colliding_people"], (distance <= 0.2).any(axis=(0, 2)).sum())
        self.assertTrue(0 < found["truth_disc_colliding_people"] < 12)
        self.assertGreaterEqual(found["truth_colliding_people"], found["truth_disc_colliding_people"])
        self.assertEqual(found["truth_frames"], len(places[0]))
        self.assertEqual(bch.check(**predicted, fps=25).summary["truth_frames"], 0)

    def columns(self, count=60):
        """Rows of some people, in no order, as arrays of many types."""
        random = np.random.default_rng(5)
        frame, id = (each.ravel() for each in np.meshgrid(np.arange(3, 3 + count), np.arange(12), indexing="ij"))
        order = random.permutation(len(frame))
        x, y = (random.uniform(0, 4, 12)[id] + 0.03 * random.uniform(-1, 1, 12)[id] * frame for _ in "xy")
        heading = np.where(random.random(len(id)) < 0.3, np.nan, random.uniform(-4, 4, len(id)))
        return {"frame": frame[order], "id": id[order], "x": x[order], "y": y[order], "heading": heading[order]}

    def same(self, one, other):
        for name in ("events", "frames", "pairs"):
            self.assertEqual(getattr(one, name).tobytes(), getattr(other, name).tobytes(), name)
        self.assertGreater(min(len(one.events), len(one.pairs)), 0)
        self.assertEqual(one.summary, other.summary)

    def as_csv(self, columns, **options):
        path = Path(self.folder.name) / "same.csv"
        rows = zip(*(values.tolist() for values in columns.values()))
        path.write_text(",".join(columns) + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
        return bch.check(path, max_distance=0.5, **options)

    def test_arrays(self):
        columns = self.columns()
        check = lambda changed={}, **more: bch.check(**{**columns, **changed}, max_distance=0.5, **{"fps": 25, **more})
        expected = self.as_csv(columns, fps=25)
        self.same(check(), expected)
        self.assertEqual([line for line in check().assumptions if "no unit" in line], [])
        types = {"kind": "i1", "frame": ">i2", "id": "u8", "x": "f8", "y": "f8", "heading": "f8"}
        records = np.empty(len(columns["x"]), list(types.items()))
        for name, values in columns.items():
            records[name] = values
        self.same(check({name: records[name] for name in columns}), expected)
        self.same(check({name: values.tolist() for name, values in columns.items()}), expected)
        backwards = {name: values[::-1] for name, values in columns.items()}
        self.same(check(backwards), self.as_csv(backwards, fps=25))
        masked = np.ma.masked_invalid(columns["heading"])
        self.same(check({"heading": masked, "x": columns["x"] * 100, "y": columns["y"] * 100}, unit=0.01),
                  self.as_csv({**columns, "x": columns["x"] * 100, "y": columns["y"] * 100}, fps=25, unit=0.01))
        floats = {name: columns[name].astype(np.float32) for name in ("x", "y", "heading")}
        self.same(check(floats), self.as_csv({**columns, **floats}, fps=25))
        statures = {"stature": 1.5 + 0.05 * columns["id"]}
        self.same(check(statures), self.as_csv({**columns, **statures}, fps=25))
        # Times from any origin are those of frames from the first on.
        timed = {"frame": None, "time": 1.7e9 + columns["frame"] / 25}
        self.same(check(timed, fps=None), self.as_csv({"time": timed["time"], **{n: v for n, v in columns.items() if n != "frame"}}))
        epochs = np.datetime64("2026-05-01", "ns") + (columns["frame"] * 40_000_000).astype("timedelta64[ns]")
        self.assertEqual(check({"frame": None, "time": epochs}, fps=None).events["depth"].tolist(), expected.events["depth"].tolist())

    def test_bodies_of_any_kind(self):
        still = {"frame": [0, 0, 0], "id": [1, 2, 3], "x": [0, 1.5, 9], "y": [0, 0, 0], "heading": [0, 0, 0]}
        cart = {"cart": [(0, -0.2), (1.01, -0.2), (1.01, 0.2), (0, 0.2)]}
        found = bch.check(**still, length=[0, 1, 2], body=["cart", "box", None], footprints=cart, fps=1)
        self.assertEqual([(one["first"], one["second"]) for one in found.events], [(1, 2)])
        self.assertEqual((found.summary["overlap_events"], found.summary["pass_events"]), (1, 0))
        self.assertEqual(len(bch.check(**still, length=[0, 0.97, 2], body=["cart", "box", ""], footprints=cart, fps=1).events), 0)
        self.assertEqual(len(bch.check(**still, radius=[0.8, 0.71, 0], fps=1).events), 1)
        self.assertEqual(len(bch.check(**still, radius=[0.8, 0.69, np.nan], fps=1).events), 0)
        measured = bch.check(**still, length=[0, 1, 2], body=["cart", "box", None], footprints=cart, fps=1, measures=True).measures
        clearance = measured["clearance"][:2]  # of discs of 1 cm, which cover the two
        self.assertTrue((clearance <= -0.01).all() and (clearance > -0.03).all(), clearance)
        for kind, words, more in ((ValueError, "footprints: cart: .*found a line", {"footprints": {"cart": "LINESTRING (0 0, 1 1)"}}),
                                  (ValueError, "'cart' is none of disc.*footprints adds others", {}),
                                  (TypeError, "footprints is .*mapping", {"footprints": [cart]})):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                bch.check(**still, body=["cart", "", ""], fps=1, **more)
        path = Path(self.folder.name) / "bodies.csv"
        path.write_text("frame,id,x,y,body,length,clip\n0,1,0,0,box,1.2345,\n0,2,5,0,,,walk\n0,3,9,0,,,\n")
        trajectory = bch.read_trajectory(path, fps=10, unit=1)
        self.assertEqual(trajectory.motions, [("", ""), ("", "walk")])
        self.assertEqual(trajectory.bodies[1].kind, "")
        self.assertEqual((trajectory.bodies[0].kind, round(trajectory.bodies[0].length, 4)), ("box", 1.235))
        self.assertEqual(trajectory.body.tolist(), ["box", "", ""])

    def test_tables_by_what_they_offer(self):
        columns = self.columns()
        expected = self.as_csv(columns, fps=25)
        nothing = [None] * len(columns["id"])
        clips = {"character": nothing, "Clip": np.array(["", "walk"])[columns["id"] % 2], "point": [object()] * len(nothing)}

        class Frame:  # as a dataframe of pandas
            def __init__(self, columns):
                self.columns, self._columns = tuple(columns), columns

            def __getitem__(self, name):
                return Series(self._columns[name])

        class Series:
            def __init__(self, values):
                self._values = values

            def __array__(self, dtype=None, copy=None):
                return np.array(self._values, dtype)

        class Arrow(Frame):  # whose columns have no names
            def __init__(self, columns):
                super().__init__(columns)
                self.column_names, self.columns = list(columns), [Series(values) for values in columns.values()]

        records = np.empty(len(columns["x"]), [(name, values.dtype) for name, values in columns.items()])
        for name, values in columns.items():
            records[name] = values
        check = lambda table, **more: bch.check(table, max_distance=0.5, **more)
        for table in (columns, {**columns, "v": np.zeros((720, 2))}, records, records.view(np.recarray), Frame(columns), Arrow(columns)):
            self.same(check(table, fps=25), expected)
        people = [bch.default_male(), bch.default_female()]
        named = {**columns, "character": np.full(len(nothing), ""), "Clip": clips["Clip"]}
        self.same(check(Frame({**columns, **clips}), fps=25, characters=people), self.as_csv(named, fps=25, characters=people))

        class TrajectoryData:  # of PedPy
            data, frame_rate = Frame({**{n: columns[n] for n in ("id", "frame", "x", "y")}, "point": clips["point"]}), 25.0

        self.same(check(TrajectoryData()), self.as_csv({n: columns[n] for n in ("id", "frame", "x", "y")}, fps=25))
        self.assertEqual(check(TrajectoryData(), fps=5).summary["fps"], 5)
        self.assertFalse(any("no unit" in line for line in check(TrajectoryData()).assumptions))

        class Agent:
            def __init__(self, id, x, y, heading):
                self.id, self.position = id, (x, y)
                self.orientation = (0.0, 0.0) if np.isnan(heading) else (np.cos(heading), np.sin(heading))

        class Recording:  # of JuPedSim
            num_frames, fps = 70, 25.0

            def frame(self, number):
                rows = np.flatnonzero(columns["frame"] == number)
                return mock.Mock(agents=[Agent(*(columns[n][row] for n in ("id", "x", "y", "heading"))) for row in rows])

            def geometry(self):
                return mock.Mock(spec=["wkt"], wkt="POLYGON ((1 -9, 9 -9, 9 9, 1 9, 1 -9))")

        recording = Recording()
        turned = np.arctan2(np.sin(columns["heading"]), np.cos(columns["heading"]))
        self.same(check(recording, walls="LINESTRING (50 0, 51 0)"), self.as_csv({**columns, "heading": turned}, fps=25))
        self.assertGreater(check(recording).summary["in_walls"], 0)

    def test_notes(self):
        columns = self.columns()
        notes = lambda changed={}, **more: bch.check({**columns, **changed}, **{"fps": 25, **more}).notes
        self.assertEqual(notes(), [])
        self.assertEqual(notes({"speed": columns["x"], "name": ["a"] * 720}), ["Columns 'speed', 'name' are ignored."])
        self.assertEqual(notes(walls=[]), ["The walls have no segment."])
        (turned,) = notes({"heading": np.linspace(0, 359, 720)})
        self.assertEqual(turned, "Headings reach 359 radians: are they degrees, as of a column 'heading [deg]'?")
        degrees = {name: values for name, values in columns.items() if name != "heading"}
        self.assertEqual(bch.check({**degrees, "heading_deg": np.linspace(0, 359, 720)}, fps=25).notes, [])
        (slow,) = notes(fps=0.01)
        self.assertIn(" m/s on average: do they stand, or is the frame rate higher?", slow)
        (fast,) = notes({"x": 100 * columns["x"]}, fps=50)
        self.assertIn(" m/s on average: is the unit of length smaller than metres, or the frame rate lower?", fast)
        path = Path(self.folder.name) / "more.csv"
        path.write_text("frame,id,x,y,speed\n0,1,0,0,3\n")
        self.assertEqual(bch.read_trajectory(path, fps=1).notes, ["Column 'speed' is ignored."])

    def test_tables_of_results(self):
        found = bch.check(self.path, unit=1, max_distance=0.5, walls="LINESTRING (-1 -0.3, -1 0.3)")
        events, frames, pairs = found.table(), found.table("frames"), found.table("pairs")
        self.assertEqual(
            list(events),
            ["first", "second", "from", "from_seconds", "to", "to_seconds", "worst", "worst_seconds"]
            + ["x", "y", "depth", "frames", "kind", "after"],
        )
        self.assertEqual(list(pairs), ["frame", "seconds", "first", "second", "depth", "gap", "x", "y", "kind"])
        self.assertEqual(list(frames), [name for name in found.frames.dtype.names if name != "_"])
        self.assertEqual(set(pairs["kind"]), {"near", "overlap", "wall"})
        self.assertEqual((events["kind"] == "overlap").tolist(), (found.events["kind"] == bch.OVERLAP).tolist())
        np.testing.assert_array_equal(events["to_seconds"], found.events["to"] / 25)
        np.testing.assert_array_equal(pairs["seconds"], pairs["frame"] / 25)
        passing = bch.check(frame=[0, 0, 1, 1], id=[1, 2] * 2, x=[8999.0, 9001, 9001, 8999], y=[5.0] * 4, fps=2)
        (event,) = zip(*passing.table().values())
        named = dict(zip(passing.table(), event))
        self.assertEqual((named["kind"], named["from_seconds"]), ("pass", 0))
        self.assertEqual(named["worst_seconds"], float(named["after"]) / 2)
        with self.assertRaisesRegex(ValueError, "name is 'people'"):
            found.table("people")
        densities = found.summary["by_density"]
        self.assertEqual([each["from"] for each in densities], [0, 1, 2, 3, 4, 6])
        for count in ("person_frames", "overlapping", "in_walls", "near_pairs", "overlapping_near_pairs"):
            self.assertEqual(sum(each[count] for each in densities), found.summary[count], count)
        self.assertGreater(found.summary["in_walls"], 0)
        pandas = mock.Mock(DataFrame=dict)
        with mock.patch.dict(sys.modules, pandas=pandas):
            self.assertEqual(list(found.to_dataframe("pairs")), list(pairs))

    def test_walls_of_geometries(self):
        ring = [[0, 0], [3, 0], [3, 3], [0, 3]]
        wkt = "POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))"
        closed = {"type": "Polygon", "coordinates": (tuple(map(tuple, ring + ring[:1])),)}
        with_wkt = lambda **what: mock.Mock(spec=list(what), **what)
        shapely = with_wkt(wkt=wkt)
        lines = {"type": "MultiLineString", "coordinates": [ring + ring[:1]]}
        count = lambda walls: bch.check(self.path, walls=walls, unit=1).summary["in_walls"]
        expected = count(bch.Obstacles.from_wkt(wkt, walkable=True))
        self.assertGreater(expected, 0)
        for walls in (
            *(wkt, shapely, with_wkt(polygon=shapely), closed, with_wkt(__geo_interface__=closed), lines),
            {"type": "Feature", "geometry": closed},
            {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": closed}]},
            {"type": "GeometryCollection", "geometries": [lines]},
            *(ring, [ring], np.array(ring, np.float32), [np.array(ring), np.array(ring) + 50]),
        ):
            with self.subTest(walls):
                self.assertEqual(count(walls), expected)
        self.assertEqual(len(bch.Obstacles.from_wkt([ring, ring])), 2)
        self.assertEqual(len(bch.Obstacles.from_wkt([])), 0)

    def test_arrays_that_are_wrong(self):
        columns = self.columns()
        broken = {name: values.copy() for name, values in columns.items()}
        broken["x"][3] = np.nan
        jumping = {**columns, "x": columns["x"] + 400 * (columns["frame"] == 20)}
        far = np.full(len(columns["id"]), 2**63, np.uint64)
        for kind, words, changed in (
            (ValueError, "^recording: row 3: x nan is not finite$", broken),
            (ValueError, r"^recording: row \d+: person \d+ jumps by 399.* m, ", jumping),
            (ValueError, r"^recording: row \d+: repeats row \d+, person \d+ in", {n: np.tile(v, 2) for n, v in columns.items()}),
            (ValueError, "row 0: id 2.5 is not a whole number", {**columns, "id": columns["id"] + 0.5}),
            (ValueError, "^recording: has no column called 'y', only 'frame, id, x, heading'$", {**columns, "y": None}),
            (ValueError, "^recording: says no frame rate: fps has to give", {**columns, "fps": None}),
            (ValueError, "columns is for files", {**columns, "columns": "frame,id,x,y"}),
            (TypeError, "^y has 719 rows, and frame has 720$", {**columns, "y": columns["y"][1:]}),
            (ValueError, "^recording: column 'x' does not have a number in every row$", {**columns, "x": ["one"]}),
            (ValueError, "^recording: column 'x' does not have a number in every row$", {**columns, "x": columns["x"][:, None]}),
            (IndexError, r"^id\[0\] is 9223372036854775808, above 9223372036854775807$", {**columns, "id": far}),
            (TypeError, "^recording is not given, nor are arrays", {}),
            (TypeError, "^recording is a int; expected a path, or a table with columns by name", {"recording": 7}),
            (ValueError, "^recording: has no column called 'id', only 'x, y'$", {"recording": {n: columns[n] for n in ("x", "y")}}),
            (TypeError, "^recording and y are both given", {"recording": self.path, "y": columns["y"]}),
        ):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                bch.check(**{"fps": 25, **changed})

    def test_options_of_checks(self):
        check = lambda **more: bch.check(self.path, unit=1, **more)
        overlaps = lambda **more: check(**more).summary["overlapping_near_pairs"]
        self.assertEqual(check(walls=bch.Obstacles.from_wkt("LINESTRING(-9 0.6, 9 0.6)")).summary["in_walls"], 0)
        counts = [overlaps(depth=0), overlaps(depth=3), overlaps(leaves="discs"), overlaps()]
        self.assertEqual(counts, sorted(counts, reverse=True))
        self.assertGreater(counts[0], counts[2])
        self.assertLessEqual(overlaps(bodies="spheres", spheres=512), overlaps(bodies="spheres", spheres=64))
        people = [bch.default_male(), bch.default_female()]
        self.assertGreater(overlaps(bodies="spheres", spheres=64, characters=people), 0)
        baked = bch.bake([bch.default_male()], poses=100)
        for more, assumed in (
            ({"characters": [bch.default_male(), bch.default_female()]}, "walks, by its feet, at "),
            ({"characters": baked, "clip_speeds": {"walk": 1.3}}, "walks in walk at 1.3 m/s"),
        ):
            found = check(**more)
            self.assertGreater(found.summary["overlapping_near_pairs"], 0)
            self.assertTrue(any(assumed in line for line in found.assumptions))
        for kind, words, more in (
            (Exception, "frames 0 to 99: more than 5 pairs of people are near each other", {"max_pairs": 5}),
            (ValueError, "does not say how fast people walk", {"characters": baked}),
            (TypeError, "clip_speeds and facing are for", {"facing": 1.5}),
            (TypeError, r"characters\[0\] is a str", {"characters": ["default:male"]}),
            (ValueError, "leaves is 'discs and segments'", {"leaves": "discs and segments"}),
            (ValueError, "bodies is 'capsules'", {"bodies": "capsules"}),
            (ValueError, "expected 64, 128, 256 or 512 spheres, found 65", {"bodies": "spheres", "spheres": 65}),
            (ValueError, "belong to outlines", {"bodies": "spheres", "depth": 3}),
            (ValueError, "baked has outlines", {"bodies": "spheres", "characters": baked, "clip_speeds": {"walk": 1.3}}),
            (TypeError, "walls is a int", {"walls": 3}),
            (ValueError, "^walls: WKT: line 1, column 1: expected POLYGON", {"walls": "SQUARE (0 0, 1 1)"}),
            (TypeError, "walls is a mapping of type 'Walls' without coordinates", {"walls": {"type": "Walls"}}),
            (TypeError, r"walls\[0\] is an array of float64 with shape \(4, 3\)", {"walls": np.zeros((1, 4, 3))}),
        ):
            with self.assertRaisesRegex(kind, words):
                check(**more)

class Interrupts(unittest.TestCase):
    def test_baking_ends_and_leaves_no_file(self):
        with tempfile.TemporaryDirectory() as folder:
            script = f"""
                import bch
                print("begin", flush=True)
                bch.bake(bch.default_male(), poses=200_000, path={folder + "/people.bch"!r})
            """
            baking = subprocess.Popen(
                [sys.executable, "-c", textwrap.dedent(script)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            )
            self.assertEqual(baking.stdout.readline(), "begin\n")
            time.sleep(0.5)
            baking.send_signal(signal.SIGINT)
            _, errors = baking.communicate(timeout=60)
            self.assertTrue(errors.rstrip().endswith("KeyboardInterrupt"), errors)
            self.assertNotIn("ignored", errors)
            self.assertEqual(os.listdir(folder), [])

    def test_a_bar_on_a_terminal(self):
        script = "import bch; bch.bake(bch.default_male(), poses=3000, progress=True)"
        terminal, other = pty.openpty()
        subprocess.run([sys.executable, "-c", script], stderr=other, check=True)
        os.close(other)
        shown = b""
        try:
            while part := os.read(terminal, 4096):
                shown += part
        except OSError:
            pass  # the end of a terminal that nobody writes to
        os.close(terminal)
        self.assertIn(b"baking default:male", shown)
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True)
        self.assertEqual((ended.stdout, ended.stderr), (b"", b""))

class Memory(unittest.TestCase):
    def test_calls_with_out_allocate_nothing(self):
        n = 50_000
        shapes, agents = squares(n)
        pairs = np.stack([np.arange(n - 1), np.arange(1, n)], axis=1).astype(np.uint32)
        hits, gaps = np.empty(len(pairs), bool), np.empty(len(pairs), np.float32)
        depths = np.empty(len(pairs), bch.PENETRATION)
        ways = np.ones(len(pairs))

        def ask():
            bch.collide(shapes, agents, pairs, out=hits)
            bch.within(shapes, agents, pairs, ways, out=hits)
            bch.clearance(shapes, agents, pairs, max_distance=0.5, out=gaps)
            bch.penetration(shapes, agents, pairs, out=depths)
            bch.time_of_impact(shapes, agents, pairs, ways, ways, out=gaps)

        for _ in range(10):  # after these, numpy keeps what it keeps
            ask()
        tracemalloc.start()
        for _ in range(10):
            ask()
        gc.collect()
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        for _ in range(10):
            ask()
        gc.collect()
        after, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        # Structs and numbers of a call, of which numpy keeps some for the next; the smallest answer takes 50 kB.
        self.assertLess(after - before, 10_000)
        self.assertLess(peak - before, 20_000)

    def test_objects_are_freed(self):
        statm = Path("/proc/self/statm")
        resident = lambda: int(statm.read_text().split()[1]) * os.sysconf("SC_PAGESIZE")
        people = bch.bake(bch.default_male(), poses=200)
        make = lambda: bch.DynamicShapeSet(people).shapes
        for _ in range(5):
            make()
        before = resident()
        for _ in range(50):
            make()
        self.assertLess(resident() - before, 10 * people.nbytes)

class Documentation(unittest.TestCase):
    def test_everything_public_explains_itself(self):
        for name in bch.__all__:
            thing = getattr(bch, name)
            if not (inspect.isfunction(thing) or inspect.isclass(thing)):
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            if inspect.isfunction(thing) and inspect.signature(thing).parameters:
                text = inspect.getdoc(thing)
                self.assertTrue("Parameters" in text or len(inspect.signature(thing).parameters) == 1, name)
            for member, function in inspect.getmembers(thing, inspect.isfunction):
                if not member.startswith("_") and function.__module__.startswith("bch"):
                    self.assertTrue(inspect.getdoc(function), f"{name}.{member}")

if __name__ == "__main__":
    unittest.main()
