"""Calibrations from Python: the same card as the program's, progress, interruption, resuming.

usage: test_calibration.py PROGRAM SOURCE_DIR [unittest options]
"""

import contextlib
import importlib.util
import io
import math
import os
import pathlib
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

import numpy as np
from studies import PROGRAM, THREADS, Desk, coarse_study, main
import pastefit as pf


def runs(process):
    """Whether a process has not ended, be it that nobody has asked for its end."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def stored_in(folder):
    """How many evaluations a calibration that goes on has stored."""
    if (folder / "evaluations.sqlite-wal").exists():
        with contextlib.suppress(sqlite3.Error), contextlib.closing(sqlite3.connect(folder / "evaluations.sqlite")) as store:
            return store.execute("SELECT count(*) FROM evaluations").fetchone()[0]
    return 0


class Calibration(Desk):
    def test_the_card_is_the_programs_to_the_byte(self):
        study, there = self.study_file(), self.folder / "program"
        subprocess.run([PROGRAM, "calibrate", study, "--out", there, "--threads", str(THREADS)], capture_output=True)
        result = pf.calibrate(study, out=self.out, threads=THREADS)
        self.assertEqual((self.out / "card.json").read_bytes(), (there / "card.json").read_bytes())
        self.assertEqual((self.out / "summary.txt").read_bytes(), (there / "summary.txt").read_bytes())
        self.assertEqual(sorted(file.name for file in self.out.iterdir()),
                         sorted(file.name for file in there.iterdir()))
        self.assertEqual(result.card, pf.Card.load(self.out / "card.json"))
        self.assertEqual(result.summary, (self.out / "summary.txt").read_text())

    def test_a_result_holds_readings_intervals_and_every_evaluation(self):
        told = []
        result = pf.calibrate(pf.Study(coarse_study()), progress=told.append)
        self.assertTrue(result.confirmed, result.reason)
        self.assertEqual(list(result.readings["name"]), ["step1.height_mm"])
        self.assertLess(abs(result.readings["difference"][0]), 40)
        self.assertEqual(list(result.intervals["parameter"]), ["strength_pa"])
        self.assertEqual(len(result.evaluations), result.simulated)
        self.assertTrue(np.all((300 <= result.evaluations["strength_pa"]) & (result.evaluations["strength_pa"] <= 40000)))
        self.assertIn("step1.height_mm", result.evaluations.dtype.names)
        self.assertEqual(told[-1]["simulations"], result.simulated)
        self.assertEqual(told[-1]["budget"], 16)
        for part in ("<table>", "<svg", "strength_pa"):
            self.assertIn(part, result._repr_html_())

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "there is no Matplotlib")
    def test_a_plot_has_a_point_for_each_reading_at_its_difference_in_tolerances(self):
        from matplotlib.figure import Figure
        result = pf.calibrate(pf.Study(coarse_study()))
        axes = result.plot(Figure().subplots())
        points, = [line for line in axes.lines if line.get_marker() == "o"]
        self.assertEqual(list(points.get_xdata()), list(result.readings["difference"] / result.readings["tolerance"]))
        self.assertTrue(axes.get_yticklabels()[0].get_text().startswith("step1.height_mm"))

    def test_a_bar_shows_how_far_it_is(self):
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            pf.calibrate(pf.Study(coarse_study()), progress=True)
        self.assertRegex(shown.getvalue(), r"\d+.*16.*")
        self.assertIn("tolerance", shown.getvalue())

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "there is no pandas")
    def test_a_data_frame_has_a_row_for_each_evaluation(self):
        result = pf.calibrate(pf.Study(coarse_study()))
        frame = result.to_pandas()
        self.assertEqual(len(frame), result.simulated)
        self.assertEqual(list(frame["step1.height_mm"]), list(result.evaluations["step1.height_mm"]))

    def test_a_folder_with_a_result_is_not_replaced_by_chance_and_resumes_without_a_simulation(self):
        study = pf.Study(coarse_study())
        first = pf.calibrate(study, out=self.out, page=False)
        fault, = self.faults(pf.calibrate, study, out=self.out)
        self.assertIn("resume=True", fault.remedy)
        again = pf.calibrate(study, out=self.out, resume=True, page=False)
        self.assertEqual(again.simulated, 0)
        self.assertEqual(again.card, first.card)

    def test_options_that_contradict_each_other_or_are_no_numbers_are_told_before_anything_runs(self):
        for options, word in (({"resume": True, "force": True}, "resume"), ({"threads": -1}, "threads"),
                              ({"threads": 1.5}, "threads"), ({"wall_budget_s": math.nan}, "wall_budget_s"),
                              ({"wall_budget_s": -1}, "wall_budget_s")):
            fault, = self.faults(pf.calibrate, self.study_file(), out=self.out, **options)
            self.assertEqual(fault.where, word)
        self.assertFalse(self.out.exists())

    def test_options_of_the_command_line_that_cannot_be_used_end_in_status_2_without_a_traceback(self):
        for options in (["--processes", "0"], ["--processes", "-1"], ["--time", "nan"], ["--dask", "nowhere.json"]):
            result = subprocess.run([sys.executable, "-m", "pastefit", "calibrate", str(self.study_file()), "--out",
                                     str(self.out), *options], capture_output=True, text=True, timeout=120)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertNotIn("Traceback", result.stderr)
        self.assertFalse(self.out.exists())

    def test_workers_end_soon_after_a_driver_that_was_killed(self):
        study = self.study_file(screening=1000, budget_simulations=2000)  # which is not over before
        driver = subprocess.Popen([sys.executable, "-m", "pastefit", "calibrate", str(study), "--out",
                                   str(self.out), "--processes", "2", "--quiet"], start_new_session=True)
        workers = []
        deadline = time.monotonic() + 60
        while (len(workers) < 2 or stored_in(self.out) < 2) and time.monotonic() < deadline and driver.poll() is None:
            with contextlib.suppress(OSError):  # of a thread that ends
                workers = [int(one) for task in pathlib.Path(f"/proc/{driver.pid}/task").glob("*/children")
                           for one in task.read_text().split()]
            time.sleep(0.05)
        driver.kill()
        driver.wait()
        self.assertGreater(len(workers), 0)
        while any(map(runs, workers)) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(list(filter(runs, workers)), [])

    def test_a_study_that_cannot_be_calibrated_is_told_so_before_anything_runs(self):
        fault, = self.faults(pf.calibrate, pf.Study(coarse_study(strategy="defualt")), out=self.out)
        self.assertEqual(fault.where, "search.strategy")
        self.assertFalse(self.out.exists())

    def test_an_error_in_progress_ends_the_calibration_and_is_raised(self):
        def fail(_):
            raise RuntimeError("no more")
        with self.assertRaisesRegex(RuntimeError, "no more"):
            pf.calibrate(pf.Study(coarse_study()), progress=fail)

    def test_ctrl_c_leaves_a_store_that_resumes_to_the_same_card(self):
        study = self.study_file()
        for attempt in range(5):  # where the machine stalls, the calibration may be over before the interrupt
            self.out = self.folder / f"out-{attempt}"
            code = f"import pastefit as pf\npf.calibrate({str(study)!r}, out={str(self.out)!r}, threads=1, page=False)\n"
            process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True, env=os.environ)
            while process.poll() is None and stored_in(self.out) == 0:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            _, error = process.communicate(timeout=60)
            if process.returncode != 0:
                break
        self.assertIn("KeyboardInterrupt", error)
        self.assertNotIn("Fatal", error)
        resumed = pf.calibrate(study, out=self.out, resume=True, page=False)
        whole = pf.calibrate(study, out=self.folder / "whole", page=False)
        self.assertLess(resumed.simulated, whole.simulated)
        self.assertEqual(resumed.card, whole.card)


if __name__ == "__main__":
    main()
