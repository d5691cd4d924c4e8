#!/usr/bin/env python3
"""Writes the laboratory files concrete-mix-NN.json, and the studies of the same names, from the table of 103 mixes.

Source of the table: I-Cheng Yeh, "Concrete Slump Test", UCI Machine Learning Repository, 2009,
licence CC BY 4.0. Columns, by position: number, seven amounts in kg per cubic metre of concrete (cement, slag, fly ash,
water, superplasticizer, coarse aggregate, fine aggregate), slump in cm, flow in cm, strength in MPa.

usage: make_concrete_mixes.py            writes those of `MIXES`, here and in ../studies
       make_concrete_mixes.py --all DIR  writes those of all rows into a new folder, each with its mix: for pastefit batch
"""

import csv
import json
import pathlib
import sys

TABLE = pathlib.Path(__file__).resolve().parent / "concrete-slump-test.csv"
LAB = pathlib.Path(__file__).resolve().parent
STUDIES = LAB.parent / "studies"

# One mix of each kind, by its number in the table.
MIXES = {
    2: "did not move",
    4: "slump small",
    20: "slump middle",
    50: "slump large",
    66: "slump large",
    79: "slump middle",
    85: "slump large",
    89: "slump low to middle",
    103: "nearly flowed away",
}
# Of these the height alone is fitted: no convex heap has both readings, or there is nothing to fit (data/studies/README.md).
HEIGHT_FITTED = {2, 20, 103}
# At the edge of what the model reaches, where a search that asks coarse grains first loses its way.
FINE_ONLY = {66, 89}
MOULD_HEIGHT_MM = 300
HEIGHT_DEVIATION_MM = 7.5
SPREAD_DEVIATION_MM = 25
AMOUNTS = ("cement", "slag", "fly_ash", "water", "superplasticizer", "coarse_aggregate", "fine_aggregate")
SHEAR_MM = 40  # a top that shifts by more than 0.4 of the base radius has sheared off


def number(value):
    """Whole numbers without a decimal point; the table states one decimal at most two."""
    rounded = round(value, 3)
    return int(rounded) if rounded == int(rounded) else rounded


def lab_file(row, kind, both):
    mix = int(row[0])
    amounts, slump_cm, flow_cm = [float(cell) for cell in row[1:8]], float(row[8]), float(row[9])
    return {
        "format": "pastefit-lab-1",
        "title": f"Concrete mix {mix} of Yeh's slump tests: slump {number(slump_cm)} cm ({kind})",
        "provenance": {
            "source": f"I-Cheng Yeh, Concrete Slump Test, UCI Machine Learning Repository, 2009, row {mix}",
            "licence": "CC BY 4.0",
            "notes": "Slump and flow as in the source, in mm. The source states neither mould nor table: an Abrams cone "
                     "(200/100/300 mm) read at its centre is assumed. Density: sum of the seven amounts. "
                     "The source has no repeats: 7.5 mm is from ASTM C143-98, 21 mm as the 95 % limit between two "
                     "results; 25 mm for the spread is an estimate."
                     + ("" if both else " A slump that is reported did not shear off, or the standards would have had it "
                                        "repeated: a shift of the top of 0 +- 20 mm."),
            "twin": False,
        },
        "apparatus": {"preset": "abrams"},
        "material": {"bulk_density_kg_m3": number(sum(amounts))},
        "grains": {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10} if both
        else {"distribution": "mono", "radius_mm": 8},
        "measurements": {
            "step1.height_mm": {
                "value": number(MOULD_HEIGHT_MM - 10 * slump_cm),
                "standard_deviation": HEIGHT_DEVIATION_MM,
            },
            "step1.spread_mm": {"value": number(10 * flow_cm), "standard_deviation": SPREAD_DEVIATION_MM},
        } | ({} if both else {"step1.lateral_shift_mm": {"value": 0, "standard_deviation": SHEAR_MM / 2}}),
    }


def study_file(row, kind, both):
    mix = int(row[0])
    fitted = "height and spread" if both else "the height"
    study = {
        "format": "pastefit-study-1",
        "title": f"Concrete mix {mix}, slump {number(float(row[8]))} cm ({kind}): fit of {fitted}",
        "lab": f"../lab/concrete-mix-{mix:02}.json",
        "contact": {"formation": "film", "rolling_model": "spring_dashpot", "friction_basis": "total"},
        "parameters": {
            "strength_pa": {"free": [10 if both else 300, 40000], "scale": "log"},
            "rupture_force_ratio": {"value": 0.5} if both else {"free": [0, 0.5]},
            "curvature": {"value": -0.5} if both else {"free": [-0.5, 1]},
            "rupture_gap_ratio": {"free": [0.4, 1.0], "scale": "log"} if both else {"free": [0.3, 1.0]},
            "formation_ratio": {"value": 0.3} if both else {"free": [0, 1]},
            "friction": {"free": [0.05, 0.3], "scale": "log"} if both else {"value": 0.15},
            "rolling_friction": {"free": [0, 0.5]} if both else {"value": 0.02},
        },
        "weights": {"step1.height_mm": 1, "step1.spread_mm": int(both)}
        | ({} if both else {"step1.lateral_shift_mm": 0}),
    }
    if both:
        study["parameters"]["table_friction"] = {"free": [0.1, 1]}  # the source names no table
        study["tolerances"] = {
            "step1.height_mm": HEIGHT_DEVIATION_MM,
            "step1.spread_mm": SPREAD_DEVIATION_MM,
        }
    study["search"] = {
        "strategy": "default",
        "screening": 16 if both else 8,
        "budget_simulations": 150 if both else 80,
        "packings": 2,
        "confirmation_packings": 8,
    }
    if both and mix not in FINE_ONLY:
        study["search"]["coarse_first"] = True
    if not both:
        study["search"]["tolerance_mm"] = 5
    study["search"]["seed"] = 1
    return study


def text(content, indent=0):
    """JSON with one line for each object or list that fits, as a person would write it."""
    line = json.dumps(content, ensure_ascii=False)
    if not isinstance(content, dict) or (indent > 0 and len(line) <= 100):
        return line
    space = " " * (indent + 2)
    entries = [f"{space}{json.dumps(key)}: {text(value, indent + 2)}" for key, value in content.items()]
    return "{\n" + ",\n".join(entries) + "\n" + " " * indent + "}"


def write(path, content):
    path.write_text(text(content) + "\n", encoding="utf-8")


def mix_of(row):
    """The amounts, and the water over all binders, by mass."""
    mix = {f"{name}_kg_m3": number(float(cell)) for name, cell in zip(AMOUNTS, row[1:8])}
    binders = mix["cement_kg_m3"] + mix["slag_kg_m3"] + mix["fly_ash_kg_m3"]
    return mix | {"water_binder_ratio": number(mix["water_kg_m3"] / binders)}


def read_table():
    with TABLE.open(newline="", encoding="utf-8") as file:
        return {int(row[0]): row for row in csv.reader(file) if row and row[0].strip().isdigit()}


def write_all(folder):
    """Every mix with the same bounds and tolerances, its height and spread fitted."""
    if folder.exists():
        sys.exit(f"{folder} is there already: name a new folder")
    (folder / "lab").mkdir(parents=True)
    for mix, row in read_table().items():
        name = f"concrete-mix-{mix:03}.json"
        lab, study = lab_file(row, "one of 103", True), study_file(row, "one of 103", True)
        write(folder / "lab" / name, lab | {"mix": mix_of(row)})
        write(folder / name, study | {"lab": f"lab/{name}"})


def write_shipped():
    rows = read_table()
    for mix, kind in MIXES.items():
        both = mix not in HEIGHT_FITTED
        write(LAB / f"concrete-mix-{mix:02}.json", lab_file(rows[mix], kind, both))
        write(STUDIES / f"concrete-mix-{mix:02}.json", study_file(rows[mix], kind, both))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--all":
        write_all(pathlib.Path(sys.argv[2]))
    elif len(sys.argv) == 1:
        write_shipped()
    else:
        sys.exit(__doc__)
