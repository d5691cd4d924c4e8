#!/usr/bin/env python3
"""Collapse of dry columns: run-out and height against the laws that two groups measured.

usage: columns.py PROGRAM TABLE.csv [--packings 3]

A cylinder of radius 80 mm with grains of 8 mm is lifted at 2 m/s. a is the initial height over the initial radius r. The
deposit's radius is r (1 + 1.24 a) for a < 1.7, r (1 + 1.6 sqrt(a)) above, for sand, sugar, salt and rice alike; its height is
0.88 r a^(1/6) for a > 1.7 (Lube, Huppert, Sparks, Hallworth, J. Fluid Mech. 508 (2004) 175-199). On glass beads the height is
r a for a < 0.74, 0.74 r above (Lajeunesse, Mangeney-Castelnau, Vilotte, Phys. Fluids 16 (2004) 2371-2381). The law of the
radius does not depend on the grains, so that nothing is calibrated.
"""
import argparse
import csv
import json
import math
import subprocess
import tempfile
from pathlib import Path

RADIUS_MM = 80
ASPECT_RATIOS = (0.5, 1, 1.5, 2, 3, 5)
FRICTIONS = ((0.3, 0.1), (0.5, 0.1), (0.7, 0.3))  # friction, rolling friction: angles of repose of about 13 to 28 degrees
LAB = {
    "format": "pastefit-lab-1",
    "title": "Collapse of a column",
    "provenance": {"source": "Lube et al. 2004, Lajeunesse et al. 2004", "twin": False},
    "material": {"bulk_density_kg_m3": 1500},
    "grains": {"distribution": "uniform", "smallest_mm": 3.6, "largest_mm": 4.4},
    "measurements": {},
}
APPARATUS = {"table_length_mm": 1200, "lift_velocity_mm_s": 2000, "drop_plate": None,
             "reading": {"height": "axis", "probe_diameter_mm": 20}}
STUDY = {
    "format": "pastefit-study-1",
    "title": "Collapse of a column",
    "lab": "lab.json",
    "contact": {"normal": "hertz", "attraction": "none", "rolling_model": "spring_dashpot", "friction_basis": "elastic"},
    "parameters": {"friction": {"free": [0.2, 0.8]}, "rolling_friction": {"value": 0.1}, "table_friction": {"value": 0.5},
                   "table_rolling_friction": {"value": 0.1}, "mould_friction": {"value": 0.1}},
}
COLUMNS = ["aspect_ratio", "friction", "rolling_friction", "packing", "radius_mm", "height_mm", "law_radius_mm", "law_height_mm", "law_height_of_lube_mm"]


def law_radius_mm(aspect):
    return RADIUS_MM * (1 + (1.24 * aspect if aspect < 1.7 else 1.6 * math.sqrt(aspect)))


def law_height_mm(aspect):
    return RADIUS_MM * min(aspect, 0.74)


def law_height_of_lube_mm(aspect):
    return round(0.88 * RADIUS_MM * aspect ** (1 / 6), 1) if aspect > 1.7 else ""


def write_files(folder, aspect):
    height_mm = aspect * RADIUS_MM
    mould = {"base_diameter_mm": 2 * RADIUS_MM, "top_diameter_mm": 2 * RADIUS_MM, "height_mm": height_mm}
    readings = {"step1.height_mm": {"value": law_height_mm(aspect), "standard_deviation": 2},
                "step1.spread_mm": {"value": 2 * law_radius_mm(aspect), "standard_deviation": 10}}
    lab = {**LAB, "apparatus": {"mould": mould, **APPARATUS}, "measurements": readings}
    (folder / "lab.json").write_text(json.dumps(lab))
    (folder / "study.json").write_text(json.dumps(STUDY))


def deposit(program, folder, friction, rolling, packing):
    """Readings of one deposit."""
    sets = [f"parameters.friction={friction}", f"parameters.rolling_friction={rolling}"]
    done = subprocess.run([program, "simulate", folder / "study.json", *(word for one in sets for word in ("--set", one)),
                           "--seed", str(packing), "--time-step", "5e-5", "--json", "--quiet"], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)["observables"]


def measure(options):
    with open(options.table, "w", newline="") as file, tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = csv.writer(file)
        rows.writerow(COLUMNS)
        for aspect in ASPECT_RATIOS:
            write_files(folder, aspect)
            for friction, rolling in FRICTIONS:
                for packing in range(1, options.packings + 1):
                    found = deposit(options.program, folder, friction, rolling, packing)
                    rows.writerow([aspect, friction, rolling, packing, round(found["step1.spread_mm"] / 2, 1),
                                   round(found["step1.height_mm"], 1), round(law_radius_mm(aspect), 1),
                                   round(law_height_mm(aspect), 1), law_height_of_lube_mm(aspect)])
                    file.flush()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("table")
    parser.add_argument("--packings", type=int, default=3)
    measure(parser.parse_args())
