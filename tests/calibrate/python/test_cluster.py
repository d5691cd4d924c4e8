"""The command line over many workers. usage: test_cluster.py PROGRAM SOURCE_DIR [unittest options]"""

import importlib.util
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import unittest

from studies import PROGRAM, Desk, coarse_study, main


class Cluster(Desk):
    def calibrated(self, name, *before, options=()):
        out = self.folder / name
        made = subprocess.run([*before, "-m", "pastefit", "calibrate", self.study_file(), "--out", out, "--quiet", *options],
                              capture_output=True, text=True, timeout=300)
        return made, out

    def card_of_the_program(self):
        there = self.folder / "program"
        subprocess.run([PROGRAM, "calibrate", self.study_file(), "--out", there, "--threads", "1"], capture_output=True)
        return (there / "card.json").read_bytes()

    def test_two_processes_make_the_programs_card(self):
        made, out = self.calibrated("processes", sys.executable, options=("--processes", "2"))
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("The material reproduces the measurement", made.stdout)
        self.assertEqual((out / "card.json").read_bytes(), self.card_of_the_program())

    @unittest.skipUnless(importlib.util.find_spec("mpi4py") and shutil.which("mpiexec"), "there is no MPI")
    def test_two_ranks_of_mpi_make_the_programs_card(self):
        ranks = ("mpiexec", "--allow-run-as-root", "--oversubscribe", "-n", "2", sys.executable, "-m", "mpi4py.futures")
        made, out = self.calibrated("ranks", *ranks)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual((out / "card.json").read_bytes(), self.card_of_the_program())

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "there is no Dask")
    def test_two_workers_of_dask_make_the_programs_card(self):
        from dask.distributed import LocalCluster
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            made, out = self.calibrated("dask", sys.executable, options=("--dask", cluster.scheduler_address))
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual((out / "card.json").read_bytes(), self.card_of_the_program())

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "there is no Dask")
    def test_workers_of_dask_that_are_killed_cost_their_simulations_only(self):
        from dask.distributed import LocalCluster
        killed, store = [], self.folder / "killed" / "evaluations.sqlite"
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            def kill_now_and_then(ended):
                while len(killed) < 3 and not ended.wait(1 if killed else 0.01):
                    worker = cluster.workers[len(killed) % 2]
                    if worker.pid and store.exists():
                        os.kill(worker.pid, signal.SIGKILL)
                        killed.append(worker.pid)
            ended = threading.Event()
            killer = threading.Thread(target=kill_now_and_then, args=(ended,))
            killer.start()
            made, out = self.calibrated("killed", sys.executable, options=("--dask", cluster.scheduler_address))
            ended.set()
            killer.join()
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertTrue(killed)
        self.assertEqual((out / "card.json").read_bytes(), self.card_of_the_program())

    def test_a_study_that_cannot_be_used_ends_with_status_2_and_its_faults(self):
        bad = self.folder / "bad.json"
        bad.write_text(json.dumps(coarse_study(screening=-1)))
        made = subprocess.run([sys.executable, "-m", "pastefit", "calibrate", bad, "--out", self.folder / "bad"],
                              capture_output=True, text=True)
        self.assertEqual(made.returncode, 2)
        self.assertIn("search.screening", made.stderr)
        self.assertFalse(os.path.exists(self.folder / "bad" / "card.json"))


if __name__ == "__main__":
    main()
