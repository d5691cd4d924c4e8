#!/usr/bin/env python3
"""What a calibration to one reading of a concrete predicts for the other: the spread from the height, or the height from the spread.

usage: unfitted_reading.py PROGRAM TABLE.csv [--mixes 02,79,...] [--fitted height,spread] [--seed 1] [--packings 8]

Mixes: of Yeh's 103 concretes those that are at most 1.1 times as wide as a cone of their height and volume, and narrower heaps too. Each is calibrated as
`pastefit new` sets it up from density and one reading. The card's material is simulated on packings that no search has seen; the means
of the heaps that stand are compared with the laboratory. Rows that stand in the table are not run again.
`prediction_table.py` makes bias and scatter of it.
"""
import argparse
import csv
from pathlib import Path
from types import SimpleNamespace

import laws

COLUMNS = ["mix", "fitted", "seed", "status", "error", "sheared", "measured_height_mm", "measured_spread_mm", "height_mm", "spread_mm"]
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
    chosen = SimpleNamespace(search={}, parameters="{}", foreign=options.packings, target="lammps")
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


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("table")
    parser.add_argument("--mixes", default="")
    parser.add_argument("--fitted", default="height,spread")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--packings", type=int, default=8)
    given = parser.parse_args()
    measure(given)
