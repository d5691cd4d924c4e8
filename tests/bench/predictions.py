#!/usr/bin/env python3
"""Coverage of the bands that `pastefit predict` gives for another test.

usage: predictions.py PROGRAM TABLE.csv [--twins 1-20] [--preset hinged-plate] [--crossed] [--parameters JSON]
       predictions.py --report TABLE.csv

A twin is a random material with the bridge (odd numbers) or elasto-plastic adhesion (even numbers). Its measurement is
simulated: the mean height and spread of three packings in the Abrams cone, in whole millimetres. `pastefit new` and
`pastefit calibrate` fit a material to these two readings, with the law of the twin or, with `--crossed`, the other one, and
`pastefit predict` predicts the preset. One heap of the twin there, in a packing used nowhere else, is the measurement to
compare with. Twins are redrawn if a heap sheared off or its height is outside 60 to 230 mm. A row of the table is a reading;
existing rows are not run again.
"""
import argparse
import csv
import json
import math
import os
import random
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

COLUMNS = ["twin", "law", "status", "error", "reading", "measured", "lower", "upper", "within", "materials"]
LAWS = ("epa", "bridge")
SHEARED_MM = 40
DENSITY = "2300"
# What is read on each preset; the values only let `pastefit new` write a file.
READINGS = {"hinged-plate": ["--height", "120", "--spread", "290", "--height2", "100", "--spread2", "310", "--sag", "5"],
            "lifted-cylinder": ["--height", "60", "--spread", "200"], "haegermann": ["--height", "50", "--spread", "110"]}


def material_of(law, draw):
    between = lambda low, high: math.exp(draw.uniform(math.log(low), math.log(high)))
    if law == "bridge":
        return {"strength_pa": between(700, 2500), "rupture_gap_ratio": between(0.45, 0.95), "friction": between(0.07, 0.28),
                "rolling_friction": draw.uniform(0.05, 0.45)}
    return {"adhesion_ratio": between(0.6, 1.5), "friction": between(0.03, 0.12), "table_friction": between(0.03, 0.5)}


def without_comments(text):
    return json.loads(re.sub(r"(?m)//.*$", "", text))


def made(program, folder, law, words, mould):
    subprocess.run([program, "new", folder, "--mould", mould, "--density", DENSITY, "--law", law, "--force", "--quiet", *words],
                   check=True, capture_output=True)
    return folder / "study.json"


def heap(program, study, material, packing):
    sets = [word for name, value in material.items() for word in ("--set", f"parameters.{name}={value!r}")]
    done = subprocess.run([program, "simulate", study, *sets, "--seed", str(packing), "--json", "--quiet"], capture_output=True, text=True)
    return json.loads(done.stdout)["observables"] if done.returncode == 0 else None


def stands(heap):
    return heap is not None and heap["step1.lateral_shift_mm"] < SHEARED_MM


def twin_of(program, folder, law, number, options):
    """A material, its mean height and spread in the Abrams cone, and one heap of it on the preset."""
    draw = random.Random(number)
    cone = made(program, folder / "cone", law, ["--height", "120", "--spread", "330"], "abrams")
    other = made(program, folder / "other", law, READINGS[options.preset], options.preset)
    while True:
        material = material_of(law, draw)
        heaps = [heap(program, cone, material, packing) for packing in (301, 302, 303)]
        if not all(stands(one) for one in heaps):
            continue
        height, spread = (round(statistics.mean(one[f"step1.{name}_mm"] for one in heaps)) for name in ("height", "spread"))
        measured = heap(program, other, material, 401)
        if 60 <= height <= 230 and stands(measured):
            return height, spread, measured


def rows_of(number, options):
    law = LAWS[number % 2]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        height, spread, measured = twin_of(options.program, folder, law, number, options)
        fitted = LAWS[(number + 1) % 2] if options.crossed else law
        study = made(options.program, folder / "fit", fitted, ["--height", str(height), "--spread", str(spread)], "abrams")
        started = without_comments(study.read_text())
        started["search"]["seed"] = number
        started["parameters"] |= json.loads(options.parameters)
        study.write_text(json.dumps(started))
        subprocess.run([options.program, "calibrate", study, "--out", folder / "out", "--threads", "1", "--quiet"], capture_output=True)
        card = json.loads((folder / "out/card.json").read_text())
        status, error = card["search"]["status"], round(card["confirmation"]["error"], 2)
        done = subprocess.run([options.program, "predict", folder / "out", "--preset", options.preset, "--threads", "1", "--json", "--quiet"],
                              capture_output=True, text=True)
        if done.returncode:
            yield [number, fitted, status, error, done.stderr.strip().replace("\n", " ")[-200:], "", "", "", "", ""]
            return
        for reading, said in json.loads(done.stdout)["readings"].items():
            if reading in measured:
                value, lower, upper = measured[reading], said["lower"], said["upper"]
                yield [number, fitted, status, error, reading, round(value, 1), round(lower, 1), round(upper, 1),
                       int(lower <= value <= upper), json.dumps([round(mean, 1) for mean in said["of_materials"]])]


def measure(options):
    known = set()
    if os.path.exists(options.table):
        with open(options.table) as file:
            known = {int(row["twin"]) for row in csv.DictReader(file)}
    first, _, last = options.twins.partition("-")
    with open(options.table, "a", newline="") as file:
        rows = csv.writer(file)
        if not known and file.tell() == 0:
            rows.writerow(COLUMNS)
        for number in range(int(first), int(last or first) + 1):
            if number not in known:
                rows.writerows(list(rows_of(number, options)))
                file.flush()


def report(table):
    with open(table) as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "confirmed"]
    print("| reading | twins | within the band | mean of predicted less measured | deviation | width of the band, median |\n|---|---|---|---|---|---|")
    for name in dict.fromkeys(row["reading"] for row in rows):
        of = [row for row in rows if row["reading"] == name and row["measured"]]
        misses = [statistics.mean(json.loads(row["materials"])) - float(row["measured"]) for row in of]
        widths = [float(row["upper"]) - float(row["lower"]) for row in of]
        print(f"| {name} | {len(of)} | {sum(int(row['within']) for row in of)} | {statistics.mean(misses):.1f} | "
              f"{statistics.stdev(misses) if len(misses) > 1 else 0:.1f} | {statistics.median(widths):.0f} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("table")
    parser.add_argument("--twins", default="1-20")
    parser.add_argument("--preset", choices=READINGS, default="hinged-plate")
    parser.add_argument("--crossed", action="store_true", help="fit each twin with the other law")
    parser.add_argument("--parameters", default="{}", help="JSON that replaces some of the study's parameters")
    parser.add_argument("--report", action="store_true")
    chosen = parser.parse_args()
    report(chosen.table) if chosen.report else measure(chosen)
