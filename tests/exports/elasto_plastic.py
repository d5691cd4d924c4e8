"""Elasto-plastic adhesion of two grains, computed independently of the engine; and the nearest model of LIGGGHTS.

usage: elasto_plastic.py        (needs liggghts)

As a program it moves two grains through all branches of LIGGGHTS's model `edinburgh` with a fixed adhesion stiffness. With
linear springs it must give the law to 1e-6 of the largest force; with the exponent 3/2 only until a contact returns from the
adhesion branch, after which it must give the force of its source code. It also measures what exported decks must consider in
LIGGGHTS 3.8.0: `limitForce`, its default, removes every attraction without a constant pull-off; and when grains are sorted,
a pair whose order changes loses its largest overlap. Exit status 77 without LIGGGHTS.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

EXPONENT = {"epa": 1.5, "luding": 1.0}
TOLERANCE = 1e-6
PLASTICITY, ADHESION, PULL_OFF_PA = 0.85, 1.0, 150.0
OF_BRIDGE = ("strength_pa", "rupture_force_ratio", "curvature", "rupture_gap_ratio", "formation_ratio", "cohesion_ratio")
TURNS = (0.0505, 0.0305, 0.0605, 0.0055, 0.0455, 0.0805, -0.0055, 0.0205, -0.0095)  # overlaps over the radius


def forces(overlaps, loading, exponent, plasticity, adhesion, pull_off):
    """Of overlaps one after the other: loading k1 d^m, unloading k2 (d^m - l D^m), adhesion -kc d^m, less the pull-off.

    D, the deepest overlap, shrinks on the adhesion branch so that reloading goes parallel to unloading."""
    unloading, tearing = loading / (1 - plasticity), adhesion * loading
    deepest, out = 0.0, []  # D^m
    for overlap in overlaps:
        if overlap <= 0:
            deepest = 0.0
            out.append(0.0)
            continue
        depth = overlap ** exponent
        deepest = max(deepest, depth)
        force = unloading * (depth - plasticity * deepest)
        if force < -tearing * depth:
            force = -tearing * depth
            deepest = depth * (1 + adhesion * (1 - plasticity)) / plasticity
        out.append(force - pull_off)
    return out


def loading_stiffness(modulus, poisson, radius, exponent):
    """k1 of two equal grains."""
    return 4 / 3 * modulus / (2 * (1 - poisson ** 2)) * (radius / 2) ** (2 - exponent)


def of_card(card, law):
    """The card with this law in place of its bridges."""
    material = card["material"]
    contact, radius = material["contact"], material["grains"]["radius_m"]
    own = {"plasticity_ratio": PLASTICITY, "adhesion_ratio": ADHESION}
    contact.update(normal=law, cohesion_n=PULL_OFF_PA * radius ** 2, **own)
    own["pull_off_pa"] = PULL_OFF_PA
    for numbers in (material["parameters"], material["free"]):
        for key in OF_BRIDGE:
            numbers.pop(key, None)
    material["parameters"].update(own)
    material["free"] = {"adhesion_ratio": {"lower": 0.5, "upper": 2.0, "scale": "log"}}
    return card


def slump_card(card, law, adhesion, radius):
    """The card's slump test with soft grains of this law and radius, 2280 kg/m3 together, on a smooth table."""
    material = card["material"]
    contact, table = material["contact"], card["tests"][0]["test"]["table_wall"]
    contact["bridge"] = {key: 0.0 for key in contact["bridge"]} | {"shape": "none", "formation": "film"}
    of_card(card, law)
    soft = {"youngs_modulus_pa": 1e6, "friction": 0.156, "rolling_friction": 0.01}
    contact.update(soft, adhesion_ratio=adhesion, cohesion_n=0.0)
    material["parameters"].update(soft, adhesion_ratio=adhesion, pull_off_pa=0.0, table_friction=0.1)
    table["friction"] = 0.1
    material["grain_density_kg_m3"] *= 2280 / material["bulk_density_kg_m3"]
    material["bulk_density_kg_m3"] = 2280.0
    material["grains"].update(radius_m=radius, smallest_m=radius, largest_m=radius)
    return card


def largest_error(path, radius, expected):
    """Over the largest force, but for overlaps that are zero to rounding."""
    peak = max(abs(force) for force in expected)
    return max(abs(force - other) for (distance, force), other in zip(path, expected)
               if abs(2 * radius - distance) > 1e-9 * radius) / peak


def judge(test, target, deck, path):
    """Whether a program gave the law of the card; LIGGGHTS that of the moduli in its deck, with linear springs."""
    contact, radius = test["contact"], test["grains"]["radius_m"]
    if len(path) < 300:
        print(f"{target}: only {len(path)} distances")
        return False
    exponent, modulus = EXPONENT[contact["normal"]], contact["youngs_modulus_pa"]
    if target == "liggghts":
        properties = re.search(r"youngsModulus peratomtype (\S+)", (deck / "material.inc").read_text())
        modulus, exponent = 1.5 * float(properties[1]), 1.0
    loading = loading_stiffness(modulus, contact["poissons_ratio"], radius, exponent)
    expected = forces([2 * radius - distance for distance, _ in path], loading, exponent, contact["plasticity_ratio"],
                      contact["adhesion_ratio"], contact["cohesion_n"])
    worst = largest_error(path, radius, expected)
    print(f"{target}, {contact['normal']} with the exponent {exponent:g}: {len(path)} distances, forces from "
          f"{min(expected):.4g} to {max(expected):.4g} N; largest error {worst:.1e} of the largest")
    if exponent == EXPONENT[contact["normal"]] and abs(modulus / contact["youngs_modulus_pa"] - 1) > 1e-12:
        print("the deck has another modulus than the card")
        return False
    return worst < (1e-10 if target == "lammps" else TOLERANCE) and min(expected) < 0


DECK = """units lj
atom_style granular
atom_modify map array {sort}
boundary f f f
newton off
communicate single vel yes
region box block -0.04 0.08 -0.04 0.04 -0.04 0.04 units box
create_box 1 box
create_atoms 1 single 0 0 0 units box
create_atoms 1 single {start:.17g} 0 0 units box
set type 1 diameter {diameter:.17g}
set type 1 density 2500
neighbor 0.002 bin
neigh_modify delay 0
fix p1 all property/global youngsModulus peratomtype {modulus:.17g}
fix p2 all property/global poissonsRatio peratomtype 0.3
fix p3 all property/global coefficientRestitution peratomtypepair 1 0.3
fix p4 all property/global coefficientFriction peratomtypepair 1 0.3
fix p5 all property/global UnloadingStiffness peratomtypepair 1 {stiffening:.17g}
fix p6 all property/global coefficientAdhesionStiffness peratomtypepair 1 {adhesion:.17g}
fix p7 all property/global overlapExponent scalar {exponent:g}
fix p8 all property/global adhesionExponent scalar {exponent:g}
fix p9 all property/global pullOffForce peratomtypepair 1 {pull:.17g}
fix p10 all property/global surfaceEnergy peratomtypepair 1 0
pair_style gran model edinburgh tangential history fixKc on limitForce {limit}
pair_coeff * *
timestep {step:.17g}
group first id 1
group second id 2
compute push second reduce sum fx
compute at second reduce sum x
variable push equal c_push
variable at equal c_at
thermo_style custom step c_push c_at
fix out all print 1 "path ${{at}} ${{push}}"
fix hold first move linear 0 0 0 units box
"""


ROTATION = """unfix hold
fix turn all move rotate 0 0 0 0 0 1 {period:.17g} units box
compute sideways second reduce sum fy
variable size equal sqrt(c_push^2+c_sideways^2)
fix sized all print 1 "turned ${{size}}"
thermo_style custom step c_push c_at c_sideways
run 1000
"""


def in_liggghts(law, radius, modulus, pull_off, limit="off", sort="sort 0 0", turns=TURNS, end=""):
    """What LIGGGHTS prints on the way of the exported decks."""
    speed, at, exponent = 1e-10, -0.0095, EXPONENT[law]
    # Of linear springs LIGGGHTS takes 2 E* R* for k1, in place of 4/3 E* R*.
    deck = DECK.format(start=(2 - at) * radius, diameter=2 * radius, modulus=modulus * (1 if law == "epa" else 2 / 3),
                       stiffening=1 / (1 - PLASTICITY), adhesion=ADHESION, exponent=exponent, pull=-pull_off,
                       step=0.001 * radius / speed, limit=limit, sort=sort)
    for turn in turns:
        steps = round(abs(turn - at) / 0.001)
        deck += f"fix pull second move linear {speed if turn < at else -speed:g} 0 0 units box\nrun {steps}\nunfix pull\n"
        at = turn
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "in.path").write_text(deck + end.format(period=2000 * 0.001 * radius / speed))
        run = subprocess.run(["liggghts", "-in", "in.path", "-log", "none"], cwd=folder, capture_output=True, text=True,
                             errors="replace", timeout=300)
    return run.stdout


def distances(output):
    return [tuple(map(float, line.split()[1:])) for line in output.splitlines() if line.startswith("path ")]


def as_its_source_says(overlaps, loading, exponent, pull_off):
    """The model with the memory that LIGGGHTS 3.8.0 leaves on the adhesion branch: (k2 + kc)/(k2 - k1) d at any exponent."""
    unloading, tearing = loading / (1 - PLASTICITY), ADHESION * loading
    deepest, out = 0.0, []
    for overlap in overlaps:
        if overlap <= 0:
            deepest = 0.0
            out.append(0.0)
            continue
        deepest = max(deepest, overlap)
        force = unloading * (overlap ** exponent - deepest ** exponent) + loading * deepest ** exponent
        if force < -tearing * overlap ** exponent:
            force = -tearing * overlap ** exponent
            deepest = (unloading + tearing) / (unloading - loading) * overlap
        out.append(force - pull_off)
    return out


def judge_springs(law, radius, modulus, pull_off):
    exponent = EXPONENT[law]
    path = distances(in_liggghts(law, radius, modulus, pull_off))
    loading = loading_stiffness(modulus, 0.3, radius, exponent)
    overlaps = [2 * radius - distance for distance, _ in path]
    expected = forces(overlaps, loading, exponent, PLASTICITY, ADHESION, pull_off)
    back = next(i for i in range(1, len(path)) if overlaps[i] > overlaps[i - 1] > 0
                and abs(expected[i - 1] + pull_off + ADHESION * loading * overlaps[i - 1] ** exponent) < 1e-9)
    before = largest_error(path[:back], radius, expected[:back])
    after = largest_error(path, radius, expected)
    source = largest_error(path, radius, as_its_source_says(overlaps, loading, exponent, pull_off))
    print(f"{law}, exponent {exponent:g}, pull-off {pull_off:.3g} N: {len(path)} distances; largest error {before:.1e} of the "
          f"largest force until the contact is pressed again from the adhesion branch ({back} distances), {after:.1e} beyond; "
          f"{source:.1e} from the formula in LIGGGHTS's source")
    return before < TOLERANCE and source < TOLERANCE and (after < TOLERANCE) == (law == "luding")


def judge_limit(radius, modulus):
    """Whether the default cuts every pull."""
    path = distances(in_liggghts("luding", radius, modulus, 0.0, limit="on"))
    least = min(force for _, force in path)
    print(f"with limitForce on and no constant pull-off the least force is {least:.3g} N")
    return least == 0


def judge_order(radius, modulus):
    """Whether a pair that was pressed and partly unloaded, and turns half about, keeps its force unsorted only."""
    kept = {}
    for sort in ("sort 0 0", "sort 10 0.02"):
        run = in_liggghts("luding", radius, modulus, 0.0, sort=sort, turns=(0.0505, 0.0455), end=ROTATION)
        sizes = [float(line.split()[1]) for line in run.splitlines() if line.startswith("turned ")]
        kept[sort] = sizes[-1] / sizes[1]
    print("turned half about, a pair has of its force", ", ".join(f"{share:.4f} ({sort})" for sort, share in kept.items()))
    return abs(kept["sort 0 0"] - 1) < 1e-4 and kept["sort 10 0.02"] > 1.1


def main():
    if not shutil.which("liggghts"):
        print("skipped: liggghts is not installed")
        return 77
    radius, modulus = 0.008, 1e6
    judged = [judge_springs(law, radius, modulus, pull_off_pa * radius ** 2)
              for law in EXPONENT for pull_off_pa in (0, PULL_OFF_PA)]
    judged += [judge_limit(radius, modulus), judge_order(radius, modulus)]
    return 0 if all(judged) else 1


if __name__ == "__main__":
    sys.exit(main())
