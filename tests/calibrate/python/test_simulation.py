"""Simulations from Python. usage: test_simulation.py PROGRAM SOURCE_DIR [unittest options]"""

import gc
import json
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
from studies import PROGRAM, Desk, coarse_lab, coarse_study, main
import pastefit as pf


class Simulation(Desk):
    def test_readings_are_those_of_the_program(self):
        study = self.study_file()
        printed = subprocess.run([PROGRAM, "simulate", study, "--seed", "4", "--set", "strength_pa=2000", "--json"],
                                 capture_output=True, text=True, check=True).stdout
        simulation = pf.simulate(study, seed=4, set={"strength_pa": 2000})
        self.assertIsNone(simulation.failure)
        self.assertEqual(simulation.readings, json.loads(printed)["observables"])

    def test_a_file_a_study_and_a_dict_are_the_same_test(self):
        readings = [pf.simulate(scene, seed=2).readings for scene in (self.study_file(), pf.Study(coarse_study()),
                                                                       coarse_study())]
        self.assertEqual(readings[0], readings[1])
        self.assertEqual(readings[0], readings[2])

    def test_a_laboratory_runs_without_a_study(self):
        self.assertIn("step1.height_mm", pf.simulate(coarse_lab()).readings)

    def test_positions_are_views_of_the_engines_memory(self):
        simulation = pf.simulate(coarse_study())
        positions, radii = simulation.positions, simulation.radii
        self.assertEqual(positions.shape, (len(radii), 3))
        self.assertFalse(positions.flags.owndata)
        self.assertFalse(positions.flags.writeable)
        self.assertEqual(positions.strides, (64, 8))  # of core/world/particles.h
        self.assertTrue(np.allclose(radii, 0.018, rtol=0.02))
        highest = 1e3 * (positions[:, 2] + radii).max()
        self.assertAlmostEqual(highest, simulation.readings["step1.height_max_mm"], delta=40)
        kept = positions.copy()
        del simulation
        gc.collect()
        self.assertTrue(np.array_equal(positions, kept))  # the array keeps the memory

    def test_frames_are_as_far_apart_as_asked_for(self):
        frames = pf.simulate(coarse_study(), frames=0.2).frames
        self.assertGreater(len(frames), 5)
        self.assertTrue(all(sorted(frame.identities) == sorted(frames[-1].identities) for frame in frames
                            if frame.phase.startswith("step1")))
        steps = [after.time_s - before.time_s for before, after in zip(frames, frames[1:])
                 if before.phase == after.phase]
        self.assertGreater(max(steps), 0.19)

    def test_a_wrong_setting_is_told_with_its_remedy(self):
        fault, = self.faults(pf.simulate, coarse_study(), set={"strenght_pa": 2000})
        self.assertIn("strength_pa", fault.remedy)
        self.assertNotIn("--", fault.where)

    def test_every_option_that_is_wrong_is_told_with_its_remedy(self):
        for wrong in ({"threads": -1}, {"threads": 1.5}, {"threads": True}, {"threads": 2**40}, {"seed": True}, {"seed": -1},
                      {"seed": 2**70}, {"seed": 1.5}, {"seed": "4"}, {"frames": 0}, {"frames": "x"},
                      {"frames": float("nan")}):
            fault, = self.faults(pf.simulate, coarse_study(), **wrong)
            self.assertEqual(fault.where, *wrong)
            self.assertTrue(fault.remedy)
        self.assertEqual(len(self.faults(pf.simulate, coarse_study(), seed=-1, threads=-1, frames=-1)), 3)

    def test_the_threads_do_not_change_the_readings(self):
        one = pf.simulate(coarse_study()).readings
        for threads in (0, np.int64(2), 1000):
            self.assertEqual(pf.simulate(coarse_study(), threads=threads).readings, one)

    def test_the_lock_of_the_interpreter_is_released(self):
        counted, ended = [0], threading.Event()

        def count():
            while not ended.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        pf.simulate(coarse_lab(radius_mm=8))
        ended.set()
        thread.join()
        self.assertGreater(counted[0], 20)

    def test_ctrl_c_ends_a_long_simulation_at_once(self):
        code = ("import pastefit as pf, sys\n"
                "try:\n"
                "    print('begins', flush=True)\n"
                f"    pf.simulate({coarse_lab(radius_mm=3)!r})\n"
                "except KeyboardInterrupt:\n"
                "    print('interrupted')\n")
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, env=os.environ)
        self.assertEqual(process.stdout.readline(), "begins\n")
        time.sleep(1)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=30)
        self.assertEqual(output, "interrupted\n")
        self.assertLess(time.monotonic() - start, 10)
        self.assertEqual(process.returncode, 0)


if __name__ == "__main__":
    main()
