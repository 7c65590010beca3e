#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Runs bch_ratios and prints its times, their ratios and the project's goals for them, table by table. The rows of a table come from one
run, whose repetitions take turns, so ratios hold on a busy machine, too.

Examples: bench/ratios/ratios.py --table kernel --table leaves
          bench/ratios/ratios.py --table crowd --runs 3 -- --agents=2000
          bench/ratios/ratios.py --table kernel --against /elsewhere/build/release/bch_ratios
"""

import argparse
import itertools
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys

# A line: the table | a value, or two of which the ratio counts | the goal, and what else to know. A value is the time of a benchmark in ns an
# item, or NAME#COUNTER. {a,b} stands for each of these, {1} for what the line's first braces stand for, *
# for anything, the same on both sides, ISA for each instruction set that is wider than one lane, BEST for the widest that runs here. Three goals
# are those with AVX-512, AVX2 and SSE2.
GOALS = """
kernel | collide/colliding/reference / collide/colliding/discs/ISA | >= 24 15 10, aim 50 with AVX-512
kernel | collide/{near_miss,no_hit}/reference / collide/{1}/discs/ISA | >= 10 7 5, aim 20 with AVX-512
kernel | collide/crowd/reference / collide/crowd/discs/ISA | >= 16 11 8, aim 30 with AVX-512
leaves | collide/{crowd,colliding,near_miss,no_hit}/segments/ISA / collide/{1}/discs/ISA | <= 1.3, aim 1.1
peers | collide/colliding/fcl_obb_contour / collide/colliding/discs/BEST | >= 200
peers | collide/colliding/fcl_obb_segments / collide/colliding/discs/BEST | one triangle a segment
peers | collide/colliding/obb_contour_2d / collide/colliding/discs/BEST | >= 40
calls | threads/1 / threads/2 | >= 1.9
calls | batches/16 / batches/512 | <= 1.6
crowd | crowd/1000000/step | <= 120, aim 50
crowd | crowd/1000000/step / crowd/10000/step | <= 1.3
crowd | crowd/1000000/step#MiB | <= 1024
crowd | crowd/1000000/pairs |
distances | clearance/crowd/BEST / collide/crowd/discs/BEST | <= 6
distances | clearance/candidates/BEST / collide/candidates/discs/BEST | <= 8
distances | exact_clearance/crowd/BEST / collide/crowd/discs/BEST |
distances | within/crowd/BEST / collide/crowd/discs/BEST | <= 1.3
distances | time_of_impact/crowd/BEST / collide/crowd/discs/BEST | <= 4
distances | clearance/near_miss/reference / clearance/near_miss/BEST | >= 12
distances | within/near_miss/reference / within/near_miss/BEST |
distances | time_of_impact/near_miss/reference / time_of_impact/near_miss/BEST | >= 10
distances | {clearance,within,time_of_impact}/near_miss/{avx512,avx2,sse2,scalar} |
distances | clearance/near_miss/fcl_walls / clearance/near_miss/BEST | >= 150
distances | clearance/near_miss/fcl_walls / exact_clearance/near_miss/BEST |
distances | clearance/near_miss/fcl_segments / {clearance,exact_clearance}/near_miss/BEST |
responses | {contacts,penetration,collisions}/crowd/BEST / collide/crowd/discs/BEST |
responses | {contacts,penetration}/crowd/reference / {1}/crowd/BEST | brute force
obstacles | obstacles/collide | <= 60
obstacles | obstacles/{clearance,clearance_unlimited} | <= 200
obstacles | obstacles/clearance_exact |
obstacles | obstacles/loop / obstacles/collide | >= 500
bodies | bodies/contacts | <= 10000
bodies | bodies/loop / bodies/contacts | >= 20
shapes | shapes/5000 / shapes/200 | <= 1.8
shapes | shapes/50000 / shapes/200 | <= 3
plans | plans/{single_cylinder,depth_3,depth_6,all,mixed,all_discs,one_frame}/{bake,query} |
spheres | spheres/128/crowd/avx2 / collide/crowd/segments/avx2 | <= 1.1
spheres | spheres/256/crowd/avx2 / collide/crowd/segments/avx2 | <= 1.4
spheres | spheres/512/crowd/avx2 / collide/crowd/segments/avx2 | <= 2.1
spheres | spheres_clearance/256/crowd/avx2 / clearance/crowd/avx2 | <= 1.8
spheres | spheres_clearance/512/crowd/avx2 / clearance/crowd/avx2 | <= 2.5
construction | construction/*/ISA/{skin,outline,hierarchy,levels,interior} |
construction | construction/*/ISA/{pose,all} | <= 45000 45000 90000
construction | construction/*/clipper / construction/*/BEST/outline | >= 1000
load | load/{map,read} |
paper | collide/{paper500,paper500_cached,colliding}/discs/BEST / collide/{1}/reference |
paper | collide/{paper500,paper500_cached,colliding}/obb_contour / collide/{1}/reference | 4630 ns / 2660 ns = 1.7 in the paper
paper | collide/{paper500,paper500_cached,colliding}/obb_projected / collide/{1}/reference | 20660 ns / 2660 ns = 7.8 in the paper
paper | collide/{paper500,paper500_cached,colliding}/{obb_contour_2d,fcl_obb_contour,fcl_obb_segments} / collide/{1}/reference |
"""
ISAS = ("avx512", "avx2", "sse2")
MOST_PAIRED = 1.03  # of a build over another one
NO_COUNTERS = set(
    "name family_index per_family_instance_index run_name run_type repetitions repetition_index threads iterations".split()
    + "real_time cpu_time time_unit per_item".split()
)


def rows_of(table):
    """The lines of a table: values and goal."""
    lines = [[field.strip() for field in line.split("|")] for line in GOALS.strip().splitlines()]
    return [(values, goal) for name, values, goal in lines if name == table]


def benchmark_of(value):
    return value.partition("#")[0]


def expand_names(values, names):
    """The values of a line for each name that * may stand for, if the program has these benchmarks."""
    pattern = re.escape(benchmark_of(values.split(" / ")[0])).replace(r"\*", "([^/]*)")
    found = [match.groups() for match in (re.fullmatch(pattern, name) for name in names) if match]
    for stars in sorted(found, key=lambda stars: [(len(star), star) for star in stars]):  # 996 before 2864
        each = (values.replace("*", stars[0]) if stars else values).split(" / ")
        if all(benchmark_of(value) in names for value in each):
            yield each


def expand(values, names):
    """All values that a line stands for, and their instruction set."""
    groups = re.findall(r"\{([^}]*,[^}]*)\}", values)
    for choice in itertools.product(*(group.split(",") for group in groups)):
        chosen = iter(choice)
        text = re.sub(r"\{[^}]*,[^}]*\}", lambda _: next(chosen), values)
        text = re.sub(r"\{(\d)\}", lambda match: choice[int(match[1]) - 1], text)
        for isa in ISAS if "ISA" in text else [*ISAS, "scalar"] if "BEST" in text else [""]:
            found = list(expand_names(text.replace("ISA", isa).replace("BEST", isa), names))
            yield from ((each, isa) for each in found)
            if found and "BEST" in text:
                break


def benchmarks_of(table, names):
    """The benchmarks that a table needs, in its order."""
    used = [benchmark_of(value) for values, _ in rows_of(table) for each, _ in expand(values, names) for value in each]
    return list(dict.fromkeys(used))


class Results:
    """What benchmarks took in seconds an item, repetition by repetition, and what they counted."""

    def __init__(self, documents):
        self.taken, self.counters = {}, {}
        for run in (run for document in documents for run in document["benchmarks"] if run["run_type"] == "iteration"):
            name = run["run_name"].removesuffix("/real_time")
            if run.get("error_occurred"):
                raise SystemExit(f"{name}: {run['error_message']}")
            self.taken.setdefault(name, []).append(run["per_item"])
            self.counters[name] = {key: value for key, value in run.items() if key not in NO_COUNTERS}

    def time(self, name, typical=statistics.median):
        return 1e9 * typical(self.taken[name])

    def value(self, value):
        name = benchmark_of(value)
        if "#" in value:
            return self.counters[name][value.partition("#")[2]]
        return self.time(name)


def text_of(number):
    return f"{number:.2f}" if number < 10 else f"{number:.1f}" if number < 1000 else f"{number:,.0f}".replace(",", " ")


def judge(value, goal, isa):
    """Returns: whether the goal is met, and what to say of it."""
    match = re.match(r"([<>]=) ([\d. ]+)(.*)", goal)
    if not match:
        return True, goal
    bounds = match[2].split()
    bound = float(bounds[ISAS.index(isa) if len(bounds) > 1 else 0])
    over = value / bound - 1
    if match[1] == ">=":
        return over >= 0, (f"PASS (needs {bound:g})" if over >= 0 else f"needs {bound:g}: {-100 * over:.0f} % short") + match[3]
    return over <= 0, (f"PASS (at most {bound:g})" if over <= 0 else f"at most {bound:g}: {100 * over:.0f} % over") + match[3]


def print_times(names, results):
    """A row for the benchmarks whose names differ in their last part alone."""
    rows = {}
    for name in names:
        row, _, column = name.rpartition("/")
        rows.setdefault(row, {})[column] = name
    columns = list(dict.fromkeys(name.rpartition("/")[2] for name in names))
    widths = [max(len(column), 8) + 2 for column in columns]
    first = max(10, *map(len, rows))
    print("ns an item".ljust(first) + "".join(column.rjust(width) for column, width in zip(columns, widths)))
    for row, cells in rows.items():
        line = row.ljust(first)
        for column, width in zip(columns, widths):
            line += (text_of(results.time(cells[column])) if column in cells else "").rjust(width)
        counted = {}
        for name in cells.values():
            for counter, value in results.counters[name].items():
                counted.setdefault(counter, []).append(f"{value:.6g}")
        print(line + "".join(f"   {counter} {' / '.join(dict.fromkeys(values))}" for counter, values in counted.items()))


def label_of(each):
    parts = [value.split("/") for value in each]
    common = sum(1 for _ in itertools.takewhile(lambda same: len(set(same)) == 1, zip(*parts))) if len(each) > 1 else 0
    return "/".join(parts[0][:common]) + (": " if common else "") + " / ".join("/".join(part[common:]) for part in parts)


def print_table(table, results):
    """Prints times, then goals. Returns: whether all are met."""
    names = set(results.taken)
    print_times(benchmarks_of(table, names), results)
    all_met = True
    for values, goal in rows_of(table):
        rows = list(expand(values, names))
        if not rows:
            print(f"  {values}: not in this build")
        for each, isa in rows:
            if len(each) == 1 and not goal and "#" not in each[0]:
                continue  # a time that stands above
            value = results.value(each[0]) / (results.value(each[1]) if len(each) > 1 else 1)
            unit = "x" if len(each) > 1 else "" if "#" in each[0] else "ns"
            met, said = judge(value, goal, isa)
            all_met = all_met and met
            print(f"  {label_of(each):70} {text_of(value):>8} {unit:2}  {said}".rstrip())
    return all_met


def print_paired(names, ours, theirs, typical):
    """Prints both times and their ratio. Returns: whether the mean ratio is allowed."""
    ratios = []
    for name in (name for name in names if name in theirs.taken):
        own, other = ours.time(name, typical), theirs.time(name, typical)
        ratios.append(own / other)
        print(f"  {name:70} {text_of(own):>9} / {text_of(other):>9} ns {ratios[-1]:6.3f} x")
    if not ratios:
        raise SystemExit("the other program has no benchmark of these names")
    mean = statistics.geometric_mean(ratios)
    print(f"  mean {mean:.3f} x   {judge(mean, f'<= {MOST_PAIRED}', '')[1]}")
    return mean <= MOST_PAIRED


def list_benchmarks(program, options):
    command = [program, "--benchmark_list_tests=true", *options]
    listed = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if listed.returncode != 0:
        raise SystemExit(listed.returncode)
    return {name.removesuffix("/real_time") for name in listed.stdout.split()}


def run(program, names, options, repetitions):
    command = [
        program,
        "--benchmark_min_time=0.01",
        "--benchmark_enable_random_interleaving=true",
        f"--benchmark_repetitions={repetitions}",
        "--benchmark_display_aggregates_only=false",
        *options,
        f"--benchmark_filter=^({'|'.join(names)})(/real_time)?$",
        "--benchmark_format=json",
    ]
    ran = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if not ran.stdout:
        raise SystemExit(ran.returncode or f"{program} has printed nothing")
    return json.loads(ran.stdout)


def run_table(table, arguments):
    """Runs a table's benchmarks and prints it. Returns: whether all goals are met."""
    names = benchmarks_of(table, list_benchmarks(arguments.program, arguments.options))
    if arguments.against:
        programs, documents = [arguments.program, arguments.against], ([], [])
        for i in range(2 * arguments.runs):  # ours, theirs, theirs, ours: none is always the first
            which = (i + 1) // 2 % 2
            documents[which].append(run(programs[which], names, arguments.options, 1))
    else:
        documents = ([run(arguments.program, names, arguments.options, arguments.runs)],)
    print(f"# {table}: {arguments.runs} runs, load {os.getloadavg()[0]:.1f}", flush=True)
    results = [Results(each) for each in documents]
    return print_paired(names, *results, arguments.typical) if arguments.against else print_table(table, results[0])


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    all_tables = list(dict.fromkeys(line.split()[0] for line in GOALS.strip().splitlines()))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", nargs="+", action="extend", choices=all_tables, metavar="NAME", help=f"of {', '.join(all_tables)} [all]")
    parser.add_argument("--program", default=str(root / "build/release/bch_ratios"), help="[build/release/bch_ratios]")
    parser.add_argument("--runs", type=int, default=9, help="how often each benchmark is timed; its time is the median [9]")
    parser.add_argument("--against", metavar="PROGRAM", help="another build, run in turns with the program: prints the ratios of both builds' times")
    parser.add_argument("--min", dest="typical", action="store_const", const=min, default=statistics.median, help="with --against: the least time")
    parser.add_argument("--json", metavar="FILE", type=argparse.FileType(), help="read what --benchmark_format=json wrote instead of running")
    parser.add_argument("--strict", action="store_true", help="exit code 1 where a goal is missed")
    parser.add_argument("options", nargs="*", help="options of the program, after --")
    arguments = parser.parse_args()
    results = Results([json.load(arguments.json)]) if arguments.json else None
    all_met = True
    for table in arguments.table or all_tables:
        if results is None:
            all_met = run_table(table, arguments) and all_met
        elif benchmarks_of(table, set(results.taken)):
            print(f"# {table}")
            all_met = print_table(table, results) and all_met
    sys.exit(arguments.strict and not all_met)


if __name__ == "__main__":
    main()
