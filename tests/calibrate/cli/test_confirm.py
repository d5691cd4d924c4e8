"""pastefit confirm: a card's test in another engine. The engine here is a stand-in that returns the filled mould as the heap,
or fails as engines do; for LAMMPS itself see tests/exports/confirm.py.

usage: test_confirm.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest

from desk import PROGRAM, SOURCE, Desk, coarse_card, run

STAND_IN = r"""#!{python}
import os, sys, time
assert sys.argv[1:] == ["-in", "in.slump"], sys.argv
how = "{how}"
log = "LAMMPS (1 Jan 2000)\nLoop time of 3 on 2 procs for 10 steps with 9 atoms\n50.0% CPU use with 2 MPI tasks x no OpenMP threads\n"
if how == "impossible":
    log = "LAMMPS (1 Jan 2000)\nLoop time of 1e999 on 99999999999999 procs for 10 steps with 9 atoms\n1e999% CPU use\n"
if how == "slow":
    time.sleep(2)
with open("runs.txt", "a") as runs:
    runs.write("run\n")
print(log * (2 if how == "copies" else 1), end="", flush=True)
if how == "hangs":
    time.sleep(600)
if how == "lost":
    print("ERROR: Lost atoms: original 9 current 8 (src/thermo.cpp:481)", flush=True)
    sys.exit(1)
if how == "status":
    print("mpirun noticed something", flush=True)
    sys.exit(7)
rows = open("grains.data").read().split("Atoms # sphere\n\n")[1].split("\n")[:-1]
def dump(name, rows):
    with open(name, "w") as out:
        out.write(f"ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z radius\n")
        for row in rows:
            number, kind, diameter, density, x, y, z = row.split()
            out.write(f"{number} {kind} {x} {y} {z} {float(diameter) / 2!r}\n")
dump("filled.dump", rows)
if how != "no heap":
    dump("heap.dump", rows[:-1] if how == "fewer" else rows)
open("log.lammps", "w").write(log + "Total wall time: 0:00:03\n")
"""


class Confirm(Desk):
    def setUp(self):
        super().setUp()
        self.card = self.folder / "card.json"
        card = json.loads(coarse_card().read_text())
        source = json.loads((SOURCE / "data/cards/concrete-mix-79.json").read_text())
        card["tests"][0]["readings"] = source["tests"][0]["readings"]
        card["confirmation"] = source["confirmation"]
        self.card.write_text(json.dumps(card))
        self.runs = self.folder / "runs"

    def engine(self, how="well"):
        file = self.folder / "engine"
        file.write_text(STAND_IN.replace("{python}", sys.executable).replace("{how}", how))
        file.chmod(0o755)
        return file

    def confirm(self, how="well", *options):
        return run("confirm", self.card, "--program", self.engine(how), "--runs", self.runs, "--packings", "2", *options)

    def test_the_readings_with_bias_and_cost_stand_on_the_card_which_is_otherwise_the_same(self):
        before = json.loads(run("show", self.card, "--json").stdout)
        before["tests"][0].pop("yield_stress_pa")  # derived: printed, not stored
        result = self.confirm("well", "--radius", "13")
        self.assertEqual(result.returncode, 0, result.stderr)
        after = json.loads(self.card.read_text())
        (one,) = after.pop("further_confirmations")
        self.assertEqual(after, before)
        self.assertEqual((one["engine"], one["program"], one["ranks"]), ("lammps", "LAMMPS (1 Jan 2000)", 2))
        self.assertAlmostEqual(one["radius_m"], 0.013, places=12)
        self.assertEqual((one["wall_s"], one["core_s"]), (6, 6))  # two runs of 3 s, two ranks that work half the time
        height, own = one["readings"]["step1.height_mm"], before["tests"][0]["readings"]["step1.height_mm"]
        self.assertGreater(height["simulated"], 250)  # the mould as it stands
        self.assertEqual(height["card"], own["simulated"])
        self.assertAlmostEqual(height["bias"], height["simulated"] - own["simulated"], places=9)
        noise = (height["simulated_standard_deviation"] ** 2 / 2 + own["standard_error"] ** 2) ** 0.5
        self.assertAlmostEqual(height["standard_error"], noise, places=9)
        self.assertFalse(one["meets_laboratory"])
        shown = run("show", self.card).stdout
        for words in ("Simulated in another program: LAMMPS (1 Jan 2000)", "grains of 13 mm", "ranks: 2", "bias +"):
            self.assertIn(words, shown)
            self.assertIn(words, result.stdout)

    def test_a_second_confirmation_stands_beside_the_first_and_a_finished_run_is_not_repeated(self):
        for _ in range(2):
            self.assertEqual(self.confirm().returncode, 0)
        first, second = json.loads(self.card.read_text())["further_confirmations"]
        self.assertEqual(first, second)
        self.assertEqual([file.read_text() for file in sorted(self.runs.glob("packing-*/runs.txt"))], ["run\n"] * 2)
        self.assertEqual(self.confirm("well", "--radius", "13").returncode, 0)  # another deck
        self.assertEqual([file.read_text() for file in sorted(self.runs.glob("packing-*/runs.txt"))], ["run\nrun\n"] * 2)

    def test_a_run_that_fails_is_one_message_and_the_card_stays_as_it_was(self):
        before = self.card.read_bytes()
        for how, words in {"lost": ["ERROR: Lost atoms", "output.txt"], "status": ["status 7", "mpirun noticed something"],
                           "no heap": ["heap.dump", "no such file"], "fewer": ["grains in the mould", "must not be lost"],
                           "copies": ["--launch", "2 separate copies"]}.items():
            with self.subTest(how=how):
                result = self.confirm(how)
                self.fails(result, 1, "1 error", "packing 80001", *words)
                self.assertEqual(result.stdout, "")
                self.assertEqual(self.card.read_bytes(), before)

    def test_a_log_without_end_or_with_impossible_numbers_leaves_a_card_that_can_be_read(self):
        self.assertEqual(self.confirm("impossible").returncode, 0)
        self.assertEqual(run("show", self.card).returncode, 0)
        for replace in (lambda log: log.symlink_to("/dev/zero"), os.mkfifo):
            for log in self.runs.glob("packing-*/log.lammps"):
                log.unlink()
                replace(log)
            self.assertEqual(self.confirm().returncode, 0)
            self.assertEqual(run("show", self.card).returncode, 0)

    def test_runs_that_nobody_named_are_in_a_new_folder_that_only_this_user_can_read(self):
        for _ in range(2):
            result = run("confirm", self.card, "--program", self.engine("lost"), "--packings", "2",
                         env={**os.environ, "TMPDIR": str(self.folder)})
            self.assertEqual(result.returncode, 1)
        folders = [folder for folder in self.folder.iterdir() if folder.name.startswith("pastefit-")]
        self.assertEqual([folder.stat().st_mode & 0o777 for folder in folders], [0o700] * 2)

    def test_two_confirmations_at_once_are_both_on_the_card(self):
        command = ["confirm", self.card, "--program", self.engine("slow"), "--packings", "2"]
        both = [subprocess.Popen([PROGRAM, *map(str, command), "--radius", radius], stdout=subprocess.DEVNULL)
                for radius in ("13", "14")]
        self.assertEqual([one.wait(120) for one in both], [0, 0])
        self.assertEqual(sorted(one["radius_m"] for one in json.loads(self.card.read_text())["further_confirmations"]),
                         [0.013, 0.014])

    def test_a_card_that_cannot_be_replaced_is_said_before_anything_runs(self):
        link = self.folder / "link.json"
        link.symlink_to(self.card)
        self.fails(run("confirm", link, "--program", self.engine(), "--runs", self.runs), 2, "CARD", "symbolic link")
        self.assertFalse(self.runs.exists())

    def test_a_card_that_became_another_keeps_the_runs(self):
        command = ["confirm", self.card, "--program", self.engine("slow"), "--runs", self.runs, "--packings", "2"]
        with subprocess.Popen([PROGRAM, *map(str, command)], stderr=subprocess.PIPE, text=True) as process:
            self.assertTrue(process.stderr.readline())  # it has read the card
            card = json.loads(self.card.read_text())
            card["title"] = "another"
            self.card.write_text(json.dumps(card))
            err = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 1, err)
        self.assertIn("the runs are kept in", err)
        self.assertEqual(len(list(self.runs.glob("packing-*/heap.dump"))), 2)

    def test_what_cannot_be_used_is_bad_input_and_nothing_runs(self):
        before = self.card.read_bytes()
        taken = self.folder / "taken.json"
        taken.write_text("mine")
        for options, words in [(["--launch", "no-such-launcher -n 2"], ["--launch", "no-such-launcher", "openmpi-bin"]),
                               (["--program", self.folder / "none"], ["--program", "none"]),
                               (["--engine", "liggghts"], ["--engine", "liggghts"]),
                               (["--out", taken], ["--out", "--force"]), (["--radius", "60"], ["radius"]),
                               (["--packings", "1"], ["--packings"]), (["--test", "other"], ["other"]),
                               (["--radius", "0.05"], ["grains", "of memory"])]:
            with self.subTest(options=options):
                program = [] if "--program" in options else ["--program", self.engine()]
                self.fails(run("confirm", self.card, "--runs", self.runs, *program, *options), 2, *words)
                self.assertFalse(self.runs.exists())
        pellet = json.loads((SOURCE / "tests/calibrate/card/several_tests.json").read_text())
        names = [test["name"] for test in pellet["tests"] if test["test"]["kind"] != "slump"]
        for name in names:
            result = run("confirm", SOURCE / "tests/calibrate/card/several_tests.json", "--program", self.engine(), "--test", name)
            self.fails(result, 2, name, "no deck")
        self.assertEqual((self.card.read_bytes(), taken.read_text()), (before, "mine"))

    def test_what_is_missing_to_build_lammps_is_said_all_at_once(self):
        environment = {"PATH": str(self.folder), "XDG_CACHE_HOME": str(self.folder / "cache")}
        result = run("confirm", self.card, env=environment)
        self.fails(result, 2, "mpicxx", "libopenmpi-dev", "--program")

    def test_an_engine_that_hangs_is_told_of_and_an_interrupt_ends_it_too(self):
        before = self.card.read_bytes()
        driver = subprocess.Popen([PROGRAM, "confirm", self.card, "--program", self.engine("hangs"), "--runs", self.runs],
                                  stderr=subprocess.PIPE, text=True)
        self.addCleanup(driver.kill)
        said = next(line for line in driver.stderr if not re.match(r"fill\.|packing ", line))  # a sign of life of the engine
        self.assertRegex(said, r"^LAMMPS, \d+ s gone")
        driver.send_signal(signal.SIGINT)
        said = driver.communicate(timeout=60)[1]
        self.assertEqual(driver.returncode, 1)
        self.assertIn("interrupted", said)
        self.assertEqual(self.card.read_bytes(), before)

    def test_a_card_is_the_old_or_the_new_one_whenever_a_confirmation_is_killed(self):
        before = self.card.read_bytes()
        words = [PROGRAM, "confirm", self.card, "--program", self.engine(), "--runs", self.runs, "--packings", "2", "--quiet"]

        def taken_s():
            start = time.monotonic()
            subprocess.run(words, capture_output=True, check=True)
            return time.monotonic() - start

        duration = min(taken_s() for _ in range(3))  # the first one runs the engine, and a machine may stall in one
        replaced = 0
        for kill in range(12):
            self.card.write_bytes(before)
            with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
                time.sleep(duration * (kill + 0.5) / 11)
                process.kill()
            after = self.card.read_bytes()
            replaced += after != before
            shown = run("show", self.card, "--json")
            self.assertEqual(shown.returncode, 0, shown.stderr)
            self.assertEqual(len(json.loads(shown.stdout).get("further_confirmations", [])), int(after != before))
        self.assertLess(replaced, 12)
        self.card.write_bytes(before)
        result = self.confirm()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(json.loads(self.card.read_text())["further_confirmations"]), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
