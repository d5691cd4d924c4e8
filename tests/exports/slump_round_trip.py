#!/usr/bin/env python3
"""Runs the slump test of a card in LAMMPS, from the exported deck, and in pastefit, in the same fillings, and compares.

usage: slump_round_trip.py PASTEFIT READ_HEAP CARD [--strengths 0.3,1,2,4,10] [--packings N] [--radius-mm R] [--ranks N]
                           [--as-it-is]

For each factor the card's attraction is multiplied by it, so that a family from weak to strong comes out. The family has
no memory (bridges form where they rupture) and friction of the elastic force, which LAMMPS's own styles can represent;
--as-it-is keeps what the card says.

Exit status 1 if some reading differs by more than noise does once in a thousand comparisons (t-interval for the
difference of two means, pooled variance); 77 if LAMMPS is not installed.
"""

import argparse
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

SKIP = 77
# two-sided quantile of Student's t at 0.001 for 2 (n - 1) degrees of freedom
BAND = {2: 31.6, 3: 8.61, 4: 5.96, 5: 5.04, 6: 4.59, 8: 4.14, 10: 3.92, 12: 3.79, 16: 3.65}
READINGS = ["step1.height_axis_mm", "step1.height_max_mm", "step1.spread_mm"]


def variant(card, factor, as_it_is):
    card = json.loads(json.dumps(card))
    contact = card["test"]["contact"]
    bridge = contact["bridge"]
    for key in ("a_n_m2", "b_n_m", "c_n"):
        bridge[key] *= factor
    if contact["cohesion_n"] is not None:
        contact["cohesion_n"] *= factor
    if not as_it_is:
        bridge["offset_m"] = -0.5 * bridge["d_c_m"] * 1.001
        bridge["formation"] = "film"
        contact["friction_basis"] = "elastic"
    card["test"]["drop"] = None
    return card


def ours(program, file, packing):
    run = subprocess.run([program, "simulate", file, "--seed", str(packing), "--json"], capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(run.stderr)
    return json.loads(run.stdout)["observables"]


def theirs(program, read_heap, file, packing, folder, ranks, lammps):
    subprocess.run([program, "export", file, "--to", "lammps", "--out", folder, "--packing", str(packing), "--force"],
                   check=True, capture_output=True)
    command = [lammps, "-in", "in.slump", "-log", "none"]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + command
    start = time.time()
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if run.returncode != 0 or "ERROR" in run.stdout:
        raise SystemExit(run.stdout[-2000:] + run.stderr)
    wall = time.time() - start
    read = subprocess.run([read_heap, file, folder / "filled.dump", folder / "heap.dump"], check=True,
                          capture_output=True, text=True)
    return json.loads(read.stdout), wall


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("read_heap")
    parser.add_argument("card")
    parser.add_argument("--strengths", default="0.3,1,2,4,10")
    parser.add_argument("--packings", type=int, default=4, choices=BAND)
    parser.add_argument("--radius-mm", type=float)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--as-it-is", action="store_true")
    parser.add_argument("--lammps", default="lmp")
    options = parser.parse_args()
    if not shutil.which(options.lammps):
        print("skipped: lammps is not installed")
        return SKIP
    program, read_heap = (str(pathlib.Path(p).resolve()) for p in (options.program, options.read_heap))
    worst = 0
    print(f"{'c, N':>8} {'reading':<24} {'pastefit':>18} {'LAMMPS':>18} {'difference':>12} {'noise':>8}  of it")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        source = pathlib.Path(options.card)
        if options.radius_mm:
            source = folder / "rescaled.json"
            subprocess.run([program, "rescale", options.card, "--radius", str(options.radius_mm), "--packings", "0",
                            "--out", source], check=True, stdout=subprocess.DEVNULL)
        card = json.loads(source.read_text())
        for factor in map(float, options.strengths.split(",")):
            file = folder / "card.json"
            changed = variant(card, factor, options.as_it_is)
            file.write_text(json.dumps(changed))
            pairs, walls = [], []
            for packing in range(1, options.packings + 1):
                mine = ours(program, file, packing)
                other, wall = theirs(program, read_heap, file, packing, folder / "deck", options.ranks, options.lammps)
                pairs.append((mine, other))
                walls.append(wall)
            for reading in READINGS:
                a, b = [p[0][reading] for p in pairs], [p[1][reading] for p in pairs]
                difference = statistics.mean(b) - statistics.mean(a)
                noise = max(math.sqrt((statistics.variance(a) + statistics.variance(b)) / len(pairs)), 1e-9)
                worst = max(worst, abs(difference) / noise)
                print(f"{changed['test']['contact']['bridge']['c_n']:8.4f} {reading:<24} "
                      f"{statistics.mean(a):9.1f} +- {statistics.stdev(a):5.1f} "
                      f"{statistics.mean(b):9.1f} +- {statistics.stdev(b):5.1f} "
                      f"{difference:+12.1f} {noise:8.1f} {difference / noise:+6.1f}", flush=True)
            print(f"         LAMMPS: {statistics.mean(walls):.1f} s a test", flush=True)
    allowed = BAND[options.packings]
    print(f"largest difference: {worst:.1f} standard errors; noise alone stays below {allowed} in 999 of 1000 comparisons")
    return 0 if worst <= allowed else 1


if __name__ == "__main__":
    sys.exit(main())
