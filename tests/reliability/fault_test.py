"""Makes one call of a calibration fail, a different one each time, resumes the calibration, and compares the card.

usage: fault_test.py FAULTS SEED LIBRARY STUDY COMMAND...

LIBRARY is failing_calls.so: the n-th write, sync, rename, thread start, or memory allocation of SQLite fails. FAULTS is the
number drawn of each kind, or "all": every call of an undisturbed run. COMMAND is as in kill_test.py.

Checked after every fault: the program ends within a minute with a documented status (0, 1 or 2), and with a message if there
is no card. Checked after resuming: the same card, byte for byte, as that of the undisturbed run, the same evaluations, and
no other files.
"""

import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

from kill_test import evaluations


def main():
    faults, seed, library, study, command = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4], sys.argv[5:]
    draw = random.Random(seed)
    root = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-fault-"))
    counts = root / "calls"

    def calibrate(folder, fault=None):
        folder.mkdir(exist_ok=True)
        words = [word.format(study=study, out=folder) for word in command]
        preloaded = {"LD_PRELOAD": library, "PASTEFIT_FAIL": fault, "PASTEFIT_CALLS": str(counts)} if fault else {}
        alone = {"OPENBLAS_NUM_THREADS": "1"}  # a BLAS may start a thread for each processor, and end the program without
        return subprocess.run(words, capture_output=True, text=True, timeout=60, env={**os.environ, **alone, **preloaded})

    def calls():
        return {kind: int(number) for kind, number in map(str.split, counts.read_text().splitlines())}

    def what_is_in(folder):
        return (folder / "card.json").read_bytes(), evaluations(folder), sorted(os.listdir(folder))

    wrong = []
    try:
        undisturbed = root / "undisturbed"
        result = calibrate(undisturbed, "write 0")
        if result.returncode not in (0, 1):
            sys.exit(f"a calibration failed with {result.returncode}:\n{result.stdout}{result.stderr}")
        aim, there = what_is_in(undisturbed), calls()
        for kind, number in there.items():
            if number == 0:
                sys.exit(f"no call of the kind {kind} was seen: {library} does not work here")
        made = stopped = 0
        for kind, number in there.items():
            numbers = range(1, number + 1)
            for n in numbers if faults == "all" else sorted(draw.sample(numbers, min(int(faults), number))):
                fault, folder = f"{kind} {n}", root / "disturbed"
                counts.unlink(missing_ok=True)
                try:
                    result = calibrate(folder, fault)
                except subprocess.TimeoutExpired:
                    wrong.append(f"{fault}: did not end")
                    continue
                finally:
                    came = counts.exists() and calls()[kind] >= n  # threads do not always take the same turns
                made += came
                has_card = (folder / "card.json").exists()
                stopped += not has_card
                if result.returncode not in (0, 1, 2) or not counts.exists():
                    wrong.append(f"{fault}: ended with {result.returncode}: {result.stderr[-300:]}")
                elif not has_card and not result.stderr.strip():
                    wrong.append(f"{fault}: no card and no word")
                resumed = calibrate(folder)
                if resumed.returncode not in (0, 1):
                    wrong.append(f"{fault}: going on ended with {resumed.returncode}: {resumed.stderr[-300:]}")
                elif (is_there := what_is_in(folder)) != aim:
                    what = [name for name, a, b in zip(("card", "evaluations", "files"), is_there, aim) if a != b]
                    wrong.append(f"{fault}: another {', '.join(what)} than undisturbed: {is_there[2]}")
                shutil.rmtree(folder)
        print("\n".join(wrong))
        print(", ".join(f"{number} of {kind}" for kind, number in there.items()) + " in an undisturbed run of "
              f"{len(aim[1])} evaluations; {made} made fail, {stopped} of which left no card; {len(wrong)} wrong")
        sys.exit(1 if wrong else 0)
    finally:
        shutil.rmtree(root)


main()
