#!/usr/bin/env python3
"""Heaps of a material in moulds of other sizes and shapes than that of its calibration.

usage: moulds.py PROGRAM [--law epa|bridge] [--moulds abrams,plate,pashias,hagermann,double] [--packings 4] NAME=VALUE ...

NAME=VALUE are parameters of the material (`adhesion_ratio=0.84 table_friction=0.15`); the others have the values that
`pastefit new` writes. A row for each mould: height and spread after each step, mean and deviation, and how many heaps
sheared off (top shifted by more than 0.4 of the mould's base radius).
"""
import argparse
import json
import statistics
import subprocess
import tempfile

DENSITY = ["--density", "2300"]
# Words for `pastefit new`; heights and spreads only choose what is read. The radius of the base in mm.
MOULDS = {
    "abrams": (["--mould", "abrams", *DENSITY, "--height", "137", "--spread", "310"], 100),
    "plate": (["--mould", "hinged-plate", *DENSITY, "--height", "120", "--height2", "105", "--spread", "270", "--spread2", "290"], 100),
    "pashias": (["--mould", "200/200/200", *DENSITY, "--height", "110", "--spread", "320"], 100),
    "hagermann": (["--mould", "haegermann", *DENSITY, "--height", "50", "--spread", "110"], 50),
    "double": (["--mould", "400/200/600", *DENSITY, "--height", "200", "--spread", "650"], 200),
}


def heaps_of(options, study):
    sets = [word for value in options.parameters for word in ("--set", f"parameters.{value}")]
    for packing in range(201, 201 + options.packings):
        done = subprocess.run([options.program, "simulate", study, *sets, "--seed", str(packing), "--json", "--quiet"],
                              capture_output=True, text=True)
        if done.returncode == 2:
            raise SystemExit(done.stderr)
        if done.returncode == 0:
            yield json.loads(done.stdout)["observables"]


def row(options, mould):
    words, radius_mm = MOULDS[mould]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([options.program, "new", folder, *words, "--law", options.law], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{mould}: {done.stderr}")
        heaps = list(heaps_of(options, f"{folder}/study.json"))
    cells = []
    for reading in ("step1.height_mm", "step1.spread_mm", "step2.height_mm", "step2.spread_mm"):
        values = [heap[reading] for heap in heaps if reading in heap]
        cells.append(f"{statistics.mean(values):.0f} ({statistics.stdev(values):.1f})" if len(values) > 1 else "")
    sheared = sum(heap["step1.lateral_shift_mm"] > 0.4 * radius_mm for heap in heaps)
    return f"| {mould} | {' | '.join(cells)} | {sheared} of {len(heaps)} |"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("parameters", nargs="+", metavar="NAME=VALUE")
    parser.add_argument("--law", choices=("epa", "bridge"), default="epa")
    parser.add_argument("--moulds", default=",".join(MOULDS))
    parser.add_argument("--packings", type=int, default=4)
    chosen = parser.parse_args()
    print("| mould | height 1 | spread 1 | height 2 | spread 2 | sheared off |\n|---|---|---|---|---|---|")
    for name in chosen.moulds.split(","):
        print(row(chosen, name), flush=True)
