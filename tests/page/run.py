#!/usr/bin/env python3
"""Tests of the page of a calibration, and of the page that calibrates, which need npm, node and a browser; skipped (status 77)
without them.

usage: run.py sources SOURCE_DIR WORK_DIR            checks the pages' scripts: format, ESLint, types, unit tests
       run.py bundle SOURCE_DIR WORK_DIR             rebuilds the page and compares it with the shipped one
       run.py browser PROGRAM SOURCE_DIR WORK_DIR    tests the page of a calibration in Chromium
       run.py calibrator SOURCE_DIR WORK_DIR         tests the page that calibrates in Chromium, with a module that only waits
       run.py module SOURCE_DIR WORK_DIR FOLDER      the same with the module in FOLDER, pastefit.js and pastefit.wasm: calibrates
                                                     a sheet, some minutes; the page is WORK_DIR/pastefit.html
       run.py picture PROGRAM SOURCE_DIR WORK_DIR    makes the picture of the README, of the first example's card
       run.py map PROGRAM SOURCE_DIR WORK_DIR        calibrates that, some minutes, and draws the map of the misfit

WORK_DIR keeps the packages of npm between runs, the pages, and pictures of them (WORK_DIR/shots).
"""

import fcntl
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

SKIPPED = 77
PAGE, CALIBRATOR, TESTS = "calibrate/report/page", "calibrate/browser/page", "tests/page"
EXAMPLE = "concrete-mix-79"  # that of .ci/try
HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)> &lt;b&gt;"


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def need(*commands):
    for command in commands:
        if not shutil.which(command):
            skip(f"there is no {command} (.ci/install .ci/packages-page.txt)")


def need_chromium():
    if not any(pathlib.Path("/usr/bin", name).exists() for name in ("chromium-headless-shell", "chromium")):
        skip("there is no Chromium (.ci/install .ci/packages-page.txt)")


def packages_of(page, place):
    """Installs in `place` what the page's package-lock.json locks, unless that was done.

    Tests run side by side: one installs, the others wait, also for an npm whose test was killed (it has the lock).
    """
    place.mkdir(parents=True, exist_ok=True)
    with open(place / "lock", "w") as busy:
        fcntl.flock(busy, fcntl.LOCK_EX)
        lock, installed = page / "package-lock.json", place / "node_modules/installed.json"
        if installed.exists() and installed.read_bytes() == lock.read_bytes():
            return
        for name in ("package.json", "package-lock.json"):
            shutil.copy(page / name, place)
        result = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=place,
                                pass_fds=[busy.fileno()], capture_output=True, text=True)
        if result.returncode != 0:
            skip(f"npm could not install the packages of the page:\n{result.stderr}")
        shutil.copy(lock, installed)


def with_packages(source, work, name):
    """Copies the pages' sources and tests, without what was built of them, and gives them packages: two of the folders."""
    packages_of(source / PAGE, work / "packages")
    tree = work / name
    shutil.rmtree(tree, ignore_errors=True)
    for folder in (PAGE, CALIBRATOR, TESTS):
        shutil.copytree(source / folder, tree / folder, ignore=shutil.ignore_patterns("node_modules", "built"))
        (tree / folder / "node_modules").symlink_to(work / "packages/node_modules")
    shutil.copy(source / ".prettierrc.json", tree)
    return tree / PAGE, tree / TESTS


def sources(source, work):
    page, _ = with_packages(source, work, "sources")
    sys.exit(subprocess.run(["npm", "run", "--silent", "check"], cwd=page).returncode)


def bundle(source, work):
    page, _ = with_packages(source, work, "bundle")
    subprocess.run(["node", "build.mjs", "built"], cwd=page, check=True)
    shipped = source / PAGE / "built"
    if sorted(os.listdir(shipped)) != sorted(os.listdir(page / "built")):
        sys.exit(f"{shipped} has other files than a build makes")
    different = [name for name in sorted(os.listdir(shipped))
                 if (page / "built" / name).read_bytes() != (shipped / name).read_bytes()]
    if different:
        sys.exit(f"{', '.join(different)} in {shipped} is not what its sources give: npm ci && npm run build there")
    print("the shipped page is what its sources give")


def pastefit(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True)


def report(program, folder, page):
    """The page of a folder, without simulating, as `page`."""
    result = pastefit(program, "report", folder, "--quick")
    if result.returncode != 0:
        sys.exit(f"{folder}: {result.stderr}")
    shutil.copy(folder / "report.html", page)


def part_of(result, place, *names):
    place.mkdir()
    for name in names:
        shutil.copy(result / name, place)
    return place


def make_parts(program, result, work):
    """Pages of folders that are not whole: {work}/NAME.html."""
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    card, store = "card.json", "evaluations.sqlite"
    report(program, part_of(result, work / "1", card), work / "no-store.html")
    report(program, part_of(result, work / "2", store), work / "no-card.html")
    damaged = part_of(result, work / "3", card, store)
    (damaged / card).write_text((damaged / card).read_text()[:3000])
    report(program, damaged, work / "damaged-card.html")
    damaged = part_of(result, work / "4", card, store)
    (damaged / store).write_bytes((damaged / store).read_bytes()[:5000])
    report(program, damaged, work / "damaged-store.html")
    hostile = part_of(result, work / "5", card, store)
    content = json.loads((hostile / card).read_text())
    content["title"] = HOSTILE
    content["search"]["reason"] = HOSTILE
    content["tests"][0]["lab"].update(source=HOSTILE, notes=HOSTILE + "<!--", licence="<script>alert(3)</script>")
    (hostile / card).write_text(json.dumps(content))
    report(program, hostile, work / "hostile.html")
    sheared = part_of(result, work / "7", card, "views.json")
    content = json.loads((sheared / card).read_text())
    content["tests"][0]["baseline"]["readings"]["step1.lateral_shift_mm"][0] = 500
    (sheared / card).write_text(json.dumps(content))
    report(program, sheared, work / "sheared.html")
    vane = part_of(result, work / "6", card)
    content = json.loads((vane / card).read_text())
    content["tests"][0]["measured_yield_stress_pa"] = {"value": 400, "standard_deviation": 50, "repeats": 3}
    (vane / card).write_text(json.dumps(content))
    report(program, vane, work / "vane.html")
    pastefit(program, "report", work)  # of these folders: report.html


def interrupted(program, study, place):
    """Begins a calibration, keeps its page of the way as place/live.html, and ends it as Ctrl-C does."""
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    content = json.loads(study.read_text())
    content["lab"] = str(study.parent / content["lab"])
    content["search"]["tolerance_mm"] = 0.001  # never confirmed before it is interrupted
    (place / "study.json").write_text(json.dumps(content))
    made = subprocess.Popen([program, "calibrate", place / "study.json", "--out", place / "out", "--budget", "1000"],
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    page, deadline = place / "out/report.html", time.monotonic() + 60
    while not page.exists() and made.poll() is None and time.monotonic() < deadline:
        time.sleep(0.1)
    if made.poll() is not None or not page.exists():
        made.kill()
        sys.exit("a calibration that goes on has no page")
    shutil.copy(page, place / "live.html")
    made.send_signal(signal.SIGINT)
    made.wait(timeout=60)
    return place / "out"


def browser(program, source, work):
    need_chromium()
    _, tests = with_packages(source, work, "browser")
    result = work / "result"
    study = source / "tests/reliability/coarse-study.json"
    made = pastefit(program, "calibrate", study, "--out", result, "--force")
    if not (result / "report.html").exists():
        sys.exit(made.stdout + made.stderr)
    make_parts(program, result, work / "parts")
    ended = interrupted(program, study, work / "interrupted")
    shutil.copy(ended / "report.html", work / "parts/interrupted.html")
    pastefit(program, "calibrate", source / "data/studies/drop-twin.json", "--out", work / "drop", "--force")
    (work / "shots").mkdir(exist_ok=True)
    environment = dict(os.environ, PASTEFIT_PAGE=str(result / "report.html"),
                       PASTEFIT_DROP=str(work / "drop/report.html"),
                       PASTEFIT_LIVE=str(work / "interrupted/live.html"), PASTEFIT_PARTS=str(work / "parts"),
                       PASTEFIT_SHOTS=str(work / "shots"))
    ended = [subprocess.run(["node", "--test", file], cwd=tests, env=environment).returncode
             for file in ("page.test.js", "tables.test.js")]  # one after the other: pictures a second are measured
    sys.exit(max(ended))


def calibrate_in_browser(source, work, name, loader, module, test):
    """Builds the page with a module, and with the licences beside it if there are any; runs a test of it."""
    _, tests = with_packages(source, work, name)
    page, shots = work / f"{name}.html", work / "shots"
    shots.mkdir(exist_ok=True)
    licences = [file for file in [module.parent / "licences.txt"] if file.exists()]
    subprocess.run(["node", "build.mjs", loader, module, page, *licences], cwd=tests.parents[1] / CALIBRATOR, check=True)
    environment = dict(os.environ, PASTEFIT_CALIBRATOR=str(page), PASTEFIT_SHOTS=str(shots),
                       PASTEFIT_TOY=str(source / "tests/reliability"))
    sys.exit(subprocess.run(["node", "--test", test], cwd=tests / "calibrator", env=environment).returncode)


def calibrator(source, work):
    need_chromium()
    work.mkdir(parents=True, exist_ok=True)
    (work / "empty.wasm").write_bytes(b"\0asm\1\0\0\0")
    loader = source / TESTS / "calibrator/fake.js"
    calibrate_in_browser(source, work, "calibrator", loader, work / "empty.wasm", "calibrator.test.js")


def module(source, work, folder):
    need_chromium()
    calibrate_in_browser(source, work, "pastefit", folder / "pastefit.js", folder / "pastefit.wasm", "module.test.js")


def picture(program, source, work):
    _, tests = with_packages(source, work, "picture")
    result = work / EXAMPLE
    result.mkdir(exist_ok=True)
    shutil.copy(source / f"data/cards/{EXAMPLE}.json", result / "card.json")
    pastefit(program, "report", result)
    shown = source / TESTS / f"{EXAMPLE}.jpg"
    subprocess.run(["node", "picture.js", result / "report.html", shown], cwd=tests, check=True)


def picture_of_map(program, source, work):
    _, tests = with_packages(source, work, "picture")
    result = work / f"{EXAMPLE}-search"
    if not (result / "report.html").exists():
        pastefit(program, "calibrate", source / f"data/studies/{EXAMPLE}.json", "--out", result, "--force")
    pastefit(program, "report", result)
    shown = source / "calibrate/manual/open.jpg"
    subprocess.run(["node", "map.js", result / "report.html", shown], cwd=tests, check=True)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    need("node", "npm")
    what, *places = sys.argv[1:]
    verbs = {"sources": sources, "bundle": bundle, "browser": browser, "calibrator": calibrator, "module": module,
             "picture": picture, "map": picture_of_map}
    verbs[what](*[pathlib.Path(place).resolve() for place in places])


if __name__ == "__main__":
    main()
