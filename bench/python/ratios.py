# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The speed of the Python package over that of the C functions that it calls, and over shapely's.

Usage: ratios.py [--quick]   The package has to be importable.
"""

import statistics
import sys
import threading
import time

import bch
import numpy as np
from bch._library import lib


def crowd_of(people, n, density):
    random = np.random.default_rng(n)
    side = (n / density) ** 0.5
    shape = random.integers(len(people), size=n, dtype=np.uint32)
    return bch.Agents(shape, *random.uniform(0, side, (2, n)), random.uniform(-np.pi, np.pi, n))


def nanoseconds(call):
    begin = time.perf_counter()
    call()
    return 1e9 * (time.perf_counter() - begin)


def times_of(ask, function):
    """Returns how long a call of the package takes, and within it the C function that it calls."""
    called, inside = getattr(lib, function), []

    def timed(*arguments):
        begin = time.perf_counter()
        status = called(*arguments)
        inside.append(1e9 * (time.perf_counter() - begin))
        return status

    setattr(lib, function, timed)
    try:
        return nanoseconds(ask), inside[0]
    finally:
        setattr(lib, function, called)


def medians_of(ask, function, rounds):
    return map(statistics.median, zip(*(times_of(ask, function) for _ in range(rounds))))


def compare(name, ask, function, rounds, bar):
    whole, inside = medians_of(ask, function, rounds)
    print(f"{name}: Python {whole / 1e6:.2f} ms, C {inside / 1e6:.2f} ms: {whole / inside:.3f} x   (at most {bar} x)", flush=True)


def many_pairs(people, rounds, pairs_wanted):
    agents = crowd_of(people, pairs_wanted // 2, 3)
    pairs = np.ascontiguousarray(bch.Crowd().candidates(people, agents)[:pairs_wanted])
    n = len(pairs)
    hits, gaps, x, y = np.empty(n, bool), np.empty(n, np.float32), np.full(n, 1.3), np.full(n, 0.2)
    print(f"{n} pairs")
    compare("collide", lambda: bch.collide(people, agents, pairs, out=hits), "bch_collide", rounds, 1.05)
    compare("clearance", lambda: bch.clearance(people, agents, pairs, max_distance=0.5, out=gaps), "bch_clearance", rounds, 1.05)
    compare("time of impact", lambda: bch.time_of_impact(people, agents, pairs, x, y, out=gaps), "bch_time_of_impact", rounds, 1.05)


def whole_crowd(people, rounds, n):
    agents, crowd = crowd_of(people, n, 1), bch.Crowd()
    print(f"{n} agents")
    compare("collisions", lambda: crowd.collisions(people, agents), "bch_crowd_collisions", rounds, 1.05)


def one_pair(people):
    agents, pairs, out = crowd_of(people, 2, 3), np.array([[0, 1]], np.uint32), np.empty(1, bool)
    whole, inside = medians_of(lambda: bch.collide(people, agents, pairs, out=out), "bch_collide", 20_000)
    print(f"one pair: Python {whole / 1000:.2f} us, C {inside / 1000:.2f} us: {(whole - inside) / 1000:.2f} us more   (at most 5)")


def two_threads(people, pairs_wanted):
    agents = crowd_of(people, pairs_wanted // 2, 3)
    pairs = np.ascontiguousarray(bch.Crowd().candidates(people, agents)[:pairs_wanted])
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
    pairs = np.ascontiguousarray(bch.Crowd().candidates(people, agents)[:n])
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
        ours = bch.collide(people, agents, pairs, leaves=leaves, out=out).copy()
        ask = lambda: bch.collide(people, agents, pairs, leaves=leaves, out=out)
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
    quick = "--quick" in sys.argv
    people = bch.bake([bch.default_male(), bch.default_female()], poses=20 if quick else 100)
    many_pairs(people, 3 if quick else 15, 20_000 if quick else 1_000_000)
    whole_crowd(people, 3 if quick else 15, 2_000 if quick else 100_000)
    one_pair(people)
    two_threads(people, 20_000 if quick else 500_000)
    shapely(people, 1_000 if quick else 10_000)


main()
