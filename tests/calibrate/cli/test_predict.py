"""`pastefit predict`: predictions of the fitting materials for another test, and the next test to measure.

usage: test_predict.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import sys
import unittest

from desk import Desk, run


class Predict(Desk):
    def setUp(self):
        super().setUp()
        self.assertIn(run("calibrate", self.study(budget=16), "--out", self.out, "--quiet").returncode, (0, 1))

    def test_the_materials_that_fit_predict_another_test_and_are_held_against_what_was_measured_there(self):
        said = run("predict", self.out, "--preset", "hinged-plate", "--packings", "2", "--json", "--quiet")
        self.assertEqual(said.returncode, 0, said.stderr)
        found = json.loads(said.stdout)
        self.assertEqual(found["heaps"], 2 * found["materials"])
        self.assertEqual(found["level"], 0.9)
        self.assertIn("step2.height_mm", found["readings"])
        for name, row in found["readings"].items():
            with self.subTest(name):
                self.assertEqual(len(row["of_materials"]), found["materials"])
                self.assertAlmostEqual(row["mean"], sum(row["of_materials"]) / found["materials"])
                self.assertLessEqual(row["lower"], min(row["of_materials"]))
                self.assertGreaterEqual(row["upper"], max(row["of_materials"]))
        self.assertNotIn("step1.slump_mm", found["readings"])  # the height in another form
        result = run("predict", self.out, "--lab", self.folder / "lab.json", "--packings", "2", "--quiet")
        self.assertEqual(result.returncode, 1 if "x: the measured value lies outside" in result.stdout else 0, result.stdout + result.stderr)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
        self.assertRegex(result.stdout, r"step1.height_mm .* 150\b")
        self.fails(run("predict", self.folder, "--preset", "hinged-plate"), 2, "neither card.json nor evaluations.sqlite")
        self.fails(run("predict", self.out, "--preset", "abram"), 2, "did you mean", "abrams")

    def test_without_a_test_the_readings_of_the_presets_are_ranked_by_what_they_would_tell(self):
        said = run("predict", self.out, "--packings", "2", "--json", "--quiet")
        self.assertEqual(said.returncode, 0, said.stderr)
        found = json.loads(said.stdout)
        left = [one["width_left"] for one in found["readings"]]
        self.assertEqual(left, sorted(left))
        self.assertTrue(all(0 < one <= 1 for one in left))
        presets = {one["preset"] for one in found["readings"]}
        self.assertLessEqual({"abrams", "hinged-plate", "haegermann-table"}, presets | set(found["left_out"]))
        self.assertIn("mini-cone", found["left_out"])  # its mould is three grains wide
        self.assertIn("the mould is only", found["left_out"]["mini-cone"])

    def test_every_material_that_fits_is_exported_with_a_card_of_its_own(self):
        decks = self.folder / "decks"
        result = run("export", self.out / "card.json", "--to", "liggghts", "--out", decks, "--materials", "--unconfirmed")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(len(list(decks.iterdir())), 1)
        own = json.loads((self.out / "card.json").read_text())["material"]
        seen = []
        for number in range(1, 1 + len(list(decks.iterdir()))):
            folder = decks / f"material-{number}"
            card = json.loads((folder / "card.json").read_text())
            seen.append(card["material"]["parameters"])
            if number == 1:
                self.assertEqual(card["material"], own)
                continue
            self.assertEqual((folder / "NOTES.txt").read_text().splitlines()[0], "NOT CONFIRMED: not simulated on fresh packings")
            self.assertNotEqual(card["material"]["contact"], own["contact"])
            self.assertFalse(any(test["readings"] for test in card["tests"]))
            self.assertEqual(run("export", folder / "card.json", "--to", "csv", "--out", folder / "csv", "--unconfirmed").returncode, 0)
        self.assertEqual(len({json.dumps(one) for one in seen}), len(seen))
        alone = self.folder / "card.json"
        alone.write_text((self.out / "card.json").read_text())
        self.fails(run("export", alone, "--to", "liggghts", "--out", self.folder / "none", "--materials", "--unconfirmed"), 2,
                   "does not contain materials that fit")
        self.assertFalse((self.folder / "none").exists())


class Plan(Desk):
    EXPECTED = ["--mould", "DIN EN 12350-2", "--slump", "150", "--grains", "13"]

    def test_before_anything_is_measured_the_readings_are_ranked_as_after_a_calibration(self):
        plan = self.folder / "plan"
        said = run("plan", plan, *self.EXPECTED, "--budget", "24", "--packings", "2", "--json", "--quiet")
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        found = json.loads(said.stdout)
        left = [one["width_left"] for one in found["readings"]]
        self.assertEqual(left, sorted(left))
        self.assertTrue({one["preset"] for one in found["readings"]} & {"abrams", "abrams-en"})
        card = json.loads((plan / "out/card.json").read_text())
        self.assertLessEqual({"strength_pa", "friction", "rolling_friction"}, set(card["material"]["free"]))
        self.assertEqual(json.loads((plan / "lab.json").read_text().split("\n", 1)[1])["provenance"]["source"], "expected, not measured")
        same = run("predict", plan / "out", "--packings", "2", "--json", "--quiet")
        self.assertEqual(json.loads(same.stdout), found)
        self.fails(run("plan", plan, *self.EXPECTED), 2, "lab.json", "--force")

    def test_a_plan_wants_a_mould_and_what_is_expected(self):
        self.fails(run("plan", self.folder / "x", "--mould", "abrams"), 2, "--slump", "what you expect")
        self.fails(run("plan", self.folder / "x", "--mould", "abram", "--slump", "100"), 2, 'did you mean "abrams"')
        self.assertNotEqual(run("plan", self.folder / "x", "--slump", "100").returncode, 0)
        self.assertFalse((self.folder / "x").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
