"""A user at the command line: the program, shipped files and a folder. Reads PROGRAM and SOURCE_DIR from the command line of
the test."""

import atexit
import contextlib
import functools
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
STUDY = SOURCE / "data/studies/concrete-mix-20.json"
CARD = SOURCE / "data/cards/concrete-mix-79.json"
LAB = SOURCE / "data/lab/concrete-mix-20.json"
APPARATUS = SOURCE / "data/apparatus/abrams.json"
TWO = str(min(2, len(os.sched_getaffinity(0))))  # threads
COARSE = ["--set", "grains.radius_mm=12"]


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


def size_of(file):
    """Of a file that comes and goes; 0 while it is not there."""
    try:
        return file.stat().st_size
    except FileNotFoundError:
        return 0


def used_s(process):
    """Processor seconds of a running process: others use this machine, too."""
    ticks = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]
    return sum(map(float, ticks)) / os.sysconf("SC_CLK_TCK")


def used_by_ended_s():
    """Processor seconds of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def told_to_end(process, name=signal.SIGINT):
    """Output and errors of a process from this signal to its end, and the processor seconds until then."""
    if process.poll() is not None:
        return *process.communicate(), 0.0
    before_s = used_by_ended_s() + used_s(process)
    process.send_signal(name)
    output = process.communicate(timeout=30)
    return *output, used_by_ended_s() - before_s


def wait_until_it_listens(process, name):
    """Until a process has a handler of the signal, which would have killed it before, or has ended."""
    while process.poll() is None:
        caught = re.search(r"^SigCgt:\s*(\w+)$", pathlib.Path(f"/proc/{process.pid}/status").read_text(), re.M)[1]
        if int(caught, 16) >> (name - 1) & 1:
            return
        time.sleep(0.002)


def shown_on(terminal):
    """What came to a terminal whose other end is closed here, until no process has it; closes this end, too."""
    shown = b""
    with contextlib.suppress(OSError):  # the end of a terminal
        while part := os.read(terminal, 65536):
            shown += part
    os.close(terminal)
    return shown.decode()


@functools.cache
def coarse_card():
    """The shipped card with large grains, which are quick to export; without a baseline."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-cli-"))
    atexit.register(shutil.rmtree, folder)
    card = folder / "coarse.json"
    result = run("rescale", CARD, "--radius", "12", "--packings", "0", "--out", card)
    assert result.returncode == 0, result.stderr
    return card


class Desk(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pastefit-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = self.folder / "out"

    def terminal(self):
        """Both ends of a terminal. A system without devices, as in a bare chroot, has none."""
        try:
            return os.openpty()
        except OSError as error:
            raise unittest.SkipTest(f"no terminal can be made here: {error}")

    def study(self, budget=4, screening=2, radius_mm=12, **changes):
        """A study of coarse grains with few simulations, beside its laboratory file."""
        lab = json.loads(LAB.read_text())
        lab["grains"] = {"distribution": "mono", "radius_mm": radius_mm}
        (self.folder / "lab.json").write_text(json.dumps(lab))
        study = json.loads(STUDY.read_text())
        study["lab"] = "lab.json"
        study["search"].update(screening=screening, budget_simulations=budget, packings=1, confirmation_packings=1,
                               rejected_share=1)
        study.update(changes)
        file = self.folder / "study.json"
        file.write_text(json.dumps(study))
        return file

    def fails(self, result, status, *words):
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def calibrates(self, study, *options, out=None):
        """Runs a calibration to its card; status 0 says that the material is confirmed."""
        out = out or self.out
        result = run("calibrate", study, "--out", out, *options)
        self.assertIn(result.returncode, (0, 1), result.stdout + result.stderr)
        status = json.loads((out / "card.json").read_text())["search"]["status"]
        self.assertEqual(result.returncode == 0, status == "confirmed", result.stdout + result.stderr)
        return result
