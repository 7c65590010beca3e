# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The speed of the Python package over the C++ library's, and over shapely's, answers checked first.

Usage: python_ratios.py LIBRARY [--quick]   LIBRARY: libbch_cpp_calls.so of the build; the package has to be importable.
"""

import ctypes
import statistics
import sys
import tempfile
import threading
import time

import bch
import numpy as np


class Scene(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ("shape", "x", "y", "heading")] + [
        ("agents", ctypes.c_size_t),
        ("pairs", ctypes.c_void_p),
        ("count", ctypes.c_size_t),
    ]


def load(path):
    calls = ctypes.CDLL(path)
    calls.cpp_load.restype = ctypes.c_void_p
    for name in ("collide", "clearance", "time_of_impact", "collide_all"):
        getattr(calls, "cpp_" + name).restype = ctypes.c_double
    calls.cpp_load.argtypes = [ctypes.c_char_p]
    calls.cpp_collide.argtypes = [ctypes.c_void_p] * 3
    calls.cpp_clearance.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p]
    calls.cpp_time_of_impact.argtypes = [ctypes.c_void_p] * 5
    calls.cpp_collide_all.argtypes = [ctypes.c_void_p] * 3
    return calls


def crowd_of(people, n, density):
    random = np.random.default_rng(n)
    side = (n / density) ** 0.5
    shape = random.integers(len(people), size=n, dtype=np.uint32)
    return bch.Agents(shape, *random.uniform(0, side, (2, n)), random.uniform(-np.pi, np.pi, n))


def scene_of(agents, pairs):
    return Scene(*(a.ctypes.data for a in (agents.shape, agents.x, agents.y, agents.heading)), len(agents), pairs.ctypes.data, len(pairs))


def nanoseconds(call):
    begin = time.perf_counter()
    call()
    return 1e9 * (time.perf_counter() - begin)


def compare(name, python, cpp, rounds, bar):
    """Takes turns. The ratio is that of the medians."""
    mine, theirs = [], []
    for _ in range(rounds):
        theirs.append(cpp())
        mine.append(nanoseconds(python))
    ours, others = statistics.median(mine), statistics.median(theirs)
    print(f"{name}: Python {ours / 1e6:.2f} ms, C++ {others / 1e6:.2f} ms: {ours / others:.3f} x   (at most {bar} x)", flush=True)


def same(name, found, expected):
    if found.tobytes() != expected.tobytes():
        raise SystemExit(f"{name}: another answer than C++")


def many_pairs(calls, c_set, people, rounds, pairs_wanted):
    agents = crowd_of(people, pairs_wanted // 2, 3)
    pairs = np.ascontiguousarray(bch.candidate_pairs(people, agents)[:pairs_wanted])
    scene = scene_of(agents, pairs)
    n, at = len(pairs), ctypes.byref(scene)
    hits, expected = np.empty(n, bool), np.empty(n, bool)
    calls.cpp_collide(c_set, at, expected.ctypes.data)
    same("collide", bch.collide(people, agents, pairs, out=hits), expected)
    print(f"{n} pairs")
    compare("collide", lambda: bch.collide(people, agents, pairs, out=hits), lambda: calls.cpp_collide(c_set, at, expected.ctypes.data), rounds, 1.05)
    gaps, expected = np.empty(n, np.float32), np.empty(n, np.float32)
    calls.cpp_clearance(c_set, at, 0.5, expected.ctypes.data)
    same("clearance", bch.clearance(people, agents, pairs, max_distance=0.5, out=gaps), expected)
    compare("clearance", lambda: bch.clearance(people, agents, pairs, max_distance=0.5, out=gaps), lambda: calls.cpp_clearance(c_set, at, 0.5, expected.ctypes.data), rounds, 1.05)
    x, y = np.full(n, 1.3), np.full(n, 0.2)
    ways = (c_set, at, x.ctypes.data, y.ctypes.data, expected.ctypes.data)
    calls.cpp_time_of_impact(*ways)
    same("time of impact", bch.time_of_impact(people, agents, pairs, x, y, out=gaps), expected)
    compare("time of impact", lambda: bch.time_of_impact(people, agents, pairs, x, y, out=gaps), lambda: calls.cpp_time_of_impact(*ways), rounds, 1.05)


def whole_crowd(calls, c_set, people, rounds, n):
    agents = crowd_of(people, n, 1)
    scene = scene_of(agents, np.empty((0, 2), np.uint32))
    collider = bch.CrowdCollider()
    found = ctypes.c_uint64()
    cpp = lambda: calls.cpp_collide_all(c_set, ctypes.byref(scene), ctypes.byref(found))
    cpp()
    if len(collider.collide_all(people, agents).values) != found.value:
        raise SystemExit("collide_all: another answer than C++")
    print(f"{n} agents")
    compare("collide_all", lambda: collider.collide_all(people, agents), cpp, rounds, 1.05)


def one_pair(calls, c_set, people):
    agents = crowd_of(people, 2, 3)
    pairs = np.array([[0, 1]], np.uint32)
    scene = scene_of(agents, pairs)
    out = np.empty(1, bool)
    cpp, python = [], []
    for _ in range(20_000):
        cpp.append(calls.cpp_collide(c_set, ctypes.byref(scene), out.ctypes.data))
        python.append(nanoseconds(lambda: bch.collide(people, agents, pairs, out=out)))
    ours, others = statistics.median(python), statistics.median(cpp)
    print(f"one pair: Python {ours / 1000:.2f} us, C++ {others / 1000:.2f} us: {(ours - others) / 1000:.2f} us more   (at most 5)")


def two_threads(people, pairs_wanted):
    agents = crowd_of(people, pairs_wanted // 2, 3)
    pairs = np.ascontiguousarray(bch.candidate_pairs(people, agents)[:pairs_wanted])
    ask = lambda: [bch.collide(people, agents, pairs, threads=1) for _ in range(4)]

    def together():
        asking = [threading.Thread(target=ask) for _ in range(2)]
        for thread in asking:
            thread.start()
        for thread in asking:
            thread.join()

    ask()
    ratios = [2 * nanoseconds(ask) / nanoseconds(together) for _ in range(7)]
    print(f"two Python threads: {statistics.median(ratios):.2f} x one   (at least 1.8 x)")


def shapely(people, n):
    try:
        from shapely.affinity import affine_transform
        from shapely.geometry import Polygon
        from shapely.ops import unary_union
        from shapely.prepared import prep
    except ImportError:
        print("shapely is not installed")
        return
    agents = crowd_of(people, n // 2, 3)
    pairs = np.ascontiguousarray(bch.candidate_pairs(people, agents)[:n])
    # An outline may touch itself, which shapely's polygons may not: buffer(0) makes them valid.
    shapes = [unary_union([Polygon(c).buffer(0) for c in people.outline(i)]) for i in range(len(people))]
    c, s = np.cos(agents.heading), np.sin(agents.heading)
    begin = time.perf_counter()
    placed = [affine_transform(shapes[k], (c[i], -s[i], s[i], c[i], agents.x[i], agents.y[i])) for i, k in enumerate(agents.shape)]
    prepared = [prep(each) for each in placed]
    placing = time.perf_counter() - begin
    test = lambda: np.array([prepared[a].intersects(placed[b]) for a, b in pairs.tolist()])
    begin = time.perf_counter()
    theirs = test()  # builds the trees of prepared geometries, which a crowd that has moved needs anew
    shapely_time = time.perf_counter() - begin
    again = nanoseconds(test) / 1000
    print(
        f"{len(pairs)} pairs by shapely: {1e6 * shapely_time / len(pairs):.1f} us a pair ({again / len(pairs):.1f} once more "
        f"with the same geometries), beside {1e6 * placing / len(agents):.0f} us to place an agent"
    )
    out = np.empty(len(pairs), bool)
    for leaves in ("discs", "segments"):
        ours = bch.collide(people, agents, pairs, semantics="solid", leaves=leaves, out=out).copy()
        ask = lambda: bch.collide(people, agents, pairs, semantics="solid", leaves=leaves, out=out)
        taken = statistics.median(nanoseconds(ask) for _ in range(50)) / 1e9
        whole = shapely_time + placing
        missed, more = (theirs & ~ours).sum(), (ours & ~theirs).sum()
        print(
            f"  {leaves}: {whole / taken:.0f} x as fast as placing and testing   (at least 500 x), "
            f"{shapely_time / taken:.0f} x as testing alone; misses {missed}, {100 * more / theirs.sum():.2f} % more hits"
        )
        if missed:
            raise SystemExit("a collision that shapely sees is missed")


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        raise SystemExit(__doc__)
    quick = "--quick" in sys.argv
    calls = load(sys.argv[1])
    people = bch.bake([bch.default_male(), bch.default_female()], poses=20 if quick else 100)
    with tempfile.TemporaryDirectory() as folder:
        people.save(folder + "/people.bch")
        c_set = calls.cpp_load((folder + "/people.bch").encode())
    many_pairs(calls, c_set, people, 3 if quick else 15, 20_000 if quick else 1_000_000)
    whole_crowd(calls, c_set, people, 3 if quick else 15, 2_000 if quick else 100_000)
    one_pair(calls, c_set, people)
    two_threads(people, 20_000 if quick else 500_000)
    shapely(people, 1_000 if quick else 10_000)


main()
