#!/usr/bin/env python3
"""Makes three-tests-cone.json, three-tests-plate.json and three-tests-fast.json: three tests of one material whose truth is
known, by simulating it.

Usage: make_three_tests_twin.py PASTEFIT [FOLDER]      (PASTEFIT: the program; a minute on two cores)

"cone" is a slump in the Abrams cone, "plate" the two-step test in the cone of EN 12350-5, "fast" the Abrams cone lifted ten
times as fast. Each packing counts as one repeat. The grains are coarse and the same as in the fit, so that the example is
quick and only packings and ruler stand between the twin and the truth.
"""
import concurrent.futures
import json
import pathlib
import random
import sys
import tempfile

from make_two_step_twin import BULK_DENSITY_KG_M3, RULER_DEVIATION_MM, simulate, study

HERE = pathlib.Path(__file__).resolve().parent
TRUTH = {
    "strength_pa": 1800,
    "rupture_force_ratio": 0.2,
    "curvature": 0.3,
    "rupture_gap_ratio": 0.7,
    "formation_ratio": 1,
    "friction": 0.15,
    "rolling_friction": 0.02,
}
GRAIN_RADIUS_MM = 10
GRAINS = {"distribution": "mono", "radius_mm": GRAIN_RADIUS_MM}
SEEDS = range(9101, 9106)
TESTS = {
    "cone": ({"preset": "abrams", "lift_velocity_mm_s": 100}, ["step1.height_mm", "step1.spread_mm"]),
    "plate": ({"preset": "en12350-5", "lift_velocity_mm_s": 100}, ["step1.height_mm", "step2.height_mm", "step1.spread_mm", "step2.spread_mm"]),
    "fast": ({"preset": "abrams", "lift_velocity_mm_s": 1000}, ["step1.height_mm", "step1.spread_mm"]),
}


def lab(name, measurements):
    return {
        "format": "pastefit-lab-1",
        "title": f"Twin of three tests of one material, {name}: simulated, not measured",
        "provenance": {
            "source": "simulated with pastefit by make_three_tests_twin.py",
            "licence": "Apache-2.0",
            "notes": "A twin. Truth: " + ", ".join(f"{k} {v}" for k, v in TRUTH.items())
            + f"; grains of {GRAIN_RADIUS_MM} mm radius, packings {SEEDS[0]} to {SEEDS[-1]}, one a repeat; a ruler's "
            "normal noise was added (heights 1 mm, spread 5 mm).",
            "twin": True,
        },
        "apparatus": TESTS[name][0],
        "material": {"bulk_density_kg_m3": BULK_DENSITY_KG_M3},
        "grains": GRAINS,
        "measurements": measurements,
    }


def main(program, output):
    noise = random.Random("three tests twin")
    for name, (_, readings) in TESTS.items():
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            first = {readings[0]: {"value": 100, "standard_deviation": 1}}
            (folder / "lab.json").write_text(json.dumps(lab(name, first)))
            (folder / "study.json").write_text(json.dumps(study("lab.json", TRUTH)))
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                runs = list(pool.map(lambda seed: simulate(program, folder / "study.json", seed, TRUTH, GRAINS), SEEDS))
        measurements = {
            reading: {"repeats": [round(run[reading] + noise.gauss(0, RULER_DEVIATION_MM[reading]), 1) for run in runs]}
            for reading in readings
        }
        (output / f"three-tests-{name}.json").write_text(json.dumps(lab(name, measurements), indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE)
