"""Many studies as an array job of Slurm, on this machine. Skipped (status 77) without Slurm. PASTEFIT_SLURM_STUDIES sets the
number of studies (default: the four of the gate).

usage: test_slurm.py PROGRAM SOURCE_DIR [unittest options]
"""

import csv
import os
import signal
import subprocess
import sys
import time
import unittest

from batches import parent_of, process_of, write_studies
from desk import Desk, run
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
        """The calibrating process of a study and its driver, once something is in the store."""
        folder = self.out / study
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline:
            store = folder / "evaluations.sqlite-wal"
            if store.exists() and store.stat().st_size > 30000 and (found := process_of("calibrate", str(folder))):
                return found
            time.sleep(0.02)
        self.fail(f"{study} does not run: {self.slurm.jobs()}")

    def test_elements_that_are_killed_or_out_of_time_go_on_and_end_with_the_cards_of_plain_runs(self):
        studies = write_studies(self.folder, STUDIES)
        self.out = self.folder / "a job"
        written = run("batch", *studies, "--out", self.out, "--slurm", "--workers", "1")
        self.assertEqual(written.returncode, 0, written.stderr)
        submitted = self.slurm.run("sh", "-c", written.stdout)
        self.assertIn("Submitted batch job", submitted.stdout, submitted.stderr)

        worker, _ = self.calibration_of(studies[0].stem)
        os.kill(worker, signal.SIGKILL)
        _, driver = self.calibration_of(studies[1].stem)
        os.kill(driver, signal.SIGKILL)
        _, driver = self.calibration_of(studies[2].stem)
        os.kill(parent_of(driver), signal.SIGUSR1)  # the script of the element, as before the time limit

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
