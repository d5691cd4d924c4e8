"""Every verb on every shipped file of its kind gives an answer or a classified failure, never an internal error. `check` of the
cards and `verify` of the cases are separate tests (tests/CMakeLists.txt).

usage: test_shipped_files.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import re
import shutil
import sys
import unittest

from desk import SOURCE, Desk, run


def shipped(kind):
    return sorted((SOURCE / "data" / kind).glob("*.json"))


def coarser(scene):
    """Settings that make a quarter of an hour of fine granules a few seconds of coarse ones, of a study's laboratory too."""
    document = json.loads(scene.read_text())
    if isinstance(document.get("lab"), str):
        document = json.loads((scene.parent / document["lab"]).read_text())
    grains = document.get("grains", {})
    if grains.get("radius_mm") == 8:
        return ["--set", "grains.radius_mm=11"]
    fine = {key: value for key, value in grains.items() if key.endswith("_mm") and grains.get("radius_mm", grains.get("smallest_mm")) < 0.5}
    return [word for key, value in fine.items() for word in ("--set", f"grains.{key}={3 * value}")]


class ShippedFiles(Desk):
    def answers(self, *arguments, statuses=(0,)):
        result = run(*arguments)
        self.assertIn(result.returncode, statuses, result.stderr)
        self.assertTrue(result.stdout)
        return result.stdout

    def each(self, files, look):
        """Calls `look` with each file, and with a folder of its own for what is written."""
        self.assertTrue(files)
        for number, file in enumerate(files):
            with self.subTest(file.name):
                look(file, self.folder / str(number))

    def test_cards(self):
        targets = re.search(r"target: ([\w, -]+)", run("export", "--help").stdout)[1].split(", ")
        self.assertIn("lammps", targets)

        def look(card, out):
            self.answers("show", card)
            json.loads(self.answers("simulate", card, "--json", "--time-step", "0.01", statuses=(0, 1)))
            result = run("rescale", card, "--radius", "9", "--packings", "0", "--out", f"{out}.json")
            self.assertIn(result.returncode, (0, 2), result.stderr)  # 2: grains that the apparatus does not take
            if result.returncode == 0:
                self.answers("show", f"{out}.json")
            for target in targets:  # 2: a target that lacks the law, or has no deck of the test
                result = run("export", "--unconfirmed", card, "--to", target, "--out", out / target)
                self.assertIn(result.returncode, (0, 2), result.stderr)
        self.each(shipped("cards"), look)

    def test_studies(self):
        def look(study, out):
            json.loads(self.answers("simulate", study, "--json", "--time-step", "0.01", *coarser(study), statuses=(0, 1)))
            result = run("calibrate", study, "--out", out, "--wall-budget", "1")
            self.assertIn(result.returncode, (0, 1), result.stderr)
            self.assertTrue((out / "evaluations.sqlite").exists())
            result = run("infer", study, "--from", out)
            self.assertIn(result.returncode, (0, 2), result.stderr)
        self.each(shipped("studies"), look)

    def test_laboratories_and_apparatus(self):
        def look(scene, out):
            answer = json.loads(self.answers("simulate", scene, "--json", "--time-step", "0.01", "--out", out, "--vtk", "0.05",
                                             *coarser(scene), statuses=(0, 1)))
            self.assertEqual(answer, json.loads((out / "outcome.json").read_text()))
        self.each(shipped("lab") + shipped("apparatus"), look)

    def test_applications(self):
        card = next(file for file in shipped("cards") if file.stem == "concrete-mix-79")

        def look(application, out):
            self.answers("export", "--unconfirmed", card, "--to", "liggghts", "--application", application.stem, "--out", out)
            result = run("kpi", out)
            self.assertEqual(result.returncode, 2)
            self.assertIn("has not been run", result.stderr)
        self.each(shipped("applications"), look)

    def test_an_application_is_not_replaced_by_its_own_export(self):
        card = next(file for file in shipped("cards") if file.stem == "concrete-mix-79")
        for file in (SOURCE / "data/applications").glob("chute.*"):
            shutil.copy(file, self.folder)
        (self.folder / "hopper").mkdir()  # a folder does not hide the machine of its name
        before = (self.folder / "chute.stl").read_text()
        common = ("export", "--unconfirmed", card, "--to", "liggghts", "--force")
        for words, complaint in (((self.folder / "chute.json", "--out", self.folder), "is the folder of the application"),
                                 (("", "--out", self.folder / "x"), "is empty"),
                                 (("a" * 5000, "--out", self.folder / "x"), "a")):
            result = run(*common, "--application", *words)
            self.assertEqual(result.returncode, 2, result.stderr[-300:])
            self.assertIn(complaint, result.stderr)
        self.assertEqual((self.folder / "chute.stl").read_text(), before)
        result = run(*common, "--application", "hopper", "--out", self.folder / "y", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_starting_files(self):
        help_text = " ".join(run("template", "--help").stdout.split())  # as lines are broken
        names = re.search(r"which one: (\w[\w-]*(?:, \w[\w-]*)*)", help_text)[1].split(", ")
        self.assertIn("lab", names)
        names = [name for name in names if not name.startswith("sheet")]  # to print, see test_workbooks.py
        for name in names:
            with self.subTest(name):
                (self.folder / f"{name}.json").write_text(self.answers("template", name))
        for name in names:
            with self.subTest(name):
                (self.folder / "lab.json").write_text((self.folder / f"{name.replace('study', 'lab')}.json").read_text())
                self.answers("simulate", self.folder / f"{name}.json", "--time-step", "0.01", statuses=(0, 1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
