#!/usr/bin/env python3
"""Strength of heaps over the yield stress that a formula gives for their height.

usage: strengths.py EVALUATIONS.sqlite...

Takes every complete stored simulation of an Abrams cone (`standing_heaps.py --keep`), also of coarse grains, with the
density of concrete 79. The formula is that of calibrate/laboratory/yield_stress.h (Schowalter & Christensen 1998).
"""
import json
import math
import sqlite3
import sys

HEIGHT_MM, SHAPE, DENSITY = 300, 1.0, 2349.2  # of the mould; its top's radius over what the base's is more; kg/m3
HEIGHTS_MM = [40, 60, 80, 100, 125, 150, 200, 250, 290]


def kept_share(stress):
    """Height over the mould's; `stress`: yield stress over rho g H."""
    def at(depth):
        return SHAPE / 6 * ((1 + depth / SHAPE) - (1 + depth / SHAPE) ** -2)

    def excess(depth):
        return (1 + depth / SHAPE) ** 3 - 1

    if at(1) <= stress:
        return 1
    low, high = 0, 1
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if at(middle) < stress else (low, middle)
    return low + 2 * stress * math.log(excess(1) / excess(low))


def yield_stress_pa(height_mm):
    low, high = 0, 1
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if kept_share(middle) < height_mm / HEIGHT_MM else (low, middle)
    return low * DENSITY * 9.81 * 1e-3 * HEIGHT_MM


def ratios(paths):
    for path in paths:
        store = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        for values, readings, run in store.execute("SELECT parameter_values, observables, run FROM evaluations WHERE failure = 'null'"):
            height_mm = json.loads(readings).get("step1.height_mm")
            if height_mm and not json.loads(run)["ended_early"] and HEIGHTS_MM[0] <= height_mm < HEIGHTS_MM[-1]:
                yield height_mm, json.loads(values)["strength_pa"] / yield_stress_pa(height_mm)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    found = list(ratios(sys.argv[1:]))
    print("| height, mm | heaps | 2.5 % | median | 97.5 % |\n|---|---:|---:|---:|---:|")
    for low, high in zip(HEIGHTS_MM, HEIGHTS_MM[1:]):
        there = sorted(ratio for height, ratio in found if low <= height < high)
        if there:
            cells = [f"{there[round(share * (len(there) - 1))]:.2g}" for share in (0.025, 0.5, 0.975)]
            print(f"| {low} to {high} | {len(there)} | " + " | ".join(cells) + " |")
