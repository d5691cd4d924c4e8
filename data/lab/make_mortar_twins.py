#!/usr/bin/env python3
"""Makes mortar-table-lime.json and mortar-table-masonry.json, laboratory files of two mortars on a jolting table whose
truth is known, by simulating them.

Usage: make_mortar_twins.py PASTEFIT [FOLDER]      (PASTEFIT: the program; minutes on two cores)

Spreads of one mortar before and after the strokes are published as means of series, without the fresh density of the
batch and the scatter of one reading that a fit needs. These twins stand in: each packing of a seed that no fit uses counts
as one repeat of the laboratory, and noise of measurement is added to every reading. The files say that they are twins.
"""
import concurrent.futures
import json
import pathlib
import random
import sys
import tempfile

from make_two_step_twin import simulate, study

HERE = pathlib.Path(__file__).resolve().parent
SHAPE = {"rupture_force_ratio": 0.5, "curvature": -0.5, "rupture_gap_ratio": 0.7, "formation_ratio": 0.3}
MORTARS = {  # scale-free, so the same material at every grain size
    "lime": ("haegermann-table", 1850, {**SHAPE, "strength_pa": 500, "friction": 0.2, "rolling_friction": 0.1}),
    "masonry": ("astm-c1437", 2100, {**SHAPE, "strength_pa": 350, "friction": 0.15, "rolling_friction": 0.1}),
}
GRAINS = {"distribution": "uniform", "smallest_mm": 2.5, "largest_mm": 4}  # as in the fit
SEEDS = range(9201, 9207)  # packings of a fit are numbered from its own search seed, far below
CALLIPER_DEVIATION_MM = {"step1.spread_mm": 1.5, "after_drops.spread_mm": 2.5}  # what it adds to one reading


def lab(name, measurements):
    preset, density, truth = MORTARS[name]
    return {
        "format": "pastefit-lab-1",
        "title": f"Twin of a {name} mortar on the table of {preset}: simulated, not measured",
        "provenance": {
            "source": "simulated with pastefit by make_mortar_twins.py",
            "licence": "Apache-2.0",
            "notes": "A twin. Truth: " + ", ".join(f"{k} {v}" for k, v in truth.items())
            + f"; grains of {GRAINS['smallest_mm']} to {GRAINS['largest_mm']} mm radius, packings {SEEDS[0]} to {SEEDS[-1]}, "
            "one a repeat; a calliper's normal noise was added ("
            + ", ".join(f"{k} {v} mm" for k, v in CALLIPER_DEVIATION_MM.items()) + ").",
            "twin": True,
        },
        "apparatus": {"preset": preset, "lift_velocity_mm_s": 50},
        "material": {"bulk_density_kg_m3": density},
        "grains": GRAINS,
        "measurements": measurements,
    }


def main(program, output):
    for name, (_, _, truth) in MORTARS.items():
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            first = {"step1.spread_mm": {"value": 110, "standard_deviation": 1}}
            (folder / "lab.json").write_text(json.dumps(lab(name, first)))
            (folder / "study.json").write_text(json.dumps(study("lab.json", truth)))
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                runs = list(pool.map(lambda seed: simulate(program, folder / "study.json", seed, truth, GRAINS), SEEDS))
        noise = random.Random(f"mortar twin {name}")
        measurements = {
            reading: {"repeats": [round(run[reading] + noise.gauss(0, deviation), 1) for run in runs]}
            for reading, deviation in CALLIPER_DEVIATION_MM.items()
        }
        (output / f"mortar-table-{name}.json").write_text(json.dumps(lab(name, measurements), indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else HERE)
