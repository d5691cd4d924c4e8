#!/usr/bin/env python3
"""Compares search strategies on one study: same budget, results judged on the same new packings.

usage: compare.py PROGRAM STUDY [--strategies default,bobyqa,...] [--seeds 1,2] [--budget N] [--judge-packings 8] [--threads 2]

A row for each strategy: number of confirmed searches; medians of the number of simulations and of the error of the material
(largest difference over its tolerance, means of the judging packings, fitted readings with a tolerance); the worst error.
Strategies that cannot search the study's parameters report this and are left out.
"""
import argparse
import json
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile

STRATEGIES = "default,levenberg_marquardt,dogleg,direct_l,crs2_lm,bobyqa,cobyla,nelder_mead,sbplx"


def judged_error(options, study, card):
    """Nothing where a packing fails."""
    sets = [word for name, value in card["material"]["parameters"].items() for word in ("--set", f"parameters.{name}={value!r}")]
    heaps = []
    for packing in range(1_000_000_001, 1_000_000_001 + options.judge_packings):
        done = subprocess.run([options.program, "simulate", study, *sets, "--seed", str(packing), "--json", "--quiet"],
                              capture_output=True, text=True)
        if done.returncode:
            return None
        heaps.append(json.loads(done.stdout)["observables"])
    fitted = {name: reading for test in card["tests"] for name, reading in test["readings"].items() if reading.get("tolerance")}
    return max(abs(statistics.mean(heap[name] for heap in heaps) - reading["measured"]) / reading["tolerance"]
               for name, reading in fitted.items())


def trial(options, study, strategy, seed, folder):
    study["search"] |= {"strategy": strategy, "seed": seed} | ({"budget_simulations": options.budget} if options.budget else {})
    file = folder / "study.json"
    file.write_text(json.dumps(study))
    out = folder / f"{strategy}-{seed}"
    done = subprocess.run([options.program, "calibrate", file, "--out", out, "--threads", str(options.threads), "--quiet"],
                          capture_output=True, text=True)
    if done.returncode not in (0, 1) or not (out / "card.json").exists():
        print(f"{strategy}, seed {seed}: {done.stderr.strip()}", flush=True)
        return None
    card = json.loads((out / "card.json").read_text())
    return card["search"]["status"] == "confirmed", card["search"]["simulations"], judged_error(options, file, card)


def compare(options):
    source = pathlib.Path(options.study)
    study = json.loads(re.sub(r"(?m)^\s*//.*$", "", source.read_text()))
    print("| strategy | confirmed | simulations | error | worst error |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copy(source.parent / study["lab"], folder / study["lab"])
        for strategy in options.strategies.split(","):
            trials = [trial(options, study, strategy, int(seed), folder) for seed in options.seeds.split(",")]
            trials = [one for one in trials if one]
            errors = [error for _, _, error in trials if error is not None]
            if trials:
                print(f"| {strategy} | {sum(one[0] for one in trials)} of {len(trials)} | {statistics.median(one[1] for one in trials):g} | "
                      + (f"{statistics.median(errors):.2f} | {max(errors):.2f} |" if errors else "| |"), flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("study")
    parser.add_argument("--strategies", default=STRATEGIES)
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--budget", type=int)
    parser.add_argument("--judge-packings", type=int, default=8)
    parser.add_argument("--threads", type=int, default=2)
    compare(parser.parse_args())
