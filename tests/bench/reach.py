#!/usr/bin/env python3
"""Spreads of the heaps that do not shear off, at a measured height.

usage: reach.py EVALUATIONS.sqlite...

Takes every complete stored simulation of an Abrams cone (`standing_heaps.py --keep`), whatever the target of its search. For
each mix: of the heaps with a height within the tolerance, the number sheared off, and quantiles of the spread of the others.
A mix is in reach if its spread, plus or minus its tolerance, is between them. Then, of the heaps near both readings of some
mix, the share that sheared off, by their sliding friction.
"""
import json
import sqlite3
import sys

from standing_heaps import MIXES, SHEARED_MM

HEIGHT_TOLERANCE_MM, SPREAD_TOLERANCE_MM = 7.5, 25
FEWEST_GRAINS = 1000  # coarse grains are another test
FRICTIONS = [0.05, 0.08, 0.12, 0.18, 0.25, 0.4, 0.8]


def heaps(paths):
    seen = set()
    for path in paths:
        store = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        rows = store.execute("SELECT observables, run, parameter_values, packing FROM evaluations WHERE failure = 'null'")
        for readings, run, values, packing in rows:
            if (readings, values, packing) in seen:
                continue
            seen.add((readings, values, packing))
            heap, run, values = map(json.loads, (readings, run, values))
            if run["particles"] >= FEWEST_GRAINS and not run["ended_early"] and "step2.height_mm" not in heap:
                yield heap["step1.height_mm"], heap["step1.spread_mm"], heap["step1.lateral_shift_mm"] > SHEARED_MM, values["friction"]


def quantile(values, share):
    return sorted(values)[round(share * (len(values) - 1))]


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    found = list(heaps(sys.argv[1:]))
    print(f"{len(found)} heaps, {sum(sheared for _, _, sheared, _ in found)} sheared off\n")
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

    print("\n| mix | friction | heaps near both readings | sheared off |\n|---|---|---|---|")
    for mix, (height, spread) in MIXES.items():
        near = [heap for heap in found
                if abs(heap[0] - height) <= 3 * HEIGHT_TOLERANCE_MM and abs(heap[1] - spread) <= SPREAD_TOLERANCE_MM]
        for lower, upper in zip(FRICTIONS, FRICTIONS[1:]):
            band = [sheared for _, _, sheared, friction in near if lower <= friction < upper or friction == upper == FRICTIONS[-1]]
            if band:
                print(f"| {mix} | {lower} to {upper} | {len(band)} | {100 * sum(band) / len(band):.0f} % |")
