#!/usr/bin/env python3
"""Makes two-step-twin.json, a laboratory file whose truth is known, by simulating it.

Usage: make_two_step_twin.py PASTEFIT [OUTPUT]      (PASTEFIT: the program; a few minutes on two cores)

No public data of the two-step slump test exist. This twin stands in: the material below is simulated with grains of another
size and packings of other seeds than any fit uses, each packing counts as one repeat of the laboratory, and noise of
measurement is added to every reading. The file says in its first lines that it is a twin.
"""
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TRUTH = {  # scale-free, so the same material at every grain size
    "strength_pa": 1800,
    "rupture_force_ratio": 0.2,
    "curvature": 0.3,
    "rupture_gap_ratio": 0.7,
    "formation_ratio": 1,
    "friction": 0.15,
    "rolling_friction": 0.02,
}
GRAIN_RADIUS_MM = 6  # a fit uses 8
BULK_DENSITY_KG_M3 = 2100
SEEDS = range(9001, 9009)  # packings of a fit are numbered from its own search seed, far below
RULER_DEVIATION_MM = {  # what a ruler on a rough surface adds to one reading
    "step1.height_mm": 1.0,
    "step2.height_mm": 1.0,
    "step2.plateau_sag_mm": 1.0,
    "step1.spread_mm": 5.0,
    "step2.spread_mm": 5.0,
}


def lab(measurements):
    return {
        "format": "pastefit-lab-1",
        "title": "Twin of a two-step slump test: simulated, not measured",
        "provenance": {
            "source": "simulated with pastefit by make_two_step_twin.py",
            "licence": "Apache-2.0",
            "notes": "A twin. Truth: " + ", ".join(f"{k} {v}" for k, v in TRUTH.items())
            + f"; grains of {GRAIN_RADIUS_MM} mm radius, packings {SEEDS[0]} to {SEEDS[-1]}, one a repeat; a ruler's "
            "normal noise was added (heights and sag 1 mm, spread 5 mm).",
            "twin": True,
        },
        "apparatus": {"preset": "en12350-5"},
        "material": {"bulk_density_kg_m3": BULK_DENSITY_KG_M3},
        "grains": {"distribution": "mono", "radius_mm": 8},
        "measurements": measurements,
    }


def study(lab_name):
    return {
        "format": "pastefit-study-1",
        "title": "truth of the twin",
        "lab": lab_name,
        "contact": {"formation": "film", "rolling_model": "spring_dashpot", "friction_basis": "total"},
        "parameters": {**{k: {"value": v} for k, v in TRUTH.items()}, "strength_pa": {"free": [300, 40000]}},
        "weights": {},
    }


def simulate(program, study_file, seed, radius_mm=GRAIN_RADIUS_MM):
    command = [program, "simulate", str(study_file), "--json", "--seed", str(seed),
               "--set", f"grains.radius_mm={radius_mm}",
               "--set", f"parameters.strength_pa={TRUTH['strength_pa']}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}{done.stdout}")
    return json.loads(done.stdout)["observables"]


def main(program, output):
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "lab.json").write_text(json.dumps(lab({"step1.height_mm": {"value": 100, "standard_deviation": 1}})))
        (folder / "study.json").write_text(json.dumps(study("lab.json")))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            runs = list(pool.map(lambda seed: simulate(program, folder / "study.json", seed), SEEDS))
    noise = random.Random("two-step twin")
    measurements = {}
    for name, deviation in RULER_DEVIATION_MM.items():
        readings = [round(run[name] + noise.gauss(0, deviation), 1) for run in runs]
        measurements[name] = {"repeats": readings}
    output.write_text(json.dumps(lab(measurements), indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE / "two-step-twin.json")
