#!/usr/bin/env python3
"""Counts measures of complexity, and fails if one exceeds its limit (`MOST`) or if a replaced word returns (`RETIRED`).

usage: check_structure.py SOURCE_DIR
"""

import pathlib
import re
import sys

# What each count may be at most. Lower a number when the tree shrinks; one that has to grow wants a reason in its commit.
MOST = {
    "lines of C++ in calibrate": 36731,
    "files of core and calibrate": 397,
    "of them below 40 lines": 41,
    "files that start or wait for threads": 2,
    "files that decide whether a material meets the laboratory": 1,
    "lines of schemas written by hand": 282,
    "files in which a reading has its name": 6,
    "files in which a law's parameter has its name": 14,
}

# Words that were given up: a reading is no observable, and an error is the largest difference over its tolerance (tests/style.md).
RETIRED = re.compile(r"\w*(?:observable|normalised_error|misfit_?unit_of|MisfitUnit|best_miss)\w*", re.I)

# Where an older word stays, since it stands on users' disks or in their scripts, or is a name of somebody else's.
KEPT = {
    "calibrate/card/card_json.cpp": {"observables"},  # key of cards of versions 4 and 5
    "calibrate/cli/simulate_command.cpp": {"observables"},  # key of `simulate --json`
    "core/laws/figures.py": {"observables"},  # which reads that key
    "calibrate/manual/figures.py": {"observables"},
    "calibrate/store/store.cpp": {"observables"},  # column of stores
    "calibrate/python/pastefit/search.py": {"observables"},  # gest-api's word in a VOCS
    "calibrate/manual/python.md": {"observables"},
    "calibrate/python/module.cpp": {"best_miss"},  # key of what `progress` is told
    "calibrate/python/pastefit/calibration.py": {"best_miss"},
    "calibrate/python/pastefit/progress.py": {"best_miss"},
    "calibrate/report/README.md": {"Observable"},  # Observable Plot
    "calibrate/report/page/source/plots.js": {"observablehq"},
}


def retired_words(source):
    """Those of core and calibrate, with their places."""
    written = re.compile(r"\.(?:h|cpp|md|py|pyi|js)$")
    files = [file for part in ("core", "calibrate") for file in sorted((source / part).glob("**/*"))
             if written.search(file.name) and not {"node_modules", "built"} & set(file.parts)]
    return [f"{place}:{number}: {word}" for file in files for place in [file.relative_to(source).as_posix()]
            for number, line in enumerate(file.read_text().split("\n"), 1) for word in RETIRED.findall(line)
            if word not in KEPT.get(place, ())]


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
        "files in which a reading has its name": matching(r"plateau_width"),
        "files in which a law's parameter has its name": matching(r"cohesion_energy_density"),
        "lines of schemas written by hand": (source / "data/schema/case.schema.json").read_text().count("\n"),
    }


if __name__ == "__main__":
    source = pathlib.Path(sys.argv[1]).resolve()
    found = counts(source)
    grown = {what: count for what, count in found.items() if count > MOST[what]}
    for what, count in found.items():
        print(f"{count:7} (at most {MOST[what]}) {what}")
    errors = [f"more than before: {', '.join(grown)}"] if grown else []
    errors += [f"{place}, a word that was given up: see RETIRED" for place in retired_words(source)]
    sys.exit("\n".join(errors) or 0)
