"""Makes the start of one thread fail, a different one each time: a simulation on two threads ends with the same readings.

usage: thread_test.py LIBRARY LAB PROGRAM

LIBRARY is failing_calls.so. Also checks that every fault occurred. Skipped (status 77) on one processor, where no work is
shared.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile


def main():
    library, lab, program = sys.argv[1:]
    if len(os.sched_getaffinity(0)) < 2:
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="pastefit-thread-") as folder:
        counts = pathlib.Path(folder) / "calls"

        def simulate(fault):
            counts.unlink(missing_ok=True)
            result = subprocess.run([program, "simulate", lab, "--threads", "2", "--json"], capture_output=True, text=True,
                                    env={**os.environ, "LD_PRELOAD": library, "PASTEFIT_FAIL": f"thread {fault}",
                                         "PASTEFIT_CALLS": str(counts), "OPENBLAS_NUM_THREADS": "1"})
            if result.returncode != 0:
                sys.exit(f"thread {fault}: ended with {result.returncode}: {result.stderr}")
            started = dict(line.split() for line in counts.read_text().splitlines())["thread"]
            return json.loads(result.stdout)["observables"], int(started)

        undisturbed, started = simulate(0)
        if started < 2:
            sys.exit(f"{started} threads were started: {library} does not work here, or nothing is shared")
        for fault in range(1, started + 1):
            readings, seen = simulate(fault)
            if seen < fault:
                sys.exit(f"thread {fault} was not asked for")
            if readings != undisturbed:
                sys.exit(f"thread {fault}: other readings: {readings}")
        print(f"{started} threads, each of which failed once; the same readings")


main()
