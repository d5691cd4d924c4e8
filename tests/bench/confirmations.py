#!/usr/bin/env python3
"""What a confirmation determines about the share of heaps that shear off, and how many heaps a card costs.

usage: confirmations.py EVALUATIONS.sqlite...
       confirmations.py --readings

Takes stored simulations (`standing_heaps.py --keep`) near the readings of concrete 79 (within 15 mm of its height and 25 mm
of its spread, with the study's own grains), and draws confirmations from the shifts of their tops: unchanged, or scaled so
that another share exceeds the limit. 3,000 draws for each number give a share to 0.01. Each candidate costs three more
simulations. The decision rule is that of calibrate/judge/verdict.h. The probability from the shifts is that of a normal
variable of unknown mean and deviation, drawn here (400 deviations), and of a noncentral t distribution there.

--readings: how often a material of known true error is confirmed, by the mean over 8 normally distributed packings, and by a
mean that is examined after 8, 12, ..., 64 of them until there is a decision. 200,000 materials for each number.
"""
import json
import math
import sqlite3
import sys

import numpy as np

HEIGHT_MM, SPREAD_MM, SHEARED_MM = 137.5, 310, 40
ALLOWED, HARDLY, LIKELY, SURELY = 0.2, 0.1, 0.5, 0.8
CONFIRMATIONS, CANDIDATE = 3000, 3
STAGES = {"as many again": (8, 16, 32), "half as many more": (8, 12, 16, 20, 24, 28, 32)}
random = np.random.default_rng(1)


def near_heaps(paths):
    found = []
    for path in paths:
        store = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        for readings, run in store.execute("SELECT observables, run FROM evaluations WHERE failure = 'null'"):
            heap, run = json.loads(readings), json.loads(run)
            if run["particles"] < 1000 or run["ended_early"]:
                continue
            if abs(heap["step1.height_mm"] - HEIGHT_MM) < 15 and abs(heap["step1.spread_mm"] - SPREAD_MM) < 25:
                found.append(heap["step1.lateral_shift_mm"] / SHEARED_MM)
    return np.array(found)


def within_by_count(rejected, heaps):
    """P(share <= ALLOWED) of a beta distribution of rejected + 1 and heaps - rejected + 1: that of more than `rejected` of heaps + 1."""
    return sum(math.comb(heaps + 1, k) * ALLOWED**k * (1 - ALLOWED) ** (heaps + 1 - k) for k in range(rejected + 1, heaps + 2))


def normal_cdf(values):
    return np.vectorize(lambda value: 0.5 * math.erfc(-value / math.sqrt(2)))(values)


def within_by_index(indices):
    """The same by how near heaps came, a row each; their roots are normal."""
    heaps = indices.shape[1]
    roots = np.sqrt(np.clip(indices, 0, 2.25))
    mean, squares = roots.mean(1), ((roots - roots.mean(1)[:, None]) ** 2).sum(1)
    deviations = np.sqrt(squares[:, None] / random.chisquare(heaps - 1, 400)[None, :])
    needed = 0.8416212  # deviations beyond which a share of 0.2 of a normal variable lies
    return normal_cdf((1 - needed * deviations - mean[:, None]) / (deviations / math.sqrt(heaps))).mean(1)


def confirm(indices, stages):
    """Of all confirmations the share that holds, and the heaps of one."""
    verdict, asked = np.zeros(len(indices), int), np.zeros(len(indices))
    for heaps in stages:
        left = verdict == 0
        rows = indices[left, :heaps]
        by_count = np.array([within_by_count(int(count), heaps) for count in (rows > 1).sum(1)])
        by_index = within_by_index(rows)
        now = np.where((by_index >= SURELY) & (by_count >= LIKELY), 1, 0)
        now[np.minimum(by_index, by_count) < HARDLY] = -1
        verdict[left], asked[left] = now, heaps
    return (verdict == 1).mean(), asked.mean()


def meets(error, scatter, looks, materials=200_000):
    """The share of materials of this true error that is confirmed; scatter: of one packing; both in tolerances."""
    heaps = random.normal(error, scatter, (materials, max(looks)))
    confirmed, open_ = np.zeros(materials, bool), np.ones(materials, bool)
    for count in looks:
        mean, noise = heaps[:, :count].mean(1), heaps[:, :count].std(1, ddof=1) / math.sqrt(count)
        confirmed |= open_ & (mean**2 + noise**2 <= 1)
        open_ &= ~confirmed & (mean**2 - noise**2 <= 1)
    return confirmed.mean()


def report_on_readings():
    print("| true error, tolerances | " + " | ".join(f"scatter {scatter:g}: 8 packings | 8 to 64" for scatter in (0.5, 1, 2)) + " |")
    print("|---:|" + "---:|" * 6)
    for error in (0.6, 0.8, 1, 1.1, 1.2, 1.5, 2):
        cells = [f"{meets(error, scatter, looks):.3f}" for scatter in (0.5, 1, 2) for looks in ((8,), range(8, 65, 4))]
        print(f"| {error:g} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[1] == "--readings":
        sys.exit(report_on_readings())
    shifts = near_heaps(sys.argv[1:])
    shared = (shifts > 1).mean()
    print(f"{len(shifts)} heaps, {100 * shared:.1f} % sheared off\n")
    print("| share that shears off | " + " | ".join(f"{name}: holds | heaps to a card" for name in STAGES) + " |")
    print("|---:|" + "---:|" * (2 * len(STAGES)))
    for share in sorted({0.06, shared, 0.2, 0.25, 0.3}):
        scaled = shifts / np.quantile(shifts, 1 - share)
        cells = []
        for stages in STAGES.values():
            holds, heaps = confirm(random.choice(scaled, (CONFIRMATIONS, max(stages))), stages)
            cells += [f"{holds:.2f}", f"{(heaps + CANDIDATE) / holds - CANDIDATE:.0f}"]
        print(f"| {100 * share:.3g} % | " + " | ".join(cells) + " |")
