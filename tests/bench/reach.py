#!/usr/bin/env python3
"""Which spreads standing heaps have at the height that a laboratory measured.

usage: reach.py EVALUATIONS.sqlite...

Takes every whole simulation of an Abrams cone that the searches stored (`standing_heaps.py --keep`), whatever they were looking for. For each mix: of
the heaps whose height is within the tolerance, how many sheared off, and the quantiles of the spread of those that stand. A mix is in
reach where its spread, less or more its tolerance, lies between them.
"""
import json
import sqlite3
import sys

from standing_heaps import MIXES, SHEARED_MM

HEIGHT_TOLERANCE_MM, SPREAD_TOLERANCE_MM = 7.5, 25
FEWEST_GRAINS = 1000  # coarse grains are another test


def heaps(paths):
    for path in paths:
        store = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        for observables, run in store.execute("SELECT observables, run FROM evaluations WHERE failure = 'null'"):
            heap, run = json.loads(observables), json.loads(run)
            if run["particles"] >= FEWEST_GRAINS and not run["ended_early"] and "step2.height_mm" not in heap:
                yield heap["step1.height_mm"], heap["step1.spread_mm"], heap["step1.lateral_shift_mm"] > SHEARED_MM


def quantile(values, share):
    return sorted(values)[round(share * (len(values) - 1))]


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    found = list(heaps(sys.argv[1:]))
    print(f"{len(found)} heaps, {sum(sheared for *_, sheared in found)} sheared off\n")
    print("| mix | height | heaps | sheared off | spread needed | spread of the others: smallest, 5 %, median, 95 %, largest | in reach |")
    print("|---|---|---|---|---|---|---|")
    for mix, (height, spread) in MIXES.items():
        near = [heap for heap in found if abs(heap[0] - height) <= HEIGHT_TOLERANCE_MM]
        spreads = [heap[1] for heap in near if not heap[2]]
        if not spreads:
            continue
        quantiles = [quantile(spreads, share) for share in (0, 0.05, 0.5, 0.95, 1)]
        reached = sum(abs(value - spread) <= SPREAD_TOLERANCE_MM for value in spreads)
        print(f"| {mix} | {height} | {len(near)} | {len(near) - len(spreads)} | {spread} ± {SPREAD_TOLERANCE_MM} |",
              ", ".join(f"{value:.0f}" for value in quantiles), f"| {reached} of {len(spreads)} |")
