"""Runs the commands of the manual (calibrate/manual): every block marked sh, page by page, in a folder with the shipped
studies, laboratory files and cards. Calibrations are limited to a few simulations of coarse grains, and may end unconfirmed.

usage: check_manual.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PAGES = {page.name: page.read_text() for page in sorted((SOURCE / "calibrate/manual").glob("*.md"))}
BLOCK = re.compile(r"^( *)```sh\n(.*?)^\1```$", re.M | re.S)
OTHER_PROGRAMS = ("cd ", "(cd ", "./lmp_pastefit", "pastefit read ", "pastefit kpi ")  # of a deck that has run elsewhere
PLACEHOLDER = re.compile(r"\b[A-Z]{3,}\b")


def commands(page):
    """Lines of the page's blocks."""
    return [line.strip() for _, block in BLOCK.findall(page) for line in block.splitlines() if line.strip()]


def cut_short(command):
    """What a test runs in place of a calibration: the same of fewer and larger grains, with a handful of simulations."""
    if command.startswith("pastefit export "):
        return f"{command} --unconfirmed"  # as a card of so few simulations is
    if not re.match("pastefit (calibrate|batch) ", command):
        return command
    shrunk = [f"{sys.executable} {pathlib.Path(__file__).resolve()} --shrink {study}" for study in re.findall(r"\S+\.json", command)]
    return "\n".join([*shrunk, f"{command} || test $? = 1"])


def shrink(study):
    """Changes a study and its laboratory file so that a calibration takes seconds."""
    def change(path, edit):
        document = json.loads(re.sub(r"(^|\s)//.*$", "", path.read_text(), flags=re.M))
        edit(document)
        path.write_text(json.dumps(document))

    def coarser(lab):
        lab["grains"] |= {key: 1.6 * value for key, value in lab["grains"].items() if key.endswith("_mm")}

    search = {"screening": 2, "budget_simulations": 6, "packings": 1, "confirmation_packings": 2,
              "examination_simulations": 0, "coarse_first": False}
    change(study, lambda document: document.setdefault("search", {}).update(search))
    change(study.parent / "lab.json", coarser)


class Manual(unittest.TestCase):
    def test_every_command_of_a_page_does_what_it_says(self):
        for name, page in PAGES.items():
            if not commands(page):
                continue
            with self.subTest(page=name), tempfile.TemporaryDirectory(prefix="pastefit-manual-") as folder:
                for data in ("studies", "lab", "cards"):
                    shutil.copytree(SOURCE / "data" / data, pathlib.Path(folder) / data)
                environment = dict(os.environ, PATH=f"{PROGRAM.parent}:{os.environ['PATH']}")
                result = subprocess.run(["sh", "-exc", "\n".join(map(cut_short, commands(page)))], cwd=folder,
                                        env=environment, capture_output=True, text=True)
                self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_commands_are_marked_to_be_run(self):
        """An indented line that calls the program is the output of one, has a placeholder, or needs another program."""
        for name, page in PAGES.items():
            for line in re.findall(r"^ {4}(\S.*)$", BLOCK.sub("", page), re.M):
                if line.startswith(("pastefit ", "cd ", "(cd ", "./")):
                    with self.subTest(page=name, line=line):
                        self.assertTrue(line.startswith(OTHER_PROGRAMS) or PLACEHOLDER.search(line))


if __name__ == "__main__":
    if sys.argv[1] == "--shrink":
        sys.exit(shrink(pathlib.Path(sys.argv[2])))
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
