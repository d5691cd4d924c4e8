"""Card of a mix between those of a batch: pastefit.interpolate.

usage: test_mix.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import math
import subprocess
import sys

import numpy as np

from studies import PROGRAM, SOURCE, Desk, main
import pastefit as pf
from pastefit.mix import predicted_on_line

sys.path.insert(0, str(SOURCE / "tests/calibrate/cli"))
from batches import study, write_studies


class Line(Desk):
    def test_a_line_through_points_on_it_predicts_without_an_interval(self):
        mean, half = predicted_on_line(np.array([1, 2, 4, 7]), np.array([5, 7, 11, 17]), 3)
        self.assertAlmostEqual(mean, 9)
        self.assertAlmostEqual(half, 0)

    def test_the_interval_of_a_line_is_students_prediction_interval(self):
        # Of x = 1..5, y = 2, 4, 5, 4, 5: slope 0.6, s^2 = 0.8, t(0.975; 3) = 3.1824.
        mean, half = predicted_on_line(np.arange(1, 6), np.array([2, 4, 5, 4, 5]), 4)
        self.assertAlmostEqual(mean, 4.6)
        self.assertAlmostEqual(half, 3.1824 * math.sqrt(0.8 * (1 + 0.2 + 0.1)), delta=0.004)


class Mix(Desk):
    def program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)

    def refused(self, variable, value, *words):
        fault = self.faults(pf.interpolate, self.out, variable, value)[0]
        for word in words:
            self.assertIn(word, str(fault))

    def test_its_card_says_that_it_is_interpolated_and_not_confirmed(self):
        studies = write_studies(self.folder, 4, tolerance_mm=80)
        self.assertEqual(self.program("batch", *studies, "--out", self.out).returncode, 0)
        card, file = pf.interpolate(self.out, "mix.water_kg_m3", 243), self.folder / "between.json"
        self.assertEqual((card.content["interpolated"]["value"], card.content["interpolated"]["model"]), (243, "linear"))
        self.assertFalse(card.meets_laboratory)
        interval = card.content["intervals"]["parameters"]["strength_pa"]
        self.assertTrue(300 <= interval["lower"] <= card.parameters["strength_pa"] <= interval["upper"] <= 40000, interval)
        nearest = pf.Card.load(self.out / "mix-02" / "card.json").content["material"]["contact"]
        self.assertNotEqual(card.content["material"]["contact"], nearest)

        card.save(file)
        words = "Interpolated, not confirmed: mix.water_kg_m3 243, linear between 4 materials"
        self.assertIn(words, " ".join(self.program("show", file).stdout.split()))
        checked = self.program("check", file, "--against", self.folder / "lab-01.json")
        self.assertIn(checked.returncode, (0, 1), checked.stderr)
        self.assertIn(words, " ".join(checked.stdout.split()))
        self.program("export", "--unconfirmed", file, "--to", "liggghts", "--out", self.folder / "deck")
        for name in ("NOTES.txt", "in.slump"):
            self.assertIn(words, (self.folder / "deck" / name).read_text())

        self.refused("mix.water_kg_m3", 300, "300", "238 to 250")
        self.refused("mix.wine_kg_m3", 240, "no laboratory file has this variable", "mix.water_kg_m3")
        changed = study(3, tolerance_mm=80)
        changed["parameters"]["friction"] = {"value": 0.3}
        studies[3].write_text(json.dumps(changed))
        self.program("batch", *studies, "--out", self.out)
        self.refused("mix.water_kg_m3", 243, "other contact laws, parameters or bounds")
        self.program("batch", *studies[:2], "--out", self.out)
        self.refused("mix.water_kg_m3", 248, "2 confirmed cards", "at least 3")


if __name__ == "__main__":
    main()
