#!/usr/bin/env python3
"""Adds a normal law to a copy of the sources, following core/README.md, counts the files this takes, builds the engine and
simulates with it.

usage: throwaway_law.py SOURCE_DIR BUILD_DIR
"""

import pathlib
import shutil
import subprocess
import sys

SOURCE, BUILD = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
HERE = pathlib.Path(__file__).resolve().parent
MOST_FILES = 6  # that are no tests; a parameter of its own takes two more (calibrate/study/parameters.cpp and its JSON)

HEADER = """#pragma once

#include "core/laws/normal.h"

namespace pastefit {

/// Acts as Hertz does.
struct Throwaway : Hertz {
  static constexpr NormalLaw choice = NormalLaw::throwaway;
  static constexpr std::string_view word = "throwaway";
};

}  // namespace pastefit
"""

# In the last law's place, whichever that is.
EDITS = [("core/laws/materials.h", "  last = luding", "  throwaway,\n  last = throwaway"),
         ("core/laws/table.h", '#include "core/laws/sjkr.h"', '#include "core/laws/sjkr.h"\n#include "core/laws/throwaway.h"'),
         ("core/laws/table.h", "Epa, Luding>;", "Epa, Luding, Throwaway>;"),
         ("data/schema/laws.schema.json", '"luding"', '"luding","throwaway"')]


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def add_law(copy):
    (copy / "core/laws/throwaway.h").write_text(HEADER)
    for name, before, after in EDITS:
        text = (copy / name).read_text()
        if before not in text:
            sys.exit(f"{name} does not hold {before!r}: EDITS of {pathlib.Path(__file__).name} is out of date")
        (copy / name).write_text(text.replace(before, after, 1))
    run(sys.executable, copy / "data/schema/make_tables.py")


def changed(copy):
    files = {file.relative_to(copy) for part in ("core", "calibrate", "data") for file in (copy / part).rglob("*") if file.is_file()}
    return sorted(str(file) for file in files
                  if not (SOURCE / file).exists() or (SOURCE / file).read_bytes() != (copy / file).read_bytes())


def compiler_of(build):
    (line,) = (line for line in (build / "CMakeCache.txt").read_text().splitlines() if line.startswith("CMAKE_CXX_COMPILER:"))
    return line.split("=", 1)[1]


def main():
    copy, build = BUILD / "sources", BUILD / "build"
    shutil.rmtree(copy, ignore_errors=True)
    for part in ("core", "calibrate", "data"):
        shutil.copytree(SOURCE / part, copy / part, ignore=shutil.ignore_patterns("node_modules"))
    add_law(copy)
    files = changed(copy)
    print(f"a law takes {len(files)} files: {', '.join(files)}")
    if len(files) > MOST_FILES:
        sys.exit(f"more than {MOST_FILES}")
    shutil.copy(SOURCE / "CMakeLists.txt", copy)
    run("cmake", "-S", copy, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DPASTEFIT_TESTS=OFF")  # quicker to compile than without optimisation
    run("cmake", "--build", build, "--target", "pastefit_core")
    program = build / "throwaway_law"
    run(compiler_of(build), "-std=c++20", "-x", "c++", HERE / "throwaway_law.cc", "-x", "none", f"-I{copy}",
        build / "core/libpastefit_core.a", "-pthread", "-o", program)
    print(run(program), end="")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
