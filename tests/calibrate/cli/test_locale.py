"""In locales with a decimal comma, or with a dotted capital I, every file is read and written the same.

usage: test_locale.py PROGRAM SOURCE_DIR [unittest options]
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from desk import CARD, coarse_card, LAB, STUDY, Desk, run

LOCALES = ("de_DE", "tr_TR")


class Locale(Desk):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("localedef") or not pathlib.Path("/usr/share/i18n/locales/tr_TR").exists():
            raise unittest.SkipTest("the Debian package locales is not installed")
        cls.made = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-locale-"))
        cls.addClassCleanup(shutil.rmtree, cls.made)
        for name in LOCALES:
            subprocess.run(["localedef", "-i", name, "-f", "UTF-8", cls.made / f"{name}.UTF-8"], check=True,
                           capture_output=True)

    def surroundings(self, name):
        return {**os.environ, "LOCPATH": str(self.made), "LC_ALL": f"{name}.UTF-8", "LANG": f"{name}.UTF-8"}

    def test_the_locales_of_this_test_are_at_work(self):
        for name in LOCALES:
            half = subprocess.run(["awk", "BEGIN { printf(\"%.1f\", 0.5) }"], env=self.surroundings(name),
                                  capture_output=True, text=True)
            python = subprocess.run([sys.executable, "-c", "import locale; locale.setlocale(locale.LC_ALL, ''); "
                                     "print(locale.format_string('%.1f', 0.5))"], env=self.surroundings(name),
                                    capture_output=True, text=True)
            self.assertIn("0,5", half.stdout + python.stdout, half.stderr + python.stderr)

    def everything(self, out, **options):
        """What the verbs print and write."""
        small = self.study(budget=4, screening=2, radius_mm=14)
        coarse = ["--set", "grains.radius_mm=14.5"]
        answers = [run(*command, **options) for command in
                   (["simulate", LAB, *coarse, "--seed", "3", "--set", "parameters.friction=0.25"],
                    ["calibrate", small, "--out", out / "calibration", "--threads", "1"],
                    ["show", CARD], ["verify", "free-fall", "chung-ooi-1"],
                    ["rescale", CARD, "--radius", "9.5", "--packings", "0", "--out", out / "rescaled.json"],
                    *(["export", "--unconfirmed", coarse_card(), "--to", target, "--out", out / target]
                      for target in ("lammps", "liggghts", "yade", "csv")))]
        for answer in answers:
            self.assertIn(answer.returncode, (0, 1), answer.stderr)
        files = {file.relative_to(out): file.read_bytes() for file in sorted(out.rglob("*"))
                 if file.is_file() and file.suffix not in (".sqlite", ".html")}
        self.assertIn(pathlib.Path("calibration/card.json"), files)
        return files, [answers[k].stdout for k in (2, 3, 4)]  # what holds no path and no time

    def test_every_file_reads_and_writes_the_same(self):
        out = self.folder / "plain"
        out.mkdir()
        plain = self.everything(out, env={**os.environ, "LC_ALL": "C.UTF-8"})
        for name in LOCALES:
            with self.subTest(name):
                other = self.folder / name
                other.mkdir()
                there = self.everything(other, env=self.surroundings(name))
                self.assertEqual(plain[0].keys(), there[0].keys())
                for file, content in plain[0].items():
                    self.assertEqual(content, there[0][file], file)
                self.assertEqual(plain[1:], there[1:])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
