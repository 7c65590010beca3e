# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""The speed of `bch check` with whole bodies over that of a plain test of discs, all pairs of a frame, on a made-up crowd.

People walk one way at 3 a square metre, slower and faster in waves. The test of discs is timed without reading the file, `bch check` as a whole.
Person-frames a second are those of all frames less those of a third of them, so that the start does not count; of spheres, of a tenth of the frames.

Usage: discs.py PROGRAM [PEOPLE [FRAMES]]   PROGRAM: build/release/bch; the environment's BCH_ISA chooses the instruction set
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

RADIUS = 0.25
FPS = 25


def crowd(people, frames):
    """Places by frame and person: a lattice that sways and is pushed together and apart by a quarter."""
    random = np.random.default_rng(29)
    columns = int(np.ceil(people**0.5))
    spacing = (3 * 0.75**0.5) ** -0.5
    row, column = np.divmod(np.arange(people), columns)
    at_rest = np.stack([(column + row % 2 / 2) * spacing, row * spacing * 0.75**0.5], axis=1)
    sway, turn, rate = random.uniform(0, 0.06, at_rest.shape), random.uniform(0, 6.28, at_rest.shape), random.uniform(0.4, 1.2, at_rest.shape)
    seconds = np.arange(frames)[:, None, None] / FPS
    places = at_rest + sway * np.sin(rate * seconds + turn)
    places[..., 0] += 0.6 * seconds[..., 0] - 1.7 * np.cos(0.3 * seconds[..., 0] + 0.1 * at_rest[:, 0])
    return places.round(3)


def pairs_of_discs(places):
    """As tools for trajectories write it."""
    found = 0
    for frame in places:
        distance = np.linalg.norm(frame[:, None] - frame[None, :], axis=2)
        found += np.count_nonzero(distance[np.triu_indices(len(frame), 1)] < 2 * RADIUS)
    return found


def seconds(call):
    begin = time.perf_counter()
    answer = call()
    return time.perf_counter() - begin, answer


def main(program, people=5000, frames=400):
    places = crowd(people, frames)
    checked = places[: max(1, int(2e7 / people**2))]  # all frames take equally long
    with tempfile.TemporaryDirectory() as folder:
        file, answers = pathlib.Path(folder, "crowd.csv"), pathlib.Path(folder, "check.json")

        def check(of, *options):
            with open(file, "w") as out:
                out.write("frame,id,x,y\n")
                for k, frame in enumerate(of):
                    out.writelines("%d,%d,%.3f,%.3f\n" % (k, i, x, y) for i, (x, y) in enumerate(frame))
            command = [program, "check", file, "--fps", str(FPS), "--unit", "m", "--threads", "2", "--json", answers, *options]
            return min(seconds(lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL))[0] for _ in range(3))

        def rate(of, *options):
            part = of[: len(of) // 3]
            return people * (len(of) - len(part)) / (check(of, *options) - check(part, *options))

        time_of_discs, pairs = seconds(lambda: pairs_of_discs(checked))
        time_of_discs *= frames / len(checked)
        check(checked)
        discs = {disc["radius"]: disc["pairs_within_1.2_m"] for disc in json.loads(answers.read_text())["all"]["discs"]}
        if discs[RADIUS] != pairs:
            raise SystemExit(f"{discs[RADIUS]} pairs of discs, and {pairs} by numpy")
        time_of_check = check(places)
        outlines, spheres = rate(places), rate(places[: max(3, frames // 10)], "--bodies", "spheres")
    print(f"{people} people, {frames} frames: numpy's discs {time_of_discs:.2f} s, bodies {time_of_check:.2f} s: {time_of_discs / time_of_check:.1f} x")
    print(f"person-frames a second: outlines {outlines:.3g}, bodies of 256 spheres {spheres:.3g}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:]))
