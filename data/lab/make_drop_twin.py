#!/usr/bin/env python3
"""Makes drop-twin.json, a laboratory file of a drop test whose truth is known, by simulating it.

Usage: make_drop_twin.py PASTEFIT [OUTPUT]      (PASTEFIT: the program; seconds)

The material below falls on a slab of its own, level and tilted. Each repeat of the laboratory is a ball of another
radius and restitution about the mean ones, as grains of gravel are, and noise of measurement is added to every reading.
The file says in its first lines that it is a twin.
"""
import json
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TRUTH = {
    "restitution": 0.9,
    "friction": 0.08,
    "strength_pa": 1,
    "rupture_gap_ratio": 0.001,
    "rolling_friction": 0,
    "youngs_modulus_pa": 5e10,
}
RADIUS_MM, RADIUS_DEVIATION_MM = 10, 0.2
RESTITUTION_DEVIATION = 0.01
REPEATS = 8
NOISE = {"level.rebound_height_mm": 3.0, "tilted.rebound_height_mm": 2.0, "tilted.spin_rad_s": 3.0}


def lab(measurements):
    return {
        "format": "pastefit-lab-1",
        "test": "drop",
        "title": "Twin of a drop test: simulated, not measured",
        "provenance": {
            "source": "simulated with pastefit by make_drop_twin.py",
            "licence": "Apache-2.0",
            "notes": "A twin. Truth: " + ", ".join(f"{k} {v:g}" for k, v in TRUTH.items())
            + f"; {REPEATS} balls, radius {RADIUS_MM} +- {RADIUS_DEVIATION_MM} mm, restitution +- "
            f"{RESTITUTION_DEVIATION}, and normal noise of the readings (heights 3 and 2 mm, spin 3 rad/s).",
            "twin": True,
        },
        "apparatus": {"drop_height_mm": 500, "plate_tilt_deg": 40},
        "material": {"bulk_density_kg_m3": 2500},
        "grains": {"distribution": "mono", "radius_mm": RADIUS_MM},
        "measurements": measurements,
    }


def simulate(program, file, values, radius_mm):
    settings = [f"grains.radius_mm={radius_mm!r}", *(f"parameters.{name}={value!r}" for name, value in values.items())]
    command = [program, "simulate", str(file), "--json", *(word for one in settings for word in ("--set", one))]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}{done.stdout}")
    return json.loads(done.stdout)["observables"]


def main(program, output):
    luck = random.Random("drop twin")
    readings = {name: [] for name in NOISE}
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "lab.json"
        file.write_text(json.dumps(lab({"level.rebound_height_mm": {"value": 300, "standard_deviation": 1}})))
        for _ in range(REPEATS):
            values = dict(TRUTH, restitution=luck.gauss(TRUTH["restitution"], RESTITUTION_DEVIATION))
            run = simulate(program, file, values, luck.gauss(RADIUS_MM, RADIUS_DEVIATION_MM))
            for name, deviation in NOISE.items():
                readings[name].append(round(run[name] + luck.gauss(0, deviation), 1))
    measurements = {name: {"repeats": values} for name, values in readings.items()}
    output.write_text(json.dumps(lab(measurements), indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE / "drop-twin.json")
