#!/usr/bin/env python3
"""How a parameter affects the share of heaps that shear off: packings of a card with other values, counted and averaged.

usage: parameter_heaps.py PROGRAM CARD TABLE.csv [--set NAME=VALUE ...] --vary NAME=VALUE,VALUE... [--packings 201:217] [--jobs 2]

Simulates each value of the varied parameter, with the values of --set for all. A row: label, value, number of heaps
simulated, number sheared off (top shifted by more than 0.4 of the mould's base radius), height and spread of the others (of
all, if all sheared off) with the standard deviation of one, the simulated time of step 1, and core-seconds of a heap. Failed
runs are counted as such. Existing rows are not run again.
"""
import argparse
import csv
import json
import os
import resource
import statistics
import subprocess
from concurrent.futures import ThreadPoolExecutor

COLUMNS = ["card", "set", "parameter", "value", "heaps", "failed", "sheared", "height_mm", "height_sd", "spread_mm", "spread_sd",
           "core_s"]
SHEARED_MM = 40


def simulated(options, sets, packing):
    words = [part for one in sets for part in ("--set", f"parameters.{one}")]
    done = subprocess.run([options.program, "simulate", options.card, *words, "--seed", str(packing), "--json", "--quiet"],
                          capture_output=True, text=True)
    if done.returncode == 2:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)["observables"] if done.returncode == 0 else None


def mean_and_deviation(values):
    if not values:
        return "", ""
    return round(statistics.mean(values), 1), round(statistics.stdev(values), 1) if len(values) > 1 else ""


def row_of(options, parameter, value):
    sets = [*options.set, f"{parameter}={value}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    first, last = map(int, options.packings.split(":"))
    with ThreadPoolExecutor(options.jobs) as pool:
        runs = list(pool.map(lambda packing: simulated(options, sets, packing), range(first, last)))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    heaps = [heap for heap in runs if heap]
    sheared = [heap for heap in heaps if heap["step1.lateral_shift_mm"] > SHEARED_MM]
    standing = [heap for heap in heaps if heap["step1.lateral_shift_mm"] <= SHEARED_MM] or heaps
    core_s = (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) / max(1, len(runs))
    return [os.path.basename(options.card), " ".join(options.set), parameter, value, len(heaps), len(runs) - len(heaps),
            len(sheared), *mean_and_deviation([heap["step1.height_mm"] for heap in standing]),
            *mean_and_deviation([heap["step1.spread_mm"] for heap in standing]), round(core_s, 1)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("card")
    parser.add_argument("table")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--vary", required=True)
    parser.add_argument("--packings", default="201:217")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    parameter, values = options.vary.split("=")
    known = set()
    if os.path.exists(options.table):
        with open(options.table) as file:
            known = {tuple(row[name] for name in COLUMNS[:4]) for row in csv.DictReader(file)}
    with open(options.table, "a", newline="") as file:
        rows = csv.writer(file)
        if file.tell() == 0:
            rows.writerow(COLUMNS)
        for value in values.split(","):
            key = (os.path.basename(options.card), " ".join(options.set), parameter, value)
            if key not in known:
                rows.writerow(row_of(options, parameter, value))
                file.flush()


if __name__ == "__main__":
    main()
