"""Compares READMEs and manual with the source tree and the program, and runs the main README's example and the tutorial.
Numbers that a page shows as output must be those of the run; the wording is free.

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


def options_of(text):
    """Options that stand at the beginning of a line of help."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z0-9-]+)", text, re.M))


def first_cells(text):
    """Options that the first columns of a page's tables name."""
    return {option for row in re.findall(r"^\| (`--[^|]*)", text, re.M) for option in re.findall(r"`(--[a-z0-9-]+)", row)}


NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def missing(shown, printed):
    """Lines of a page's indented block whose numbers, in their order, no part of the output has."""
    have = f" {' '.join(NUMBER.findall(printed))} "
    return [line for line in shown.splitlines() if f" {' '.join(NUMBER.findall(line))} " not in have and NUMBER.search(line)]


def run(commands, folder):
    """Output and errors of commands of a page."""
    environment = dict(os.environ, PATH=f"{PROGRAM.parent}:{os.environ['PATH']}")
    result = subprocess.run(["sh", "-exc", commands], cwd=folder, env=environment, capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(result.stdout + result.stderr)
    return result.stdout + result.stderr


def gives_the_shown_bits():
    """Every instruction set that rounds once does."""
    return "SSE2" not in subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout


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
        verbs = sorted(re.findall(r"^  ([\w-]+) +\w", help_of().split("\nStart:")[1], re.M))
        self.assertEqual(verbs, sorted(re.search(r"pastefit ([\w-]+)", cells[0])[1] for cells in rows("verb")))
        page = (SOURCE / "calibrate/manual/options.md").read_text()
        for_all, *sections = re.split(r"^## pastefit ", page, flags=re.M)
        shared = first_cells(for_all)
        self.assertEqual(verbs, sorted(section.split("\n")[0] for section in sections))
        for section in sections:
            verb = section.split("\n")[0]
            options = options_of(help_of(verb).split("\nOptions:")[1])
            self.assertEqual(options - shared, first_cells(section) - shared, verb)

    def test_parameters_are_those_of_the_schema(self):
        schema = json.loads((SOURCE / "data/schema/study.schema.json").read_text())
        names = list(schema["properties"]["parameters"]["properties"])
        self.assertEqual([cells[0].strip("`") for cells in rows("name")], names)

    def test_search_options_are_those_of_the_schema(self):
        schema = json.loads((SOURCE / "data/schema/study.schema.json").read_text())
        options = schema["properties"]["search"]["properties"]
        headings = dict(re.findall(r"^### `(\w+)`: (.*)$", MANUAL, re.M))
        self.assertEqual(set(headings), set(options))
        for name, option in options.items():
            for default in re.findall(r"\bdefault (\d[\d.]*)", option["description"]):
                self.assertIn(f"default {default}", headings[name])

    def test_tests_are_those_of_laboratory_files(self):
        schema = json.loads((SOURCE / "data/schema/lab.schema.json").read_text())
        self.assertEqual([cells[0].strip("`") for cells in rows("test")], schema["properties"]["test"]["enum"])

    def test_readings_are_those_of_laboratory_files(self):
        # The schema is held against the program's table by a test of its own (tests/calibrate/study/test_study.cpp).
        schema = json.loads((SOURCE / "data/schema/lab.schema.json").read_text())
        keys = set(schema["properties"]["measurements"]["properties"])
        told = {f"{stage}.{name}" for cells in rows("reading") for name in re.findall(r"`(\w+)`", cells[0])
                for stage in re.findall(r"`(\w+)`", cells[1])}
        told |= {key for cells in rows("test") for key in re.findall(r"`(\w+\.\w+)`", cells[-1])}
        self.assertEqual(told, keys)

    def test_the_example_does_what_it_says(self):
        commands = "\n".join(re.findall(r"```sh\n(.*?)```", README, re.S))
        with tempfile.TemporaryDirectory(prefix="pastefit-readme-") as folder:
            printed = run(commands, folder)
            card = json.loads((pathlib.Path(folder) / "my-paste/out/card.json").read_text())
            print(card["confirmation"])
            if gives_the_shown_bits():
                shown = [block for block in re.findall(r"^((?:    .*\n)+)", README, re.M) if "step1." in block]
                self.assertEqual(missing("\n".join(shown), printed), [])
            for file in ("card.json", "summary.txt", "evaluations.sqlite", "report.html"):
                self.assertTrue((pathlib.Path(folder) / "my-paste/out" / file).exists(), file)
            self.assertTrue((pathlib.Path(folder) / "my-paste/film/grains.pvd").exists())

    def test_the_tutorial_shows_what_its_commands_print(self):
        page = (SOURCE / "calibrate/manual/tutorial.md").read_text()
        with tempfile.TemporaryDirectory(prefix="pastefit-tutorial-") as folder:
            for commands, rest in re.findall(r"```sh\n(.*?)```\n(.*?)(?=```sh|\Z)", page, re.S):
                printed = run(commands, folder)
                if "--to lammps" in commands or not gives_the_shown_bits():
                    continue  # what follows is printed by LAMMPS, too
                shown = "".join(re.findall(r"^((?: {4}.*\n)+)", rest, re.M))
                with self.subTest(commands):
                    self.assertEqual(missing(shown, printed + (pathlib.Path(folder) / "mix-57/study.json").read_text()), [])
            if gives_the_shown_bits():  # and the page that explains the same summary
                page = (SOURCE / "calibrate/manual/result.md").read_text()
                summary = (pathlib.Path(folder) / "mix-57/out/summary.txt").read_text()
                shown = "".join(re.findall(r"^((?: {4}.*\n)+)", page.split("\n## ")[1], re.M))
                self.assertEqual(missing(shown, summary), [])


# Files that the text speaks of, but that come into being elsewhere, and words with a slash that are no files.
NAMED_OTHERWISE = {"card.json", "summary.txt", "evaluations.sqlite", "views.json", "lab.json", "study.json", "NOTES.txt",
                   "material.py", "edem.txt", "edem_material.py", "my-chute.json", "cone/step1.height_mm"}
MADE = ("build/", "out/", "share/", "mortar/", "paste/")

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
