"""A simulation that is stopped or killed goes on from its checkpoint, as if nothing had been.

usage: test_checkpoint.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import signal
import subprocess
import sys
import time
import unittest

from desk import PROGRAM, RIG, Desk, run


class Checkpoint(Desk):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "run.checkpoint"
        self.lab = self.folder / "lab.json"
        self.lab.write_text(run("template", "pellet-lab").stdout)
        self.settings = ["--set", "grains.radius_mm=1.2", "--set", "grains.smallest_mm=1.2"]

    def simulate(self, *options):
        return ["simulate", self.lab, *self.settings, "--json", *options]

    def stopped(self, after_s, *options):
        """A run that is asked to stop after so many seconds."""
        command = [PROGRAM, *map(str, self.simulate("--checkpoint", self.file, *options))]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            time.sleep(after_s)
            process.send_signal(signal.SIGTERM)
            out, err = process.communicate(timeout=60)
        return subprocess.CompletedProcess(command, process.returncode, out, err)

    def stopped_midway(self):
        """One that was stopped half-way, by the clock of a whole run beside it."""
        wall_s = json.loads(run(*self.simulate()).stdout)["run"]["wall_s"]
        for _ in range(20):
            result = self.stopped(0.5 * wall_s + 0.1)
            if result.returncode == 1:
                return result
        return result

    def answer(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)
        outcome = json.loads(result.stdout)
        for of_clock in ("wall_s", "particle_steps_per_s"):
            del outcome["run"][of_clock]
        return outcome

    def test_a_stopped_run_goes_on_with_the_same_result_and_the_file_is_gone_at_the_end(self):
        result = run(*self.simulate())
        whole, wall_s = self.answer(result), json.loads(result.stdout)["run"]["wall_s"]
        sessions = 0
        while True:
            result = self.stopped(0.3 * wall_s + 0.2, "--out", self.out)
            if result.returncode == 0:
                break
            if result.returncode == -signal.SIGTERM:  # it had not begun to listen
                continue
            sessions += 1
            self.assertLess(sessions, 200)
            self.fails(result, 1, "the same command goes on from " + str(self.file))
            self.assertEqual(result.stdout, "")
            self.assertTrue(self.file.exists())
            self.assertFalse((self.out / "outcome.json").exists())
        self.assertGreater(sessions, 1)
        self.assertIn("goes on from " + str(self.file), result.stderr)
        self.assertEqual(self.answer(result), whole)
        self.assertEqual(json.loads((self.out / "outcome.json").read_text())["observables"], whole["observables"])
        self.assertFalse(self.file.exists())

    def test_a_file_of_another_run_or_program_a_damaged_one_and_one_that_is_none_are_faults(self):
        self.fails(self.stopped_midway(), 1)
        good = self.file.read_bytes()
        self.fails(run(*self.simulate("--checkpoint", self.file, "--seed", "9")), 2, "run.checkpoint",
                   "is of another run", "seed")
        self.file.write_bytes(good[:-100] + bytes(100))
        self.fails(run(*self.simulate("--checkpoint", self.file)), 2, "run.checkpoint", "is damaged", "start anew")
        self.file.write_bytes(good[:len(good) // 2])
        self.fails(run(*self.simulate("--checkpoint", self.file)), 2, "run.checkpoint", "is damaged")
        self.file.write_bytes(good.replace(b" engine ", b" motor  ", 1))
        self.fails(run(*self.simulate("--checkpoint", self.file)), 2, "was written by pastefit", "start anew")
        self.file.write_text("my notes")
        self.fails(run(*self.simulate("--checkpoint", self.file)), 2, "is no checkpoint", "name another file")
        self.assertEqual(self.file.read_text(), "my notes")

    def test_what_has_no_checkpoint_says_so(self):
        drop = self.folder / "drop.json"
        drop.write_text(run("template", "drop-lab").stdout)
        self.fails(run("simulate", drop, "--checkpoint", self.file), 2, "--checkpoint", "leave it out")
        self.fails(run("simulate", RIG, "--checkpoint", self.file, "--vtk", "0.1", "--out", self.out), 2,
                   "--checkpoint", "--vtk")
        self.fails(run("simulate", RIG, "--checkpoint", self.folder), 2, "--checkpoint")
        self.fails(run("simulate", RIG, "--checkpoint", self.folder / "nowhere" / "file"), 2, "--checkpoint")
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
