"""The programs for which decks are exported: how to call them here."""

import hashlib
import os
import pathlib
import shutil
import subprocess
import sys

SKIP = 77


class Missing(Exception):
    """What is not installed, for "skipped: ... is not installed"."""


def styled_lammps(pastefit, deck):
    """LAMMPS with the styles of a deck, built by the command of its notes; kept beside pastefit while they stay the same."""
    style = pathlib.Path(deck) / "style"
    sources = sorted(file for file in style.rglob("*") if file.is_file())
    name = hashlib.sha256(b"".join(file.read_bytes() for file in sources)).hexdigest()[:16]
    built = pathlib.Path(pastefit).resolve().parent / f"lmp_pastefit-{name}"
    if built.exists():
        return built
    for needed in ("mpicxx", "/usr/include/lammps/lammps.h"):
        if not shutil.which(needed) and not os.path.exists(needed):
            raise Missing(f"liblammps-dev ({needed})")
    beside = f"{built}.{os.getpid()}.part"
    notes = (pathlib.Path(deck) / "NOTES.txt").read_text()
    command = notes[notes.index("mpicxx"):].split("\n")[0].rstrip(")").replace("../lmp_pastefit", beside)
    run = subprocess.run(["sh", "-c", command], cwd=style, capture_output=True, text=True)
    if run.returncode != 0:
        raise SystemExit(f"{command}\n{run.stderr}")
    os.replace(beside, built)
    return built


def command_of(target, script, pastefit, deck, ranks=1):
    """The command that runs a script of a deck, script without its suffix. Raises Missing."""
    plain = {"liggghts": "liggghts", "yade": "yade"}
    if target in plain and not shutil.which(plain[target]):
        raise Missing(plain[target])
    if target == "yade":
        return ["yade", "-j1", "-n", "-x", f"{script}.py"]
    program = str(styled_lammps(pastefit, deck)) if target == "lammps" else plain[target]
    command = [program, "-in", f"in.{script}", "-log", "none"]
    if ranks == 1:
        return command
    if not shutil.which("mpirun"):
        raise Missing("mpirun")
    # mpirun refuses root, and more ranks than cores, unless it is told not to.
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + command


def environment():
    # Ranks that wait leave the processor to others.
    return os.environ | {"OMP_NUM_THREADS": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}


def export(pastefit, card, target, deck, packing=None):
    choice = [] if packing is None else ["--packing", str(packing)]
    subprocess.run([pastefit, "export", "--unconfirmed", card, "--to", target, "--out", deck, "--force", *choice], check=True,
                   stdout=subprocess.DEVNULL)


def exit_with(main, *arguments):
    """Ends the script with the status that `main` returns, or with SKIP where a program is missing."""
    try:
        sys.exit(main(*arguments))
    except Missing as missing:
        print(f"skipped: {missing} is not installed")
        sys.exit(SKIP)
