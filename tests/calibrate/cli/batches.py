"""Quick studies for tests of many studies: coarse grains, one strength, one height."""

import json
import pathlib
import re


def lab(number):
    """Its mix names a water content that falls while the height rises."""
    return {"format": "pastefit-lab-1", "title": f"Mix {number}",
            "provenance": {"source": "made up", "licence": "Apache-2.0", "notes": "", "twin": False},
            "apparatus": {"preset": "abrams", "lift_velocity_mm_s": 100}, "material": {"bulk_density_kg_m3": 2300},
            "mix": {"water_kg_m3": 250 - 4 * number}, "grains": {"distribution": "mono", "radius_mm": 18},
            "measurements": {"step1.height_mm": {"value": 110 + 3 * number, "standard_deviation": 7.5}}}


def study(number, **search):
    return {"format": "pastefit-study-1", "title": f"Mix {number}: strength alone", "lab": f"lab-{number:02}.json",
            "contact": {"formation": "film", "rolling_model": "spring_dashpot", "friction_basis": "total"},
            "parameters": {"strength_pa": {"free": [300, 40000], "scale": "log"}, "friction": {"value": 0.15},
                           "rolling_friction": {"value": 0.02}},
            "search": {"screening": 3, "budget_simulations": 24, "packings": 1, "confirmation_packings": 2,
                       "examination_simulations": 2, "tolerance_mm": 20, "rejected_share": 1, "seed": 1, **search}}


def write_studies(folder, count, **search):
    """Writes them with their laboratory files; the files of the studies."""
    files = []
    for number in range(count):
        (folder / f"lab-{number:02}.json").write_text(json.dumps(lab(number)))
        files.append(folder / f"mix-{number:02}.json")
        files[-1].write_text(json.dumps(study(number, **search)))
    return files


def parent_of(process):
    return int(re.search(r"PPid:\s*(\d+)", pathlib.Path(f"/proc/{process}/status").read_text()).group(1))


def process_of(*words):
    """The first process with all these words in its command line: (id, id of its parent)."""
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
            if all(word in command for word in words):
                return int(entry.name), parent_of(entry.name)
        except OSError:
            continue
    return None
