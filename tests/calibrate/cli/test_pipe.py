"""Every kind of laboratory test through the whole program, from its starting files to an export.

usage: test_pipe.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import re
import shutil
import subprocess
import sys
import unittest

import jsonschema
from desk import SOURCE, Desk, run
import schemas

LAWS = ("edem-notes", "csv", "mercurydpm")  # the first has every law
DECKS = {"lammps": ("in.two_grains", ("lmp_pastefit", "-log", "none", "-in")),  # run where somebody built it
         "liggghts": ("in.two_grains", ("liggghts", "-log", "none", "-in")),
         "yade": ("two_grains.py", ("yade", "-j1", "-n", "-x"))}
FEW = {"screening": 6, "budget_simulations": 24, "packings": 1, "confirmation_packings": 2, "examination_simulations": 4,
       "rejected_share": 1}


def template(name):
    text = run("template", name).stdout
    return json.loads(re.sub(r"(^|\s)//.*$", "", text, flags=re.M))


def schema(name):
    return schemas.schema(SOURCE / "data", name)


def kinds():
    return schema("lab")["properties"]["test"]["enum"]


def is_slump(kind):
    return kind == kinds()[0]


class Pipe(Desk):
    def done(self, *arguments):
        result = run(*arguments)
        self.assertEqual(result.returncode, 0, f"{arguments}\n{result.stdout}{result.stderr}")
        self.assertNotRegex(result.stdout + result.stderr, r"\bnan\b|\binf\b")
        return result.stdout

    def calibrated(self, *arguments):
        """A calibration of a few simulations, confirmed or not."""
        result = run("calibrate", *arguments)
        self.assertIn(result.returncode, (0, 1), f"{arguments}\n{result.stdout}{result.stderr}")
        self.assertIn("card.json", result.stderr)
        return result.stdout

    def write(self, kind):
        """The starting files of the kind, with a search of a few simulations, and coarse grains if it pours any."""
        word = "" if is_slump(kind) else kind + "-"
        lab, study = template(word + "lab"), template(word + "study")
        if is_slump(kind):
            lab["grains"] = {"distribution": "mono", "radius_mm": 14}
        if kind == "pellet":
            lab["grains"] = {"distribution": "mono", "radius_mm": 1.8}
        if kind == "shear":
            lab["grains"] = {"distribution": "mono", "radius_mm": 1.05}
            lab["apparatus"]["final_displacement_mm"] = 2
        jsonschema.validate(lab, schema("lab"))
        study["search"].update(FEW)
        jsonschema.validate(study, schema("study"))
        (self.folder / "lab.json").write_text(json.dumps(lab))
        (self.folder / "study.json").write_text(json.dumps(study))
        return self.folder / "study.json"

    def test_every_kind_of_test_goes_through_the_pipe(self):
        for kind in kinds():
            with self.subTest(kind):
                out = self.folder / kind
                self.calibrated(self.write(kind), "--out", out)
                card = out / "card.json"
                document = json.loads(card.read_text())
                jsonschema.validate(document, schema("card"))
                self.assertTrue(document["tests"][0]["baseline"]["readings"])
                self.assertIn(document["title"], self.done("show", card))
                self.assertIn("agrees", self.done("check", card))
                again = json.loads(self.done("simulate", card, "--json", "--out", out / "film", "--vtk", "0.25"))
                readings = document["tests"][0]["baseline"]["readings"]
                self.assertEqual({name: values[0] for name, values in readings.items()}, again["observables"])
                self.assertTrue((out / "film/grains.pvd").exists())
                sticks = json.loads((self.folder / "study.json").read_text())["contact"].get("normal") == "jkr"
                for target in LAWS[:1] if sticks else LAWS:
                    self.done("export", "--unconfirmed", card, "--to", target, "--out", out / target)
                    self.assertIn("\nname,value,meaning\n", "\n" + (out / target / "parameters.csv").read_text())
                self.check_deck(kind, out)
                self.assertEqual((out / LAWS[0] / "grains.csv").exists(), is_slump(kind))
                self.assertEqual((out / "film/curve.csv").exists(), kind in ("pellet", "shear"))
                self.assertEqual((out / "curve.csv").exists(), kind in ("pellet", "shear"))
                if (out / "curve.csv").exists():
                    self.check_curve(out / "curve.csv", document["tests"][0])
                resumed = self.calibrated(self.folder / "study.json", "--out", out, "--resume")
                self.assertEqual(json.loads(card.read_text()), document, resumed)

    def check_curve(self, file, test):
        """Mean and range of the packings, beside what the laboratory measured in the same unit."""
        header, *rows = [line.split(",") for line in file.read_text().splitlines()]
        self.assertEqual(header[1:4], ["stress_pa", "stress_pa_lowest", "stress_pa_highest"])
        in_pascal = {name: one for name, one in test["readings"].items()
                     if name.endswith("_pa") and one.get("measured") is not None}
        self.assertEqual(header[4:], [word for name in in_pascal for word in (name, name + "_deviation")])
        self.assertGreater(len(in_pascal), 0)
        self.assertGreater(len(rows), 20)
        for row in rows:
            x, mean, lowest, highest, *laboratory = map(float, row)
            self.assertLessEqual(lowest, mean + 1e-6 * abs(mean))
            self.assertLessEqual(mean, highest + 1e-6 * abs(mean))
            for value, one in zip(laboratory[::2], in_pascal.values()):
                self.assertAlmostEqual(value, one["measured"], delta=1e-5 * abs(value))
        self.assertTrue(any(float(row[2]) < float(row[3]) for row in rows))

    def check_deck(self, kind, out):
        """Of a slump test a deck of it is written; of others two grains and what is lost, which the program then runs."""
        for target, (script, command) in DECKS.items():
            text = self.done("export", "--unconfirmed", out / "card.json", "--to", target, "--out", out / "deck" / target)
            files = {file.name for file in (out / "deck" / target).iterdir()}
            self.assertIn(script, files)
            material = "material.py" if target == "yade" else "material.inc"
            self.assertIn(material, files)
            self.assertIn(material.split(".")[0], (out / "deck" / target / script).read_text())
            self.assertEqual("in.slump" in files or "slump.py" in files, is_slump(kind))
            self.assertIn("contact laws are exported" if kind == "drop" and target != "lammps" else "What is lost or changed", text)
            if is_slump(kind) or not shutil.which(command[0]):
                continue
            run_of_deck = subprocess.run([*command, script], cwd=out / "deck" / target, capture_output=True, text=True,
                                         timeout=300)
            apart = [line for line in run_of_deck.stdout.splitlines() if line.startswith("apart ")]
            self.assertGreater(len(apart), 200, f"{target}\n{run_of_deck.stdout[-2000:]}{run_of_deck.stderr[-2000:]}")

    def test_readings_of_another_kind_are_refused_in_one_message(self):
        of_kind = {}
        for kind in kinds():
            of_kind[kind] = template(("" if is_slump(kind) else kind + "-") + "lab")
        for kind in kinds():
            for other in set(kinds()) - {kind}:
                with self.subTest(f"{kind} with readings of {other}"):
                    file = self.folder / "strange.json"
                    file.write_text(json.dumps(dict(of_kind[kind], measurements=of_kind[other]["measurements"])))
                    result = run("simulate", file)
                    self.assertEqual(result.returncode, 2)
                    self.assertEqual(len(re.findall("measurements", result.stderr)), 1, result.stderr)
                    for words in (f"a {kind} test has no", f"readings of a {other} test"):
                        self.assertIn(words, result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
