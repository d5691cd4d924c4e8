"""Holds the READMEs against the tree and the program, and runs the example of the main one.

usage: check_readme.py PROGRAM SOURCE_DIR
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
README = (SOURCE / "README.md").read_text()
MANUAL = "\n\n".join(page.read_text() for page in sorted((SOURCE / "calibrate/manual").glob("*.md")))
PAGES = [*SOURCE.glob("**/README.md"), *SOURCE.glob("calibrate/manual/*.md"), *SOURCE.glob("tests/results/*.md")]
READMES = [file for file in dict.fromkeys(PAGES) if not {"build", "out", "node_modules"} & set(file.relative_to(SOURCE).parts)]


def help_of(*verb):
    return subprocess.run([PROGRAM, *verb, "--help"], capture_output=True, text=True, check=True).stdout


def rows(first_column):
    """Rows of the manual's table with this first column, as lists of cells."""
    head = re.search(rf"^\| {first_column} \|.*\n\|---", MANUAL, re.M)
    table = MANUAL[head.start():].split("\n\n", 1)[0].splitlines()[2:]
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in table]


class Readme(unittest.TestCase):
    def test_the_two_commands_are_there(self):
        for command in re.findall(r"\.ci/\w+\b(?!\.)", README):
            self.assertTrue(os.access(SOURCE / command, os.X_OK), command)

    def test_files_and_folders_that_are_named_exist(self):
        for readme in READMES:
            text = readme.read_text()
            places = re.findall(r"\]\(([\w./-]+)\)", text)
            places += re.findall(r"`((?:\w+/)+[\w.]*|(?:[\w-]+/)*[\w-]+\.(?:h|cpp|py|md|json|txt))`", text, re.A)
            for place in places:
                if place.startswith(MADE) or place in NAMED_OTHERWISE or "NN" in place or re.match(r"\d", place):
                    continue
                tries = [folder / place for folder in readme.parents if SOURCE in (folder, *folder.parents)]
                with self.subTest(readme=str(readme.relative_to(SOURCE)), place=place):
                    self.assertTrue(any(path.exists() for path in tries))

    def test_verbs_and_options_are_those_of_the_program(self):
        verbs = re.findall(r"^  ([\w-]+) +\w", help_of().split("\nStart:")[1], re.M)
        told = {re.search(r"pastefit ([\w-]+)", cells[0]).group(1): cells[1] for cells in rows("verb")}
        self.assertEqual(sorted(verbs), sorted(told))
        for verb, text in told.items():
            options = set(re.findall(r"--[a-z-]+", help_of(verb))) - {"--help", "--quiet"}
            named = set(re.findall(r"--[a-z-]+", text + " ".join(row[0] for row in rows("verb") if verb in row[0])))
            self.assertEqual(options, named, verb)

    def test_parameters_are_those_of_the_schema(self):
        schema = json.loads((SOURCE / "data/schema/study.schema.json").read_text())
        names = list(schema["properties"]["parameters"]["properties"])
        self.assertEqual([cells[0].strip("`") for cells in rows("name")], names)

    def test_tests_are_those_of_laboratory_files(self):
        schema = json.loads((SOURCE / "data/schema/lab.schema.json").read_text())
        self.assertEqual([cells[0].strip("`") for cells in rows("test")], schema["properties"]["test"]["enum"])

    def test_readings_are_those_of_laboratory_files(self):
        # The schema is held against the program's table by a test of its own (tests/calibrate/study/test_study.cpp).
        schema = json.loads((SOURCE / "data/schema/lab.schema.json").read_text())
        keys = set(schema["properties"]["measurements"]["properties"])
        told = set()
        for cells in rows("reading"):
            for name in re.findall(r"`(\w+)`", cells[0]):
                steps = [step for step in ("step1", "step2") if f"{step}.{name}" in keys]
                self.assertTrue(steps, f"{name} is no reading of a laboratory file")
                self.assertEqual("step 1 only" in cells[1], steps == ["step1"], name)
                self.assertEqual(cells[1].startswith("step 2"), steps == ["step2"], name)
                told |= {f"{step}.{name}" for step in steps}
        for line in re.findall(r"In a laboratory file: (.*)", MANUAL):
            told |= set(re.findall(r"`(\w+\.\w+)`", line))
        told |= {key for cells in rows("test") for key in re.findall(r"`(\w+\.\w+)`", cells[-1])}
        self.assertEqual(told, keys)

    def test_the_example_does_what_it_says(self):
        commands = "\n".join(re.findall(r"```sh\n(.*?)```", README, re.S))
        with tempfile.TemporaryDirectory(prefix="pastefit-readme-") as folder:
            environment = dict(os.environ, PATH=f"{PROGRAM.parent}:{os.environ['PATH']}")
            result = subprocess.run(["sh", "-exc", commands], cwd=folder, env=environment, capture_output=True,
                                    text=True)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            verdict = re.search(r"^The material (meets|does not meet) the laboratory[:,] .*$", result.stdout, re.M)
            self.assertIsNotNone(verdict, result.stdout)
            print(verdict.group(0))
            # The sample is what the command gives, with every instruction set that rounds once.
            sample = re.search(r"a summary\s+\(shortened\):\n\n((?:    .*\n)+)", README)[1]
            plain = " ".join(result.stdout.split())
            if "SSE2" not in subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout:
                for line in sample.splitlines():
                    self.assertIn(" ".join(line.split()), plain)
            for file in ("card.json", "summary.txt", "evaluations.sqlite", "report.html"):
                self.assertTrue((pathlib.Path(folder) / "my-paste/out" / file).exists(), file)
            self.assertTrue((pathlib.Path(folder) / "my-paste/film/grains.pvd").exists())


# Files that the text speaks of, but that come into being elsewhere, and words with a slash that are no files.
NAMED_OTHERWISE = {"card.json", "summary.txt", "evaluations.sqlite", "views.json", "lab.json", "study.json", "NOTES.txt",
                   "material.py", "edem.txt", "cone/step1.height_mm"}
MADE = ("build/", "out/", "share/", "mortar/", "paste/")

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
