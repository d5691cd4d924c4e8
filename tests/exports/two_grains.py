#!/usr/bin/env python3
"""Force of two grains against their distance, measured in another program with the deck that was exported for it,
against the card's law.

usage: two_grains.py PASTEFIT CARD lammps|lammps-tables|liggghts|yade

The program has to give the card's curve to 1e-6 of its peak: on the way apart, with a bridge that lives until it
ruptures, and, where the program has memory, on the way back, where a new one forms when the shells meet. LIGGGHTS, whose
nearest law is another one, has to give the curve that the export says it will, to 1e-6 of the peak; the difference to
the card is reported.
Exit status 77, and "skipped: ... is not installed", where the program is missing.
"""

import copy
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import engines

TOLERANCE = 1e-6


def of_deck_grains(test, deck):
    """The card's law for the grains of the deck: those that fill the mould, by up to 2 % larger or smaller than the mean."""
    found = re.search(r"^set +type 1 diameter (\S+)", deck.read_text(), re.MULTILINE)
    if not found:
        return test
    test = copy.deepcopy(test)
    contact, bridge = test["contact"], test["contact"]["bridge"]
    scale = 0.5 * float(found[1]) / test["grains"]["radius_m"]
    test["grains"]["radius_m"] *= scale
    for key, power in (("b_n_m", 1), ("c_n", 2), ("d_c_m", 1), ("offset_m", 1)):
        bridge[key] *= scale ** power
    if contact["cohesion_n"] is not None:
        contact["cohesion_n"] *= scale ** 2
    return test


def card_force(test, distance):
    """Force that pushes two grains of the mean radius apart, by the card's numbers."""
    contact, radius = test["contact"], test["grains"]["radius_m"]
    bridge = contact["bridge"]
    overlap = 2 * radius - distance
    if overlap > 0:
        modulus = contact["youngs_modulus_pa"] / (2 * (1 - contact["poissons_ratio"] ** 2))
        cohesion = bridge["c_n"] if contact["cohesion_n"] is None else contact["cohesion_n"]
        return 4 / 3 * modulus * math.sqrt(radius / 2) * overlap ** 1.5 - cohesion
    if overlap < bridge["d_c_m"]:
        return 0.0
    return -((bridge["a_n_m2"] * overlap + bridge["b_n_m"]) * overlap + bridge["c_n"])


def liggghts_force(test, fit, distance):
    """The same with the bridge of Soulie et al. (2006) that the export names, at contact angle 0."""
    radius = test["grains"]["radius_m"]
    repulsion = card_force(test, distance) + fit["cohesion"] if distance < 2 * radius else 0.0
    gap = max(distance - 2 * radius, 0.0)
    if gap >= fit["volume"] ** (1 / 3):
        return 0.0
    v = fit["volume"] / radius ** 3
    bridge = math.exp(-1.1 * v ** -0.53 * gap / radius + 0.48 - 0.0082 * math.log(v)) + 0.078 + 0.0018 * math.log(v)
    return repulsion - math.pi * fit["tension"] * radius * bridge


def fit_of(deck, test):
    """Volume and tension as the deck gives them to LIGGGHTS."""
    value = {}
    for line in deck.read_text().splitlines():
        words = line.split()
        if len(words) == 7 and words[3] == "property/global" and words[5] == "scalar":
            value[words[4]] = float(words[6])
    radius, contact = test["grains"]["radius_m"], test["contact"]
    grain = 4 / 3 * math.pi * radius ** 3
    cohesion = contact["bridge"]["c_n"] if contact["cohesion_n"] is None else contact["cohesion_n"]
    return {"volume": value["surfaceLiquidContentInitial"] * grain * (1 - math.sqrt(0.75)),
            "tension": value["surfaceTension"], "cohesion": cohesion}


def distances(output, way):
    """Distance and force of every line "apart r F" or "back r F" of a program."""
    return [tuple(map(float, line.split()[1:])) for line in output.splitlines() if line.split()[:1] == [way]]


def largest_error(points, expected, peak):
    return max(abs(force - expected(distance)) / peak for distance, force in points)


def main(program, card_file, target):
    test = json.loads(pathlib.Path(card_file).read_text())["material"]  # its grains, and the law between them
    with tempfile.TemporaryDirectory() as name:
        deck = pathlib.Path(name) / "deck"
        engines.export(program, card_file, target, deck)
        try:
            command = engines.command_of(target, "two_grains", program, deck)
        except engines.Missing as missing:
            print(f"skipped: {missing} is not installed")
            return engines.SKIP
        run = subprocess.run(command, cwd=deck, capture_output=True, text=True, timeout=300, env=engines.environment())
        fit = fit_of(deck / "in.two_grains", test) if target == "liggghts" else None
        if target.startswith("lammps"):
            test = of_deck_grains(test, deck / "in.two_grains")
    apart, back = distances(run.stdout, "apart"), distances(run.stdout, "back")
    if len(apart) < 200 or (target.startswith("lammps") and len(back) < 200):
        print(run.stdout[-2000:], run.stderr[-2000:])
        return 1
    bridge, radius = test["contact"]["bridge"], test["grains"]["radius_m"]
    peak = bridge["c_n"]
    expected = (lambda r: liggghts_force(test, fit, r)) if fit else (lambda r: card_force(test, r))
    worst = largest_error(apart, expected, peak)
    across = largest_error([p for p in apart if p[0] > 2 * radius], lambda r: card_force(test, r), peak)
    inside = [p for p in apart if p[0] < 2 * radius]
    beyond = [p for p in apart if p[1] == 0]
    print(f"{target}: {len(apart)} distances, {len(inside)} in overlap, {len(beyond)} beyond rupture; largest error "
          f"{worst:.1e} of the peak of {peak:.4g} N; across a gap {across:.2g} of the peak from the card")
    good = worst < TOLERANCE and inside and beyond
    if back:
        shells = 2 * radius + (2 * bridge["offset_m"] if bridge["formation"] == "film" else 0)
        worst = largest_error(back, lambda r: card_force(test, r) if r <= shells else 0.0, peak)
        print(f"{target}, on the way back, where the bridge forms at {1e3 * shells:.4g} mm: {worst:.1e} of the peak")
        good = good and (worst < TOLERANCE or target == "lammps-tables")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
