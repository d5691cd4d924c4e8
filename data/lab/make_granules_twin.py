#!/usr/bin/env python3
"""Makes laboratory files of granules whose truth is known, by simulating them: shear-karkala.json and
granules-pellet.json of one material, slump-pellet-cone.json and slump-pellet-crush.json of another.

Usage: make_granules_twin.py PASTEFIT [FOLDER [NAME...]]      (PASTEFIT: the program; NAME: files, without .json; minutes)

The granules are those of Karkala et al., Processes 7 (2019) 278, with the surface energy that a pellet crush asks for and
more rolling friction, in their shear cell and in their pellet crush. The publication's shear stress is not at hand, so that what
stands in shear-karkala.json is this twin's and not a laboratory's. Each packing counts as one repeat, and normal noise of the
instruments is added. The granules are those of the fit, so that only packings and instruments stand between a twin and its
truth.

The second material is heavier and sticks a ninth as much, so that an Abrams cone of it slumps (that of the first stands
as it was filled) and a pellet of it still stands without its die.
"""
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DRY = {"friction": 0.4, "restitution": 0.2, "youngs_modulus_pa": 2400000, "poissons_ratio": 0.2}
GRANULES = {"adhesion_pa": 3700, "rolling_friction": 0.05, **DRY}
WEAK = {"adhesion_pa": 400, "rolling_friction": 0.05, **DRY}
DENSITY = {3700: 1000, 400: 2000}  # kg/m3, by adhesion_pa
SEEDS = range(9201, 9209)  # packings of a fit are numbered from its own search seed, far below
INSTRUMENT_SHARE = 0.02  # normal noise of a reading over the reading

PELLET = {"die_diameter_mm": 25, "fill_height_mm": 29, "pressed_height_mm": 22, "punch_speed_mm_s": 1.5,
          "press_speedup": 50, "platen_speed_mm_s": 100, "final_strain": 0.2}
SHEAR = {"length_mm": 18, "width_mm": 23, "fill_height_mm": 16,
         "lid_ribs": {"height_mm": 3, "thickness_mm": 0.8, "pitch_mm": 10.5},
         "base_ribs": {"height_mm": 2, "thickness_mm": 1, "pitch_mm": 5.35},
         "normal_stress_pa": 2000, "shear_speed_mm_s": 0.03813, "shear_speedup": 500, "final_displacement_mm": 11.4}

CONE = {"mould": {"base_diameter_mm": 200, "top_diameter_mm": 100, "height_mm": 300}, "table_length_mm": 900,
        "lift_velocity_mm_s": 100, "drop_plate": None, "reading": {"height": "highest", "probe_diameter_mm": 40}}


def granules(radius_mm):
    """The publication's: normal, mean 0.35 mm, standard deviation 0.105, cut to 0.35 to 0.5; enlarged."""
    k = radius_mm / 0.35
    return {"distribution": "normal", "radius_mm": radius_mm, "standard_deviation_mm": round(0.105 * k, 6),
            "smallest_mm": radius_mm, "largest_mm": round(0.5 * k, 6)}


# file: kind, apparatus, grains, readings, truth, title
TWINS = {
    "shear-karkala": ("shear", SHEAR, granules(0.7), ["shear.stress_pa", "shear.height_mm"], GRANULES,
                      "Shear cell of Karkala et al. 2019 with twin granules: simulated, not measured"),
    "granules-pellet": ("pellet", PELLET, granules(1.05), ["pellet.dynamic_yield_strength_pa", "pellet.height_mm"], GRANULES,
                        "Twin of a pellet crush of the same granules: simulated, not measured"),
    "slump-pellet-cone": ("slump", CONE, {"distribution": "mono", "radius_mm": 10},
                          ["step1.height_mm", "step1.spread_mm"], WEAK,
                          "Twin of a weak wet material in an Abrams cone: simulated, not measured"),
    "slump-pellet-crush": ("pellet", PELLET, granules(1.05), ["pellet.dynamic_yield_strength_pa", "pellet.height_mm"], WEAK,
                           "Twin of a pellet crush of that material: simulated, not measured"),
}


def lab(name, measurements):
    kind, apparatus, grains, _, truth, title = TWINS[name]
    return {
        "format": "pastefit-lab-1",
        "test": kind,
        "title": title,
        "provenance": {
            "source": "simulated with pastefit by make_granules_twin.py; apparatus of the granules: Karkala et al., Processes 7 "
                      "(2019) 278, doi 10.3390/pr7050278",
            "licence": "Apache-2.0",
            "notes": "A twin. Truth: " + ", ".join(f"{key} {value:g}" for key, value in truth.items())
            + f"; packings {SEEDS[0]} to {SEEDS[-1]}, one a repeat; normal noise of {100 * INSTRUMENT_SHARE:g} % was added.",
            "twin": True,
        },
        "apparatus": apparatus,
        "material": {"bulk_density_kg_m3": DENSITY[truth["adhesion_pa"]]},
        "grains": grains,
        "measurements": measurements,
    }


def simulate(program, file, truth, seed):
    settings = [f"parameters.{name}={value!r}" for name, value in truth.items()]
    command = [program, "simulate", str(file), "--json", "--seed", str(seed),
               *(word for one in settings for word in ("--set", one))]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}{done.stdout}")
    return json.loads(done.stdout)["observables"]


def main(program, output, names):
    shared = random.Random("granules twin")
    for name, (_, _, _, readings, truth, _) in TWINS.items():
        if name not in names:
            continue
        luck = shared if truth is GRANULES else random.Random(name)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "lab.json").write_text(json.dumps(lab(name, {readings[0]: {"value": 100, "standard_deviation": 1}})))
            (folder / "study.json").write_text(json.dumps({
                "format": "pastefit-study-1", "title": "truth of the twin", "lab": "lab.json",
                "contact": {"normal": "jkr", "attraction": "none", "rolling_model": "constant_torque",
                            "friction_basis": "elastic"},
                "parameters": {key: {"value": value} for key, value in truth.items()} | {"adhesion_pa": {"free": [100, 10000]}},
            }))
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                runs = list(pool.map(lambda seed: simulate(program, folder / "study.json", truth, seed), SEEDS))
        measurements = {
            reading: {"repeats": [float(f"{run[reading] * luck.gauss(1, INSTRUMENT_SHARE):.4g}") for run in runs]}
            for reading in readings
        }
        (output / f"{name}.json").write_text(json.dumps(lab(name, measurements), indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 2 or set(sys.argv[3:]) - set(TWINS):
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else HERE, sys.argv[3:] or list(TWINS))
