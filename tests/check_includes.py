#!/usr/bin/env python3
"""Reads the #include lines of core and calibrate: folders include each other in one direction only, core nothing of
calibrate, no two headers have one file name, and no two types of one name are declared.

usage: check_includes.py SOURCE_DIR
"""

import collections
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
FILES = sorted(file for part in ("core", "calibrate") for file in (SOURCE / part).glob("**/*")
               if file.suffix in (".h", ".cpp"))

# Files that may speak of the slump test, its mould or its drop plate, outside of comments: its own, the decks of its test,
# the laws and words that its parameters have. A new kind of test needs no entry here but for decks of its own.
SLUMP_FILES = {
    "laboratory/heap_shape.cpp", "laboratory/heap_shape.h", "laboratory/slump.cpp", "laboratory/slump.h",
    "laboratory/slump_drawing.cpp", "laboratory/slump_template.cpp", "laboratory/test.cpp", "laboratory/test.h",
    "exports/edem_notes.cpp", "exports/export.cpp", "exports/export.h", "exports/lammps.cpp", "exports/lammps_deck.cpp",
    "exports/lammps_deck.h", "exports/lammps_tables.cpp", "exports/liggghts.cpp", "exports/mercurydpm.cpp",
    "exports/parameter_table.cpp", "exports/yade.cpp",
    "study/parameters.cpp",
}


def room_of(path):
    """The folder of a file. What lies in core itself is used on every floor, so that each file is a room of its own."""
    folder = str(path.parent)
    return str(path.with_suffix(".h")) if folder == "core" else folder


def arrows():
    """{(from, to): [places]} between rooms."""
    found = collections.defaultdict(list)
    for file in FILES:
        here = file.relative_to(SOURCE)
        for number, line in enumerate(file.read_text().splitlines(), 1):
            include = re.match(r'#include "((?:core|calibrate)/[^"]+)"', line)
            if not include:
                continue
            there = room_of(pathlib.PurePath(include.group(1)))
            if there != room_of(here):
                found[room_of(here), there].append(f"{here}:{number} includes {include.group(1)}")
    return found


def circle_in(graph):
    """Some circle as a list of rooms, the first one again at the end; nothing if there is none."""
    done, path = set(), []

    def visit(room):
        if room in path:
            return path[path.index(room):] + [room]
        if room in done:
            return None
        path.append(room)
        for there in sorted(graph[room]):
            if circle := visit(there):
                return circle
        done.add(path.pop())
        return None

    for room in sorted(graph):
        if circle := visit(room):
            return circle
    return None


def graph_of(pairs):
    graph = collections.defaultdict(set)
    for one, other in pairs:
        graph[one].add(other)
        graph[other]
    return graph


class Includes(unittest.TestCase):
    def test_a_circle_is_seen(self):
        self.assertEqual(circle_in(graph_of([("a", "b"), ("b", "c"), ("c", "a")])), ["a", "b", "c", "a"])
        self.assertIsNone(circle_in(graph_of([("a", "b"), ("b", "c"), ("a", "c")])))

    def test_folders_do_not_include_each_other_in_a_circle(self):
        found = arrows()
        circle = circle_in(graph_of(found))
        if circle:
            steps = [found[step][0] for step in zip(circle, circle[1:])]
            self.fail(" -> ".join(circle) + "\n" + "\n".join(steps))

    def test_only_its_own_files_know_the_slump_test(self):
        known = set()
        for file in FILES:
            here = file.relative_to(SOURCE)
            code = re.sub(r"//[^\n]*", "", file.read_text())
            if here.parts[0] == "calibrate" and re.search(r"slump|mould|drop_?plate", code, re.I):
                known.add(str(here.relative_to("calibrate")))
        self.assertEqual(known, SLUMP_FILES)

    def test_core_includes_nothing_of_calibrate(self):
        places = [place for (one, other), found in arrows().items() if one.startswith("core")
                  and other.startswith("calibrate") for place in found]
        self.assertEqual(places, [])

    def test_no_two_headers_have_one_name(self):
        headers = collections.defaultdict(list)
        for file in FILES:
            if file.suffix == ".h":
                headers[file.name].append(str(file.relative_to(SOURCE)))
        self.assertEqual([places for places in headers.values() if len(places) > 1], [])

    def test_no_two_types_have_one_name(self):
        types = collections.defaultdict(set)
        for file in FILES:
            if file.suffix == ".h":
                for name in re.findall(r"^(?:enum class|enum|class|struct) (\w+)[^;(]*\{", file.read_text(), re.M):
                    types[name].add(str(file.relative_to(SOURCE)))
        self.assertEqual([(name, sorted(places)) for name, places in types.items() if len(places) > 1], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
