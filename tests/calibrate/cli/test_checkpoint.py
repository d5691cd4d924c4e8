"""A stopped or killed simulation resumes from its checkpoint with the same result.

usage: test_checkpoint.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import math
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest

from desk import PROGRAM, APPARATUS, Desk, run, wait_until_it_listens


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
        """A run that is asked to stop so many seconds after it began."""
        command = [PROGRAM, *map(str, self.simulate("--checkpoint", self.file, *options))]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            wait_until_it_listens(process, signal.SIGTERM)
            time.sleep(after_s)
            process.send_signal(signal.SIGTERM)
            out, err = process.communicate(timeout=60)
        return subprocess.CompletedProcess(command, process.returncode, out, err)

    def stopped_midway(self):
        """One that was stopped half-way, by the clock of a whole run beside it, or sooner if that was a slow one."""
        after_s = 0.5 * json.loads(run(*self.simulate()).stdout)["run"]["wall_s"]
        while (result := self.stopped(after_s)).returncode == 0 and after_s > 0.001:
            after_s *= 0.7
        return result

    def stopped_until_it_ends(self, after_s):
        """How many runs were stopped after so many seconds, each going on from the one before, and the one that ended."""
        shutil.rmtree(self.out, ignore_errors=True)
        for sessions in range(200):
            result = self.stopped(after_s, "--out", self.out)
            if result.returncode == 0:
                return sessions, result
            self.fails(result, 1, "the same command continues from " + str(self.file))
            self.assertEqual(result.stdout, "")
            self.assertTrue(self.file.exists())
            self.assertFalse((self.out / "outcome.json").exists())
        self.fail("it was stopped 200 times and did not end")

    def answer(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)
        outcome = json.loads(result.stdout)
        for of_clock in ("wall_s", "particle_steps_per_s"):
            del outcome["run"][of_clock]
        return outcome

    def test_a_stopped_run_goes_on_with_the_same_result_and_the_file_is_gone_at_the_end(self):
        result = run(*self.simulate())
        whole, wall_s = self.answer(result), json.loads(result.stdout)["run"]["wall_s"]
        # A machine that is less busy than it was may come to the end before it was stopped twice.
        for share in (0.3, 0.1, 0.03):
            sessions, result = self.stopped_until_it_ends(share * wall_s)
            if sessions > 1:
                break
        self.assertGreater(sessions, 1)
        self.assertIn("continues from " + str(self.file), result.stderr)
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
        self.fails(run(*self.simulate("--checkpoint", self.file)), 2, "is not a checkpoint", "name another file")
        self.assertEqual(self.file.read_text(), "my notes")

    def forged(self, good, state=None, wall=None):
        """The checkpoint with another state, or another time taken, and the right hash of them."""
        lines = good.split(b"\n", 5)
        wall, state = wall if wall is not None else lines[3], state if state is not None else lines[5]
        hashed = 0xCBF29CE484222325
        for byte in wall + b"\n" + state:
            hashed = (hashed ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
        return b"\n".join([*lines[:3], wall, b"%016x" % hashed, state])

    def test_a_forged_checkpoint_is_refused_whatever_was_forged_although_its_hash_is_right(self):
        self.fails(self.stopped_midway(), 1)
        good = self.file.read_bytes()
        state = good.split(b"\n", 5)[5]
        self.assertEqual(self.forged(good), good)
        forgeries = {f"time {wall}": self.forged(good, wall=wall.encode())
                     for wall in ("nan", "inf", "-1", "1e300", "", "12 s", "0x10")}
        forgeries |= {"cut": self.forged(good, state[:-8]), "longer": self.forged(good, state + bytes(8)),
                      "half": self.forged(good, state[:len(state) // 2]), "one byte": self.forged(good, b"x"),
                      "nothing": self.forged(good, bytes(len(state)))}
        waiting = struct.unpack("<Q", state[:8])[0]  # their number stands first
        for waits in (waiting + 1, waiting + 1000, 2**40, 2**64 - 1):
            forgeries[f"{waits} waits"] = self.forged(good, struct.pack("<Q", waits) + state[8:])
        impossible = {"nan": struct.pack("<d", math.nan), "inf": struct.pack("<d", math.inf),
                      "huge": b"\x7f" * 8}  # in single precision too
        for name, number in impossible.items():
            for step in range(20):  # wherever the run had come to, by the speed of the machine
                share = (step + 0.5) / 20
                words = bytearray(state)
                begin = int(share * (len(words) - 512)) // 8 * 8
                words[begin:begin + 512] = number * 64
                forgeries[f"{name} at {share}"] = self.forged(good, bytes(words))
        self.assertGreaterEqual(len(forgeries), 70)
        for name, content in forgeries.items():
            with self.subTest(name):
                self.file.write_bytes(content)
                self.fails(run(*self.simulate("--checkpoint", self.file)), 2, "run.checkpoint", "is damaged", "start anew")
                self.assertEqual(self.file.read_bytes(), content)

    def test_what_has_no_checkpoint_says_so(self):
        drop = self.folder / "drop.json"
        drop.write_text(run("template", "drop-lab").stdout)
        self.fails(run("simulate", drop, "--checkpoint", self.file), 2, "--checkpoint", "leave it out")
        self.fails(run("simulate", APPARATUS, "--checkpoint", self.file, "--vtk", "0.1", "--out", self.out), 2,
                   "--checkpoint", "--vtk")
        self.fails(run("simulate", APPARATUS, "--checkpoint", self.folder), 2, "--checkpoint")
        self.fails(run("simulate", APPARATUS, "--checkpoint", self.folder / "nowhere" / "file"), 2, "--checkpoint")
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
