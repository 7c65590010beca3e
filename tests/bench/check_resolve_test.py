# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Tests recordings whose people are moved until no bodies overlap. Usage: check_resolve_test.py BCH"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BCH = sys.argv.pop(1)
DATA = os.environ.get("BCH_TEST_DATA")
SAID = re.compile(
    r"resolved +([0-9 ]+) overlaps? in frames before, ([0-9 ]+) after\n"
    r"shift +([0-9.]+) m on average, ([0-9.]+) m at most\n"
    r"speed +changed by ([0-9.]+) m/s on average, by ([0-9.]+) m/s at most\n"
)


def resolve(file, to, *options):
    """Return the numbers of the report: overlaps before and after, shift and change of speed, means and largest."""
    run = subprocess.run([BCH, "check", str(file), "--resolve", str(to), *options], capture_output=True, text=True)
    said = SAID.search(run.stdout)
    if run.returncode != 0 or not said:
        raise AssertionError(run.stderr + run.stdout)
    return [float(number.replace(" ", "")) for number in said.groups()]


class Resolved(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.out = pathlib.Path(self.folder.name) / "out.csv"

    def test_two_who_meet(self):
        """They walk through each other. The answer is the same for any number of threads, and can be checked."""
        two = self.out.with_name("two.csv")
        rows = [f"7,{k},{-2.4 + 0.048 * k},0\n5,{k},{2.4 - 0.048 * k},0.1\n" for k in range(100)]
        two.write_text("id,frame,x,y\n" + "".join(rows))
        options = ["--fps", "25", "--unit", "m"]
        before, after, _, shift, _, _ = resolve(two, self.out, *options, "--threads", "1")
        self.assertGreater(before, 5)
        self.assertEqual(after, 0)
        self.assertGreater(shift, 0.1)
        first = self.out.read_text()
        self.assertEqual(len(first.splitlines()), 201)
        resolve(two, self.out, *options, "--threads", "3")
        self.assertEqual(self.out.read_text(), first)
        self.assertLess(resolve(self.out, two, "--unit", "m")[0], before / 2)

    @unittest.skipUnless(DATA, "BCH_TEST_DATA is not set")
    def test_recorded_people_are_moved_by_little(self):
        for file, options in (
            ("juelich_unidirectional_uo-050-180-180.txt", ["--fps", "16", "--unit", "cm"]),
            ("single_file_n56_cam1.csv", ["--fps", "25", "--unit", "m"]),
            ("jpscore_corner_traj.txt", []),
            ("pathfinder.csv", []),
        ):
            with self.subTest(file):
                before, after, shift, _, change, _ = resolve(pathlib.Path(DATA, "trajectories", file), self.out, *options)
                self.assertGreater(before, 100)
                self.assertEqual(after, 0)
                self.assertLess(shift, 0.02)
                self.assertLess(change, 0.1)


if __name__ == "__main__":
    unittest.main()
