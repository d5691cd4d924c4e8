#!/usr/bin/env python3
"""Typical laboratory sheets, calibrated as `pastefit new` sets them up, with each law of attraction.

usage: laws.py PROGRAM TABLE.csv [--sheets structural,en,stiff,uci:79,...] [--laws epa,bridge] [--seeds 1,2] [--at-once 2]
                                 [--search KEY=VALUE ...] [--parameters JSON] [--foreign 16] [--target edem]
       laws.py --report TABLE.csv

readme: the sheet of the README. structural: Abrams cone, slumps 95, 110 and 100 mm, spread 270 mm. en: EN 12350-5 with one drop. stiff: slumps of 40 to 120
mm with spreads of 0.8 and 0.9 of the width of a cone of the mould's volume and the heap's height; slump-80-0.9: one of them.
uci:NN: a concrete of Yeh's slump tests; uci:all: those whose spread is at most 1.1 of that width. The law `new` is the one
that `pastefit new` chooses. Existing rows are not run again. Each material is simulated on packings 201 to 216 (number:
`--foreign`), which no search has used; readings are averaged over the heaps that do not shear off. core_s is the processor
time of the calibration, core_s_to_card that of its simulations up to the end of the confirmation.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import re
import statistics
import subprocess
import tempfile
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CONE_M3 = math.pi * 0.3 / 12 * (0.2**2 + 0.2 * 0.1 + 0.1**2)
COLUMNS = ["sheet", "law", "seed", "status", "simulations", "to_card", "core_s", "core_s_to_card", "miss", "packings", "rejected", "foreign_sheared",
           "height", "deviation", "spread", "free"]


def width_of_cone_mm(height_mm):
    return 2000 * math.sqrt(3 * CONE_M3 / (math.pi * height_mm / 1000))


def concretes():
    with open(ROOT / "data/lab/concrete-slump-test.csv") as file:
        rows = list(csv.DictReader(file))
    return {int(row["mix"]): row for row in rows}


def sheets_of(words):
    sheets = {}
    for word in words.split(","):
        if word == "readme":
            sheets[word] = ["--mould", "abrams", "--density", "2350", "--slump", "180, 175, 190", "--spread", "330"]
        elif word == "structural":
            sheets[word] = ["--mould", "abrams", "--density", "2280", "--slump", "95, 110, 100", "--spread", "270"]
        elif word == "en":
            sheets[word] = ["--mould", "hinged-plate", "--density", "1900", "--height", "135", "--height2", "118", "--sag", "9",
                            "--spread", "255", "--spread2", "280"]
        elif word == "stiff" or word.startswith("slump-"):
            for slump in (40, 60, 80, 100, 120):
                for share in (0.8, 0.9):
                    spread = round(share * width_of_cone_mm(300 - slump))
                    if word in ("stiff", f"slump-{slump}-{share}"):
                        sheets[f"slump-{slump}-{share}"] = ["--mould", "abrams", "--density", "2300", "--slump", str(slump), "--spread",
                                                            str(spread)]
        elif word.startswith("uci:"):
            for mix, row in concretes().items():
                height, spread = 300 - 10 * float(row["slump_cm"]), 10 * float(row["flow_cm"])
                possible = spread <= 1.1 * width_of_cone_mm(height)
                if word == f"uci:{mix:02}" or (word == "uci:all" and possible):
                    density = sum(float(value) for name, value in row.items() if name.endswith("_kg_m3"))
                    sheets[f"uci:{mix:02}"] = ["--mould", "abrams", "--density", f"{density:.1f}", "--height", f"{height:g}", "--spread",
                                               f"{spread:g}"]
        else:
            raise SystemExit(f"{word}: no such sheet")
    return sheets


def without_comments(text):
    return json.loads(re.sub(r"(?m)//.*$", "", text))


def foreign_heaps(program, study, card, number):
    sets = [part for name, value in card["material"]["parameters"].items() for part in ("--set", f"parameters.{name}={value!r}")]
    heaps = []
    for packing in range(201, 201 + number):
        done = subprocess.run([program, "simulate", study, *sets, "--seed", str(packing), "--json", "--quiet"], capture_output=True, text=True)
        if done.returncode == 0:
            heaps.append(json.loads(done.stdout)["observables"])
    return heaps


def seconds_of(process):
    """Processor seconds of a process and what it started, once it is over."""
    _, _, usage = os.wait4(process.pid, 0)
    return usage.ru_utime + usage.ru_stime


def run(program, sheet, words, law, seed, options):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        done = subprocess.run([program, "new", folder, *words, "--for", options.target, *([] if law == "new" else ["--law", law])], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{sheet}: {done.stderr}")
        study = without_comments((folder / "study.json").read_text())
        study["search"]["seed"] = seed
        study["search"] |= dict(options.search)
        study["parameters"] |= json.loads(options.parameters)
        (folder / "study.json").write_text(json.dumps(study))
        with open(folder / "said", "w") as said:
            process = subprocess.Popen([program, "calibrate", folder / "study.json", "--out", folder / "out", "--threads", "1", "--quiet"],
                                       stdout=said, stderr=said)
            core_s = seconds_of(process)
        if not (folder / "out/card.json").exists():
            return [sheet, law, seed, (folder / "said").read_text()[-200:].replace("\n", " ")] + [""] * (len(COLUMNS) - 4)
        card = json.loads((folder / "out/card.json").read_text())
        heaps = foreign_heaps(program, folder / "study.json", card, options.foreign)
    radius_mm = 100
    sheared = [heap["step1.lateral_shift_mm"] > 0.4 * radius_mm for heap in heaps]
    standing = [heap for heap, gone in zip(heaps, sheared) if not gone] or heaps
    simulations = card["search"]["simulations"]
    to_card = int(re.search(r"\((\d+) simulations\)", card["search"]["reason"] + f"({simulations} simulations)")[1])
    heights = [heap["step1.height_mm"] for heap in standing]
    spreads = [heap["step1.spread_mm"] for heap in standing]
    free = {name: float(f"{card['material']['parameters'][name]:.3g}") for name, value in study["parameters"].items() if "free" in value}
    return [sheet, law, seed, card["search"]["status"], simulations, to_card, round(core_s), round(core_s * to_card / simulations),
            round(card["confirmation"]["error"], 2),
            len(card["confirmation"]["packings"]), card["confirmation"].get("rejected", ""), f"{sum(sheared)} of {len(heaps)}",
            round(statistics.mean(heights), 1) if heights else "", round(statistics.stdev(heights), 1) if len(heights) > 1 else "",
            round(statistics.mean(spreads), 1) if spreads else "", json.dumps(free)]


def measure(options):
    known = set()
    if os.path.exists(options.table):
        with open(options.table) as file:
            known = {(row["sheet"], row["law"], row["seed"]) for row in csv.DictReader(file)}
    lock = threading.Lock()
    with open(options.table, "a", newline="") as file, concurrent.futures.ThreadPoolExecutor(options.at_once) as workers:
        rows = csv.writer(file)
        if not known and file.tell() == 0:
            rows.writerow(COLUMNS)

        def one(job):
            row = run(options.program, *job, options)
            with lock:
                rows.writerow(row)
                file.flush()

        jobs = [(sheet, words, law, int(seed)) for seed in options.seeds.split(",") for law in options.laws.split(",")
                for sheet, words in sheets_of(options.sheets).items() if (sheet, law, seed) not in known]
        for _ in workers.map(one, jobs):
            pass


def report(table):
    with open(table) as file:
        rows = list(csv.DictReader(file))
    groups = {}
    for row in rows:
        groups.setdefault((row["sheet"], row["law"]), []).append(row)
    print("| sheet | law | confirmed | simulations to the card | core-s to the card | largest miss | foreign heaps sheared off, of 16 | deviation of a height |")
    print("|---|---|---|---|---|---|---|---|")
    for (sheet, law), of in groups.items():
        done = [row for row in of if row["status"] == "confirmed"]

        def spread_of(values):
            return f"{statistics.median(values):.3g}, {min(values):.3g} to {max(values):.3g}" if values else ""

        print(f"| {sheet} | {law} | {len(done)} of {len(of)} | {spread_of([int(r['to_card']) for r in done])} | "
              f"{spread_of([float(r['core_s_to_card']) for r in done])} | {spread_of([float(r['miss']) for r in done])} | "
              f"{spread_of([int(r['foreign_sheared'].split()[0]) for r in done])} | "
              f"{spread_of([float(r['deviation']) for r in done if r['deviation']])} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("table")
    parser.add_argument("--sheets", default="structural,en,stiff")
    parser.add_argument("--laws", default="epa,bridge")
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--at-once", type=int, default=2)
    parser.add_argument("--search", action="append", default=[], type=lambda text: (text.split("=")[0], json.loads(text.split("=")[1])))
    parser.add_argument("--foreign", type=int, default=16, help="packings of each material besides")
    parser.add_argument("--target", default="lammps", help="program that the material is for")
    parser.add_argument("--parameters", default="{}", help="JSON that replaces some of the study's parameters")
    parser.add_argument("--report", action="store_true")
    chosen = parser.parse_args()
    report(chosen.table) if chosen.report else measure(chosen)
