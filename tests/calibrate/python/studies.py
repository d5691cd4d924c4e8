"""Shared by the tests of the Python package: coarse studies that take seconds. Reads PROGRAM and SOURCE_DIR from the command
line of the test; skips it (status 77) without NumPy."""

import json
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
except ImportError:
    sys.exit(77)

import pastefit as pf

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
STUDY = SOURCE / "data/studies/concrete-mix-20.json"
CARD = SOURCE / "data/cards/concrete-mix-79.json"
THREADS = min(2, len(os.sched_getaffinity(0)))


def coarse_lab(radius_mm=18, height_mm=150):
    """A laboratory whose test is simulated in a moment, all conditions stated."""
    return {"format": "pastefit-lab-1", "title": "Coarse grains", "provenance": {
                "source": "made up", "licence": "Apache-2.0", "notes": "", "twin": False},
            "apparatus": {"preset": "abrams", "lift_velocity_mm_s": 100}, "material": {"bulk_density_kg_m3": 2300},
            "grains": {"distribution": "mono", "radius_mm": radius_mm},
            "measurements": {"step1.height_mm": {"value": height_mm, "standard_deviation": 7.5}}}


def coarse_study(**search):
    """Its strength alone is fitted, within a wide tolerance."""
    return {"format": "pastefit-study-1", "title": "Coarse grains, strength alone", "lab": coarse_lab(),
            "contact": {"formation": "film", "rolling_model": "spring_dashpot", "friction_basis": "total"},
            "parameters": {"strength_pa": {"free": [300, 40000], "scale": "log"}, "friction": {"value": 0.15},
                           "rolling_friction": {"value": 0.02}},
            "search": {"screening": 3, "budget_simulations": 16, "packings": 1, "confirmation_packings": 2,
                       "examination_simulations": 2, "tolerance_mm": 40, "rejected_share": 1, "seed": 1, **search}}


def height(candidate):
    """A simulator that costs nothing: the stronger the material, the higher its heap; each seed a little else."""
    return {"step1.height_mm": 80 + 120 * (candidate["strength_pa"] / 40000) ** 0.3 + candidate["seed"] % 7 - 3}


class Desk(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-python-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = self.folder / "out"

    def study_file(self, **search):
        """The coarse study as files, for the program."""
        study = coarse_study(**search)
        (self.folder / "lab.json").write_text(json.dumps(study["lab"]))
        study["lab"] = "lab.json"
        (self.folder / "study.json").write_text(json.dumps(study))
        return self.folder / "study.json"

    def faults(self, call, *arguments, **options):
        """What the one InputError of a call holds."""
        with self.assertRaises(pf.InputError) as raised:
            call(*arguments, **options)
        return raised.exception.faults


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
