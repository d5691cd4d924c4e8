"""What takes long says how far it is, and what would take too long, or cannot be kept, is refused before it begins.

usage: test_long_runs.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import time
import unittest

from desk import CARD, LAB, PROGRAM, APPARATUS, Desk, coarse_card, run


class Progress(Desk):
    def lines_of(self, *arguments, patience_s=120):
        """What is said on standard error by a command until it tells how far it is, and how long that took."""
        command = [PROGRAM, *map(str, arguments)]
        start = time.monotonic()
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            try:
                for line in process.stderr:
                    if re.match(r"\d+ of \d+ ", line) or time.monotonic() - start > patience_s:
                        return line, time.monotonic() - start
            finally:
                process.kill()
        return "", time.monotonic() - start

    def test_check_and_rescale_tell_how_many_simulations_are_done(self):
        card = json.loads(CARD.read_text())
        fifty = self.folder / "card.json"
        for test in card["tests"]:  # the same readings in many packings
            baseline = test["baseline"]
            baseline["packings"] = list(range(1, 51))
            baseline["readings"] = {name: (50 * column)[:50] for name, column in baseline["readings"].items()}
        fifty.write_text(json.dumps(card))
        line, after_s = self.lines_of("check", fifty, "--threads", 1)
        self.assertRegex(line, r"^\d+ of 50 simulations, \d+ s gone")
        self.assertLess(after_s, 60)  # a second or two, unless the machine is busy
        line, _ = self.lines_of("rescale", CARD, "--radius", 10, "--packings", 40, "--threads", 1)
        self.assertRegex(line, r"^\d+ of 80 simulations, \d+ s gone")

    def test_verify_tells_how_many_points_are_done(self):
        line, after_s = self.lines_of("verify")
        self.assertRegex(line, r"^\d+ of \d+ points, \d+ s gone.*left$")
        self.assertLess(after_s, 60)

    def test_an_impact_of_many_grains_says_within_seconds_how_far_it_is(self):
        grains = [{"radius_m": 0.001, "centre_m": [0.0025 * (i % 100), 0.0025 * (i // 100 % 100), 0.0025 * (i // 10000)],
                   "velocity_m_s": [0, 0, 0.01 * (i % 7)]} for i in range(20000)]
        impact = self.folder / "impact.json"
        impact.write_text(json.dumps({
            "format": "pastefit-impact-1", "contact": {"youngs_modulus_pa": 1e7, "poissons_ratio": 0.3},
            "density_kg_m3": 2500, "grains": grains, "duration_s": 0.5, "time_step": {"fixed_s": 5e-6}}))
        with subprocess.Popen([PROGRAM, "simulate", impact], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            said = process.stderr.read(1)
            ticks = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]
            used_s = sum(map(float, ticks)) / os.sysconf("SC_CLK_TCK")
            process.kill()
        self.assertTrue(said)
        self.assertLess(used_s, 5)  # of processor time: others use this machine, too

    def test_what_is_quiet_or_short_says_nothing(self):
        self.assertEqual(run("verify", "--quiet").stderr, "")
        self.assertEqual(run("verify", "free-fall").stderr, "")


class Limits(Desk):
    def test_more_than_a_day_is_refused_with_the_estimate_unless_it_is_forced(self):
        start = time.monotonic()
        tiny = ["--set", "grains.radius_mm=0.6", "--time-step", "1e-6"]
        said = self.fails_with_estimate(run("simulate", APPARATUS, *tiny, "--out", self.out))
        self.assertIn("grains", said)
        self.fails_with_estimate(run("simulate", APPARATUS, "--set", "grains.radius_mm=1", "--time-step", "1e-8"))
        lab = json.loads(LAB.read_text())
        study = self.study(budget=1_000_000)
        lab["grains"] = {"distribution": "mono", "radius_mm": 3}
        (self.folder / "lab.json").write_text(json.dumps(lab))
        self.fails_with_estimate(run("calibrate", study, "--out", self.out), "--wall-budget")
        self.fails_with_estimate(run("rescale", CARD, "--radius", "0.5", "--packings", "100", "--out", self.folder / "c"))
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
