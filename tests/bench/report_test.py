# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors
"""The experiments of `bch_lab report` at their smallest, and the page that report.py makes of them.

report_test.py BCH_LAB: prints SKIPPED where the page cannot be made, once all else is tested.
"""

import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "bench/report/report.py"
LAB = sys.argv.pop(1)
MISSING = subprocess.run([sys.executable, "-c", "import jinja2, matplotlib, numpy"], capture_output=True, check=False).stderr.decode()
if not MISSING:
    sys.path.insert(0, str(SCRIPT.parent))
    import report


def run(folder, *arguments, data=None):
    environment = {name: value for name, value in os.environ.items() if name != "BCH_TEST_DATA"} | (
        {"BCH_TEST_DATA": data} if data else {})
    subprocess.run([LAB, "report", "--smallest", "--out", folder, *arguments], env=environment, check=True, stdout=subprocess.DEVNULL)


def read(folder, name):
    with open(f"{folder}/{name}.csv", newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def value(rows, column, **where):
    return float(next(row[column] for row in rows if all(row[key] == text for key, text in where.items())))


def make_page(folder):
    subprocess.run([sys.executable, SCRIPT, folder], check=True, stdout=subprocess.PIPE)
    return (pathlib.Path(folder) / "index.html").read_text(encoding="utf-8")


class Tables(unittest.TestCase):
    """What was measured, of all experiments that need no data from elsewhere."""

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = cls.kept.name + "/a b & \"c\""
        run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def subjects(self, experiment, table, column):
        """Returns the values of a column of a table, a list for each subject, by its structure and depth."""
        found = {(row["structure"], row["depth"]): [] for row in read(self.folder, experiment)}
        for row in read(self.folder, f"{experiment}_{table}"):
            found[list(found)[int(row["subject"])]].append(row[column])
        return found

    def test_all_but_times_is_the_same_again(self):
        compared = 0
        with tempfile.TemporaryDirectory() as again:
            run(again)
            names = sorted(path.stem for path in pathlib.Path(self.folder).glob("*.csv"))
            self.assertEqual(names, sorted(path.stem for path in pathlib.Path(again).glob("*.csv")))
            for name in names:
                first, second = read(self.folder, name), read(again, name)
                self.assertEqual(len(first), len(second), name)
                for one, other in zip(first, second) if name != "run" else ():
                    for column in one:
                        if not re.search(r"\(ns|\(us|ns/pair", column):
                            self.assertEqual(one[column], other[column], f"{name}: {column}")
                            compared += 1
        self.assertGreater(compared, 10000)

    def test_seed_draws_other_cases(self):
        with tempfile.TemporaryDirectory() as other:
            run(other, "--experiment", "distance", "--seed", "2")
            self.assertNotEqual(read(other, "distance_slides"), read(self.folder, "distance_slides"))

    def test_a_character_that_is_also_an_output_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            model = pathlib.Path(folder) / "model.obj"
            model.write_text("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", encoding="utf-8")
            (pathlib.Path(folder) / "run.csv").symlink_to(model)
            ended = subprocess.run([LAB, "report", "--smallest", "--out", folder, "--character", model], capture_output=True,
                                   check=False, text=True)
            self.assertEqual(ended.returncode, 2)
            self.assertIn(f"--out: {folder}/run.csv", ended.stderr)
            self.assertTrue(model.read_text(encoding="utf-8").startswith("v 0 0 0"))

    def test_trees_have_their_sizes(self):
        rows = read(self.folder, "construction")
        nodes = lambda structure: value(rows, "nodes a shape", structure=structure)
        self.assertEqual(nodes("single cylinder"), 1)
        for structure in "BCH projected", "OBB projected", "OBB full mesh":
            self.assertEqual(nodes(structure), 2 * 2864 - 1)  # a triangle a leaf
            self.assertTrue(11 < value(rows, "height", structure=structure) < 40)
        tests = self.subjects("query_time", "pairs", "node tests a pair")
        self.assertEqual(set(tests["single cylinder", "all"]), {"1"})
        self.assertTrue(all(float(count) > 5 for count in tests["BCH outline", "all"]))
        self.assertEqual(set(tests["BCH outline in the batch kernel", "all"]), {""})

    def test_slides_end_where_kernel_and_structures_say(self):
        places = self.subjects("depth", "slides", "place (m)")
        for depth in [*map(str, range(13)), "all"]:
            self.assertEqual(places["BCH outline", depth], places["BCH outline in the batch kernel", depth])
        self.assertNotIn("", places["BCH outline", "all"])  # all people collide
        apart = self.subjects("distance", "slides", "distance (cm)")
        self.assertTrue(all(float(cm) < 1e-4 for cm in apart["OBB full mesh", "all"] if cm))
        self.assertTrue(all(float(cm) > 1e-4 for cm in apart["single cylinder", "all"]))

    def test_only_capsules_miss_meshes(self):
        names = [row["structure"] for row in read(self.folder, "bodies")]
        self.assertEqual([sum(kind in name for name in names) for kind in ("capsules", "spheres")], [6, 1])
        hits = read(self.folder, "bodies_hits")
        self.assertEqual({row["ground"] for row in hits}, {"level", "stairs"})
        for row in hits:
            name, meeting = names[int(row["subject"])], int(row["meshes meet"])
            self.assertGreater(meeting, 0)
            self.assertTrue("capsules" in name or row["missed"] == "0", name)
            self.assertTrue(name != "OBB full mesh" or row["false hits"] == "0")
        places = self.subjects("bodies", "slides", "place (m)")
        for (name, _), of in places.items():
            for mesh, place in zip(places["OBB full mesh", "all"], of):
                self.assertTrue("capsules" in name or not mesh or float(place) <= float(mesh) + 2e-6, name)
        self.assertEqual(len({row["subject"] for row in read(self.folder, "bodies_poses")}), len(names) - 1)

    def test_bulky_man_has_the_volume_of_the_papers(self):
        bulky = [float(row["mesh volume (m3)"]) for row in read(self.folder, "volume") if row["character"] == "default:bulky"]
        self.assertTrue(len(bulky) == 2 and all(0.13 < volume < 0.14 for volume in bulky))

    def test_packings_are_dense_and_within_the_hexagonal_bound(self):
        rows = read(self.folder, "density")
        dense = lambda structure: value(rows, "densest (people/m2)", structure=structure)
        for radius in 0.25, 0.40:
            filled = math.pi * radius ** 2 * dense(f"fixed cylinder {radius:.2f} m")
            self.assertTrue(0.7 < filled < 0.9069, filled)
        self.assertGreater(dense("BCH outline to depth all"), 1.2 * dense("single cylinder"))

    def test_run_tells_what_was_run(self):
        facts = {row["what"]: row["value"] for row in read(self.folder, "run")}
        self.assertEqual(facts["command"], f"{LAB} report --smallest --out {self.folder}")
        for what in "processor", "compiler", "commit", "instruction sets", "seed", "poses of a character":
            self.assertNotEqual(facts[what], "", what)

    @unittest.skipIf(MISSING, "no page")
    def test_page_has_figures_tables_and_verdicts(self):
        page = make_page(self.folder)
        self.assertEqual(re.findall(r'<section id="experiment-(\w+)">', page), list(report.TITLES))
        self.assertNotIn("Not in this run", page)
        for name in report.FIGURES:
            self.assertEqual(page.count(f'<figure id="figure-{name}"'), 1, name)
        identifiers = re.findall(r' id="([^"]*)"', page)
        self.assertEqual(len(identifiers), len(set(identifiers)))
        self.assertEqual(page.count("<b class=\"re"), 12)  # verdicts
        self.assertNotIn(report.INK, page)  # text and axes take the page's colours, light or dark
        self.assertIn("prefers-color-scheme: dark", page)
        self.assertNotRegex(page, r"[^.\d]100 %")  # of few cases: 6 of 6
        data = report.Folder(pathlib.Path(self.folder))
        tables = report.summarised(data)
        for name, rows in tables.items():
            shown = re.search(f'<table id="table-{name}">.*?<tbody>(.*?)</tbody>', page, re.DOTALL)
            self.assertEqual(shown[1].count("<tr>"), len(rows), name)
        self.assertIn("a b &amp; &#34;c&#34;", page)  # the command
        self.assertIn(f'<td class="number">{report.brief(tables["distance"][1]["mean (cm)"])}</td>', page)
        # Paper times stand beside its own protocol alone.
        self.assertEqual(len(report.known(tables["query_time"].column("the paper (ns/pair)"))), 3)

    @unittest.skipIf(MISSING, "no page")
    def test_sentences_and_verdicts_come_from_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in "run", "depth", "depth_pairs", "depth_times", "depth_slides":
                (pathlib.Path(folder) / f"{name}.csv").write_bytes((pathlib.Path(self.folder) / f"{name}.csv").read_bytes())
            file = pathlib.Path(folder) / "depth_slides.csv"
            header, *rows = file.read_text(encoding="utf-8").splitlines()
            self.assertRegex(make_page(folder), r'class="reproduced">Reproduced.</b> It is\s+8\.')
            # Of the kernel, subjects 0 to 13 are depths 0 to 12 and all; now the last four come ever nearer.
            nearer = {10: "8", 11: "4", 12: "2", 13: "1"}
            file.write_text("\n".join([header] + [
                ",".join([*row.split(",")[:3], nearer.get(int(row.split(",")[0]), row.split(",")[3])]) for row in rows]), encoding="utf-8")
            self.assertRegex(make_page(folder), r'class="reversed">Reversed.</b> It is\s+all\.')
            figure = pathlib.Path(folder) / "figure.svg"
            subprocess.run([sys.executable, SCRIPT, folder, "--figure", "depth", "--output", figure], check=True)
            self.assertRegex(figure.read_text(encoding="utf-8"), r"(?s)^<\?xml.*<svg.*maximum recursion depth.*</svg>\s*$")


class Data(unittest.TestCase):
    """Experiments with a character and recordings of the test data."""

    def setUp(self):
        self.data = os.environ.get("BCH_TEST_DATA")
        if not self.data:
            self.skipTest("BCH_TEST_DATA is not set")

    def test_real_people_are_detected_nearer_by_tighter_bodies(self):
        with tempfile.TemporaryDirectory() as folder:
            run(folder, "--experiment", "distance", "--character", f"{self.data}/characters/rocketbox_male_cmu.glb")
            names = [row["structure"] for row in read(folder, "distance")]
            apart = {name: [] for name in names}
            for row in read(folder, "distance_slides"):
                apart[names[int(row["subject"])]].append(float(row["distance (cm)"] or "nan"))
        mean = lambda structure: sum(apart[structure]) / len(apart[structure])
        self.assertTrue(mean("OBB outline") < mean("BCH outline") < mean("single cylinder"))

@unittest.skipIf(MISSING, "no page")
class Parts(unittest.TestCase):
    def test_numbers_are_shown_in_three_digits(self):
        for number, text in {12345.6: "12 346", -1234: "-1 234", 456.7: "457", 45.67: "45.7", 4.567: "4.57", 0.012345: "0.0123",
                             20: "20", 0: "0", 1.1711490269966849e-07: "1.17e-07", -0.00012345: "-0.000123",
                             1e300: "1e+300", math.nan: "–"}.items():
            self.assertEqual(report.brief(number), text)

    def test_shares_of_few_cases_are_told_by_their_number(self):
        self.assertEqual(report.shown(report.Share(20, 20)), "20 of 20")
        self.assertEqual(report.shown(report.Share(100, 200)), "50")
        self.assertEqual(report.shown(report.Share(0, 0)), "–")

    def test_quartiles_are_interpolated(self):
        self.assertEqual(report.quartiles([4, 1, math.nan, 2, 3]), [1.75, 2.5, 3.25])

    def test_random_numbers_are_those_of_splitmix64(self):
        self.assertEqual([hex(z) for z in report.splitmix(0, 2)], ["0xe220a8397b1dcdaf", "0x6e789e6aa1b965f4"])  # of its authors

    def test_bootstrap_is_as_wide_as_the_normal_interval(self):
        mean, deviation, low, high = report.estimate([i % 20 for i in range(400)], 5)
        self.assertAlmostEqual(mean, 9.5)
        self.assertAlmostEqual(deviation, 5.773, delta=0.01)
        self.assertAlmostEqual(low, 9.5 - 1.96 * deviation / 20, delta=0.08)
        self.assertAlmostEqual(high, 9.5 + 1.96 * deviation / 20, delta=0.08)

    def test_shares_have_wilsons_interval(self):
        low, high = report.wilson(report.Share(1, 10))  # a figure of many textbooks
        self.assertAlmostEqual(low, 1.79, delta=0.01)
        self.assertAlmostEqual(high, 40.42, delta=0.01)
        self.assertEqual(report.wilson(report.Share(0, 10))[0], 0)

    def test_front_has_what_nothing_beats(self):
        nan = math.nan
        points = [dict(zip(("structure", "error", "missed collisions (%)", "crowd (ns/pair)", "near miss (ns/pair)"), row),
                       depth="all", semantics="boundary") for row in (
            ("exact and slow", 0, 0, 90, 100), ("beaten", 5, 0, 91, 101), ("fast", 20, 0, 2, 3), ("fast and missing", 1, 2, 1, 1),
            ("as good and slower", 20, 0, 3, 4), ("good", 6, 0, 10, 101), ("not known", nan, 0, 1, 1))]
        self.assertEqual([f"{row['pairs']} {row['structure']}" for row in report.front(points, "error")],
                         ["crowd exact and slow", "crowd good", "crowd fast", "near miss exact and slow", "near miss fast"])

    def test_facts_of_a_run_stand_as_they_are(self):
        with tempfile.TemporaryDirectory() as folder:  # a commit that reads as a number, and nothing measured
            (pathlib.Path(folder) / "run.csv").write_text("what,value\ncommand,bch_lab report\ncommit,16e6464\n", encoding="utf-8")
            page = make_page(folder)
        self.assertIn("<td>16e6464</td>", page)
        self.assertIn("Tried,\nand not kept.", page)  # needs no table
        self.assertEqual(page.count("Not in this run"), len(report.TITLES))
        self.assertNotIn("From depth 9", page)

    def test_a_folder_without_a_run_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, check=False, text=True)
        self.assertEqual(ended.returncode, 1)
        self.assertIn(f"{folder}/run.csv: expected what `bch_lab report --out {folder}` writes, found no such file", ended.stderr)


if __name__ == "__main__":
    if unittest.main(exit=False).result.wasSuccessful():
        print(f"SKIPPED: the page needs python3-matplotlib and python3-jinja2: {MISSING}" if MISSING else "all passed")
    else:
        sys.exit(1)
