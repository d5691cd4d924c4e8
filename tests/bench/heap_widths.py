#!/usr/bin/env python3
"""Height and width of heaps of bridge materials, from cohesive to frictional ones.

usage: heap_widths.py PROGRAM TABLE.csv

Abrams cone, 2300 kg/m3, one packing of each material. cone: width over that of a cone of the same volume and height.
"""
import csv
import itertools
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

CONE_M3 = math.pi * 0.3 / 12 * (0.2**2 + 0.2 * 0.1 + 0.1**2)
NAMES = ["strength_pa", "friction", "rolling_friction", "rupture_gap_ratio", "formation_ratio", "rupture_force_ratio", "curvature"]
TOUGH, SHORT = (0.6, 0.3, 0.5, -0.5), (0.3, 1, 0, 0)


def materials():
    for strength, friction, rolling, shape in itertools.product(
            (20, 100, 250, 1000, 2000), (0.05, 0.15, 0.3, 0.6), (0.1, 0.25, 0.5, 1), (TOUGH, SHORT)):
        yield (strength, friction, rolling, *shape)


def main(program, table):
    with tempfile.TemporaryDirectory() as folder, open(table, "w", newline="") as file:
        subprocess.run([program, "new", folder, "--mould", "abrams", "--density", "2300", "--height", "100", "--spread", "400", "--law", "bridge",
                        "--quiet", "--force"], check=True, capture_output=True)
        rows = csv.writer(file)
        rows.writerow([*NAMES, "height_mm", "spread_mm", "cone", "shift_mm"])
        for material in materials():
            sets = [word for name, value in zip(NAMES, material) for word in ("--set", f"parameters.{name}={value}")]
            done = subprocess.run([program, "simulate", Path(folder) / "study.json", *sets, "--seed", "301", "--json", "--quiet"],
                                  capture_output=True, text=True, check=True)
            heap = json.loads(done.stdout)["observables"]
            height, spread = heap["step1.height_mm"], heap["step1.spread_mm"]
            cone = 2000 * math.sqrt(3 * CONE_M3 / (math.pi * height / 1000))
            rows.writerow([*material, round(height, 1), round(spread, 1), round(spread / cone, 3), round(heap["step1.lateral_shift_mm"])])
            file.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
