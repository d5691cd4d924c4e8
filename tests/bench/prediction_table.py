#!/usr/bin/env python3
"""Bias and scatter of what cards predict of readings that they were not fitted to.

usage: prediction_table.py [--check PAGE.md]

Reads tests/results/unfitted_readings.csv (from unfitted_reading.py) and predicted_readings.csv (from predictions.py), and prints
a row for each quantity and its three worst cases; --check compares the rows with a page.

Bias and scatter are those of the validation guide of the Fire Dynamics Simulator (McGrattan and Toman, NIST, 2011). With
r = ln(predicted / measured), the deviation of r is that of model and laboratory together. Without the laboratory's own relative
deviation it is the scatter of the model, and the bias is exp(mean r + (model deviation^2 - laboratory deviation^2) / 2).
"""
import argparse
import csv
import json
import math
import statistics
import sys
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

RESULTS = Path(__file__).resolve().parents[1] / "results"
LABORATORY_MM = {"height": 7.5, "spread": 25}  # deviation between tests of a concrete, as the studies take it
HEAP_MM = {"height": 4.4, "spread": 6}  # deviation of one simulated heap (tests/results/ruler.md)


class Case(NamedTuple):
    name: str
    predicted: float
    measured: float
    laboratory: float  # standard deviation of the measurement


def table(name):
    with open(RESULTS / name) as file:
        return list(csv.DictReader(file))


def cases():
    """Of each quantity, as the page names it."""
    found = defaultdict(list)
    for row in table("unfitted_readings.csv"):
        predicted = "spread" if row["fitted"] == "height" else "height"
        if row["status"] == "confirmed":
            found[f"{predicted} from {row['fitted']}, concretes"].append(
                Case(row["mix"], float(row[f"{predicted}_mm"]), float(row[f"measured_{predicted}_mm"]), LABORATORY_MM[predicted]))
    for row in table("predicted_readings.csv"):
        step, quantity = row["reading"].split(".")
        quantity = quantity.removesuffix("_mm")
        if row["status"] == "confirmed" and quantity in HEAP_MM:
            found[f"twins, {quantity} {'before' if step == 'step1' else 'after'} the drop"].append(
                Case(f"twin {row['twin']}", statistics.mean(json.loads(row["materials"])), float(row["measured"]), HEAP_MM[quantity]))
    return found


def bias_and_scatter(of):
    """Bias, relative deviation of the model, relative deviation of the laboratory."""
    ratios = [math.log(one.predicted / one.measured) for one in of]
    laboratory = math.sqrt(statistics.mean((one.laboratory / one.measured) ** 2 for one in of))
    model = math.sqrt(max(0, statistics.variance(ratios) - laboratory**2))
    return math.exp(statistics.mean(ratios) + (model**2 - laboratory**2) / 2), model, laboratory


def rows():
    for quantity, of in cases().items():
        bias, model, laboratory = bias_and_scatter(of)
        differences = [one.predicted - one.measured for one in of]
        yield (f"| {quantity} | {len(of)} | {bias:.2f} | {100 * model:.0f} % | {100 * laboratory:.0f} % | "
               f"{statistics.mean(differences):+.0f} ± {statistics.stdev(differences):.0f} |")


def worst():
    for quantity, of in cases().items():
        for one in sorted(of, key=lambda one: -abs(math.log(one.predicted / one.measured)))[:3]:
            yield f"{quantity}: {one.name}, {one.predicted:.0f} instead of {one.measured:.0f}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", metavar="PAGE.md")
    page = parser.parse_args().check
    if page:
        written = Path(page).read_text()
        sys.exit("\n".join(f"{page} lacks: {row}" for row in rows() if row not in written) or 0)
    print("| predicted reading | cases | bias | scatter of the model | of the laboratory | predicted minus measured |")
    print("|---|---:|---:|---:|---:|---:|")
    print("\n".join([*rows(), "", "Worst:", *worst()]))
