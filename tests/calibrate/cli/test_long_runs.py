"""Long runs report their progress; runs that would take too long, or whose results cannot be stored, are refused at the start.

usage: test_long_runs.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import os
import re
import select
import signal
import subprocess
import sys
import time
import unittest

from desk import APPARATUS, CARD, LAB, PROGRAM, SOURCE, STUDY, Desk, coarse_card, run, used_s


def many_packings(folder):
    """The shipped card with a baseline of the same readings in fifty packings."""
    card = json.loads(CARD.read_text())
    for test in card["tests"]:
        baseline = test["baseline"]
        baseline["packings"] = list(range(1, 51))
        baseline["readings"] = {name: (50 * column)[:50] for name, column in baseline["readings"].items()}
    (folder / "fifty.json").write_text(json.dumps(card))
    return folder / "fifty.json"


class Progress(Desk):
    def said_by(self, *arguments, pattern=""):
        """The lines on standard error of a command until two of the pattern, and the longest time without a line, in
        processor seconds."""
        lines, last_s, longest_s = [], 0.0, 0.0
        command = [PROGRAM, *map(str, arguments)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, bufsize=0) as process:
            try:
                while sum(bool(re.search(pattern, line)) for line in lines) < 2 and longest_s < 20:
                    is_ready, _, _ = select.select([process.stderr], [], [], 0.2)
                    now_s = used_s(process)
                    longest_s = max(longest_s, now_s - last_s)
                    if not is_ready:
                        continue
                    line = process.stderr.readline().decode()
                    if not line:
                        break
                    lines.append(line)
                    last_s = now_s
            finally:
                process.kill()
        return lines, longest_s

    def fine_card(self):
        """The shipped card with grains so small that its mould takes a while to fill, and so few that this stops at once."""
        card = self.folder / "fine.json"
        self.assertEqual(run("rescale", CARD, "--radius", "2.6", "--packings", "0", "--out", card).returncode, 0)
        return card

    def test_no_verb_runs_longer_than_five_seconds_without_a_line(self):
        cases = sorted((SOURCE / "tests/cases").glob("*.json"))
        for words, pattern in (
                (["simulate", APPARATUS, "--set", "grains.radius_mm=3"], r"\d"),
                (["simulate", SOURCE / "data/studies/wheat-repose.json"], r"\d"),
                (["calibrate", SOURCE / "data/studies/shear-karkala.json", "--out", self.out, "--threads", 1], r"\d+ of \d+ simulations"),
                (["batch", STUDY, "--out", self.folder / "batch", "--workers", 1], r"\d"),
                (["check", many_packings(self.folder), "--threads", 1], r"^\d+ of 50 simulations, \d+ s gone"),
                (["rescale", CARD, "--radius", 8, "--packings", 40, "--threads", 1, "--out", self.folder / "card.json"],
                 r"^\d+ of 80 simulations, \d+ s gone"),
                (["export", self.fine_card(), "--to", "csv", "--unconfirmed", "--out", self.folder / "csv"], r"^fill\.\w+ .* gone"),
                (["confirm", CARD, "--radius", "2.6", "--program", "/bin/true", "--out", self.folder / "new.json"],
                 r"^fill\.\w+ .* gone"),
                (["verify", *10 * cases], r"^\d+ of \d+ points, \d+ s gone.*left$")):
            with self.subTest(words[0]):
                lines, longest_s = self.said_by(*words, pattern=pattern)
                self.assertTrue([line for line in lines if re.search(pattern, line)], lines)
                self.assertLess(longest_s, 5)

    def test_a_confirmation_that_fills_its_mould_can_be_interrupted_and_says_what_it_takes(self):
        command = [PROGRAM, "confirm", str(CARD), "--radius", "2", "--program", "/bin/true", "--out", str(self.folder / "new.json")]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            self.assertRegex(process.stderr.readline(), r"4 packings, each of \d+ (s|min|h) of a core or more")
            time.sleep(1)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=20)[1]
        self.assertIn("interrupted", said)
        self.assertEqual(process.returncode, 1)
        self.assertFalse((self.folder / "new.json").exists())

    def test_an_impact_of_many_grains_says_within_seconds_how_far_it_is(self):
        grains = [{"radius_m": 0.001, "centre_m": [0.0025 * (i % 100), 0.0025 * (i // 100 % 100), 0.0025 * (i // 10000)],
                   "velocity_m_s": [0, 0, 0.01 * (i % 7)]} for i in range(20000)]
        impact = self.folder / "impact.json"
        impact.write_text(json.dumps({
            "format": "pastefit-impact-1", "contact": {"youngs_modulus_pa": 1e7, "poissons_ratio": 0.3},
            "density_kg_m3": 2500, "grains": grains, "duration_s": 0.5, "time_step": {"fixed_s": 5e-6}}))
        lines, longest_s = self.said_by("simulate", impact)
        self.assertTrue(lines)
        self.assertLess(longest_s, 5)

    def test_what_is_quiet_or_short_says_nothing(self):
        self.assertEqual(run("verify", "--quiet").stderr, "")
        for _ in range(5):
            start = time.monotonic()
            said = run("verify", "free-fall").stderr
            if time.monotonic() - start < 2:  # else it was not short, as on a machine that stalls
                break
        self.assertEqual(said, "")


class Limits(Desk):
    def test_more_than_a_day_is_refused_with_the_estimate_unless_it_is_forced(self):
        start = time.monotonic()
        tiny = ["--set", "grains.radius_mm=1", "--time-step", "1e-7"]  # so small that they take a gigabyte, and no more
        said = self.fails_with_estimate(run("simulate", APPARATUS, *tiny, "--out", self.out))
        self.assertIn("grains", said)
        self.fails_with_estimate(run("simulate", APPARATUS, "--set", "grains.radius_mm=1", "--time-step", "1e-8"))
        lab = json.loads(LAB.read_text())
        study = self.study(budget=1_000_000)
        lab["grains"] = {"distribution": "mono", "radius_mm": 3}
        (self.folder / "lab.json").write_text(json.dumps(lab))
        self.fails_with_estimate(run("calibrate", study, "--out", self.out), "--wall-budget")
        self.fails_with_estimate(run("rescale", CARD, "--radius", "1", "--packings", "100", "--threads", "1", "--out", self.folder / "c"))
        self.assertLess(time.monotonic() - start, 60)
        self.assertEqual(sorted(os.listdir(self.folder)), ["lab.json", "study.json"])
        # What is asked for goes on, and is stopped here.
        command = [PROGRAM, "simulate", str(APPARATUS), "--set", "grains.radius_mm=1", "--time-step", "1e-8", "--force"]
        with self.assertRaises(subprocess.TimeoutExpired):
            subprocess.run(command, capture_output=True, timeout=5)

    def fails_with_estimate(self, result, *words):
        self.fails(result, 2, "take at least", "--force", *words)
        self.assertRegex(result.stderr, r"at least (\d+ (h|days)|years)\b")
        return result.stderr

    def test_pictures_beyond_the_room_of_the_disk_are_refused_with_the_estimate(self):
        result = run("simulate", APPARATUS, "--set", "grains.radius_mm=4", "--time-step", "1e-7", "--vtk", "1e-9", "--out",
                     self.out)
        self.fails(result, 2, "--vtk", "pictures take", "GB free", "--force")
        self.assertFalse(self.out.exists())

    def test_a_target_that_cannot_be_written_is_noticed_before_anything_is_simulated(self):
        self.out.write_text("a file")
        nowhere = self.folder / "nowhere" / "file"
        for verb in (["simulate", APPARATUS, "--out", self.out], ["simulate", APPARATUS, "--checkpoint", nowhere],
                     ["calibrate", self.study(), "--out", self.out / "x"],
                     ["rescale", CARD, "--radius", 4, "--out", nowhere], ["check", CARD, "--junit", nowhere],
                     ["export", "--unconfirmed", coarse_card(), "--to", "lammps", "--out", self.out / "x"]):
            with self.subTest(verb[0]):
                start = time.monotonic()
                self.fails(run(*verb), 2, str(verb[-1]))
                self.assertLess(time.monotonic() - start, 10)
        link = self.folder / "link.json"
        link.symlink_to(coarse_card())
        start = time.monotonic()
        self.fails(run("check", link, "--rebaseline", "--why", "a test"), 2, "symbolic link")
        self.assertLess(time.monotonic() - start, 10)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
