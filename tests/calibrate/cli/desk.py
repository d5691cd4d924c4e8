"""A user at the command line: the program, shipped files and a folder. Reads PROGRAM and SOURCE_DIR from the command line of
the test."""

import atexit
import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
STUDY = SOURCE / "data/studies/concrete-mix-20.json"
CARD = SOURCE / "data/cards/concrete-mix-79.json"
LAB = SOURCE / "data/lab/concrete-mix-20.json"
APPARATUS = SOURCE / "data/apparatus/abrams.json"
TWO = str(min(2, len(os.sched_getaffinity(0))))  # threads
COARSE = ["--set", "grains.radius_mm=12"]


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


@functools.cache
def coarse_card():
    """The shipped card with large grains, which are quick to export; without a baseline."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-cli-"))
    atexit.register(shutil.rmtree, folder)
    card = folder / "coarse.json"
    result = run("rescale", CARD, "--radius", "12", "--packings", "0", "--out", card)
    assert result.returncode == 0, result.stderr
    return card


class Desk(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = self.folder / "out"

    def terminal(self):
        """Both ends of a terminal. A system without devices, as in a bare chroot, has none."""
        try:
            return os.openpty()
        except OSError as error:
            raise unittest.SkipTest(f"no terminal can be made here: {error}")

    def study(self, budget=4, screening=2, radius_mm=12, **changes):
        """A study of coarse grains with few simulations, beside its laboratory file."""
        lab = json.loads(LAB.read_text())
        lab["grains"] = {"distribution": "mono", "radius_mm": radius_mm}
        (self.folder / "lab.json").write_text(json.dumps(lab))
        study = json.loads(STUDY.read_text())
        study["lab"] = "lab.json"
        study["search"].update(screening=screening, budget_simulations=budget, packings=1, confirmation_packings=1,
                               rejected_share=1)
        study.update(changes)
        file = self.folder / "study.json"
        file.write_text(json.dumps(study))
        return file

    def fails(self, result, status, *words):
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def calibrates(self, study, *options, out=None):
        """Runs a calibration to its card; status 0 says that the material is confirmed."""
        out = out or self.out
        result = run("calibrate", study, "--out", out, *options)
        self.assertIn(result.returncode, (0, 1), result.stdout + result.stderr)
        status = json.loads((out / "card.json").read_text())["search"]["status"]
        self.assertEqual(result.returncode == 0, status == "confirmed", result.stdout + result.stderr)
        return result
