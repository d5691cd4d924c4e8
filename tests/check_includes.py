#!/usr/bin/env python3
"""Checks core and calibrate: folders include each other in one direction only, core includes nothing of calibrate, header names
and type names are unique, files include what they use, and file-local names are unique.

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
# the laws and words that its parameters have. A new kind of test needs no entry here but for decks of its own,
# and for a sheet that `pastefit new` asks for; `Packing` is declared there, too.
SLUMP_FILES = {
    "laboratory/heap_shape.cpp", "laboratory/reading_words.cpp", "laboratory/slump.cpp",
    "laboratory/slump.h", "laboratory/slump_curves.cpp", "laboratory/slump_drawing.cpp", "laboratory/test.cpp",
    "laboratory/test.h", "laboratory/yield_stress.cpp", "laboratory/yield_stress.h",
    "browser/calls.cpp", "exports/export.cpp", "exports/export.h", "exports/heap_dump.cpp", "exports/lammps.cpp",
    "exports/lammps_deck.cpp", "exports/lammps_deck.h", "exports/liggghts.cpp", "exports/liggghts_deck.cpp",
    "exports/liggghts_deck.h", "exports/elasto_plastic.cpp",
    "exports/parameter_table.cpp", "exports/yade.cpp",
    "python/tasks.cpp", "study/parameters.cpp", "study/sheet_columns.cpp", "study/sheet_table.cpp", "study/sheet_table.h", "study/slump_lab_template.cpp",
    "study/slump_sheet.cpp", "study/slump_study.cpp", "study/slump_sheet.h", "cli/new_command.cpp", "cli/plan_command.cpp",
    "cli/template_command.cpp",
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


# What stands at the left edge of a namespace: functions, types, constants and aliases.
DECLARED = [re.compile(pattern, re.M) for pattern in (
    r"^(?!return\b|namespace\b|using\b|struct\b|class\b|enum\b)[A-Za-z_][\w:<>,&*\s\[\]]*?[\s&*](\w+)\(",
    r"^(?:struct|class|enum class|enum) (\w+)(?!\w*;)",
    r"^(?:constexpr|const|static|thread_local|inline)\b[\w:<>,&*\s]*?\b(\w+)(?:\[\w*\])?\s*[={]",
    r"^using (\w+) =")]


def declared(text):
    return {found.group(1) for pattern in DECLARED for found in pattern.finditer(text)}


def without_texts(code):
    return re.sub(r'R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"', '""', code, flags=re.S)


def without_comments(code):
    return re.sub(r"//[^\n]*", "", without_texts(code))


def kept_to_itself(text):
    """Names that a source declares in its namespaces without a name."""
    return {name for part in re.findall(r"^namespace \{\n(.*?)^\}  // namespace$", without_texts(text), re.S | re.M)
            for name in declared(part)}


def names_twice(sources, headers):
    """Places of names that a source keeps to itself and another one of its folder has too, or a header has.
    Both arguments: {path: text}."""
    known, found = collections.defaultdict(list), []
    for header, text in headers.items():
        for name in declared(text):
            known[name].append(header)
    owners = collections.defaultdict(list)
    for source, text in sources.items():
        for name in kept_to_itself(text):
            owners[source.parent, name].append(source)
    for (_, name), places in sorted(owners.items()):
        places = places + known[name]
        if len(places) > 1:
            found.append(f"{name}: " + ", ".join(map(str, places)))
    return found


# The header that declares it, for names that are used often and easily come along with another header.
STANDARD = {
    "algorithm": "sort stable_sort max min clamp find find_if any_of all_of none_of count_if transform copy_if remove_if "
                 "minmax_element max_element min_element lower_bound upper_bound nth_element ranges::sort ranges::find",
    "array": "array", "atomic": "atomic", "bit": "bit_cast", "charconv": "from_chars to_chars",
    "chrono": "chrono", "cmath": "sqrt sin cos tan exp log log10 pow hypot isfinite isnan abs floor ceil round cbrt",
    "cstdint": "int32_t int64_t uint8_t uint16_t uint32_t uint64_t", "deque": "deque", "filesystem": "filesystem",
    "fstream": "ifstream ofstream", "functional": "function", "future": "future async", "limits": "numeric_limits",
    "map": "map multimap", "memory": "unique_ptr shared_ptr make_unique make_shared",
    "mutex": "mutex lock_guard unique_lock scoped_lock", "numbers": "numbers", "numeric": "accumulate iota",
    "optional": "optional nullopt", "random": "mt19937_64", "set": "set multiset", "span": "span",
    "sstream": "ostringstream istringstream", "string": "string to_string", "string_view": "string_view",
    "thread": "thread", "tuple": "tuple tie", "variant": "variant get_if visit", "vector": "vector",
}
HEADER_OF = {name: header for header, names in STANDARD.items() for name in names.split()}


def included(file, texts):
    """What a file includes, and what that includes: project headers and standard headers."""
    found, waiting = set(), [file]
    while waiting:
        for header in re.findall(r'^#include [<"]([^>"]+)[>"]', texts.get(waiting.pop(), ""), re.M):
            if header not in found:
                found.add(header)
                waiting.append(header)
    return found


def missing_includes(texts):
    """What files use and do not come to include: {path: text} of all sources and headers."""
    homes = collections.defaultdict(set)
    for file, text in texts.items():
        if file.endswith(".h"):
            for name in re.findall(r"^(?:enum class|enum|class|struct) (\w+)[^;(]*\{", text, re.M):
                homes[name].add(file)
    missing = []
    for file, text in texts.items():
        code, reached = without_comments(text), included(file, texts) | {file}
        own = set(re.findall(r"\b(?:enum class|class|struct|typename|concept|using|enum) (\w+)", " ".join(
            without_comments(texts.get(header, "")) for header in reached)))
        missing += {f"{file}: <{HEADER_OF[name]}> for std::{name}"
                    for name in re.findall(r"\bstd::((?:ranges::)?\w+)", code)
                    if name in HEADER_OF and HEADER_OF[name] not in reached}
        missing += {f"{file}: {min(homes[name])} for {name}" for name in set(re.findall(r"\b[A-Z]\w+\b", code))
                    if homes[name] and name not in own}
    return sorted(missing)


# A name that was given to a thing by exchanging a word everywhere; in a sentence it stands in backquotes or as a member.
EXCHANGED = re.compile(r"(?<![`.\w(])(?:predictive_variance|misfit_posterior|replicate_variance|training_data)\b(?![`.(,])"
                       r"|\b(?:they|it|packings) variance\b")


def exchanged_words(text):
    return [word for comment in re.findall(r"//[^\n]*", text) for word in EXCHANGED.findall(comment)]


def graph_of(pairs):
    graph = collections.defaultdict(set)
    for one, other in pairs:
        graph[one].add(other)
        graph[other]
    return graph


class Includes(unittest.TestCase):
    maxDiff = None

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

    def test_the_page_speaks_of_no_kind_of_test(self):
        words = re.compile(r"slump|mould|\bcone\b|drop[ _]?plate", re.I)
        page = SOURCE / "calibrate/report/page"
        files = [file for part in ("source", "style") for file in sorted((page / part).iterdir())]
        self.assertTrue(files)
        self.assertEqual([file.name for file in files if words.search(file.read_text())], [])

    def test_exchanged_words_are_seen(self):
        self.assertEqual(exchanged_words("// worth of predictive_variance\n/// `predictive_variance` is one\n// where they variance\n"),
                         ["predictive_variance", "they variance"])

    # Names were once exchanged by search and replace, in the sentences of comments too.
    def test_comments_hold_no_name_in_the_place_of_a_word(self):
        found = {str(file.relative_to(SOURCE)): words for file in FILES if (words := exchanged_words(file.read_text()))}
        self.assertEqual(found, {})

    def test_core_includes_nothing_of_calibrate(self):
        places = [place for (one, other), found in arrows().items() if one.startswith("core")
                  and other.startswith("calibrate") for place in found]
        self.assertEqual(places, [])

    def test_a_name_twice_is_seen(self):
        path = pathlib.PurePath
        own = "namespace {\ndouble half(double x) {\n  return x / 2;\n}\n}  // namespace\n"
        self.assertEqual(names_twice({path("a/one.cpp"): own, path("b/two.cpp"): own}, {}), [])
        self.assertEqual(names_twice({path("a/one.cpp"): own, path("a/two.cpp"): own}, {}),
                         ["half: a/one.cpp, a/two.cpp"])
        self.assertEqual(names_twice({path("a/one.cpp"): own}, {path("c.h"): "int half(int x);\n"}),
                         ["half: a/one.cpp, c.h"])

    def test_a_missing_include_is_seen(self):
        use = "std::vector<Grain> x;\n"
        self.assertEqual(missing_includes({"a.cpp": use, "b.h": "struct Grain {\n"}),
                         ["a.cpp: <vector> for std::vector", "a.cpp: b.h for Grain"])
        self.assertEqual(missing_includes({"a.cpp": '#include "c.h"\n' + use, "b.h": "struct Grain {\n",
                                           "c.h": '#include "b.h"\n#include <vector>\n'}), [])

    # The files of a folder are compiled as one (CMakeLists.txt): another file's name would be found, and the program would
    # silently be another one.
    def test_a_name_that_a_file_keeps_to_itself_is_nobody_elses(self):
        texts = {file.relative_to(SOURCE): file.read_text() for file in FILES}
        self.assertEqual(names_twice({file: text for file, text in texts.items() if file.suffix == ".cpp"},
                                     {file: text for file, text in texts.items() if file.suffix == ".h"}), [])

    def test_files_come_to_include_what_they_use(self):
        self.assertEqual(missing_includes({str(file.relative_to(SOURCE)): file.read_text() for file in FILES}), [])

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
