#!/usr/bin/env python3
"""Tests of the page of a calibration that need npm, node and a browser; without them they are skipped (status 77).

usage: run.py bundle SOURCE_DIR WORK_DIR              builds the page anew and compares it with the one that is shipped
       run.py browser PROGRAM SOURCE_DIR WORK_DIR     looks at the page of a calibration in Chromium
       run.py picture PROGRAM SOURCE_DIR WORK_DIR     makes the picture of the README, of the shipped card of the first example
       run.py map PROGRAM SOURCE_DIR WORK_DIR         calibrates that, some minutes, and makes the picture of what is open

WORK_DIR keeps the packages of npm between runs, the pages, and pictures of them (WORK_DIR/shots).
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

SKIPPED = 77
EXAMPLE = "concrete-mix-79"  # that of .ci/try
HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)> &lt;b&gt;"


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def need(*commands):
    for command in commands:
        if not shutil.which(command):
            skip(f"there is no {command} (.ci/install .ci/packages-page.txt)")


def with_packages(source, work):
    """Copies a folder with a package-lock.json, without what was built in it, and installs what it locks."""
    work.mkdir(parents=True, exist_ok=True)
    shutil.copytree(source, work, dirs_exist_ok=True, ignore=shutil.ignore_patterns("node_modules", "built"))
    lock, installed = work / "package-lock.json", work / "node_modules/installed.json"
    if installed.exists() and installed.read_bytes() == lock.read_bytes():
        return
    result = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=work, capture_output=True,
                            text=True)
    if result.returncode != 0:
        skip(f"npm could not install the packages of {source.name}:\n{result.stderr}")
    shutil.copy(lock, installed)


def bundle(source, work):
    page = source / "calibrate/report/page"
    with_packages(page, work / "bundle")
    subprocess.run(["node", "build.mjs", "built"], cwd=work / "bundle", check=True)
    different = [name for name in ("page.html", "licences.txt")
                 if (work / "bundle/built" / name).read_bytes() != (page / "built" / name).read_bytes()]
    if different:
        sys.exit(f"{', '.join(different)} in {page / 'built'} is not what its sources give: npm ci && npm run build there")
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
    if not any(pathlib.Path("/usr/bin", name).exists() for name in ("chromium-headless-shell", "chromium")):
        skip("there is no Chromium (.ci/install .ci/packages-page.txt)")
    with_packages(source / "tests/page", work / "browser")
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
    sys.exit(subprocess.run(["node", "--test", "page.test.js"], cwd=work / "browser", env=environment).returncode)


def picture(program, source, work):
    with_packages(source / "tests/page", work / "browser")
    result = work / EXAMPLE
    result.mkdir(exist_ok=True)
    shutil.copy(source / f"data/cards/{EXAMPLE}.json", result / "card.json")
    pastefit(program, "report", result)
    subprocess.run(["node", "picture.js", result / "report.html", source / f"tests/page/{EXAMPLE}.jpg"], cwd=work / "browser", check=True)


def picture_of_map(program, source, work):
    with_packages(source / "tests/page", work / "browser")
    result = work / f"{EXAMPLE}-search"
    if not (result / "report.html").exists():
        pastefit(program, "calibrate", source / f"data/studies/{EXAMPLE}.json", "--out", result, "--force")
    pastefit(program, "report", result)
    subprocess.run(["node", "map.js", result / "report.html", source / "calibrate/manual/open.jpg"], cwd=work / "browser", check=True)


def main():
    need("node", "npm")
    what, *places = sys.argv[1:]
    {"bundle": bundle, "browser": browser, "picture": picture, "map": picture_of_map}[what](*[pathlib.Path(place).resolve() for place in places])


if __name__ == "__main__":
    main()
