#!/usr/bin/env python3
"""How a distribution of grain sizes affects heaps: share that shears off, scatter, reach and cost.

usage: grain_sizes.py PROGRAM TABLE.csv [--packings 24] [--sizes "6 to 10" ...] [--materials "card of mix 79" ...]

Simulates each material with each distribution of radii on packings 1, 2, ... in the mould of mix 79 (data/lab), and appends
a row for each simulation to TABLE.csv. Existing rows are not run again. `grain_sizes.py --report TABLE.csv` prints the
table.
"""
import argparse
import csv
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# The bridge keeps half of its force up to a gap of one radius; those of friction 0.05 and 0.2 have heaps of mix 79's height.
TOUGH = {"rupture_force_ratio": 0.5, "curvature": -0.5, "rupture_gap_ratio": 1.0, "formation_ratio": 0.3,
         "rolling_friction": 0.3, "table_friction": 0.6}
MATERIALS = {
    "card of mix 79": None,
    "tough, friction 0.05": TOUGH | {"strength_pa": 1850, "friction": 0.05},
    "tough, friction 0.2": TOUGH | {"strength_pa": 1200, "friction": 0.2},
    "tough, friction 0.4": TOUGH | {"strength_pa": 1000, "friction": 0.4},
    "weak, friction 0.05": TOUGH | {"strength_pa": 700, "friction": 0.05},
}
SIZES = {
    "8": {"distribution": "mono", "radius_mm": 8},
    "7 to 9": {"distribution": "uniform", "smallest_mm": 7, "largest_mm": 9},
    "6 to 10": {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10},
    "5 to 11": {"distribution": "uniform", "smallest_mm": 5, "largest_mm": 11},
}
# What a smaller error costs: the same spread about another mean.
OTHER_MEANS = {
    "9 to 15": {"distribution": "uniform", "smallest_mm": 9, "largest_mm": 15},
    "4.5 to 7.5": {"distribution": "uniform", "smallest_mm": 4.5, "largest_mm": 7.5},
    "3 to 5": {"distribution": "uniform", "smallest_mm": 3, "largest_mm": 5},
}
READINGS = ["step1.height_mm", "step1.spread_mm", "step1.lateral_shift_mm"]
SHEARED_MM = 40  # 0.4 of the mould's base radius


def material_of_card():
    card = json.loads((ROOT / "data/cards/concrete-mix-79.json").read_text())
    return card["material"]["parameters"]


def study_of(folder, grains):
    lab = json.loads((ROOT / "data/lab/concrete-mix-79.json").read_text())
    study = json.loads((ROOT / "data/studies/concrete-mix-79.json").read_text())
    lab["grains"] = grains
    (folder / "lab.json").write_text(json.dumps(lab))
    study["lab"] = "lab.json"
    (folder / "study.json").write_text(json.dumps(study))
    return folder / "study.json"


def simulate(program, study, parameters, packing):
    sets = [part for name, value in parameters.items() for part in ("--set", f"parameters.{name}={value}")]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "simulate", study, *sets, "--seed", str(packing), "--json", "--quiet"],
                          capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode == 2:
        sys.exit(done.stderr)
    seconds = after.ru_utime - before.ru_utime
    readings = json.loads(done.stdout)["observables"] if done.returncode == 0 else {}
    return [readings.get(name, math.nan) for name in READINGS] + [seconds]


def measure(program, table, packings, sizes_of, materials):
    known = set()
    if os.path.exists(table):
        with open(table) as file:
            known = {(row["material"], row["radii_mm"], int(row["packing"])) for row in csv.DictReader(file)}
    with open(table, "a", newline="") as file, tempfile.TemporaryDirectory() as folder:
        rows = csv.writer(file)
        if not known:
            rows.writerow(["material", "radii_mm", "packing", *READINGS, "core_s"])
        for material in materials:
            parameters = MATERIALS[material] or material_of_card()
            for sizes in sizes_of:
                study = study_of(Path(folder), (SIZES | OTHER_MEANS)[sizes])
                for packing in range(1, packings + 1):
                    if (material, sizes, packing) not in known:
                        rows.writerow([material, sizes, packing, *simulate(program, study, parameters, packing)])
                        file.flush()


def mean_and_deviation(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / max(1, len(values) - 1))


def report(table):
    groups = {}
    with open(table) as file:
        for row in csv.DictReader(file):
            groups.setdefault((row["material"], row["radii_mm"]), []).append(row)
    print("| material | radii mm | sheared off | height mm, of all | of those that stood | spread mm | shift mm | core-s |")
    print("|---|---|---|---|---|---|---|---|")
    for (material, sizes), rows in groups.items():
        heaps = [[float(row[name]) for name in READINGS] for row in rows]
        heaps = [heap for heap in heaps if not math.isnan(heap[0])]
        stood = [heap for heap in heaps if heap[2] <= SHEARED_MM]
        cells = [f"{len(heaps) - len(stood)} of {len(heaps)}"]
        for chosen, column in ((heaps, 0), (stood, 0), (heaps, 1), (heaps, 2)):
            cells.append("{:.1f} ({:.1f})".format(*mean_and_deviation([h[column] for h in chosen])) if chosen else "-")
        cells.append(f"{sum(float(row['core_s']) for row in rows) / len(rows):.1f}")
        print(f"| {material} | {sizes} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program", nargs="?")
    options.add_argument("table")
    options.add_argument("--packings", type=int, default=24)
    options.add_argument("--sizes", nargs="+", choices=SIZES | OTHER_MEANS, default=list(SIZES))
    options.add_argument("--materials", nargs="+", choices=MATERIALS, default=list(MATERIALS))
    options.add_argument("--report", action="store_true")
    chosen = options.parse_args()
    if chosen.report:
        report(chosen.table)
    else:
        measure(chosen.program, chosen.table, chosen.packings, chosen.sizes, chosen.materials)
