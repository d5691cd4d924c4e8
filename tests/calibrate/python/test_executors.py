"""Calibrations whose simulations run on an executor. usage: test_executors.py PROGRAM SOURCE_DIR [unittest options]"""

import concurrent.futures as futures
import multiprocessing
import os
import subprocess

from studies import PROGRAM, Desk, main
import pastefit as pf


class CountingPool(futures.ThreadPoolExecutor):
    """Whatever has `submit` will do."""
    calls = 0

    def submit(self, function, *arguments):
        self.calls += 1
        return super().submit(function, *arguments)


def die_at_first(mark):
    """Of a worker: the first one that starts does not live to simulate."""
    if not os.path.exists(mark):
        open(mark, "w").close()
        os._exit(1)


class Executors(Desk):
    def card_of_the_program(self, study):
        there = self.folder / "program"
        subprocess.run([PROGRAM, "calibrate", study, "--out", there, "--threads", "1"], capture_output=True)
        return (there / "card.json").read_bytes()

    def card_with(self, study, executor, name):
        out = self.folder / name
        pf.calibrate(study, out=out, executor=executor, page=False)
        return (out / "card.json").read_bytes()

    def test_the_card_is_the_programs_with_one_and_four_workers(self):
        study = self.study_file()
        card = self.card_of_the_program(study)
        with CountingPool(1) as one, futures.ProcessPoolExecutor(4) as four:
            self.assertEqual(self.card_with(study, one, "one"), card)
            self.assertGreater(one.calls, 3)
            self.assertEqual(self.card_with(study, four, "four"), card)

    def test_a_pool_that_breaks_is_made_anew(self):
        study, context = self.study_file(), multiprocessing.get_context("spawn")
        with futures.ProcessPoolExecutor(1, context, die_at_first, (str(self.folder / "mark"),)) as pool:
            self.assertEqual(self.card_with(study, pool, "broken"), self.card_of_the_program(study))

    def test_a_simulation_that_dask_gives_up_is_a_failure_with_its_reason(self):
        class KilledWorker(Exception):
            """As Dask names it."""
        class Dask:
            def ncores(self):
                return {"a": 1, "b": 2}
            def submit(self, function, *arguments):
                future = futures.Future()
                future.set_exception(KilledWorker("simulate"))
                return future
        result = pf.calibrate(self.study_file(), executor=Dask())
        self.assertFalse(result.confirmed)
        self.assertEqual(set(result.evaluations["failure"]), {"engine_failed"})
        self.assertIn("Each worker of Dask that simulated it died", result.evaluations["message"][0])

    def test_an_error_of_the_executor_is_raised(self):
        class Broken:
            def submit(self, function, *arguments):
                raise OSError("no such cluster")
        with self.assertRaisesRegex(RuntimeError, "no such cluster"):
            pf.calibrate(self.study_file(), executor=Broken())


if __name__ == "__main__":
    main()
