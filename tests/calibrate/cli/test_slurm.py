"""Many studies as an array job of Slurm, on this machine. Skipped (status 77) without Slurm. PASTEFIT_SLURM_STUDIES sets the
number of studies (default: the four of the gate).

usage: test_slurm.py PROGRAM SOURCE_DIR [unittest options]
"""

import contextlib
import csv
import os
import signal
import subprocess
import sys
import time
import unittest

from batches import parent_of, process_of, write_studies
from desk import Desk, run, size_of
from slurm import Slurm, missing

STUDIES = int(os.environ.get("PASTEFIT_SLURM_STUDIES", "4"))


class ArrayJob(Desk):
    def setUp(self):
        super().setUp()
        self.slurm = Slurm(self.folder / "slurm")
        self.addCleanup(self.slurm.stop)
        if not self.slurm.start():
            self.skipTest("Slurm does not start here: " + (self.folder / "slurm/slurmctld.txt").read_text()[-500:])

    def calibration_of(self, study):
        """The calibrating process of a study and its driver, where something is in the store."""
        folder = self.out / study
        return process_of("calibrate", str(folder)) if size_of(folder / "evaluations.sqlite-wal") > 30000 else None

    def submit(self, studies):
        written = run("batch", *studies, "--out", self.out, "--slurm", "--workers", "1")
        self.assertEqual(written.returncode, 0, written.stderr)
        submitted = self.slurm.run("sh", "-c", written.stdout)
        self.assertIn("Submitted batch job", submitted.stdout, submitted.stderr)

    def disturb(self, studies):
        """Disturbs the first three calibrations, in whichever order they run. Whether none of them was over before."""
        left = {studies[0].stem: lambda worker, driver: os.kill(worker, signal.SIGKILL),
                studies[1].stem: lambda worker, driver: os.kill(driver, signal.SIGKILL),
                # the script of the element, as before the time limit
                studies[2].stem: lambda worker, driver: os.kill(parent_of(driver), signal.SIGUSR1)}
        deadline = time.monotonic() + 120
        while left and not any((self.out / study / "card.json").exists() for study in left):
            self.assertLess(time.monotonic(), deadline, f"{list(left)} do not run: {self.slurm.jobs()}")
            for study in list(left):
                with contextlib.suppress(OSError):  # of a process that ends
                    if found := self.calibration_of(study):
                        left[study](*found)
                        del left[study]
                        deadline = time.monotonic() + 120
            time.sleep(0.02)
        return not left

    def test_elements_that_are_killed_or_out_of_time_go_on_and_end_with_the_cards_of_plain_runs(self):
        studies = write_studies(self.folder, STUDIES)
        for attempt in range(5):  # where the machine stalls, a calibration may be over before it was disturbed
            self.out = self.folder / f"a job {attempt}"
            self.submit(studies)
            if self.disturb(studies):
                break
            self.slurm.run("scancel", f"--user={os.getuid()}")
        else:
            self.fail("calibrations were over before they were disturbed")

        plain = self.folder / "plain"
        for study in studies:
            self.calibrates(study, "--threads", "1", "--quiet", out=plain / study.stem)
        while jobs := self.slurm.jobs():
            self.slurm.waits_no_longer()
            time.sleep(0.5)

        said = [(self.out / f"slurm-{k}.txt").read_text() for k in range(3)]
        self.assertIn("was killed by signal 9", said[0])
        self.assertIn("pastefit was killed (status 137)", said[1])
        self.assertIn("the time is up", said[2])
        for study in studies:
            with self.subTest(study.stem):
                self.assertEqual((self.out / study.stem / "card.json").read_bytes(),
                                 (plain / study.stem / "card.json").read_bytes())
        with (self.out / "batch.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["study"] for row in rows], [study.stem for study in studies])
        self.assertTrue((self.out / "batch.html").exists())


if __name__ == "__main__":
    if name := missing():
        print(f"skipped: there is no {name} (.ci/packages-checks.txt)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
