#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors
"""Draws and judges what `bch_lab report --out DIR` measured.

report.py DIR                             writes DIR/index.html, one page with figures, tables and verdicts
report.py DIR --figure NAME --output SVG  draws one figure by itself
"""

import argparse
import collections
import csv
import html
import io
import math
import pathlib
import re
import sys

import jinja2
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

KERNEL, EXACT = "BCH outline in the batch kernel", "BCH outline with exact leaves"
TITLES = {  # of the experiments, in the order of the page
    "error_time": "Error against run time", "bodies": "Bodies in space", "construction": "Construction time", "query_time": "Query time",
    "distance": "Distance at detection", "depth": "Depth", "volume": "Represented volume",
    "mesh_detail": "Mesh detail", "density": "Crowd density", "detail": "Detail by density",
    "motions": "Motions", "stability": "Stability", "stiff": "Stiff contact"}
# What the paper reports: times of a pair (ns), distances at detection (cm), the critical depth, and table 1 with what the text says of the
# meshes (mean, median, deviation), of its woman and its man.
PAPER_TIMES = {"BCH outline": 2660, "OBB outline": 4630, "OBB projected": 20660}
PAPER_DISTANCES = {"single cylinder": 20, "BCH outline": 5, "OBB outline": 4, "OBB full mesh": 0}
PAPER_CRITICAL_DEPTH = 9
RADIUS, CYLINDER, LEAVES, MESH = ("cylinder radius (m)", "cylinder over mesh volume", "BCH over mesh volume",
                                  "mesh volume (m3)")
WOMAN = {RADIUS: (0.34, 0.31, 0.05), CYLINDER: (11.09, 9.50, 3.55), LEAVES: (4.61, 4.27, 0.76),
         MESH: (math.nan, math.nan, 0.01)}
MAN = {RADIUS: (0.42, 0.40, 0.05), CYLINDER: (7.70, 6.99, 1.75), LEAVES: (3.57, 3.34, 0.51),
       MESH: (math.nan, math.nan, 0.01)}
PAPER_VOLUMES = {"default:female": WOMAN, "default:male": MAN, "default:bulky": MAN}
ERRORS = {"distance": "mean (cm)", "false": "false positives (%)"}  # of experiment error_time
MESHES = "OBB full mesh"  # of experiment bodies
SAME_PLACE = 2e-6  # m: places of slides are bisected to a micrometre
PROMISED_GAP = 4  # um per metre of extent, see layout/base/rounding.hpp


# Tables.


class Share(float):
    """A share in percent, which knows its cases: few of them are told by their number."""

    def __new__(cls, part, whole):
        share = super().__new__(cls, 100 * part / whole if whole else math.nan)
        share.part, share.whole = int(part), int(whole)
        return share


class Table(list):
    """Rows as dictionaries; all have the same columns."""

    def where(self, **fixed):
        return Table(row for row in self if all(row[column] == value for column, value in fixed.items()))

    def value(self, column, **fixed):
        found = self.where(**fixed)
        if not found:
            raise LookupError(f"a table has no row with {fixed}; its first has {self[0] if self else 'no columns'}")
        return found[0][column]

    def column(self, name):
        return [row[name] for row in self]

    def groups(self, *columns):
        """Returns the rows with the same values in these columns, by these values, in the order of the rows."""
        parts = collections.defaultdict(Table)
        for row in self:
            parts[row[columns[0]] if len(columns) == 1 else tuple(row[c] for c in columns)].append(row)
        return parts


def parsed(cell):
    if cell == "":
        return math.nan
    return float(cell) if re.fullmatch(r"-?(\d+(\.\d+)?(e[-+]\d+)?|inf)", cell) else cell


def read(file):
    """Returns a table with numbers where they are some. What stands in a column `value` is a name: a commit may read as a number."""
    with open(file, newline="", encoding="utf-8") as stream:
        return Table({column: cell if column == "value" else parsed(cell) for column, cell in row.items()}
                     for row in csv.DictReader(stream))


# Statistics.


def known(values):
    return [value for value in values if not math.isnan(value)]


def splitmix(seed, count):
    """The first numbers of splitmix64 (Steele, Lea, Flood 2014), as layout/base/random.hpp draws them."""
    z = np.uint64(seed) + np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return z ^ (z >> np.uint64(31))


def estimate(values, seed, resamples=1000):
    """Returns the mean, the standard deviation and the mean's 95 % interval by the percentile bootstrap, the same for a seed
    everywhere. Source: B. Efron, R. Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13."""
    values = np.array(known(values))
    if not len(values):
        return (math.nan,) * 4
    drawn = ((splitmix(seed, resamples * len(values)) >> np.uint64(32)) * np.uint64(len(values))) >> np.uint64(32)
    means = values[drawn.astype(np.int64).reshape(resamples, -1)].mean(axis=1)
    deviation = values.std(ddof=1) if len(values) > 1 else 0.0
    return float(values.mean()), float(deviation), *map(float, np.quantile(means, [0.025, 0.975]))


def quartiles(values):
    return [float(q) for q in np.quantile(known(values), [0.25, 0.5, 0.75])] if known(values) else [math.nan] * 3


def wilson(share):
    """Returns the 95 % interval of a share. Source: E. B. Wilson, "Probable inference, the law of succession, and statistical
    inference", JASA 22, 1927."""
    if not share.whole:
        return math.nan, math.nan
    z, n, p = 1.959963984540054, share.whole, share.part / share.whole
    centre = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return 100 * max(0.0, centre - half), 100 * min(1.0, centre + half)


# Summaries: from what was measured to the tables of the page. Each adds to `out`, by name.


class Folder(dict):
    """The measured tables of a folder, and statistics with the seed of the run."""

    def __init__(self, path):
        super().__init__((file.stem, read(file)) for file in sorted(path.glob("*.csv")))
        if "run" not in self:
            sys.exit(f"{path}/run.csv: expected what `bch_lab report --out {path}` writes, found no such file")
        self.seed = int(self["run"].value("value", what="seed")) if self["run"].where(what="seed") else 1

    def mean(self, values, name="mean (cm)", intervals="mean"):
        mean, _, low, high = estimate(values, self.seed)
        return {name: mean, f"{intervals} (95 % low)": low, f"{intervals} (95 % high)": high}

    def distances(self, values):
        low, median, high = quartiles(values)
        return {**self.mean(values), "lower quartile (cm)": low, "median (cm)": median, "upper quartile (cm)": high,
                "standard deviation (cm)": estimate(values, self.seed)[1], "cases": len(values),
                "never detected": len(values) - len(known(values))}

    def subjects(self, name):
        """Returns a row for each subject of an experiment: what it is, its times, hits and tests of pairs, and the distances at
        which it detects people who slide at each other. Leaves out what no subject has."""
        pairs, slides = (self.get(f"{name}_{kind}", Table()).groups("subject") for kind in ("pairs", "slides"))
        taken, table = self.get(f"{name}_times", Table()).groups("subject", "pairs"), Table()
        for subject in self[name]:
            row = {column: value for column, value in subject.items() if column != "subject"}
            for asked in pairs[subject["subject"]]:
                on = asked["pairs"].replace("_", " ")
                row |= spread(taken[subject["subject"], asked["pairs"]].column("ns/pair"), f"{on} (ns/pair)", on)
                row |= {f"{on}: hits (%)": Share(asked["hits"], asked["asked"]),
                        f"{on}: node tests": asked["node tests a pair"], f"{on}: leaf tests": asked["leaf tests a pair"]}
            if slides:
                row |= self.distances(slides[subject["subject"]].column("distance (cm)"))
            table.append(row)
        kept = [column for column in table[0] if not all(is_nan(row[column]) for row in table)]
        return Table(key(row, *kept) for row in table)


def is_nan(value):
    return isinstance(value, float) and math.isnan(value)


def key(row, *columns):
    return {column: row[column] for column in columns}


def spread(values, name, quartiles_of):
    low, median, high = quartiles(values)
    return {name: median, f"{quartiles_of} (25 %)": low, f"{quartiles_of} (75 %)": high}


def front(points, error):
    """Returns the Pareto front of time and one error, in a crowd and on near misses: of the rows that miss no collision, those
    that no other one equals or beats in both. By ascending error."""
    out = Table()
    for pairs in "crowd", "near miss":
        time, fastest = f"{pairs} (ns/pair)", math.inf
        rows = [row for row in points if row["missed collisions (%)"] == 0 and not math.isnan(row[error])]
        for row in sorted(rows, key=lambda row: (row[error], row[time])):
            if row[time] < fastest:
                fastest = row[time]
                out.append({"pairs": pairs, error: row[error], "ns/pair": fastest,
                            **key(row, "structure", "depth", "semantics")})
    return out


def error_time(data, out):
    table = data.subjects("error_time")
    for row in table:
        wrong, found = row["near miss: hits (%)"], row["colliding: hits (%)"]
        low, high = wilson(wrong)
        row |= {"false positives (%)": wrong, "false positives (95 % low)": low, "false positives (95 % high)": high,
                "missed collisions (%)": Share(found.whole - found.part, found.whole)}
    out["error_time"] = table
    for name, error in ERRORS.items():
        out[f"error_time_{name}"] = front(table, error)


def bodies(data, out):
    agents = float(data["run"].value("value", what="agents of the crowd"))
    hits, slides, poses = (data[f"bodies_{name}"].groups("subject") for name in ("hits", "slides", "poses"))
    places = [slides[i].column("place (m)") for i in range(len(data["bodies"]))]
    meshes = places[data["bodies"].column("structure").index(MESHES)]
    out["bodies"] = Table()
    for i, row in enumerate(data.subjects("bodies")):
        asked, *stairs = hits[i]
        earlier = [1000 * (mesh - place) for mesh, place in zip(meshes, places[i]) if not is_nan(mesh) and not is_nan(place)]
        later = [is_nan(place) or place > mesh + SAME_PLACE for mesh, place in zip(meshes, places[i]) if not is_nan(mesh)]
        pose = spread(poses[i].column("pose (us)") if i in poses else [], "pose (us)", "pose")
        out["bodies"].append({
            **key(row, "structure", "bytes a shape", "crowd (ns/pair)", "crowd (25 %)", "crowd (75 %)"), **pose,
            "frame (us an agent)": pose["pose (us)"] + row["crowd (ns/pair)"] * asked["asked"] / agents / 1000,
            **data.mean(earlier, "earlier than meshes (mm)", "earlier"), "later than meshes (% of slides)": Share(sum(later), len(later)),
            "mean (cm)": row["mean (cm)"], "false hits (% of mesh hits)": Share(asked["false hits"], asked["meshes meet"]),
            "on stairs (% of mesh hits)": Share(stairs[0]["false hits"], stairs[0]["meshes meet"]) if stairs else math.nan,
            "missed (% of mesh hits)": Share(asked["missed"], asked["meshes meet"])})


def construction(data, out):
    built = data["construction_times"].groups("structure")
    out["construction"] = Table({**row, **build_times(built[row["structure"]])} for row in data["construction"])
    out["construction_stages"] = Table(
        {"stage": stage, **build_times(rows)} for stage, rows in data["construction_stages"].groups("stage").items())


def build_times(rows):
    return {**spread(rows.column("build (us)"), "build (us)", "build"), "poses": len(rows)}


def query_time(data, out):
    out["query_time"] = data.subjects("query_time")
    for row in out["query_time"]:
        row["the paper (ns/pair)"] = PAPER_TIMES.get(row["structure"], math.nan)


def distance(data, out):
    out["distance"] = data.subjects("distance")
    for row in out["distance"]:
        row["the paper (cm)"] = PAPER_DISTANCES.get(row["structure"], math.nan)


def depth(data, out):
    table, critical = out["depth"], out["depth_critical"] = data.subjects("depth"), Table()
    for structure, rows in table.groups("structure").items():
        means, first = rows.column("mean (cm)"), len(rows) - 1
        while first > 0 and means[first - 1] <= 1.01 * means[-1]:
            first -= 1
        critical.append({"structure": structure, "the paper": PAPER_CRITICAL_DEPTH if structure == KERNEL else math.nan,
                         "critical depth": rows[first]["depth"], "mean without limit (cm)": means[-1]})


def volume(data, out):
    quantities = out["volume_paper"] = Table()
    for character, rows in data["volume"].groups("character").items():
        mesh = rows.column("mesh volume (m3)")
        by_mesh = rows[0]["height (m)"] / estimate(mesh, data.seed)[0]
        for quantity, values in {RADIUS: rows.column("radius (m)"),
                                 CYLINDER: [math.pi * row["radius (m)"] ** 2 * by_mesh for row in rows],
                                 LEAVES: [row["leaf discs (m2)"] * by_mesh for row in rows], MESH: mesh}.items():
            paper = PAPER_VOLUMES.get(character, {}).get(quantity, (math.nan,) * 3)
            mean, deviation, low, high = estimate(values, data.seed)
            quantities.append({
                "character": character, "quantity": quantity, "paper (mean)": paper[0], "mean": mean,
                "paper (median)": paper[1], "median": quartiles(values)[1], "paper (deviation)": paper[2],
                "standard deviation": deviation, "mean (95 % low)": low, "mean (95 % high)": high, "poses": len(values)})


def mesh_detail(data, out):
    builds = data["mesh_detail_builds"].groups("triangles", "structure")
    for row in data.subjects("mesh_detail"):
        built = "OBB full mesh" if row["structure"] == "OBB full mesh" else "BCH outline"  # the kernel's as well
        out.setdefault("mesh_detail", Table()).append(
            {"triangles": row["of"], **row, "build (us)": build_times(builds[row["of"], built])["build (us)"]})


def density(data, out):
    table = out["density"] = Table()
    for (structure, people), rows in data["density"].groups("structure", "people").items():
        mean, _, low, high = estimate(rows.column("densest (people/m2)"), data.seed)
        table.append({"structure": structure, "densest (people/m2)": mean, "95 % low": low,
                      "95 % high": high, "times the single cylinder's": mean / (table[0]["densest (people/m2)"]
                                                                                if table else mean),
                      "people": people, "packings": len(rows)})


def detail(data, out):
    frames = data["detail_times"].groups("people per m2", "detail")
    out["detail"] = Table()
    for row in data["detail"]:
        of = frames[row["people per m2"], row["detail"]]
        each = row["people"] * row["seconds"] / 2  # both of a pair stop
        out["detail"].append({
            **key(row, "people per m2", "detail"), "false stops per person and second": row["false stops"] / each,
            "true stops per person and second": row["true stops"] / each,
            "missed (%)": Share(row["missed (pair-frames)"], row["colliding (pair-frames)"]),
            **spread(of.column("tests (ns a person)"), "tests of a frame (ns a person)", "tests"),
            "levels of a frame (ns a person)": quartiles(of.column("levels (ns a person)"))[1]})


def motions(data, out):
    costs, table = data["motions_costs"], Table()
    for rate, rows in data["motions"].groups("samples a second").items():
        touching = [row for row in rows if row["first contact (s)"] < math.inf]
        late = [1000 * (row["first sample that collides (s)"] - row["first contact (s)"]) for row in touching
                if row["first sample that collides (s)"] < math.inf]
        table.append({"samples a second": rate, "pairs": len(rows), "contacts": len(touching),
                      "contacts missed": len(touching) - len(late), "lateness, least (ms)": min(late, default=math.nan),
                      "lateness, mean (ms)": sum(late) / len(late) if late else math.nan,
                      "lateness, most (ms)": max(late, default=math.nan),
                      **{f"{how}, {pairs} pair (us)": costs.value("a pair (us)", how=each, pairs=pairs)
                         for how, each in (("sampled", f"{rate:g} samples a second"), ("first contact", "first contact"))
                         for pairs in ("touching", "free")}})
    out["motions_contacts"] = table


def stability(data, out):
    table = out["stability"] = Table()
    names = "float", "double", "bch"
    for row in (row for row in data["stability"] if isinstance(row["refused"], float)):  # an empty cell
        apart = row["pairs"] - row["meeting"]
        table.append({
            **key(row, "family", "title", "axis", "value", "conditioning"), "pairs near contact": row["pairs"],
            "of them meeting": row["meeting"],
            **{f"{name}: missed (%)": Share(row[f"{name}: misses"], row["meeting"]) for name in names},
            **{f"{name}: false hits (%)": Share(row[f"{name}: false hits"], apart) for name in names},
            **{f"{name}: largest error (um/m)": 1e6 * max(row[f"{name}: deepest miss (m/m of extent)"],
                                                          row[f"{name}: largest gap (m/m of extent)"]) for name in names},
            "outlines that meet": row["outlines meeting"], "outlines missed by bch": row["outline misses"]})
    out["stability_refused"] = Table({"case": f"{row['title']}: {row['value']}", "exception": row["refused"]}
                                     for row in data["stability"] if isinstance(row["refused"], str))


def stiff(data, out):
    out["stiff"] = data["stiff"]


def summarised(data):
    """Returns the tables of the page, of the experiments that were run."""
    out = {}
    for name in TITLES:
        if name in data:
            globals()[name](data, out)
    return out


# Figures. Colours can be told apart by the colour-blind (M. Okabe, K. Ito, 2008) and read on white as on black; INK becomes the
# colour of the page's text, PAPER that of what is behind it.

INK, PAPER = "#010203", "#fdfcfb"
COLOURS = [INK, "#1f8fd6", "#e0641b", "#0aa378", "#d06fa8", "#d99a06", "#4fb3e8", "#8a8a8a", "#8d4fd3"]
MARKERS = "osD^vP<>p"
plt.rcParams.update({
    "svg.fonttype": "none", "font.family": "DejaVu Sans", "font.size": 11,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True, "grid.alpha": 0.15, "grid.color": INK,
    "legend.frameon": False, "legend.fontsize": 10, "lines.markersize": 5.5, "lines.linewidth": 1.6,
    "figure.facecolor": "none", "axes.facecolor": "none",
    **{name: INK for name in ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color")}})
Figure = collections.namedtuple("Figure", "draw caption wide")  # draw: a function of measured tables and those of the page
FIGURES = {}


def draws(name, caption, *arguments, wide=False):
    """Registers a function as what draws a figure; with arguments, these follow the tables."""
    def register(function):
        FIGURES[name] = Figure(lambda data, out: function(data, out, *arguments), caption, wide)
        return function
    return register


def chart(xlabel, ylabel, size=(6.4, 4.6), panels=1, **options):
    _, axes = plt.subplots(1, panels, figsize=size, squeeze=False, layout="constrained")
    for ax in axes[0]:
        ax.set(xlabel=xlabel, ylabel=ylabel, **options)
    return axes[0] if panels > 1 else axes[0][0]


def legend(ax, columns=2):
    """Puts the legend below; there is none of what was not drawn."""
    if ax.get_legend_handles_labels()[0]:
        ax.figure.legend(*ax.get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0), ncol=columns)


def style(i, **others):
    return {"color": COLOURS[i % 9], "marker": MARKERS[i % 9], **others}


def series(ax, rows, x, y, label, spread_of=None, **looks):
    """Draws the rows that have numbers; with bars of quartiles or intervals, (25 %) or (95 % low) and so on."""
    rows = [row for row in rows if not is_nan(row[x]) and not isinstance(row[x], str) and not is_nan(row[y])]
    if not rows:
        return
    bars = None
    if spread_of:
        ends = [f"{spread_of} ({end})" for end in
                (("25 %", "75 %") if f"{spread_of} (25 %)" in rows[0] else ("95 % low", "95 % high"))]
        bars = [[abs(row[end] - row[y]) for row in rows] for end in ends]
    ax.errorbar([row[x] for row in rows], [row[y] for row in rows], yerr=bars, label=label, elinewidth=1, **looks)


def dots(ax, labels, values, lows, highs, shift=0, **looks):
    """Draws values with bars beside names, the first on top."""
    places = range(len(labels))
    ax.errorbar(values, [place + shift for place in places], xerr=[[v - l for v, l in zip(values, lows)], [h - v for v, h in zip(values, highs)]],
                elinewidth=1, **{**style(1, linestyle="none"), **looks})
    ax.set_yticks(places, labels)
    ax.set_ylim(len(labels) - 0.5, -0.5)


# What figures of errors against times show: patterns of names of structures.
FAMILIES = {
    "exact leaves: batch kernel": EXACT, "discs, by depth: batch kernel": KERNEL, "discs, by depth: pair by pair": "BCH outline",
    "OBB tree of outlines, by depth": "OBB outline", "OBB tree of meshes, by depth": MESHES, "single cylinder": "single cylinder",
    "fixed cylinders": "fixed.*", "15 capsules: holding, between, thin": "15 capsules.*", "32 capsules, likewise": "32 capsules.*",
    "bodies of 64 to 512 spheres": r"\d+ spheres"}


def draw_families(ax, rows, x, y, missed):
    """Draws a family as a line, hollow where a structure misses hits. Small errors have more room than large ones."""
    for (label, pattern), i in zip(FAMILIES.items(), (2, 1, 3, 4, 5, 0, 0, 6, 7, 8)):
        of = [row for row in rows if re.fullmatch(pattern, row["structure"]) and not is_nan(row[y])]
        series(ax, of, x, y, label, **style(i, linestyle="none" if pattern == "fixed.*" else "-", linewidth=1.2, markerfacecolor=PAPER))
        series(ax, [row for row in of if row[missed] == 0], x, y, None, **style(i, linestyle="none"))
        for row in of:
            name, share = row["structure"].replace(" spheres", ""), row[missed]
            if name.isdigit() or share:
                text, place, side = (name, (-5, -10), "right") if name.isdigit() else (f"misses {share:.{0 if share >= 1 else 2}f} %", (7, -4), "left")
                ax.annotate(text, (row[x], row[y]), place, textcoords="offset points", fontsize=9, ha=side)
    ax.set_yscale("function", functions=(lambda v: np.sign(v) * np.sqrt(np.abs(v)), lambda v: np.sign(v) * v * v))
    least, most = (of(row[y] for row in rows if not is_nan(row[y])) for of in (min, max))
    number_ticks(ax.yaxis, [tick for tick in (-10, 0, 1, 2, 5, 10, 20, 30, 40, 60, 80, 100) if tick >= min(0, 2 * least)])
    ax.set_ylim(min(-0.001 * most, 2 * least), 1.1 * most)
    legend(ax)


@draws("error_time_false_near", "The same against the time of a near miss.", "false", "near miss")
@draws("error_time_false_crowd", "Share of near misses taken for collisions, against the time of a pair in a crowd; hollow: misses collisions.", "false", "crowd")
@draws("error_time_distance_near", "The same against the time of a near miss.", "distance", "near miss")
@draws("error_time_distance_crowd", "Mean distance of two meshes when a collision is reported, against the time of a pair in a crowd; "
       "hollow: misses collisions.", "distance", "crowd")
def draw_error_time(data, out, name, pairs):
    ax = chart("time of a pair in a crowd, one thread (ns)" if pairs == "crowd" else "time of a near miss, one thread (ns)",
               "meshes still apart when reported (cm)" if name == "distance" else "near misses taken for collisions (%)", (5.8, 5.2), xscale="log")
    # Who misses a sixth of all collisions comes near.
    rows = [row for row in out["error_time"] if name == "false" or not row["structure"].startswith("fixed")]
    draw_families(ax, rows, f"{pairs} (ns/pair)", ERRORS[name], "missed collisions (%)")
    number_ticks(ax.xaxis, (10, 100, 1000, 10000))


@draws("bodies_live_slides", "How much earlier than the meshes people who slide towards each other are reported, likewise.", "frame (us an agent)", "earlier than meshes (mm)")
@draws("bodies_live", "False hits in a crowd against what an agent costs in a frame in which everybody is posed anew, from the transforms of joints to "
       "answers; hollow: misses hits of the meshes.", "frame (us an agent)", "false hits (% of mesh hits)")
@draws("bodies_crowd_slides", "How much earlier than the meshes people who slide towards each other are reported, likewise.", "crowd (ns/pair)", "earlier than meshes (mm)")
@draws("bodies_crowd", "False hits in a crowd against the time of a pair; hollow: misses hits of the meshes.", "crowd (ns/pair)", "false hits (% of mesh hits)")
def draw_bodies(data, out, time, error):
    ax = chart("time of an agent in a frame, one thread (µs)" if "frame" in time else "time of a pair in a crowd, one thread (ns)",
               error.replace("(% of mesh hits)", "in a crowd (% of the meshes')"), (5.8, 4.8), xscale="log")
    draw_families(ax, out["bodies"][:-1], time, error, "missed (% of mesh hits)")  # all but the meshes
    number_ticks(ax.xaxis, (50, 100, 200, 500) if "ns" in time else (0.5, 1, 2, 5, 10, 20, 50, 100))


@draws("construction_stages", "The stages from keys of a clip to a flat shape with levels and inscribed discs, likewise.", "stage", {})
@draws("construction", "Time to build a structure of one pose, without the outline where it is made from one: medians; bars are quartiles over poses.", "structure", {"xscale": "log"})
def draw_construction(data, out, names, options):
    rows = out["construction" if names == "structure" else "construction_stages"]
    ax = chart("time of a pose, one thread (us)", "", (6.4, 0.6 + 0.24 * max(len(rows), 14)), **options)
    dots(ax, rows.column(names), *(rows.column(c) for c in ("build (us)", "build (25 %)", "build (75 %)")))


@draws("query_time", "Time of a pair; bars are quartiles, crosses the paper's times, on a laptop with an Intel Core i7 3630QM at 3.2 GHz.")
def draw_query_time(data, out):
    rows = out["query_time"]
    ax = chart("time of a pair, one thread (ns)", "", (8.5, 7.5), xscale="log")
    for i, (pairs, label) in enumerate({"paper500": "500 in sequence", "paper500 cached": "500, each repeated",
                                        "colliding": "colliding", "near miss": "near misses"}.items()):
        values, low, high = (rows.column(f"{pairs} ({what})") for what in ("ns/pair", "25 %", "75 %"))
        dots(ax, rows.column("structure"), values, low, high, 0.16 * (i - 1.5), label=label, **style(i, linestyle="none"))
    ax.plot(rows.column("the paper (ns/pair)"), range(len(rows)), "x", color="#e03030", markersize=9, markeredgewidth=2,
            label="the paper")
    legend(ax, 5)


@draws("distance", "Distance of the meshes at detection: median, quartiles (box), 5 % and 95 % (whiskers), mean (diamond) and the paper's mean (cross).", wide=True)
def draw_distance(data, out):
    rows, slides = out["distance"], data["distance_slides"].groups("subject")
    ax = chart("", "distance of the meshes at detection (cm)", (13, 4.8))
    ax.boxplot([known(slides[i].column("distance (cm)")) for i in range(len(rows))], whis=(5, 95), showfliers=False,
               widths=0.5, **{f"{part}props": {"color": COLOURS[1]} for part in ("box", "whisker", "cap", "median")})
    places = range(1, len(rows) + 1)
    ax.plot(places, rows.column("mean (cm)"), "D", color=INK, markersize=5, label="mean")
    ax.plot(places, rows.column("the paper (cm)"), "x", color=COLOURS[2], markersize=9, markeredgewidth=2,
            label="the paper's mean")
    ax.set_xticks(places, rows.column("structure"), rotation=30, ha="right")
    ax.set_ylim(0)
    legend(ax)


@draws("depth", "Distance at detection against depth: a thin line for every case of the cylinders over the outline, their median thick, its quartiles dashed; the medians of the single cylinder and of the OBB tree over the outline.")
def draw_depth(data, out):
    ax = chart("maximum recursion depth", "distance of the meshes at detection (cm)")
    kernel, boxes = out["depth"].where(structure=KERNEL)[:-1], out["depth"].where(structure="OBB outline")[:-1]
    cases = data["depth_slides"].groups("case")
    for i, case in list(cases.items())[:150]:
        label = f"a case ({min(150, len(cases))} of {len(cases)})" if i == 0 else None
        ax.plot(case.column("distance (cm)")[:len(kernel)], color=COLOURS[1], linewidth=0.5, alpha=0.35, label=label)
    for what, label, looks in (("median", "BCH, median", {"linewidth": 3}),
                               ("lower quartile", "BCH, quartiles", {"linestyle": "--"}), ("upper quartile", None, {"linestyle": "--"})):
        series(ax, kernel, "depth", f"{what} (cm)", label, color=INK, **looks)
    ax.axhline(kernel[0]["median (cm)"], color=COLOURS[2], linestyle="-.", label="single cylinder, median")
    series(ax, boxes, "depth", "median (cm)", "OBB outline, median", color=COLOURS[3], linewidth=2.4)
    ax.set_ylim(0)
    legend(ax, 3)


@draws("depth_time", "Time of a pair against depth; bars are quartiles.")
def draw_depth_time(data, out):
    ax = chart("maximum recursion depth", "time of a pair, one thread (ns)", yscale="log")
    kinds = {KERNEL: "BCH batch kernel", "OBB outline": "OBB outline", "OBB full mesh": "OBB full mesh",
             "BCH outline": "BCH traversal"}
    for pairs, line in ("colliding", "-"), ("near miss", "--"):
        for i, (structure, label) in enumerate(kinds.items()):
            series(ax, out["depth"].where(structure=structure), "depth", f"{pairs} (ns/pair)", f"{label}, {pairs}", pairs,
                   **style(i, linestyle=line, fillstyle="full" if line == "-" else "none"))
    legend(ax)


@draws("volume_paper", "Figure 7: volume of the single cylinder and of the hierarchy, as multiples of the mesh's: mean and standard deviation over poses; crosses are the paper's means.")
def draw_volume_paper(data, out):
    ax = chart("", "volume as a multiple of the mesh's")
    for i, (quantity, label) in enumerate({CYLINDER: "single cylinder", LEAVES: "BCH, projected triangles"}.items()):
        rows = out["volume_paper"].where(quantity=quantity)
        places = [x + 0.36 * (i - 0.5) for x in range(len(rows))]
        ax.bar(places, rows.column("mean"), 0.34, yerr=rows.column("standard deviation"), color=COLOURS[2 - i], label=label,
               ecolor=INK)
        ax.plot(places, rows.column("paper (mean)"), "x", color=INK, markersize=9, markeredgewidth=2,
                label="the paper's means" if i == 1 and known(rows.column("paper (mean)")) else None)
    ax.set_xticks(range(len(rows)), rows.column("character"))
    ax.grid(axis="x", visible=False)
    legend(ax, 3)


def number_ticks(axis, values):
    axis.set_ticks(values, [brief(value) for value in values], minor=False)
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


@draws("mesh_detail_build", "Time to build a pose's structure; the outline's hierarchy with the outline.", True)
@draws("mesh_detail", "Time of a pair against the number of triangles, one thread; bars are quartiles.")
def draw_mesh_detail(data, out, build=False):
    ax = chart("triangles", "time to build a pose, one thread (us)" if build else "time of a pair, one thread (ns)", xscale="log",
               yscale="log")
    for i, (structure, rows) in enumerate(out["mesh_detail"].groups("structure").items()):
        label = structure.replace("outline in the ", "")
        if build and structure != KERNEL:
            series(ax, rows, "triangles", "build (us)", label, **style(i))
        for pairs, line in (("colliding", "-"), ("near miss", "--")) if not build else ():
            series(ax, rows, "triangles", f"{pairs} (ns/pair)", f"{label}, {pairs}", pairs, **style(i, linestyle=line))
    number_ticks(ax.xaxis, sorted(set(out["mesh_detail"].column("triangles"))))
    legend(ax)


@draws("density", "Highest density without overlap: mean, and 95 % interval over packings.", wide=True)
def draw_density(data, out):
    rows = out["density"]
    dots(chart("people per square metre", "", (13, 4.8), xlim=(0, 1.08 * max(rows.column("95 % high")))),
         rows.column("structure"),
         *(rows.column(name) for name in ("densest (people/m2)", "95 % low", "95 % high")))


@draws("detail_time", "Time of a frame's tests, for a person, against the density.", "tests of a frame (ns a person)", "time of a frame, all threads (ns a person)", "tests")
@draws("detail", "False stops of a person in a second against the density of the crowd.", "false stops per person and second", "false stops per person and second", None)
def draw_detail(data, out, column, label, spread_of):
    ax = chart("people per square metre", label, yscale="linear" if spread_of else "log")
    for i, (kind, rows) in enumerate(out["detail"].groups("detail").items()):
        series(ax, [row for row in rows if row[column] > 0], "people per m2", column, kind, spread_of, **style(i))
    legend(ax, 3)


@draws("stability", "Hard cases, a row for each family: contacts missed, false hits and the largest error of an answer.", wide=True)
def draw_stability(data, out):
    families = [rows for rows in out["stability"].groups("family").values() if not is_nan(rows[0]["axis"])]
    figure, axes = plt.subplots(len(families), 3, figsize=(13, 2.9 * len(families)), layout="constrained", sharey="col")
    titles = {"missed (%)": "contacts missed, % of those that meet", "false hits (%)": "false hits, % of those that do not meet",
              "largest error (um/m)": "largest error, um per metre of extent"}
    for rows, panels in zip(families, axes):
        places = rows.column("conditioning")
        for ax, (what, title) in zip(panels, titles.items()):
            ax.set(title=title if rows is families[0] else "", xlabel=rows[0]["axis"])
            if min(places) > 0:
                ax.set_xscale("log")
            elif min(places) == 0:  # which stands at the left edge
                ax.set_xscale("symlog", linthresh=sorted(places)[1])
            if "error" in what:
                ax.set_yscale("symlog", linthresh=1e-12, linscale=0.4)
                ax.axhline(PROMISED_GAP, color=COLOURS[7], linestyle="--", label="promised")
                ax.set_yticks([0] + [10.0 ** e for e in range(-9, 7, 3)])
            for i, (name, label) in enumerate({"float": "plain float", "double": "plain double", "bch": "bch"}.items()):
                series(ax, rows, "conditioning", f"{name}: {what}", label, **style(i))
            ax.set_ylim(0)
            ax.set_xlim(left=0 if min(places) == 0 else None)
        panels[0].set_ylabel(rows[0]["title"])
    legend(ax, 4)


def drawn(name, data, out):
    """Returns a figure as SVG. Identifiers begin with its name, as several figures share a page."""
    plt.rcParams["svg.hashsalt"] = name
    FIGURES[name].draw(data, out)
    stream = io.StringIO()
    plt.savefig(stream, format="svg", bbox_inches="tight", pad_inches=0.05, metadata={"Date": None})
    plt.close()
    svg = stream.getvalue()
    svg = re.sub(r'(id="|href="#|url\(#)', rf"\1{name}-", svg[svg.index("<svg"):])
    svg = re.sub(r"'DejaVu Sans'[^;\"]*", "Helvetica, Arial, sans-serif", svg)  # hardly narrower than what was measured
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    return svg.replace(INK, "currentColor").replace(PAPER, "var(--paper)")


# The page.


def brief(number):
    """Writes a number with three significant digits, from 1 000 on all before the point."""
    if math.isnan(number):
        return "–"
    size = abs(number)
    if math.isinf(size) or size >= 1e9 or 0 < size < 1e-4:
        return f"{number:.3g}"
    if size >= 1000:
        return f"{number:,.0f}".replace(",", " ")
    if size >= 100 or number == 0:
        return f"{number:.0f}"
    text = f"{number:.{2 - math.floor(math.log10(size))}f}"
    return text.rstrip("0").rstrip(".")


def is_few(value):
    return isinstance(value, Share) and 0 < value.whole < 200


def shown(value):
    """Writes a cell: a share of few cases by their number."""
    if is_few(value):
        return f"{value.part} of {value.whole}"
    return brief(value) if isinstance(value, (int, float)) else value


def verdicts(out):
    """Returns, of the paper's findings whose tables are there, whether our numbers say the same."""
    def query(structure, column="paper500 (ns/pair)"):
        return out["query_time"].value(column, structure=structure)

    def built(structure):
        return out["construction"].value("build (us)", structure=structure)

    def stage(name):
        return out["construction_stages"].value("build (us)", stage=name)

    def apart(structure):
        return out["distance"].value("mean (cm)", structure=structure)

    def limited(depth):
        return out["depth"].value("colliding (ns/pair)", structure="BCH outline", depth=depth)

    def growth(structure):
        times = out["mesh_detail"].where(structure=structure).column("colliding (ns/pair)")
        return times[-1] / times[0]
    tests = "colliding: node tests"
    findings = {
        "outline queries": ("query_time", lambda: min(query("OBB outline"), query("OBB projected")) > query("BCH outline")),
        "tests": ("query_time", lambda: query("BCH outline", tests) > query("OBB outline", tests)),
        "projected queries": ("query_time", lambda: query("BCH projected") / query("OBB projected") > 2),
        "repeated": ("query_time", lambda: query("BCH outline") > query("BCH outline", "paper500 cached (ns/pair)")),
        "fixed radii": ("query_time", lambda: query("fixed cylinder 0.25 m", "colliding: hits (%)") < 100),
        "centroid": ("query_time", lambda: 0.9 < query("BCH outline") / query("BCH outline by centre") < 1.1),
        "construction order": ("construction", lambda: built("OBB projected") < built("OBB outline") + stage("outline")),
        "interactive": ("construction_stages", lambda: stage("all") > 1e6 / 60 / 100),
        "detection": ("distance", lambda: apart("single cylinder") > apart("BCH outline") > apart("OBB outline")),
        "critical depth": ("depth_critical",
                           lambda: out["depth_critical"].value("critical depth", structure=KERNEL) in (8, 9, 10)),
        "limited depth": ("depth", lambda: limited("all") / limited(3) > 1.2),
        "detail": ("mesh_detail", lambda: growth("OBB full mesh") > growth(KERNEL))}
    return {name: holds() for name, (table, holds) in findings.items() if table in out}


def page(data, out, judged):
    def figure(name):
        _, caption, wide = FIGURES[name]
        svg = re.sub(r' (width|height)="[^"]*pt"', "", drawn(name, data, out), count=2)
        return jinja2.utils.markupsafe.Markup(
            f'<figure id="figure-{name}"{" class=wide" * wide}><div>{svg}</div><figcaption>{caption}</figcaption></figure>')

    def pick(table, column, by, **fixed):
        return lambda value, of=column, **more: out[table].value(of, **{by: value}, **fixed, **more)

    def span(rows, column):
        values = known(rows.column(column))
        return f"{brief(min(values))} to {brief(max(values))}" if values else "–"

    def pick_most(table):
        return lambda column: max((row[column] for row in out[table] if not is_nan(row[column])), default=math.nan)

    def tables(experiment):
        return {name: rows for name, rows in out.items() if rows and name.startswith(experiment)}

    def figures(experiment):
        return [name for name in FIGURES if name.startswith(experiment)] if tables(experiment) else []

    environment = jinja2.Environment(autoescape=True, finalize=shown, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined,
                                     loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent))
    environment.filters["percent"] = lambda share: shown(share) if is_few(share) else f"{brief(share)} %"
    environment.filters["others"] = lambda share: environment.filters["percent"](Share(share.whole - share.part, share.whole))
    return environment.get_template("page.html").render(
        run=data["run"], T=out, titles=TITLES, verdicts=judged, pick=pick, pick_most=pick_most, span=span, tables=tables, figures=figures, figure=figure, is_nan=is_nan,
        is_number=lambda rows, column: any(isinstance(row[column], (int, float)) and not is_nan(row[column]) for row in rows),
        KERNEL=KERNEL, EXACT=EXACT)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="what bch_lab report wrote")
    parser.add_argument("--figure", metavar="NAME", choices=FIGURES, help="draw this figure alone, such as error_time_distance_crowd")
    parser.add_argument("--output", metavar="SVG", type=pathlib.Path, help="where to write it")
    options = parser.parse_args()
    if (options.figure is None) != (options.output is None):
        parser.error("--figure and --output need each other")
    data = Folder(options.folder)
    try:
        out = summarised(data)
        if options.figure:
            colours = "<style>svg { color: #1a1a1a; background: #fff; --paper: #fff }\n@media (prefers-color-scheme: dark) " \
                "{ svg { color: #e6e6e6; background: #15171a; --paper: #15171a } }</style>"
            svg = drawn(options.figure, data, out).replace(">", f">{colours}", 1)
            options.output.write_text('<?xml version="1.0" encoding="utf-8"?>\n' + svg, encoding="utf-8")
            return
        judged = verdicts(out)
        (options.folder / "index.html").write_text(page(data, out, judged), encoding="utf-8")
    except LookupError as error:
        sys.exit(f"{options.folder}: expected all tables of an experiment, as this version writes them; missing: {error}")
    for name, holds in judged.items():
        print(f"{name}: {'reproduced' if holds else 'reversed'}")
    print(options.folder / "index.html")


if __name__ == "__main__":
    main()
