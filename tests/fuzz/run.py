#!/usr/bin/env python3
"""Runs the fuzz targets (README.md) one after the other, and prints the number of files that each has read.

usage: run.py BUILD_DIR SECONDS [READER...]     SECONDS for all of them together

Files that cause a defect (a crash, more than five seconds on a busy machine, more than a gigabyte) are kept in
BUILD_DIR/fuzz, and the exit status is 1.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SHIPPED = json.loads((SOURCE / "tests/fuzz/corpus/shipped.json").read_text())


# Less memory is kept aside to catch its use after it was freed: what one file needs, a hundred times; and no word of
# where it came from, which the replay of a file tells as well. A tenth to a third more files.
LIGHT = {"ASAN_OPTIONS": "quarantine_size_mb=8:malloc_context_size=0"}


def words(value):
    """The keys and the words of a JSON document."""
    if isinstance(value, dict):
        return {*value, *(word for one in value.values() for word in words(one))}
    if isinstance(value, list):
        return {word for one in value for word in words(one)}
    return {value} if isinstance(value, str) else set()


def parsed(file):
    """What is in a file, nothing if that is not JSON."""
    try:
        return json.loads(file.read_text())
    except ValueError:
        return None


def corpus(reader, folder):
    """The shipped files, and those that a reader once could not cope with."""
    folder.mkdir(parents=True, exist_ok=True)
    for place in ["tests/fuzz/corpus/" + reader, *SHIPPED[reader]]:
        for file in (SOURCE / place).glob("*.json"):
            shutil.copy(file, folder / file.name)
    known = set()
    for file in folder.glob("*.json"):
        known |= words(parsed(file))
    dictionary = folder.parent / f"{reader}.dict"
    short = sorted(word for word in known if re.fullmatch(r"[\w.\-]{1,40}", word))
    dictionary.write_text("".join(f'"\\"{word}\\""\n' for word in short) + '"1e999"\n"-0.0"\n"null"\n"[]"\n"{}"\n"\\x00"\n')
    return dictionary


def main():
    build, seconds, readers = pathlib.Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3:] or list(SHIPPED)
    found = build / "fuzz"
    failed = total = 0
    for reader in readers:
        folder = found / reader
        dictionary = corpus(reader, folder)
        command = [build / "tests" / f"fuzz_{reader}", folder, f"-dict={dictionary}", f"-artifact_prefix={found}/{reader}-",
                   f"-max_total_time={max(1, round(seconds / len(readers)))}", "-timeout=5", "-rss_limit_mb=1024",
                   "-max_len=20000", "-entropic=0",  # weighing what is rare takes longer than reading
                   "-print_final_stats=1"]
        result = subprocess.run(list(map(str, command)), capture_output=True, text=True, errors="replace",
                                env={**LIGHT, **os.environ})
        runs = re.search(r"number_of_executed_units: (\d+)", result.stderr)
        total += int(runs[1]) if runs else 0
        print(f"{reader:14} {int(runs[1]) if runs else 0:12,} files read, {'FAILED' if result.returncode else 'none failed'}")
        if result.returncode:
            failed += 1
            print(result.stderr[-3000:])
    print(f"{total:,} files read")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
