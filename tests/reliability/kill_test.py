"""Kills calibrations at random moments, resumes them, and counts what was lost.

usage: kill_test.py KILLS SEED STUDY COMMAND...

COMMAND is a calibration with {study} and {out} in place of the study file and the output folder; it must resume from
the contents of {out}. `pastefit calibrate` is an example:

    kill_test.py 10 1 data/studies/concrete-mix-66.json \
        build/release/calibrate/pastefit calibrate {study} --out {out} --resume

Each kill comes at a random time of an undisturbed run. Checked after every kill: the store opens, and contains every
evaluation that it contained before. Checked at the end: the same card, byte for byte, as that of the undisturbed run,
and the same evaluations; if COMMAND prints "simulated N", also that it repeated none.
"""

import contextlib
import pathlib
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time


def evaluations(folder):
    """Keys in the store; none if it does not exist yet."""
    file = folder / "evaluations.sqlite"
    if not file.exists():
        return set()
    with contextlib.closing(sqlite3.connect(file)) as store:
        if not store.execute("SELECT count(*) FROM sqlite_master WHERE name = 'evaluations'").fetchone()[0]:
            return set()
        return {key for (key,) in store.execute("SELECT key FROM evaluations")}


def main():
    kills, seed, study, command = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4:]
    draw = random.Random(seed)
    root = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-kill-"))

    def start(folder):
        folder.mkdir(exist_ok=True)
        words = [word.format(study=study, out=folder) for word in command]
        return subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def finish(folder):
        process = start(folder)
        output, _ = process.communicate(timeout=600)
        if process.returncode not in (0, 1):  # 1: not confirmed
            sys.exit(f"a calibration failed with {process.returncode}:\n{output}")
        made = re.search(r"simulated (\d+)", output)
        return (folder / "card.json").read_bytes(), evaluations(folder), int(made[1]) if made else None

    try:
        begin = time.monotonic()
        card, undisturbed, _ = finish(root / "undisturbed")
        duration = time.monotonic() - begin
        done = lost = twice = different = folders = kept = 0
        while done < kills:
            folders += 1
            folder = root / f"killed-{folders}"
            before = set()
            for _ in range(draw.randint(1, 4)):
                if done == kills:
                    break
                process = start(folder)
                time.sleep(draw.uniform(0, duration))
                if process.poll() is None:
                    process.send_signal(signal.SIGKILL)
                    done += 1
                process.communicate()
                now = evaluations(folder)
                lost += len(before - now)
                before = now
            kept += len(before)
            resumed, after, made = finish(folder)
            if made is not None:
                twice += made - len(after - before)
            lost += len(before - after)
            twice += len(after - undisturbed)
            different += resumed != card
        print(f"{done} kills in {folders} calibrations of {len(undisturbed)} evaluations and {duration:.2f} s; "
              f"{kept} evaluations found after the last kill of each; {lost} lost, {twice} made twice or beside the undisturbed run's, "
              f"{different} cards differ")
        sys.exit(0 if lost == twice == different == 0 else 1)
    finally:
        shutil.rmtree(root)


if __name__ == "__main__":
    main()
