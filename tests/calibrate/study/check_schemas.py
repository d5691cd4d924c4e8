#!/usr/bin/env python3
"""Validates every shipped data file against its schema, and checks that the schemas refuse spoiled files.

Usage: check_schemas.py DATA_FOLDER
"""

import copy
import json
import pathlib
import sys

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import schemas

FOLDERS = {"apparatus": "apparatus", "application": "applications", "lab": "lab", "study": "studies", "card": "cards", "case": "../tests/cases"}


def validator(data, kind):
    known = schemas.schema(data, kind)
    jsonschema.Draft7Validator.check_schema(known)
    return jsonschema.Draft7Validator(known)


def spoiled(document, path, value=None):
    """The document with the value at `path` replaced, or removed if there is none."""
    copied = copy.deepcopy(document)
    place = copied
    for key in path[:-1]:
        place = place[key]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return copied


SPOILED = {
    "apparatus": [
        (["apparatus", "mould", "height_mm"], "200"),
        (["apparatus", "mould", "height_mm"], None),
        (["apparatus", "mould", "height_m"], 0.2),
        (["apparatus", "preset"], "abrams"),
        (["material"], None),
        (["format"], "pastefit-lab-1"),
    ],
    "application": [
        (["parts"], None),
        (["feed", "mass_kg"], 0),
        (["feed", "velocity_m_s"], [0, 0]),
        (["feed", "centre_m"], [0, 0, 1]),
        (["format"], "pastefit-lab-1"),
    ],
    "lab": [
        (["title"], None),
        (["extra"], 1),
        (["provenance", "twin"], 1),
        (["apparatus", "mold"], {}),
        (["grains", "radius_mm"], 0),
        (["grains", "largest_mm"], 9),
        (["material", "bulk_density_kg_m3"], 2.3),
        (["material", "yield_stress_pa"], {"value": 0, "standard_deviation": 30}),
        (["material", "yield_stress_pa"], {"value": 300}),
        (["measurements"], {}),
        (["measurements", "step1.height_mm", "value"], -1),
        (["measurements", "step1.height_mm", "standard_deviation"], None),
        (["measurements", "step1.height_mm", "repeats"], [1, 2]),
        (["measurements", "step1.slump_mm"], {"value": 1, "standard_deviation": 1}),
        (["measurements", "step3.height_mm"], {"value": 1, "standard_deviation": 1}),
    ],
    "study": [
        (["lab"], None),
        (["parameters"], {}),
        (["parameters", "strength_pa", "free"], [200]),
        (["parameters", "strength_pa", "free"], [0, 60000]),
        (["parameters", "strength_pa", "value"], 300),
        (["parameters", "friction", "value"], 3),
        (["parameters", "frction"], {"value": 0.3}),
        (["weights", "step1.height_mm"], -1),
        (["search", "packings"], 2.5),
        (["search", "packings"], 0),
        (["search", "end_early"], 1),
        (["contact", "formation"], "both"),
    ],
    "card": [
        (["format"], "pastefit-card-99"),
        (["material", "contact"], None),
        (["material", "grains", "radius_m"], 0),
        (["tests"], []),
        (["tests", 0, "test", "mould"], None),
        (["tests", 0, "baseline", "packings"], [-1]),
        (["tests", 0, "baseline", "readings"], {"step1.height_mm": 3}),
        (["tests", 0, "lab_hash"], 3),
        (["tests", 0, "measured_yield_stress_pa"], {"value": 300, "standard_deviation": 30}),
        (["tests", 0, "readings"], {"step1.height_mm": {"simulated": 100}}),
        (["rescaled"], {}),
        (["further_confirmations"], [{"engine": "lammps"}]),
        (["correlation"], {"strength_pa": {"curvature": 2}}),
    ],
    "case": [
        (["source"], None),
        (["checks"], []),
        (["checks", 0, "absolute_tolerance"], None),
        (["checks", 0, "reading"], 3),
        (["scene", "contact", "youngs_modulus_pa"], "stiff"),
        (["scene", "grains", 0, "radius_m"], 0),
        (["scene", "grains", 0, "velocity_m_s"], [1, 2]),
        (["scene", "walls", 0, "plane"], 1),
        (["scene", "gravity"], 9.81),
    ],
}


def without_range(schema, place="#"):
    """Where the schema has a number that may be as large, or as far below nothing, as one likes."""
    if isinstance(schema, list):
        for i, part in enumerate(schema):
            yield from without_range(part, f"{place}/{i}")
    if not isinstance(schema, dict):
        return
    kinds = schema.get("type", [])
    if {"number", "integer"} & set([kinds] if isinstance(kinds, str) else kinds):
        if "maximum" not in schema or not {"minimum", "exclusiveMinimum"} & set(schema):
            yield place
    for key, part in schema.items():
        yield from without_range(part, f"{place}/{key}")


def main(data):
    failures = []
    for kind, folder in FOLDERS.items():
        check = validator(data, kind)
        failures += [f"{kind}.schema.json: the number {place} has no range" for place in without_range(check.schema)]
        files = sorted((data / folder).glob("*.json"))
        if not files:
            failures.append(f"{data / folder}: no files")
        for path in files:
            document = json.loads(path.read_text(encoding="utf-8"))
            failures += [f"{path}: {'.'.join(map(str, error.path))}: {error.message}" for error in check.iter_errors(document)]
            for place, value in SPOILED[kind] if path is files[0] else []:
                if check.is_valid(spoiled(document, place, value)):
                    failures.append(f"{kind}.schema.json accepts {'.'.join(map(str, place))} = {value}")
    print("\n".join(failures) or "all files and schemas agree")
    return 1 if failures else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
