#!/usr/bin/env python3
"""What a calibration to one reading of a concrete predicts for the other: the spread from the height, or the height from the spread.

usage: unfitted_reading.py PROGRAM TABLE.csv [--mixes 02,79,...] [--fitted height,spread] [--seed 1] [--packings 8]
       unfitted_reading.py --report TABLE.csv

Mixes: of Yeh's 103 concretes those that are at most 1.1 times as wide as a cone of their height and volume, and narrower heaps too. Each is calibrated as
`pastefit new` sets it up from density and one reading. The card's material is simulated on packings that no search has seen; the means
of the heaps that stand are compared with the laboratory. Rows that stand in the table are not run again.

The report has bias and scatter as the validation guide of the Fire Dynamics Simulator defines them (McGrattan and Toman, NIST, 2011):
with r = ln(predicted / measured), the deviation of r is that of model and laboratory together, the laboratory's own relative deviation is
taken off, and the bias is exp(mean r + (model deviation^2 - laboratory deviation^2) / 2).
"""
import argparse
import csv
import math
import statistics
from pathlib import Path
from types import SimpleNamespace

import laws

COLUMNS = ["mix", "fitted", "seed", "status", "error", "sheared", "measured_height_mm", "measured_spread_mm", "height_mm", "spread_mm"]
LABORATORY_MM = {"height": 7.5, "spread": 25}  # deviation between tests, as the studies take it
OPTIONS = {"height": "--height", "spread": "--spread"}


def readings_of(words):
    return float(words[words.index("--height") + 1]), float(words[words.index("--spread") + 1])


def sheet_of(words, fitted):
    """The sheet without the other reading."""
    other = words.index(OPTIONS["spread" if fitted == "height" else "height"])
    return words[:other] + words[other + 2:]


def measure(options):
    known = set()
    if Path(options.table).exists():
        with open(options.table) as file:
            known = {(row["mix"], row["fitted"]) for row in csv.DictReader(file)}
    words = ",".join(f"uci:{mix}" for mix in options.mixes.split(",")) if options.mixes else "uci:all"
    chosen = SimpleNamespace(search={}, parameters="{}", foreign=options.packings)
    with open(options.table, "a", newline="") as file:
        rows = csv.writer(file)
        if not known and file.tell() == 0:
            rows.writerow(COLUMNS)
        for sheet, sheet_words in laws.sheets_of(words).items():
            height, spread = readings_of(sheet_words)
            for fitted in options.fitted.split(","):
                if (sheet, fitted) in known:
                    continue
                row = dict(zip(laws.COLUMNS, laws.run(options.program, sheet, sheet_of(sheet_words, fitted), "new", options.seed, chosen)))
                rows.writerow([sheet, fitted, options.seed, row["status"], row["miss"], row["foreign_sheared"], height, spread, row["height"],
                               row["spread"]])
                file.flush()


def bias_and_scatter(pairs, laboratory_mm):
    """Of pairs (predicted, measured): bias, relative deviation of the model, relative deviation of the laboratory."""
    ratios = [math.log(predicted / measured) for predicted, measured in pairs]
    laboratory = math.sqrt(statistics.mean((laboratory_mm / measured) ** 2 for _, measured in pairs))
    model = math.sqrt(max(0, statistics.variance(ratios) - laboratory**2))
    return math.exp(statistics.mean(ratios) + (model**2 - laboratory**2) / 2), model, laboratory


def report(table):
    with open(table) as file:
        rows = [row for row in csv.DictReader(file) if row["height_mm"] and row["spread_mm"]]
    print("| predicted, from | mixes | confirmed | bias | scatter of the model | of the laboratory | predicted less measured, mm: mean and deviation |")
    print("|---|---:|---:|---:|---:|---:|---|")
    for predicted, fitted in (("spread", "height"), ("height", "spread")):
        of = [row for row in rows if row["fitted"] == fitted]
        if len(of) < 2:
            continue
        pairs = [(float(row[f"{predicted}_mm"]), float(row[f"measured_{predicted}_mm"])) for row in of]
        bias, model, laboratory = bias_and_scatter(pairs, LABORATORY_MM[predicted])
        differences = [a - b for a, b in pairs]
        print(f"| {predicted}, from the {fitted} | {len(of)} | {sum(row['status'] == 'confirmed' for row in of)} | {bias:.2f} | "
              f"{100 * model:.0f} % | {100 * laboratory:.0f} % | {statistics.mean(differences):+.0f} ± {statistics.stdev(differences):.0f} |")
        for row, (a, b) in sorted(zip(of, pairs), key=lambda one: -abs(math.log(one[1][0] / one[1][1])))[:3]:
            print(f"    worst: {row['mix']}, {row['status']}, {predicted} {a:.0f} against {b:.0f} mm, sheared off {row['sheared']}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("table")
    parser.add_argument("--mixes", default="")
    parser.add_argument("--fitted", default="height,spread")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--packings", type=int, default=8)
    parser.add_argument("--report", action="store_true")
    given = parser.parse_args()
    report(given.table) if given.report else measure(given)
