# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Times of collide() by libraries that were built with different BCH_TASKS, in turns, the least of each.
Usage: tasks.py LIBRARY LIBRARY [THREADS]: paths of libbch.so; the ratio is that of the second to the first."""

import os
import subprocess
import sys
import time


def measure(threads):
    """Answer each line of standard input by the seconds of a call."""
    import bch
    import numpy as np

    random = np.random.default_rng(1)
    n = 400_000
    side = (n / 3) ** 0.5
    people = bch.bake([bch.default_male(), bch.default_female()], poses=100)
    agents = bch.Agents(
        random.integers(len(people), size=n, dtype=np.uint32), *random.uniform(0, side, (2, n)), random.uniform(-np.pi, np.pi, n)
    )
    pairs = np.ascontiguousarray(bch.Crowd().candidates(people, agents)[:1_000_000])
    out = np.empty(len(pairs), bool)
    bch.collide(people, agents, pairs, out=out, threads=threads)
    print(len(pairs), flush=True)
    for _ in sys.stdin:
        begin = time.perf_counter()
        bch.collide(people, agents, pairs, out=out, threads=threads)
        print(time.perf_counter() - begin, flush=True)


def main():
    libraries, threads = sys.argv[1:3], sys.argv[3] if len(sys.argv) > 3 else "2"
    workers = [
        subprocess.Popen(
            [sys.executable, __file__, "worker", threads],
            env={**os.environ, "BCH_LIBRARY": library},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for library in libraries
    ]
    pairs = [int(worker.stdout.readline()) for worker in workers]
    least = [float("inf")] * len(workers)
    for _ in range(30):
        for i, worker in enumerate(workers):
            worker.stdin.write("\n")
            worker.stdin.flush()
            least[i] = min(least[i], float(worker.stdout.readline()))
    for library, seconds in zip(libraries, least):
        print(f"{library}: {1e3 * seconds:.1f} ms for {pairs[0]} pairs, {threads} threads")
    print(f"{least[1] / least[0]:.2f} x")
    for worker in workers:
        worker.stdin.close()
        worker.wait()


if __name__ == "__main__":
    measure(int(sys.argv[2])) if sys.argv[1] == "worker" else main()
