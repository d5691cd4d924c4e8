#!/usr/bin/env python3
"""Makes two-step-twin.json, a laboratory file whose truth is known, by simulating it.

Usage: make_two_step_twin.py PASTEFIT [OUTPUT]      (PASTEFIT: the program; a few minutes on two cores)

No public data of the two-step slump test exist. This twin stands in: the material below is simulated on packings of other
seeds than any fit uses, each packing counts as one repeat of the laboratory, and noise of measurement is added to every
reading. The file says in its first lines that it is a twin.
"""
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TRUTH = {  # scale-free, so the same material at every grain size
    "strength_pa": 1400,
    "rupture_force_ratio": 0.5,
    "curvature": -0.5,
    "rupture_gap_ratio": 0.7,
    "formation_ratio": 0.3,
    "friction": 0.15,
    "rolling_friction": 0.1,
}
GRAINS = {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10}  # as in the fit
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
            + f"; grains of {GRAINS['smallest_mm']} to {GRAINS['largest_mm']} mm radius, packings {SEEDS[0]} to {SEEDS[-1]}, "
            "one a repeat; a ruler's normal noise was added (heights and sag 1 mm, spread 5 mm).",
            "twin": True,
        },
        "apparatus": {"preset": "en12350-5", "lift_velocity_mm_s": 100},
        "material": {"bulk_density_kg_m3": BULK_DENSITY_KG_M3},
        "grains": GRAINS,
        "measurements": measurements,
    }


def study(lab_name, truth):
    return {
        "format": "pastefit-study-1",
        "title": "truth of the twin",
        "lab": lab_name,
        "contact": {"formation": "film", "rolling_model": "spring_dashpot", "friction_basis": "total"},
        "parameters": {**{k: {"value": v} for k, v in truth.items()}, "strength_pa": {"free": [300, 40000]}},
        "weights": {},
    }


def simulate(program, study_file, seed, truth, grains):
    command = [program, "simulate", str(study_file), "--json", "--seed", str(seed),
               "--set", f"parameters.strength_pa={truth['strength_pa']}"]
    for key, value in grains.items():
        if key != "distribution":
            command += ["--set", f"grains.{key}={value}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}{done.stdout}")
    return json.loads(done.stdout)["observables"]


def main(program, output):
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "lab.json").write_text(json.dumps(lab({"step1.height_mm": {"value": 100, "standard_deviation": 1}})))
        (folder / "study.json").write_text(json.dumps(study("lab.json", TRUTH)))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            runs = list(pool.map(lambda seed: simulate(program, folder / "study.json", seed, TRUTH, GRAINS), SEEDS))
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
