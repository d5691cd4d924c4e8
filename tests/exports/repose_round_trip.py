#!/usr/bin/env python3
"""Compares angles of repose of dry materials in another program, from the exported deck, with those in pastefit, in the same
packings.

usage: repose_round_trip.py PASTEFIT LAB [--to liggghts|lammps] [--pairs 0.3/0.1,0.5/0.2,...] [--packings N] [--within DEGREES]

LAB is a laboratory file of a lifted cylinder with an angle of repose. Each pair is the sliding and the rolling friction of
grains and walls alike, so that the frictions are the same in both programs. The card comes from a study without free
parameters.

Exit status 1 if a mean angle differs by more than DEGREES (1) and by more than two standard errors of the difference; 77 if
the program is not installed.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

import engines

ANGLE = "step1.angle_of_repose_deg"


def card_of(program, lab, friction, rolling, folder):
    """A card of this material: of a search that has next to nothing to find."""
    walls = {f"{wall}_{kind}": {"value": value} for wall in ("mould", "table")
             for kind, value in (("friction", friction), ("rolling_friction", rolling))}
    study = {"format": "pastefit-study-1", "title": f"friction {friction}, rolling friction {rolling}", "lab": str(lab.resolve()),
             "contact": {"normal": "hertz", "attraction": "none", "rolling_model": "spring_dashpot", "friction_basis": "elastic"},
             "parameters": {"friction": {"free": [friction, friction * (1 + 1e-4)]},
                            "rolling_friction": {"value": rolling}, **walls},
             "search": {"screening": 1, "budget_simulations": 3, "packings": 1, "confirmation_packings": 1,
                        "examination_simulations": 0}}
    file = folder / "study.json"
    file.write_text(json.dumps(study))
    run = subprocess.run([program, "calibrate", file, "--out", folder / "out", "--force", "--quiet"], capture_output=True, text=True)
    if run.returncode not in (0, 1):  # 1: this material is not the laboratory's
        raise SystemExit(run.stderr)
    return folder / "out" / "card.json"


def ours(program, card, packing):
    run = subprocess.run([program, "simulate", card, "--seed", str(packing), "--json"], capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(run.stderr)
    return json.loads(run.stdout)["observables"][ANGLE]


def theirs(program, target, card, packing, deck):
    engines.export(program, card, target, deck, packing)
    run = subprocess.run(engines.command_of(target, "slump", program, deck), cwd=deck, capture_output=True, text=True,
                         env=engines.environment())
    if run.returncode != 0 or "ERROR" in run.stdout:
        raise SystemExit(run.stdout[-2000:] + run.stderr)
    read = subprocess.run([program, "read", deck / "heap.dump", "--card", card, "--packing", str(packing), "--json"],
                          capture_output=True, text=True)
    if read.returncode not in (0, 1):  # 1: the heap differs from the card's
        raise SystemExit(read.stderr)
    return json.loads(read.stdout)["readings"][ANGLE]["read"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda name: str(pathlib.Path(name).resolve()))
    parser.add_argument("lab", type=pathlib.Path)
    parser.add_argument("--to", default="liggghts")
    parser.add_argument("--pairs", default="0.3/0.1,0.5/0.1,0.5/0.25,0.7/0.25,0.7/0.5")
    parser.add_argument("--packings", type=int, default=4)
    parser.add_argument("--within", type=float, default=1)
    options = parser.parse_args()
    good = True
    print(f"| friction, rolling friction | pastefit degrees | {options.to} degrees | difference | +- its error |")
    print("|---|---|---|---|---|")
    for pair in options.pairs.split(","):
        friction, rolling = map(float, pair.split("/"))
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            card = card_of(options.program, options.lab, friction, rolling, folder)
            a, b = [], []
            for packing in range(1, options.packings + 1):
                b.append(theirs(options.program, options.to, card, packing, folder / "deck"))
                a.append(ours(options.program, card, packing))
        difference = statistics.mean(b) - statistics.mean(a)
        error = math.sqrt((statistics.variance(a) + statistics.variance(b)) / options.packings)
        good = good and abs(difference) <= max(options.within, 2 * error)
        print(f"| {friction:g}, {rolling:g} | {statistics.mean(a):.1f} ± {statistics.stdev(a):.1f} | {statistics.mean(b):.1f} ± "
              f"{statistics.stdev(b):.1f} | {difference:+.1f} | {error:.1f} |", flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    engines.exit_with(main)
