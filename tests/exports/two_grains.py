#!/usr/bin/env python3
"""Force of two grains against their distance, computed by another program from its exported deck, against the card's law.

usage: two_grains.py PASTEFIT CARD lammps|liggghts|yade [jkr|dmt|sjkr|epa|luding|linear|exponential|capillary]

With an adhesive normal law the card's grains have this instead of bridges; with elasto-plastic adhesion (`epa`, `luding`)
they go through all its branches (`elasto_plastic.py`). With another attraction the bridge has that shape.

The program must give the card's curve to 1e-6 of its peak, and LAMMPS, which runs the engine's own laws, to 1e-10: during
separation, where a bridge lives until it ruptures, and, if the program has a history, during approach, where a new one forms
when the shells touch. LIGGGHTS, whose nearest law differs, must give the curve stated by the export, to 1e-6 of the peak;
the difference from the card is reported. SJKR of the same pull-off replaces other adhesive laws in LIGGGHTS, DMT in Yade.
Exit status 77, and "skipped: ... is not installed", without the program.
"""

import copy
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import elasto_plastic
import engines

TOLERANCE = {"lammps": 1e-10, "liggghts": 1e-6, "yade": 1e-6}  # of the peak
ATTRACTIONS = ("linear", "exponential", "capillary")


def of_deck_grains(test, deck):
    """The card's law for the grains of the deck: those that fill the mould, by up to 2 % larger or smaller than the mean."""
    found = re.search(r"^set +type 1 diameter (\S+)", deck.read_text(), re.MULTILINE)
    if not found:
        return test
    test = copy.deepcopy(test)
    contact, bridge = test["contact"], test["contact"]["bridge"]  # a surface energy belongs to no size
    scale = 0.5 * float(found[1]) / test["grains"]["radius_m"]
    test["grains"]["radius_m"] *= scale
    for key, power in (("b_n_m", 1), ("c_n", 2), ("d_c_m", 1), ("offset_m", 1), ("liquid_volume_m3", 3), ("surface_tension_n_m", 1)):
        bridge[key] *= scale ** power
    if contact["cohesion_n"] is not None:
        contact["cohesion_n"] *= scale ** 2
    return test


def with_law(card, law, strength_pa=3000):
    """The card with this law in place of its bridges, as strong as it says over R^2."""
    card = copy.deepcopy(card)
    material = card["material"]
    contact, radius = material["contact"], material["grains"]["radius_m"]
    contact["bridge"] = {key: 0.0 for key in contact["bridge"]} | {"shape": "none", "formation": "film"}
    contact.update(normal=law, cohesion_n=0.0)
    adhesion = strength_pa / (2 * math.pi)
    if law in elasto_plastic.EXPONENT:
        return elasto_plastic.of_card(card, law)
    own = {"cohesion_energy_density_pa": 40 * strength_pa} if law == "sjkr" else {"adhesion_pa": adhesion}
    if law == "sjkr":
        contact["cohesion_energy_density_pa"] = 40 * strength_pa
    else:
        contact["surface_energy_j_m2"] = adhesion * radius
    for numbers in (material["parameters"], material["free"]):
        for key in elasto_plastic.OF_BRIDGE:
            numbers.pop(key, None)
    material["parameters"].update(own)
    material["free"] = {key: {"lower": value / 2, "upper": 2 * value, "scale": "log"} for key, value in own.items()}
    return card


def modulus_of(contact):
    return contact["youngs_modulus_pa"] / (2 * (1 - contact["poissons_ratio"] ** 2))


def jkr_patch(contact, radius, overlap):
    """The larger contact radius with this overlap, d = a^2/R* - sqrt(4 pi gamma a/E*), by bisection."""
    gamma, modulus = contact["surface_energy_j_m2"], modulus_of(contact)
    end = (math.pi * gamma * radius ** 2 / (4 * modulus)) ** (1 / 3)
    low, high = end, 100 * end
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle ** 2 / radius - math.sqrt(4 * math.pi * gamma * middle / modulus) < overlap:
            low = middle
        else:
            high = middle
    return low


def sticking_force(test, distance, way):
    """The same for grains that stick."""
    contact, radius = test["contact"], test["grains"]["radius_m"]
    overlap, effective, modulus = 2 * radius - distance, 0.5 * radius, modulus_of(contact)
    hertz = 4 / 3 * modulus * math.sqrt(effective) * max(overlap, 0) ** 1.5
    if contact["normal"] == "jkr":
        gamma = contact["surface_energy_j_m2"]
        end = (math.pi * gamma * effective ** 2 / (4 * modulus)) ** (1 / 3)
        last = -3 * end ** 2 / effective if way == "apart" else 0
        if overlap <= last:
            return 0.0
        patch = jkr_patch(contact, effective, overlap)
        return 4 * modulus * patch ** 3 / (3 * effective) - 4 * math.sqrt(math.pi * gamma * modulus) * patch ** 1.5
    if overlap <= 0:
        return 0.0
    if contact["normal"] == "dmt":
        return hertz - 4 * math.pi * contact["surface_energy_j_m2"] * effective
    return hertz - contact["cohesion_energy_density_pa"] * 2 * math.pi * effective * overlap


def pull_off(test):
    contact, effective = test["contact"], 0.5 * test["grains"]["radius_m"]
    if contact["normal"] == "sjkr":
        k = contact["cohesion_energy_density_pa"]
        return 2 / 3 * math.pi ** 3 * k ** 3 * effective ** 2 / modulus_of(contact) ** 2
    return (3 if contact["normal"] == "jkr" else 4) * math.pi * contact["surface_energy_j_m2"] * effective


def standing_in(card, target):
    """The card's law as the target has it: where it lacks the law, the one that stands in, of the same pull-off."""
    law = {"liggghts": "sjkr", "yade": "dmt"}.get(target, card["contact"]["normal"])
    if card["contact"]["normal"] == law:
        return card
    test, force = copy.deepcopy(card), pull_off(card)
    contact, radius, modulus = test["contact"], 0.5 * test["grains"]["radius_m"], modulus_of(test["contact"])
    contact.update(normal=law, surface_energy_j_m2=force / (4 * math.pi * radius),
                   cohesion_energy_density_pa=(3 * force * modulus ** 2 / (2 * math.pi ** 3 * radius ** 2)) ** (1 / 3))
    return test


def judge_sticking(card, target, apart, back):
    peak = pull_off(card)
    test = standing_in(card, target)
    worst = {way: largest_error(points, lambda r: sticking_force(test, r, way), peak)
             for way, points in (("apart", apart), ("back", back)) if points}
    strongest = -min(force for _, force in apart)
    print(f"{target}, {card['contact']['normal']} as {test['contact']['normal']}: {len(apart)} distances, "
          f"largest pull {strongest:.4g} N of {peak:.4g} N; "
          "largest error " + ", ".join(f"{error:.1e} of it {way}" for way, error in worst.items()))
    return max(worst.values()) < TOLERANCE[target] and strongest > 0.9 * peak and any(p[1] == 0 for p in apart)


def with_attraction(card, shape):
    """The card with a bridge of this shape between the same ends; of a capillary one by the formulas of the manual."""
    card = copy.deepcopy(card)
    bridge, radius = card["material"]["contact"]["bridge"], card["material"]["grains"]["radius_m"]
    bridge.update(shape=shape, a_n_m2=0.0, b_n_m=0.0)
    if shape == "capillary":
        gap, pull = -bridge["d_c_m"], bridge["c_n"]
        root = 2 * gap / (1 + math.sqrt(1 + 0.4 * gap / radius))  # gap = root + root^2/(10 R)
        bridge.update(c_n=0.0, d_c_m=0.0, liquid_volume_m3=root ** 3, surface_tension_n_m=pull / (2 * math.pi * radius))
    for numbers in (card["material"]["parameters"], card["material"]["free"]):
        for key in ("rupture_force_ratio", "curvature"):
            numbers.pop(key, None)
    return card


def rupture_gap(bridge, radius):
    if bridge["shape"] != "capillary":
        return -bridge["d_c_m"]
    root = bridge["liquid_volume_m3"] ** (1 / 3)
    return (1 + 0.5 * bridge["contact_angle_rad"]) * (root + 0.1 * root * root / radius)


def attraction(bridge, radius, overlap):
    """Of a living bridge between grains of this radius that overlap by so much or less than nothing."""
    if bridge["shape"] == "capillary":
        spread = -overlap * math.sqrt(radius / bridge["liquid_volume_m3"])
        pull = 2 * math.pi * radius * bridge["surface_tension_n_m"] * math.cos(bridge["contact_angle_rad"])
        return pull / (1 + 1.05 * spread + 2.5 * spread * spread)
    if bridge["shape"] == "linear":
        return bridge["c_n"] * (1 - overlap / bridge["d_c_m"])
    if bridge["shape"] == "exponential":
        return bridge["c_n"] * math.exp(-3 * overlap / bridge["d_c_m"])
    return (bridge["a_n_m2"] * overlap + bridge["b_n_m"]) * overlap + bridge["c_n"]


def card_force(test, distance):
    """Force that pushes two grains of the mean radius apart, by the card's numbers."""
    contact, radius = test["contact"], test["grains"]["radius_m"]
    bridge = contact["bridge"]
    overlap = 2 * radius - distance
    if overlap > 0:
        modulus = modulus_of(contact)
        at_touch = attraction(bridge, radius, 0.0)
        cohesion = at_touch if contact["cohesion_n"] is None else contact["cohesion_n"]
        excess = (at_touch - cohesion) * max(1 - overlap / (0.01 * radius), 0)  # passes over within R/100
        return 4 / 3 * modulus * math.sqrt(radius / 2) * overlap ** 1.5 - cohesion - excess
    if overlap < -rupture_gap(bridge, radius):
        return 0.0
    return -attraction(bridge, radius, overlap)


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


def main(program, card_file, target, law=None):
    card = json.loads(pathlib.Path(card_file).read_text())
    if law in ATTRACTIONS:
        card = with_attraction(card, law)
    elif law:
        card = with_law(card, law)
    test = card["material"]  # its grains, and the law between them
    with tempfile.TemporaryDirectory() as name:
        deck = pathlib.Path(name) / "deck"
        if law:
            card_file = pathlib.Path(name) / "card.json"
            card_file.write_text(json.dumps(card))
        engines.export(program, card_file, target, deck)
        command = engines.command_of(target, "two_grains", program, deck)
        run = subprocess.run(command, cwd=deck, capture_output=True, text=True, timeout=300, env=engines.environment())
        fit = fit_of(deck / "material.inc", test) if target == "liggghts" and not law else None
        if target == "lammps":
            test = of_deck_grains(test, deck / "in.two_grains")
        if law in elasto_plastic.EXPONENT:
            path = distances(run.stdout, "path")
            return 0 if elasto_plastic.judge(test, target, deck, path) else 1
    apart, back = distances(run.stdout, "apart"), distances(run.stdout, "back")
    if len(apart) < 200 or (target == "lammps" and len(back) < 200):
        print(run.stdout[-2000:], run.stderr[-2000:])
        return 1
    if law and law not in ATTRACTIONS:
        return 0 if judge_sticking(test, target, apart, back) else 1
    bridge, radius = test["contact"]["bridge"], test["grains"]["radius_m"]
    peak = attraction(bridge, radius, 0.0)
    expected = (lambda r: liggghts_force(test, fit, r)) if fit else (lambda r: card_force(test, r))
    worst = largest_error(apart, expected, peak)
    across = largest_error([p for p in apart if p[0] > 2 * radius], lambda r: card_force(test, r), peak)
    inside = [p for p in apart if p[0] < 2 * radius]
    beyond = [p for p in apart if p[1] == 0]
    print(f"{target}: {len(apart)} distances, {len(inside)} in overlap, {len(beyond)} beyond rupture; largest error "
          f"{worst:.1e} of the peak of {peak:.4g} N; across a gap {across:.2g} of the peak from the card")
    good = worst < TOLERANCE[target] and inside and beyond
    if back:
        shells = 2 * radius + (2 * bridge["offset_m"] if bridge["formation"] == "film" else 0)
        worst = largest_error(back, lambda r: card_force(test, r) if r <= shells else 0.0, peak)
        print(f"{target}, on the way back, where the bridge forms at {1e3 * shells:.4g} mm: {worst:.1e} of the peak")
        good = good and worst < TOLERANCE[target]
    return 0 if good else 1


if __name__ == "__main__":
    engines.exit_with(main, *sys.argv[1:])
