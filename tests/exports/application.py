#!/usr/bin/env python3
"""Runs an application in LIGGGHTS: a vessel carries the weight of what is fed into it until its floor slides away, and what does
not remain is discharged. The card's grains are coarse, so that this takes seconds.

usage: application.py PASTEFIT CARD
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import engines

GRAVITY_M_S2 = 9.81
SIDE_MM, HEIGHT_MM = 300, 400


def stl(quads):
    facets = [corners for a, b, c, d in quads for corners in ((a, b, c), (a, c, d))]
    vertices = ["".join(f"vertex {x} {y} {z}\n" for x, y, z in corners) for corners in facets]
    return "solid part\n" + "".join(f"facet normal 0 0 0\nouter loop\n{one}endloop\nendfacet\n" for one in vertices) + "endsolid part\n"


def square(half, height):
    return (-half, -half, height), (half, -half, height), (half, half, height), (-half, half, height)


def write_machine(folder):
    half = SIDE_MM / 2
    low, high = square(half, 0), square(half, HEIGHT_MM)
    (folder / "walls.stl").write_text(stl([(low[n], low[(n + 1) % 4], high[(n + 1) % 4], high[n]) for n in range(4)]))
    (folder / "floor.stl").write_text(stl([square(half + 10, -1)]))
    machine = {
        "format": "pastefit-application-1", "title": "Vessel",
        "parts": {"walls": {"file": "walls.stl", "friction": 0.0, "rolling_friction": 0.0},
                  "floor": {"file": "floor.stl", "slide": {"from_s": 3, "velocity_m_s": [2, 0, 0], "distance_mm": 400}}},
        "feed": {"centre_mm": [0, 0, 380], "radius_mm": 130, "velocity_m_s": [0, 0, -1], "mass_kg": 10, "rate_kg_s": 10},
        "outlet": {"point_mm": [0, 0, -30], "normal": [0, 0, -1]}, "duration_s": 5}
    (folder / "vessel.json").write_text(json.dumps(machine))


def main(pastefit, card):
    with tempfile.TemporaryDirectory(prefix="pastefit-application-") as name:
        folder = pathlib.Path(name)
        write_machine(folder)
        coarse = folder / "coarse.json"
        subprocess.run([pastefit, "rescale", card, "--radius", "16", "--packings", "0", "--out", coarse], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deck = folder / "deck"
        subprocess.run([pastefit, "export", coarse, "--unconfirmed", "--to", "liggghts", "--application", folder / "vessel.json",
                        "--out", deck], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(engines.command_of("liggghts", "application", pastefit, deck), cwd=deck, check=True, stdout=subprocess.DEVNULL)
        rows = [line.split(",") for line in (deck / "figures.csv").read_text().split()]
        table = [dict(zip(rows[0], map(float, row))) for row in rows[1:]]
        resting = [row["floor_force_n"] for row in table if -1 < row["time_s"] < 0]
        found = json.loads(subprocess.run([pastefit, "kpi", deck, "--json"], check=True, capture_output=True, text=True).stdout)
        figures = {key: value["mean"] for key, value in found["figures"].items()}
    print(figures)
    weight = sum(resting) / len(resting) / GRAVITY_M_S2
    fed, discharged, remaining = figures["fed_kg"], figures["discharged_kg"], figures["remaining_kg"]
    print(f"fed {fed:.3f} kg, carried by the floor {weight:.3f} kg")
    return int(abs(fed - 10) > 0.1 or abs(weight / fed - 1) > 0.01 or abs(fed - discharged - remaining) > 1e-6
               or remaining > 0.05 * fed or not 0 < figures["time_to_50_percent_s"] < 1)


if __name__ == "__main__":
    engines.exit_with(main, *sys.argv[1:3])
