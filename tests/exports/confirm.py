#!/usr/bin/env python3
"""`pastefit confirm` with LAMMPS, which it builds itself, on two ranks: the heap agrees with that of the card within the noise,
and the cost is that of two ranks.

usage: confirm.py PASTEFIT CARD CACHE_DIR

CACHE_DIR keeps the LAMMPS that was built. Exit status 77 if LAMMPS's headers or mpirun are not installed.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import engines

LAUNCH = "mpirun --allow-run-as-root --oversubscribe -np 2"  # as root, and on fewer cores than ranks
BAND = 4.6  # standard errors of a bias of 4 and 4 packings: t of 6 degrees of freedom at 0.004, for five readings
READINGS = ["step1.height_axis_mm", "step1.height_max_mm", "step1.spread_mm"]


def call(*words, **options):
    result = subprocess.run([PASTEFIT, *map(str, words)], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise SystemExit(f"{words}\n{result.stdout}{result.stderr}")


def main(card, cache):
    for needed in ("mpicxx", "mpirun", "/usr/include/lammps/lammps.h"):
        if not shutil.which(needed) and not os.path.exists(needed):
            raise engines.Missing(needed)
    with tempfile.TemporaryDirectory() as name:
        file = pathlib.Path(name) / "coarse.json"
        call("rescale", card, "--radius", 12, "--packings", 4, "--out", file)
        call("confirm", file, "--launch", LAUNCH, "--packings", 4, env=engines.environment() | {"XDG_CACHE_HOME": cache})
        (one,) = json.loads(file.read_text())["further_confirmations"]
    wrong = []
    for reading in READINGS:
        row = one["readings"][reading]
        print(f"{reading}: {row['card']:.1f} -> {row['simulated']:.1f}, bias {row['bias']:+.1f} +- {row['standard_error']:.1f}")
        if abs(row["bias"]) > BAND * max(row["standard_error"], 0.5):  # half a millimetre: LAMMPS's step is another
            wrong.append(reading)
    print(f"{one['program']}, ranks: {one['ranks']}, {one['core_s']:.1f} core s in {one['wall_s']:.1f} s")
    if one["ranks"] != 2 or not 0 < one["core_s"] <= 2.02 * one["wall_s"]:
        wrong.append("cost")
    return f"wrong: {wrong}" if wrong else 0


if __name__ == "__main__":
    PASTEFIT = str(pathlib.Path(sys.argv[1]).resolve())
    engines.exit_with(main, sys.argv[2], str(pathlib.Path(sys.argv[3]).resolve()))
