#!/usr/bin/env python3
"""Discharge of a flat-bottomed hopper beside a measurement, by the way of a user: angle of repose, card, deck, key figures.

usage: hopper.py PROGRAM DIR TABLE.csv [--angle 21] [--depths 40,55]

Measured (hopper_measured.csv): plastic spheres of 6 mm, 1592 kg/m3, 2.344 kg, in a box 200 mm wide with a slot of 40 mm;
projectchrono/DEM-Engine, branch DryGranulaFlows, post/GranularFlow/post_Plastic_Sph_Hopper.m (BSD-3), which does not name the
paper that the curve was read from, and gives 40 and 55 mm for the depth of the box. Assumed: the angle of repose, which was
not measured (21 degrees is what that source's fitted friction of 0.40 leaves here), and the frictions of the walls. The mass
that remains is no prediction, since the slopes that it leaves are what an angle of repose is. Needs `liggghts`; a run takes
some ten minutes of a core.
"""
import argparse
import csv
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "data/applications"))
import make_surfaces  # noqa: E402

MEASURED = Path(__file__).resolve().parent / "hopper_measured.csv"
HALF_WIDTH_MM, HALF_SLOT_MM, TOP_MM = 100, 20, 400
GRAIN_DENSITY, SOLID_FRACTION = 1592, 0.571  # of the heap's filled cylinder


def rectangle(x, y, z):
    return [(-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]


def side(low, high, corner, parts=1):
    """Panel between two rectangles of the same size."""
    origin, along, up = low[corner], low[(corner + 1) % 4], high[corner]
    return make_surfaces.panel(origin, *(tuple(b - a for a, b in zip(origin, to)) for to in (along, up)), parts)


def sides(low, high):
    return [(low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]) for k in range(4)]


def write_machine(folder, depth_mm):
    """A box with a slot in its floor, below a funnel that catches the feed."""
    half = depth_mm / 2
    make_surfaces.HERE = folder
    low, high = (rectangle(HALF_WIDTH_MM, half, z) for z in (0, TOP_MM))
    funnel, rim = (rectangle(HALF_WIDTH_MM, HALF_WIDTH_MM, TOP_MM + z) for z in (120, 260))
    floor = [make_surfaces.panel((x, -half, 0), (HALF_WIDTH_MM - HALF_SLOT_MM, 0, 0), (0, depth_mm, 0), 2)
             for x in (-HALF_WIDTH_MM, HALF_SLOT_MM)]
    make_surfaces.write("bin", side(low, high, 1, 2) + side(low, high, 3, 2) + floor[0] + floor[1])
    make_surfaces.write("faces", side(low, high, 0, 4) + side(low, high, 2, 4) + sides(high, funnel) + sides(funnel, rim))
    make_surfaces.write("gate", make_surfaces.panel((-30, -half, -0.5), (60, 0, 0), (0, depth_mm, 0)))
    wall = {"rolling_friction": 0.04}
    machine = {
        "format": "pastefit-application-1",
        "title": f"Flat-bottomed hopper, slot of 40 mm, {depth_mm:g} mm deep",
        "parts": {"bin": {"file": "bin.stl", "friction": 0.5, **wall},
                  "faces": {"file": "faces.stl", "friction": 0.3, **wall},  # acrylic glass
                  "gate": {"file": "gate.stl", "friction": 0.5, **wall,
                           "slide": {"from_s": 2.5, "velocity_m_s": [1, 0, 0], "distance_mm": 70}}},
        "feed": {"centre_mm": [0, 0, 640], "radius_mm": 85, "velocity_m_s": [0, 0, -1], "mass_kg": 2.344, "rate_kg_s": 1.6},
        "outlet": {"point_mm": [0, 0, -30], "normal": [0, 0, -1]},
        "duration_s": 11,
    }
    (folder / "machine.json").write_text(json.dumps(machine))


def calibrated_card(program, folder, angle):
    study = folder / "spheres"
    subprocess.run([program, "new", study, "--mould", "lifted-cylinder", "--density", str(GRAIN_DENSITY * SOLID_FRACTION),
                    "--angle", str(angle), "--sd", "angle=1", "--grains", "3", "--for", "liggghts",
                    "--fix", "rolling_friction=0.04", "--title", "Plastic spheres", "--force"], check=True)
    subprocess.run([program, "calibrate", study / "study.json", "--out", study / "out"], check=True)
    return study / "out/card.json"


def discharged_percent(figures, times_s):
    """Discharged share of the mass at these times after the gate has opened."""
    with open(figures) as file:
        rows = [(float(row["time_s"]), float(row["fed_kg"]), float(row["inside_kg"])) for row in csv.DictReader(file)]
    fed = rows[-1][1]
    return [round(100 * (1 - min(rows, key=lambda row: abs(row[0] - time))[2] / fed), 1) for time in times_s]


def run(options):
    folder = Path(options.folder)
    folder.mkdir(parents=True, exist_ok=True)
    card = calibrated_card(options.program, folder, options.angle)
    with open(MEASURED) as file:
        measured = list(csv.DictReader(file))
    for depth in options.depths.split(","):
        machine, deck = folder / f"machine-{depth}", folder / f"deck-{depth}"
        machine.mkdir(exist_ok=True)
        write_machine(machine, float(depth))
        subprocess.run([options.program, "export", card, "--to", "liggghts", "--application", machine / "machine.json",
                        "--out", deck, "--force"], check=True)
        subprocess.run(["liggghts", "-in", "in.application"], cwd=deck, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([options.program, "kpi", deck], check=True)
        for row, percent in zip(measured, discharged_percent(deck / "figures.csv", [float(row["time_s"]) for row in measured])):
            row[f"depth_{depth}_mm_percent"] = percent
    with open(options.table, "w", newline="") as file:
        rows = csv.DictWriter(file, measured[0].keys())
        rows.writeheader()
        rows.writerows(measured)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("table", metavar="TABLE.csv")
    parser.add_argument("--angle", type=float, default=21)
    parser.add_argument("--depths", default="40,55")
    run(parser.parse_args())
