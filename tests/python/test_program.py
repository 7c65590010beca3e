# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The command bch of an installed wheel, where nothing that the wheel lacks is installed."""

import re
import sqlite3
import subprocess
import tempfile
import unittest
from pathlib import Path

import bch


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_bch(self, *words):
        return subprocess.run(["bch", *words], cwd=self.folder, capture_output=True, text=True)

    def test_version(self):
        self.assertEqual(self.run_bch("--version").stdout.split()[-1], bch.__version__)

    def test_shapes(self):
        self.assertEqual(self.run_bch("bake", "default:male", "--output", "male.bch").returncode, 0)
        self.assertGreater(len(bch.ShapeSet.load(self.folder / "male.bch")), 0)

    def test_gate(self):
        """The command of the workflow for a simulator's CI, on a JuPedSim recording of two people who walk 10 cm from each other."""
        recording = sqlite3.connect(self.folder / "crowd.sqlite")
        recording.execute("CREATE TABLE metadata (key TEXT, value TEXT)")
        recording.execute("CREATE TABLE trajectory_data (frame INT, id INT, pos_x REAL, pos_y REAL, ori_x REAL, ori_y REAL)")
        recording.executemany("INSERT INTO metadata VALUES (?, ?)", [("version", "1"), ("fps", "10")])
        rows = [(frame, person, 0.1 * frame + 0.1 * person, 0, 1, 0) for frame in range(20) for person in range(2)]
        recording.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)", rows)
        recording.commit()
        recording.close()
        workflow = Path(__file__).with_name("crowd.yml").read_text()
        (command,) = re.findall(r"- run: bch (check crowd\.sqlite .*)", workflow)
        self.assertEqual(self.run_bch("check", "crowd.sqlite").returncode, 0)
        self.assertEqual(self.run_bch(*command.split()).returncode, 1)
        for name in ("overlaps.html", "overlaps.csv"):
            self.assertTrue((self.folder / name).read_text())

    def test_what_is_missing_is_named(self):
        (self.folder / "person.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        refused = self.run_bch("bake", "person.obj", "--output", "person.bch")
        self.assertEqual(refused.returncode, 3)
        self.assertIn("person.obj: files of characters are read by assimp", refused.stderr)
        with self.assertRaises(ImportError) as caught:
            bch.import_character(self.folder / "person.obj")
        self.assertIn("libassimp5", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
