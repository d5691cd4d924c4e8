#!/usr/bin/env python3
"""Pellet crush and shear cell compared with the tables of Karkala et al., Processes 7 (2019) 278.

usage: granules_paper.py PROGRAM TABLE.csv [--test pellet|shear] [--basis elastic,total,net] [--lever 1,2] [--rows base,...]
                         [--seeds 1,2,3] [--full]
       granules_paper.py --report TABLE.csv
       granules_paper.py PROGRAM DIR --calibrate [--basis elastic] [--seeds 1,2,3]

Simulates every row of the paper's tables with each basis of the friction limit and each lever: EDEM's rolling torque is mu_r
F_n R_i with the granule's own radius, ours mu_r N R*, which is half of it between equal granules, so lever 2 doubles the
coefficient. Granules are three times (pellet) or twice (shear cell) as large as the paper's, at equal force over R^2; --full
takes the paper's. Existing rows are not run again. The report has means and standard errors over the seeds. --calibrate fits
the surface energy to the strength measured in the paper, with each of the paper's four sets of the other parameters, and
shears the result.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RADIUS_M = 0.35e-3  # to which surface energies are referred: half of the paper's mean diameter
BASE = {"gamma": 0.45, "shear_modulus": 1e6, "poisson": 0.2, "restitution": 0.2, "friction": 0.4, "rolling": 0.01, "size": 1}
# Row: what it changes, and what the paper found in it [Pa] ("Karkala et al.", tables 3 to 6 and the text). None: not told.
PELLET = {
    "base": ({}, 495),
    "Poisson 0.49 (theirs 0.5)": ({"poisson": 0.49}, 457),
    "restitution 0.5": ({"restitution": 0.5}, 472),
    "G 2.5 MPa": ({"shear_modulus": 2.5e6}, 400),
    "0.675 J/m2": ({"gamma": 0.675}, 784),
    "1.125 J/m2": ({"gamma": 1.125}, 1853),
    "1.92 J/m2": ({"gamma": 1.92}, 3071),
    "2.15 J/m2": ({"gamma": 2.15}, 3378),
    "2.70 J/m2": ({"gamma": 2.7}, 4504),
    "sliding 1.0": ({"friction": 1}, 402),
    "sliding 0.1": ({"friction": 0.1}, None),
    "rolling 0.025": ({"rolling": 0.025}, 678),
    "rolling 0.3": ({"rolling": 0.3}, None),
    "G 10 MPa, 2.95 J/m2": ({"shear_modulus": 1e7, "gamma": 2.95}, 3220),
    "doubled size, 2.90 J/m2": ({"size": 2, "gamma": 2.9}, 3351),
    "both frictions 0.5, 0.95 J/m2": ({"friction": 0.5, "rolling": 0.5, "gamma": 0.95}, 3267),
}
FITTED = ("0.675 J/m2", "1.92 J/m2", "2.70 J/m2")  # the paper's linear fit there, 1837 gamma - 456, not a simulation
SHEAR = {
    "base": ({}, 1008),
    "rolling 1.0": ({"rolling": 1}, 1183),
    "sliding 1.0": ({"friction": 1}, None),
    "sliding 0.1": ({"friction": 0.1}, None),
    "1.35 J/m2": ({"gamma": 1.35}, None),
    "2.15 J/m2": ({"gamma": 2.15}, 1330),
    "doubled size, 2.90 J/m2": ({"size": 2, "gamma": 2.9}, 1330),
    "G 10 MPa, 2.95 J/m2": ({"shear_modulus": 1e7, "gamma": 2.95}, 1330),
    "both frictions 0.5, 0.95 J/m2": ({"friction": 0.5, "rolling": 0.5, "gamma": 0.95}, 1178),
}
CALIBRATED = {  # what is fixed, and the surface energy [J/m2] and strength [Pa] that the paper found by hand
    "base": ({}, 2.15, 3378),
    "G 10 MPa": ({"shear_modulus": 1e7}, 2.95, 3220),
    "doubled size": ({"size": 2}, 2.90, 3351),
    "both frictions 0.5": ({"friction": 0.5, "rolling": 0.5}, 0.95, 3267),
}
TESTS = {  # study, reading, factor of the size, rows
    "pellet": ("pellet-karkala", "pellet.dynamic_yield_strength_pa", 3, PELLET),
    "shear": ("shear-karkala", "shear.stress_pa", 2, SHEAR),
}
COLUMNS = ["test", "row", "basis", "lever", "full", "seed", "pa", "settled", "core_s", "failure"]


def settings(test, change, lever, full):
    """What `pastefit simulate --set` is told for a row."""
    row = BASE | change
    coarse = row["size"] if full else max(row["size"], TESTS[test][2])
    radius_mm = 1e3 * RADIUS_M * coarse
    values = {
        "adhesion_pa": row["gamma"] / (RADIUS_M * row["size"]),
        "youngs_modulus_pa": 2 * row["shear_modulus"] * (1 + row["poisson"]),
        "poissons_ratio": row["poisson"],
        "restitution": row["restitution"],
        "friction": row["friction"],
        "rolling_friction": lever * row["rolling"],
    }
    sets = {f"parameters.{name}": value for name, value in values.items()}
    sets |= {"grains.radius_mm": radius_mm, "grains.standard_deviation_mm": 0.3 * radius_mm,
             "grains.smallest_mm": radius_mm, "grains.largest_mm": radius_mm / 0.7}
    return sets


def write_study(folder, test, basis):
    """The shipped study with another basis of the friction limit."""
    study = json.loads((ROOT / f"data/studies/{TESTS[test][0]}.json").read_text())
    study["lab"] = str((ROOT / "data/studies" / study["lab"]).resolve())
    study["contact"]["friction_basis"] = basis
    path = Path(folder) / f"{test}-{basis}.json"
    path.write_text(json.dumps(study))
    return path


def simulate(program, study, test, sets, seed):
    command = [program, "simulate", study, "--seed", str(seed), "--json", "--quiet", "--threads", "1"]
    for name, value in sets.items():
        command += ["--set", f"{name}={value!r}"]
    before = os.times()
    done = subprocess.run(command, capture_output=True, text=True)
    after = os.times()
    core_s = after.children_user + after.children_system - before.children_user - before.children_system
    if done.returncode == 2:
        sys.exit(done.stderr)
    if done.returncode:
        return ["", "", round(core_s, 1), " ".join(done.stderr.split())[:200]]
    outcome = json.loads(done.stdout)
    return [round(outcome["observables"][TESTS[test][1]], 1), int(outcome["run"]["settled"]), round(core_s, 1), ""]


def known_runs(table):
    if not os.path.exists(table):
        return set()
    with open(table) as file:
        return {tuple(row[name] for name in COLUMNS[:6]) for row in csv.DictReader(file)}


def measure(options):
    known = known_runs(options.table)
    rows = TESTS[options.test][3]
    with tempfile.TemporaryDirectory() as folder, open(options.table, "a", newline="") as file:
        out = csv.writer(file)
        if not known and file.tell() == 0:
            out.writerow(COLUMNS)
        for seed in options.seeds.split(","):
            for row in options.rows.split(",,") if options.rows else rows:
                for basis in options.basis.split(","):
                    for lever in options.lever.split(","):
                        key = (options.test, row, basis, lever, str(int(options.full)), seed)
                        if key in known:
                            continue
                        sets = settings(options.test, rows[row][0], float(lever), options.full)
                        if options.test == "shear":
                            sets["apparatus.final_displacement_mm"] = options.displacement
                        study = write_study(folder, options.test, basis)
                        out.writerow([*key, *simulate(options.program, study, options.test, sets, seed)])
                        file.flush()


def calibrate(options):
    """A row for each set: its surface energy with its interval, its strength, its shear stress."""
    out = Path(options.table)
    print("| fixed | paper J/m2, Pa | found J/m2 (95 %) | strength Pa | confirmed | simulations | shear stress Pa |")
    print("|---|---|---|---|---|---|---|")
    for name, (change, gamma, strength) in CALIBRATED.items():
        sets = settings("pellet", change, 1, False)
        radius_m = RADIUS_M * (BASE | change)["size"]
        folder = out / name.replace(" ", "-")
        folder.mkdir(parents=True, exist_ok=True)
        study = json.loads(write_study(folder, "pellet", options.basis).read_text())
        lab = json.loads(Path(study["lab"]).read_text())
        lab["grains"] |= {key.removeprefix("grains."): value for key, value in sets.items() if key.startswith("grains.")}
        for key in study["parameters"]:
            if key != "adhesion_pa":
                study["parameters"][key] = {"value": sets[f"parameters.{key}"]}
        study["parameters"]["adhesion_pa"] = {"free": [1e3, 8e3 if change.get("size", 1) == 1 else 6e3]}
        study["lab"] = "lab.json"
        (folder / "lab.json").write_text(json.dumps(lab))
        (folder / "study.json").write_text(json.dumps(study))
        if not (folder / "out/card.json").exists():
            subprocess.run([options.program, "calibrate", folder / "study.json", "--out", folder / "out", "--threads", "1", "--quiet"])
        card = json.loads((folder / "out/card.json").read_text())
        adhesion = card["material"]["parameters"]["adhesion_pa"]
        interval = card["intervals"]["parameters"].get("adhesion_pa", {})
        reading = card["tests"][0]["readings"][TESTS["pellet"][1]]
        shear = settings("shear", change, 1, False) | {"parameters.adhesion_pa": adhesion,
                                                       "apparatus.final_displacement_mm": options.displacement}
        cell = write_study(folder, "shear", options.basis)
        stresses = [simulate(options.program, cell, "shear", shear, seed)[0] for seed in options.seeds.split(",")]
        ends = [f"{interval[key] * radius_m:.2f}" if interval.get(key) else "bound" for key in ("lower", "upper")]
        print(f"| {name} | {gamma}, {strength} | {adhesion * radius_m:.2f} ({' to '.join(ends)}) | {reading['simulated']:.0f} |",
              f"{card['search']['status']} | {card['search']['simulations']} | {mean_and_error([s for s in stresses if s != ''])} |",
              flush=True)


def mean_and_error(values):
    mean = sum(values) / len(values)
    if len(values) < 2:
        return f"{mean:.0f} (one)"
    deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))
    return f"{mean:.0f} ± {deviation / math.sqrt(len(values)):.0f}"


def report(table):
    with open(table) as file:
        runs = list(csv.DictReader(file))
    for test, (_, _, _, rows) in TESTS.items():
        columns = sorted({(run["full"], run["basis"], run["lever"]) for run in runs if run["test"] == test})
        if not columns:
            continue
        print(f"| {test} | paper Pa |", " | ".join(f"{basis}, lever {lever}{', full size' * int(full)}"
                                                 for full, basis, lever in columns), "|")
        print("|---" * (len(columns) + 2) + "|")
        for row, (_, paper) in rows.items():
            cells = []
            for column in columns:
                of_row = [run for run in runs if run["test"] == test and run["row"] == row
                          and (run["full"], run["basis"], run["lever"]) == column]
                values = [float(run["pa"]) for run in of_row if run["pa"]]
                moving = sum(run["settled"] == "0" for run in of_row)
                failed = f" ({len(of_row) - len(values)} failed)" if len(values) < len(of_row) else ""
                failed += f" ({moving} not steady)" if moving else ""
                cells.append((mean_and_error(values) if values else "") + failed)
            told = "" if paper is None else f"{paper}{' (fit)' if row in FITTED else ''}"
            print(f"| {row} | {told} |", " | ".join(cells), "|")
        print()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("table")
    parser.add_argument("--test", choices=TESTS, default="pellet")
    parser.add_argument("--basis", default="elastic,total,net")
    parser.add_argument("--lever", default="1,2")
    parser.add_argument("--rows", help="separated by two commas; all of the test where none is named")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("--displacement", type=float, default=22.8, help="of the shear cell's base [mm]")
    parser.add_argument("--full", action="store_true", help="granules of the paper's size")
    parser.add_argument("--report", action="store_true")
    parser.add_argument("--calibrate", action="store_true")
    chosen = parser.parse_args()
    if chosen.report:
        report(chosen.table)
    else:
        calibrate(chosen) if chosen.calibrate else measure(chosen)
