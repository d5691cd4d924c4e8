#!/usr/bin/env python3
"""Calibrations of concretes, and heaps of the resulting materials on packings that no search has used.

usage: standing_heaps.py PROGRAM TABLE.csv [--mixes 79,57] [--seeds 1,2] [--grains mono|spread] [--shape free|fixed]
                         [--shift] [--unexamined] [--core-budget 400] [--keep DIR]
       standing_heaps.py --report TABLE.csv

The study of mix 79 (data/studies) with the readings of other mixes. Grains: 8 mm, or uniform from 6 to 10 mm. Shape: all
eight parameters free, or the shape of the bridge fixed as in the study. With --shift the top's shift is fitted to 0 within
40 mm and sheared heaps are not counted (`rejected_share` 1), as in earlier versions of the studies. Existing rows are not
run again. Each material is simulated on packings 201 to 216; height and spread are those of the heaps that do not shear off;
core_s is the processor time of the calibration, page included.
"""
import argparse
import csv
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Height and spread in mm: rows of I-Cheng Yeh's Concrete Slump Test (UCI, 2009), slump taken from the cone's 300 mm.
MIXES = {"79": (137.5, 310), "57": (80, 400), "50": (85, 420), "29": (140, 260), "90": (155, 365), "66": (90, 510),
         "85": (65, 525), "74": (100, 380), "04": (270, 215)}
FREE = {"rupture_force_ratio": {"free": [0, 0.5]}, "curvature": {"free": [-0.5, 1]}, "formation_ratio": {"free": [0, 1]}}
GRAINS = {"mono": {"distribution": "mono", "radius_mm": 8},
          "spread": {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10}}
COLUMNS = ["mix", "seed", "grains", "shape", "shift", "status", "simulations", "core_s", "coarse", "confirmed_on", "miss", "rejected",
           "heaps", "height", "height_deviation", "spread", "spread_deviation", "friction", "rolling_friction"]
SHEARED_MM = 40  # 0.4 of the mould's base radius


def write_study(folder, mix, seed, options):
    lab = json.loads((ROOT / "data/lab/concrete-mix-79.json").read_text())
    study = json.loads((ROOT / "data/studies/concrete-mix-79.json").read_text())
    height, spread = MIXES[mix]
    lab["grains"] = GRAINS[options.grains]
    lab["measurements"] = {"step1.height_mm": {"value": height, "standard_deviation": 7.5},
                           "step1.spread_mm": {"value": spread, "standard_deviation": 25}}
    study["weights"] = {"step1.height_mm": 1, "step1.spread_mm": 1}
    study["tolerances"] = {"step1.height_mm": 7.5, "step1.spread_mm": 25}
    if options.shift:
        lab["measurements"]["step1.lateral_shift_mm"] = {"value": 0, "standard_deviation": 20}
        study["weights"]["step1.lateral_shift_mm"] = 1
        study["tolerances"]["step1.lateral_shift_mm"] = 40
        if options.rejected_share is not None:
            study["search"]["rejected_share"] = 1
    if options.shape == "free":
        study["parameters"] |= FREE
    study["search"]["seed"] = seed
    if options.unexamined:
        study["search"]["examination_simulations"] = 0
    study["lab"] = "lab.json"
    (folder / "lab.json").write_text(json.dumps(lab))
    (folder / "study.json").write_text(json.dumps(study))
    return folder / "study.json"


def foreign_heaps(program, study, card, packings):
    sets = [part for name, value in card["material"]["parameters"].items()
            for part in ("--set", f"parameters.{name}={value!r}")]
    heaps = []
    for packing in packings:
        done = subprocess.run([program, "simulate", study, *sets, "--seed", str(packing), "--json", "--quiet"],
                              capture_output=True, text=True)
        if done.returncode == 0:
            heaps.append(json.loads(done.stdout)["observables"])
    return heaps


def mean_and_deviation(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / max(1, len(values) - 1))


def run(program, mix, seed, options):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        study = write_study(folder, mix, seed, options)
        done = subprocess.run([program, "calibrate", study, "--out", folder / "out", "--threads", "1", "--quiet",
                               "--core-budget", str(options.core_budget)], capture_output=True, text=True)
        if done.returncode == 2 or not (folder / "out/card.json").exists():
            sys.exit(done.stderr)
        card = json.loads((folder / "out/card.json").read_text())
        if options.keep:
            shutil.copy(folder / "out/evaluations.sqlite", options.keep / f"{mix}-{seed}.sqlite")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        heaps = foreign_heaps(program, study, card, range(201, 217))
    standing = [heap for heap in heaps if heap["step1.lateral_shift_mm"] <= SHEARED_MM] or heaps
    parameters = card["material"]["parameters"]
    height, deviation = mean_and_deviation([heap["step1.height_mm"] for heap in standing])
    spread, spread_deviation = mean_and_deviation([heap["step1.spread_mm"] for heap in standing])
    core_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return [mix, seed, options.grains, options.shape, int(options.shift), card["search"]["status"],
            card["search"].get("evaluations", card["search"].get("simulations")), round(core_s),
            card["search"].get("coarse_simulations", 0), len(card["confirmation"]["packings"]),
            round(card["confirmation"]["error"], 2), sum(h["step1.lateral_shift_mm"] > SHEARED_MM for h in heaps), len(heaps),
            round(height, 1), round(deviation, 1), round(spread, 1), round(spread_deviation, 1),
            round(parameters["friction"], 3), round(parameters["rolling_friction"], 3)]


def measure(options):
    known = set()
    if os.path.exists(options.table):
        with open(options.table) as file:
            known = {tuple(row[name] for name in COLUMNS[:5]) for row in csv.DictReader(file)}
    with open(options.table, "a", newline="") as file:
        rows = csv.writer(file)
        if not known and file.tell() == 0:
            rows.writerow(COLUMNS)
        for seed in options.seeds.split(","):
            for mix in options.mixes.split(","):
                if (mix, seed, options.grains, options.shape, str(int(options.shift))) in known:
                    continue
                rows.writerow(run(options.program, mix, int(seed), options))
                file.flush()


def report(table):
    print("| " + " | ".join(COLUMNS) + " |\n|" + "---|" * len(COLUMNS))
    with open(table) as file:
        for row in csv.DictReader(file):
            print("| " + " | ".join(row.values()) + " |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("table")
    parser.add_argument("--mixes", default=",".join(MIXES))
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--grains", choices=GRAINS, default="spread")
    parser.add_argument("--shape", choices=("free", "fixed"), default="free")
    parser.add_argument("--shift", action="store_true")
    parser.add_argument("--unexamined", action="store_true", help="without what follows the confirmation")
    parser.add_argument("--rejected-share", type=float)
    parser.add_argument("--core-budget", type=float, default=400)
    parser.add_argument("--keep", type=Path, metavar="DIR", help="where to put each search's evaluations")
    parser.add_argument("--report", action="store_true")
    chosen = parser.parse_args()
    report(chosen.table) if chosen.report else measure(chosen)
