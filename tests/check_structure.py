#!/usr/bin/env python3
"""Counts what a reader has to walk through, and fails where there is more of it than before: see `MOST`.

usage: check_structure.py SOURCE_DIR
"""

import pathlib
import re
import sys

# What each count may be at most. Lower a number when the tree shrinks; one that has to grow wants a reason in its commit.
MOST = {
    "lines of C++ in calibrate": 38300,
    "files of core and calibrate": 551,
    "of them below 40 lines": 154,
    "files that start or wait for threads": 2,
    "files that decide whether a material meets the laboratory": 1,
    "lines of schemas written by hand": 282,
}


def counts(source):
    files = [file for part in ("core", "calibrate") for file in sorted((source / part).glob("**/*")) if file.suffix in (".h", ".cpp")]
    text = {file: file.read_text() for file in files}
    lines = {file: content.count("\n") for file, content in text.items()}

    def matching(pattern):
        return sum(bool(re.search(pattern, content)) for content in text.values())

    return {
        "lines of C++ in calibrate": sum(count for file, count in lines.items() if "calibrate" in file.relative_to(source).parts),
        "files of core and calibrate": len(files),
        "of them below 40 lines": sum(count < 40 for count in lines.values()),
        "files that start or wait for threads": matching(r"std::j?thread> |std::condition_variable"),
        "files that decide whether a material meets the laboratory": matching(r"\? Verdict::meets : "),
        "lines of schemas written by hand": (source / "data/schema/case.schema.json").read_text().count("\n"),
    }


if __name__ == "__main__":
    found = counts(pathlib.Path(sys.argv[1]).resolve())
    grown = {what: count for what, count in found.items() if count > MOST[what]}
    for what, count in found.items():
        print(f"{count:7} (at most {MOST[what]}) {what}")
    sys.exit(f"more than before: {', '.join(grown)}" if grown else 0)
