#!/usr/bin/env python3
"""The contact history follows the grains: the fill of an exported deck comes to rest at the same positions in LAMMPS in one
run, from a restart file half way, and on two ranks that exchange a fifth of the grains half way.

usage: lammps_memory.py PASTEFIT CARD

Exit status 1 if some grain is more than a nanometre off; 77 if LAMMPS's headers or mpirun are not installed.
"""

import pathlib
import subprocess
import sys
import tempfile

import engines

STEPS, TOLERANCE_M = 400, 1e-9


def places(deck, name, script, ranks):
    """Positions by grain after a script."""
    (deck / f"in.{name}").write_text(script + f"write_dump all custom {name}.dump id x y z modify sort id format float %.17g\n")
    command = engines.command_of("lammps", name, PASTEFIT, deck, ranks)
    run = subprocess.run(command, cwd=deck, capture_output=True, text=True, timeout=300, env=engines.environment())
    if run.returncode != 0:
        raise SystemExit(run.stdout[-2000:] + run.stderr)
    lines = (deck / f"{name}.dump").read_text().splitlines()
    return [tuple(map(float, line.split())) for line in lines[9:]]


def farthest(a, b):
    assert len(a) == len(b) > 300 and all(p[0] == q[0] for p, q in zip(a, b))
    return max(abs(u - v) for p, q in zip(a, b) for u, v in zip(p[1:], q[1:]))


def main(card):
    with tempfile.TemporaryDirectory() as name:
        deck = pathlib.Path(name) / "deck"
        coarse = pathlib.Path(name) / "coarse.json"
        subprocess.run([PASTEFIT, "rescale", card, "--radius", "11", "--packings", "0", "--out", coarse], check=True,
                       stdout=subprocess.DEVNULL)
        engines.export(PASTEFIT, coarse, "lammps", deck)
        scene = (deck / "in.slump").read_text().split("variable     relax")[0].replace("processors   * * 1\n", "")
        run = f"run {STEPS}\n"
        once = places(deck, "once", scene + run + "write_restart half\n" + run, 1)
        restarted = places(deck, "restarted", scene.replace("read_data    grains.data", "read_restart half") + run, 1)
        # The ranks' border moves from the axis to 4 % of the box beside it.
        shared = places(deck, "shared", "processors 2 1 1\n" + scene + run + "balance 1.0 x 0.46\n" + run, 2)
    errors = {"restart": farthest(once, restarted), "two ranks": farthest(once, shared)}
    for what, error in errors.items():
        print(f"{what}: {error:.1e} m off after {2 * STEPS} steps")
    return 0 if max(errors.values()) < TOLERANCE_M else 1


if __name__ == "__main__":
    PASTEFIT = str(pathlib.Path(sys.argv[1]).resolve())
    engines.exit_with(main, sys.argv[2])
