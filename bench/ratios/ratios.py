#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Runs bch_ratios and prints its times and their ratios, table by table. The rows of a table come from one run, whose repetitions take turns,
so ratios hold on a busy machine, too. Goals stand in bench/README.md.

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

# A line: the table | a value, or two of which the ratio counts | what else to know. A value is the time of a benchmark in ns an
# item, or NAME#COUNTER. {a,b} stands for each of these, {1} for what the line's first braces stand for, *
# for anything, the same on both sides, ISA for each instruction set that is wider than one lane, BEST for the widest that runs here.
TABLES = """
kernel | collide/{colliding,near_miss,no_hit,crowd}/reference_segments / collide/{1}/segments/ISA |
kernel | collide/{colliding,near_miss,no_hit,crowd}/reference / collide/{1}/discs/ISA |
leaves | collide/{crowd,colliding,near_miss,no_hit}/segments/ISA / collide/{1}/discs/ISA |
stages | stages/{colliding,near_miss,no_hit,crowd}/{avx512,avx2} |
peers | collide/colliding/fcl_obb_contour / collide/colliding/discs/BEST |
peers | collide/colliding/fcl_obb_segments / collide/colliding/discs/BEST | one triangle a segment
peers | collide/colliding/obb_contour_2d / collide/colliding/discs/BEST |
calls | threads/1 / threads/2 |
calls | batches/16 / batches/512 |
crowd | crowd/1000000/step |
crowd | crowd/1000000/step / crowd/10000/step |
crowd | crowd/1000000/step#MiB |
crowd | crowd/1000000/pairs |
distances | clearance/crowd/BEST / collide/crowd/discs/BEST |
distances | clearance/candidates/BEST / collide/candidates/discs/BEST |
distances | exact_clearance/crowd/BEST / collide/crowd/discs/BEST |
distances | within/crowd/BEST / collide/crowd/discs/BEST |
distances | time_of_impact/crowd/BEST / collide/crowd/discs/BEST |
distances | clearance/near_miss/reference / clearance/near_miss/BEST |
distances | within/near_miss/reference / within/near_miss/BEST |
distances | time_of_impact/near_miss/reference / time_of_impact/near_miss/BEST |
distances | {clearance,within,time_of_impact}/near_miss/{avx512,avx2,sse2,scalar} |
distances | clearance/near_miss/fcl_walls / clearance/near_miss/BEST |
distances | clearance/near_miss/fcl_walls / exact_clearance/near_miss/BEST |
distances | clearance/near_miss/fcl_segments / {clearance,exact_clearance}/near_miss/BEST |
responses | {contacts,penetration,collisions}/crowd/BEST / collide/crowd/discs/BEST |
responses | nearest_free/{colliding,crowd}/BEST / penetration/{1}/BEST |
responses | nearest_free_of_all/crowd/BEST / nearest_free/crowd/BEST | for both agents of a pair
responses | {contacts,penetration}/crowd/reference / {1}/crowd/BEST | brute force
obstacles | obstacles/{collide,clearance,clearance_exact,clearance_unlimited} |
obstacles | obstacles/loop / obstacles/collide |
bodies | bodies/contacts |
bodies | bodies/loop / bodies/contacts |
shapes | shapes/5000 / shapes/200 |
shapes | shapes/50000 / shapes/200 |
plans | plans/{single_cylinder,depth_3,depth_6,mixed,all_discs,one_frame}/query / plans/all/query |
plans | plans/{single_cylinder,depth_3,depth_6,all,mixed,all_discs,one_frame}/{bake,query} |
spheres | spheres/{128,256,512}/crowd/avx2 / collide/crowd/segments/avx2 |
spheres | spheres_clearance/{256,512}/crowd/avx2 / clearance/crowd/avx2 |
spheres | spheres_nearest_free/256/colliding/BEST / spheres_penetration/256/colliding/BEST |
construction | construction/*/ISA/{skin,outline,hierarchy,levels,interior} |
construction | construction/*/ISA/{pose,all} |
construction | construction/*/clipper / construction/*/BEST/outline |
load | load/{map,read} |
paper | collide/{paper500,paper500_cached,colliding}/discs/BEST / collide/{1}/reference |
paper | collide/{paper500,paper500_cached,colliding}/obb_contour / collide/{1}/reference | 4630 ns / 2660 ns = 1.7 in the paper
paper | collide/{paper500,paper500_cached,colliding}/obb_projected / collide/{1}/reference | 20660 ns / 2660 ns = 7.8 in the paper
paper | collide/{paper500,paper500_cached,colliding}/{obb_contour_2d,fcl_obb_contour,fcl_obb_segments} / collide/{1}/reference |
"""
ISAS = ("avx512", "avx2", "sse2")
STAGES = "place profiles even_supports inscribed_4 inscribed_8 odd_supports add blocks leaves".split()
NO_COUNTERS = set(
    "name family_index per_family_instance_index run_name run_type repetitions repetition_index threads iterations".split()
    + "real_time cpu_time time_unit per_item".split()
)


def rows_of(table):
    """The lines of a table: values and note."""
    lines = [[field.strip() for field in line.split("|")] for line in TABLES.strip().splitlines()]
    return [(values, note) for name, values, note in lines if name == table]


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
    """All values that a line stands for."""
    groups = re.findall(r"\{([^}]*,[^}]*)\}", values)
    for choice in itertools.product(*(group.split(",") for group in groups)):
        chosen = iter(choice)
        text = re.sub(r"\{[^}]*,[^}]*\}", lambda _: next(chosen), values)
        text = re.sub(r"\{(\d)\}", lambda match: choice[int(match[1]) - 1], text)
        for isa in ISAS if "ISA" in text else [*ISAS, "scalar"] if "BEST" in text else [""]:
            found = list(expand_names(text.replace("ISA", isa).replace("BEST", isa), names))
            yield from found
            if found and "BEST" in text:
                break


def benchmarks_of(table, names):
    """The benchmarks that a table needs, in its order."""
    used = [benchmark_of(value) for values, _ in rows_of(table) for each in expand(values, names) for value in each]
    return list(dict.fromkeys(used))


class Results:
    """What benchmarks took in seconds an item, repetition by repetition, and what they counted."""

    def __init__(self, documents, typical):
        self.typical, self.taken, self.counters = typical, {}, {}
        for run in (run for document in documents for run in document["benchmarks"] if run["run_type"] == "iteration"):
            name = run["run_name"].removesuffix("/real_time")
            if run.get("error_occurred"):
                raise SystemExit(f"{name}: {run['error_message']}")
            self.taken.setdefault(name, []).append(run["per_item"])
            self.counters[name] = {key: value for key, value in run.items() if key not in NO_COUNTERS}

    def time(self, name):
        return 1e9 * self.typical(self.taken[name])

    def value(self, value):
        name = benchmark_of(value)
        if "#" in value:
            return self.counters[name][value.partition("#")[2]]
        return self.time(name)


def text_of(number):
    return f"{number:.2f}" if number < 10 else f"{number:.1f}" if number < 1000 else f"{number:,.0f}".replace(",", " ")


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


def print_stages(names, results):
    """A row for each benchmark: what each stage takes of a pair's time, and on how many pairs it works."""
    first = max(map(len, names), default=0) + 2
    print("ns a pair (tests a pair)".ljust(first) + "".join(stage.rjust(15) for stage in STAGES) + "all".rjust(8))
    for name in names:
        counted = results.counters[name]
        cells = [f"{text_of(counted[stage])} ({counted[stage + '.tests']:.3f})".rjust(15) for stage in STAGES]
        print(name.ljust(first) + "".join(cells) + text_of(sum(counted[stage] for stage in STAGES)).rjust(8))


def label_of(each):
    parts = [value.split("/") for value in each]
    common = sum(1 for _ in itertools.takewhile(lambda same: len(set(same)) == 1, zip(*parts))) if len(each) > 1 else 0
    return "/".join(parts[0][:common]) + (": " if common else "") + " / ".join("/".join(part[common:]) for part in parts)


def print_table(table, results):
    """Prints times, then ratios."""
    names = set(results.taken)
    (print_stages if table == "stages" else print_times)(benchmarks_of(table, names), results)
    for values, note in rows_of(table):
        rows = list(expand(values, names))
        if not rows:
            print(f"  {values}: not in this build")
        for each in rows:
            if len(each) == 1 and "#" not in each[0]:
                continue  # a time that stands above
            value = results.value(each[0]) / (results.value(each[1]) if len(each) > 1 else 1)
            print(f"  {label_of(each):70} {text_of(value):>8} {'x' if len(each) > 1 else '':2}  {note}".rstrip())


def print_paired(names, ours, theirs):
    """Prints both times and their ratio."""
    ratios = []
    for name in (name for name in names if name in theirs.taken):
        own, other = ours.time(name), theirs.time(name)
        ratios.append(own / other)
        print(f"  {name:70} {text_of(own):>9} / {text_of(other):>9} ns {ratios[-1]:6.3f} x")
    if not ratios:
        raise SystemExit("the other program has no benchmark of these names")
    print(f"  mean {statistics.geometric_mean(ratios):.3f} x")


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
    """Runs a table's benchmarks and prints it."""
    names = benchmarks_of(table, list_benchmarks(arguments.program, arguments.options))
    if arguments.against:
        programs, documents = [arguments.program, arguments.against], ([], [])
        for i in range(2 * arguments.runs):  # ours, theirs, theirs, ours: none is always the first
            which = (i + 1) // 2 % 2
            documents[which].append(run(programs[which], names, arguments.options, 1))
    else:
        documents = ([run(arguments.program, names, arguments.options, arguments.runs)],)
    print(f"# {table}: {arguments.runs} runs, load {os.getloadavg()[0]:.1f}", flush=True)
    results = [Results(each, arguments.typical) for each in documents]
    if arguments.against:
        print_paired(names, *results)
    else:
        print_table(table, results[0])


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    all_tables = list(dict.fromkeys(line.split()[0] for line in TABLES.strip().splitlines()))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", nargs="+", action="extend", choices=all_tables, metavar="NAME", help=f"of {', '.join(all_tables)} [all]")
    parser.add_argument("--program", default=str(root / "build/release/bch_ratios"), help="[build/release/bch_ratios]")
    parser.add_argument("--runs", type=int, default=9, help="how often each benchmark is timed; its time is the median [9]")
    parser.add_argument("--against", metavar="PROGRAM", help="another build, run in turns with the program: prints the ratios of both builds' times")
    parser.add_argument("--min", dest="typical", action="store_const", const=min, default=statistics.median, help="the least time, not the median")
    parser.add_argument("--json", metavar="FILE", type=argparse.FileType(), help="read what --benchmark_format=json wrote instead of running")
    parser.add_argument("options", nargs="*", help="options of the program, after --")
    arguments = parser.parse_args()
    results = Results([json.load(arguments.json)], arguments.typical) if arguments.json else None
    for table in arguments.table or all_tables:
        if results is None:
            run_table(table, arguments)
        elif benchmarks_of(table, set(results.taken)):
            print(f"# {table}")
            print_table(table, results)


if __name__ == "__main__":
    main()
