#!/usr/bin/env python3
"""Runs the slump test of cards in another program, from the exported deck, and in pastefit, in the same packings, and compares.

usage: slump_round_trip.py PASTEFIT CARD... [--to lammps|liggghts|yade] [--strengths 0.3,1,2,4,10]
                           [--packings N] [--radius-mm R] [--ranks N] [--time-step S] [--both-steps]
                           [--law epa|luding] [--adhesion-ratio X] [--tilt]

--strengths multiplies a card's attraction by each factor, for a series from weak to strong. Step 1 only, unless
--both-steps, which adds the usual drop plate to a card without one. With --law a card's grains are soft and have
elasto-plastic adhesion instead (`elasto_plastic.slump_card`), with the radius of --radius-mm. With --tilt, the heap is a pat on
a table that is tilted until it slides (LAMMPS only); its grains slide on the table and do not roll.

Exit status 1 if a reading differs significantly, at a false alarm rate of one in a thousand comparisons (t-interval for the
difference of two means, pooled variance; spreads below a millimetre count as one); 77 if the program is not installed.
"""

import argparse
import json
import math
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

import elasto_plastic
import engines

# two-sided quantile of Student's t at 0.001 for 2 (n - 1) degrees of freedom
BAND = {2: 31.6, 3: 8.61, 4: 5.96, 5: 5.04, 6: 4.59, 8: 4.14, 10: 3.92, 12: 3.79, 16: 3.65}


def variant(card, factor, both_steps):
    card = json.loads(json.dumps(card))
    material, test = card["material"], card["tests"][0]["test"]  # the test that an export takes
    contact = material["contact"]
    bridge = contact["bridge"]
    for key in ("a_n_m2", "b_n_m", "c_n"):
        bridge[key] *= factor
    if contact["cohesion_n"] is not None:
        contact["cohesion_n"] *= factor
    if "strength_pa" in material["parameters"]:
        material["parameters"]["strength_pa"] *= factor
    if not both_steps:
        test["drop"] = None
    elif test["drop"] is None:
        test["drop"] = {"length_m": test["table_length_m"], "mass_kg": 16, "lift_height_m": 0.04, "lift_duration_s": 0.5}
    return card


def pat(card):
    """A flat disc instead of the heap, on a table that is tilted."""
    test = card["tests"][0]["test"]
    test["mould"] = {"base_radius_m": 0.1, "top_radius_m": 0.1, "height_m": 0.05}
    test["table_wall"] |= {"friction": 0.35, "rolling_friction": 0.5}
    card["material"]["parameters"] |= {"table_friction": 0.35, "table_rolling_friction": 0.5}
    test["tilt"] = {"rate_deg_s": 3, "slide_m": 0.005}


def ours(options, file, packing):
    step = ["--time-step", str(options.time_step)] if options.time_step else []
    run = subprocess.run([options.program, "simulate", file, "--seed", str(packing), "--json", *step],
                         capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(run.stderr)
    return json.loads(run.stdout)["observables"]


def theirs(options, file, packing, deck):
    """Readings and wall time of the other program."""
    engines.export(options.program, file, options.to, deck, packing)
    command = engines.command_of(options.to, "slump", options.program, deck, options.ranks)
    start = time.time()
    run = subprocess.run(command, cwd=deck, capture_output=True, text=True, env=engines.environment())
    if run.returncode != 0 or "ERROR" in run.stdout:
        raise SystemExit(run.stdout[-2000:] + run.stderr)
    wall = time.time() - start
    second = [deck / "heap2.dump"] if options.both_steps else []
    read = subprocess.run([options.program, "read", deck / "heap.dump", *second, "--card", file, "--packing", str(packing),
                           "--json"], capture_output=True, text=True)
    if read.returncode not in (0, 1):  # 1: the heap differs from the card's, whose attraction was changed here
        raise SystemExit(read.stderr)
    readings = {name: row["read"] for name, row in json.loads(read.stdout)["readings"].items()}
    if options.tilt:
        readings["tilt.slide_angle_deg"] = float(re.search(r"^slide angle (\S+) degrees$", run.stdout, re.M).group(1))
    return readings, wall


def compare(options, file, title, folder):
    """The largest difference of a reading, in standard errors of the difference."""
    pairs, walls = [], []
    for packing in range(1, options.packings + 1):
        other, wall = theirs(options, file, packing, folder / "deck")
        pairs.append((ours(options, file, packing), other))
        walls.append(wall)
    worst = 0
    for reading in pairs[0][1]:
        if reading.endswith("spilled_share") or reading not in pairs[0][0]:
            continue
        a, b = [p[0][reading] for p in pairs], [p[1][reading] for p in pairs]
        difference = statistics.mean(b) - statistics.mean(a)
        noise = math.sqrt(max(statistics.variance(a) + statistics.variance(b), 1.0) / len(pairs))
        worst = max(worst, abs(difference) / noise)
        print(f"| {title} | `{reading}` | {statistics.mean(a):.1f} ± {statistics.stdev(a):.1f} | "
              f"{statistics.mean(b):.1f} ± {statistics.stdev(b):.1f} | {difference:+.1f} | {difference / noise:+.1f} | "
              f"{statistics.mean(walls):.1f} |", flush=True)
    return worst


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda name: str(pathlib.Path(name).resolve()))
    parser.add_argument("cards", nargs="+", type=pathlib.Path)
    parser.add_argument("--to", default="lammps")
    parser.add_argument("--strengths", default="1")
    parser.add_argument("--packings", type=int, default=4, choices=BAND)
    parser.add_argument("--radius-mm", type=float)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--time-step", type=float, help="of pastefit [s]; without it the default")
    parser.add_argument("--both-steps", action="store_true")
    parser.add_argument("--tilt", action="store_true")
    parser.add_argument("--law", choices=elasto_plastic.EXPONENT)
    parser.add_argument("--adhesion-ratio", type=float, default=1.0)
    options = parser.parse_args()
    worst = 0
    print(f"| card, c in N | reading | pastefit mm | {options.to} mm | difference mm | of it | s a test |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for source in options.cards:
            taken = source
            if options.radius_mm and not options.law:
                taken = folder / "rescaled.json"
                subprocess.run([options.program, "rescale", source, "--radius", str(options.radius_mm), "--packings", "0",
                                "--out", taken], check=True, stdout=subprocess.DEVNULL)
            card = json.loads(taken.read_text())
            if options.law:
                elasto_plastic.slump_card(card, options.law, options.adhesion_ratio, 1e-3 * (options.radius_mm or 8))
            for factor in map(float, options.strengths.split(",")):
                changed = variant(card, factor, options.both_steps)
                if options.tilt:
                    pat(changed)
                file = folder / "card.json"
                file.write_text(json.dumps(changed))
                title = options.law or f"{source.stem}, {changed['material']['contact']['bridge']['c_n']:.3g}"
                worst = max(worst, compare(options, file, title, folder))
    allowed = BAND[options.packings]
    print(f"\nlargest difference: {worst:.1f} standard errors; noise alone stays below {allowed} in 999 of 1000 comparisons")
    return 0 if worst <= allowed else 1


if __name__ == "__main__":
    engines.exit_with(main)
