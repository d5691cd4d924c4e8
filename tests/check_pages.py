"""Reads every page of the project: none names a commit outside of tests/results, pages are short, links lead somewhere, and the
manual is in plain words.

usage: check_pages.py SOURCE_DIR [unittest options]
"""

import os
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()


def files(*endings):
    """{path: text} of the tree's own files with one of these endings."""
    found = {}
    for folder, inner, names in os.walk(SOURCE):
        inner[:] = [name for name in inner if name not in ("build", "built", "out", "node_modules") and name[0] != "."]
        found |= {str((pathlib.Path(folder) / name).relative_to(SOURCE)): (pathlib.Path(folder) / name).read_text()
                  for name in names if name.endswith(endings)}
    return found


PAGES = files(".md")
RECORD = "tests/results/"  # the one place for what was measured, and with which commit
MANUAL = "calibrate/manual/"
MOST_WORDS = {"README.md": 900}  # code and tables included
MOST_WORDS_OF_MANUAL = 1500
MOST_WORDS_OF_RESULT = 2000   # of a page of tests/results
MOST_WORDS_OF_RECORD = 9000   # of all of them
MOST_LINES = 80  # of a folder's README
MOST_LINKS_TO_RECORD = 5  # from all of the manual: it says what is so, the record how that was measured

# What somebody who was not here looks for, and the page that says it. From the main README it is at most two links away.
QUESTIONS = {
    "where a slump's spread is read": "core/apparatus/slump/README.md",
    "where the polynomial is evaluated": "core/README.md",
    "where NLopt is called": "calibrate/search/README.md",
    "how to add a law": "core/README.md#to-add-a-law",
    "why the default step is safe": "core/step/README.md#why-the-default-step-is-safe",
    "how the search decides to stop": "calibrate/manual/theory.md#search",
    "how to type a card into EDEM": "calibrate/manual/other-programs.md#edem",
    "which tests are slow": "tests/README.md",
    "where a message is worded": "calibrate/README.md",
}

# Words that no page of the manual needs, each with what to write instead (tests/style.md). Text in backticks and in blocks is
# not read: what the program prints is quoted as it prints it.
AVOIDED = {
    r"tells?|told|telling": "determines, shows, prints",
    r"says?|said|saying": "gives, states, prints",
    r"stands?|standing|stood": "is; keeps its shape; represents",
    r"holds?|holding|held": "contains; is valid; fixed; validation test",
    r"meets?|met": "is within its tolerance; reproduces; is confirmed",
    r"(?<!in )the laboratory(?!\s+file|'s)": "the measurement",
    r"whoever|whichever|whatever|nobody|somebody": "name the subject",
    r"luck\w*|lucky|unlucky": "noise, by chance",
    r"to speak of|hangs? on|makes? good|make up for|goes? on|as well have": "depends on; compensates; continues",
    r"refuted": "is an error; rejected",
}


def commits_in(text):
    """Words that look like a commit: seven hexadecimal digits or more that mix digits and letters, or that are called one."""
    words = re.findall(r"(?<![\w.#/-])[0-9a-f]{7,40}(?![\w.])", text)
    mixed = [word for word in words if re.search(r"\d", word) and re.search(r"[a-f]", word)]
    return sorted(set(mixed) | set(re.findall(r"\bcommit ([0-9a-f]{7,40})\b", text)))


def prose(text):
    """Markdown without its code, neither in blocks nor in a line; a heading keeps its words in backticks."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    lines = [line for line in text.splitlines() if not line.startswith("    ")]
    return "\n".join(line if line.startswith("#") else re.sub(r"`[^`]*`", "", line) for line in lines)


def avoided_words(text):
    """[(line, word, what to write instead)] of what `AVOIDED` finds in the prose of a page; targets of links are not read."""
    def blank(quoted):
        return re.sub(r"[^\n]", " ", quoted[0])

    for quotation in (r"^( *)```.*?^\1```$", r"^ {4}.*$", r"`[^`\n]*`", r"\]\([^)]*\)", r"\"[^\"\n]*\""):
        text = re.sub(quotation, blank, text, flags=re.M | (re.S if "```" in quotation else 0))
    return [(text.count("\n", 0, word.start()) + 1, word[0], instead) for pattern, instead in AVOIDED.items()
            for word in re.finditer(rf"\b(?:{pattern})\b", text, re.I)]


def anchors(text):
    """What a link can point at on a page: its headings, as GitHub and GitLab name them."""
    found, seen = [], {}
    for heading in re.findall(r"^#+ +(.*?) *$", prose(text), re.M):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = re.sub(r"[^\w -]", "", words).replace(" ", "-")
        found.append(f"{name}-{seen[name]}" if name in seen else name)
        seen[name] = seen.get(name, 0) + 1
    return found


def dead_links(pages, exists):
    """Links of {path: text} that lead to no file or no heading; exists(path) says whether a file is there."""
    found = []
    for page, text in pages.items():
        for link in re.findall(r"\]\(([^)\s]+)\)", prose(text)):
            place, _, anchor = link.partition("#")
            if re.match(r"\w+:", link):
                continue
            target = normal(pathlib.PurePosixPath(page).parent / place) if place else page
            if not exists(target) or (anchor and anchor not in anchors(pages.get(target, ""))):
                found.append(f"{page}: {link}")
    return found


def linked(page, text):
    """Pages that a page links to."""
    links = [link.partition("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", prose(text))]
    return {normal(pathlib.PurePosixPath(page).parent / link) for link in links if link and not re.match(r"\w+:", link)}


def normal(path):
    parts = []
    for part in pathlib.PurePosixPath(path).parts:
        if part == ".." and parts:
            parts.pop()
        else:
            parts.append(part)
    return str(pathlib.PurePosixPath(*parts))


def named_in_sources():
    """{page: sources} of the pages that sources name by their path from the root."""
    found = {}
    for file, text in files(".h", ".cpp", ".py", ".txt", ".json", ".js").items():
        for page in re.findall(r"\b((?:core|calibrate|data|tests)/[\w/-]*\w\.md)\b", text):
            found.setdefault(page, set()).add(file)
    return found


class Pages(unittest.TestCase):
    maxDiff = None

    def test_a_commit_is_seen(self):
        self.assertEqual(commits_in("of commit 2829717, and 55ee716; not 1000000, deadbeef, 0.5000001 or 18446744073709551615"),
                         ["2829717", "55ee716"])

    def test_a_dead_link_is_seen(self):
        pages = {"a/README.md": "# One\n[there](../b.md#two) [gone](../c.md) [no heading](../b.md#three) [here](#one)\n",
                 "b.md": "## Two\n"}
        self.assertEqual(dead_links(pages, pages.__contains__), ["a/README.md: ../c.md", "a/README.md: ../b.md#three"])

    def test_no_page_outside_of_the_record_names_a_commit(self):
        found = {page for page, text in PAGES.items() if not page.startswith(RECORD) and commits_in(text)}
        self.assertEqual(found, set())

    def test_readmes_are_short(self):
        found = {page for page, text in PAGES.items() if pathlib.PurePath(page).name == "README.md" and page != "README.md"
                 and len(text.splitlines()) > MOST_LINES}
        self.assertEqual(found, set())

    def test_pages_are_short(self):
        most = ({page: MOST_WORDS_OF_MANUAL for page in PAGES if page.startswith(MANUAL)} |
                {page: MOST_WORDS_OF_RESULT for page in PAGES if page.startswith(RECORD)} | MOST_WORDS)
        # Without the rules of tables, but for the main README.
        words = {page: sum(word != "|" or page in MOST_WORDS for word in PAGES[page].split()) for page in most}
        self.assertEqual({page: count for page, count in words.items() if count > most[page]}, {})
        self.assertLessEqual(sum(count for page, count in words.items() if page.startswith(RECORD)), MOST_WORDS_OF_RECORD)

    def test_an_avoided_word_is_seen(self):
        self.assertEqual([word for _, word, _ in avoided_words("It tells `what it says`; the laboratory\nfile is in the laboratory.\n")],
                         ["tells"])

    def test_the_manual_is_in_plain_words(self):
        found = [f"{page}:{line}: {word}: {instead}" for page, text in PAGES.items() if page.startswith(MANUAL)
                 for line, word, instead in avoided_words(text)]
        self.assertEqual(found, [])

    def test_the_manual_needs_few_measurements(self):
        links = [(page, link) for page, text in PAGES.items() if page.startswith(MANUAL)
                 for link in re.findall(r"\]\(([^)\s]*tests/results/[^)\s]*)\)", text)]
        self.assertLessEqual(len(links), MOST_LINKS_TO_RECORD, links)

    def test_links_lead_to_files_and_headings(self):
        self.assertEqual(dead_links(PAGES, lambda path: (SOURCE / path).exists()), [])

    def test_what_strangers_look_for_is_at_most_two_links_away(self):
        near = linked("README.md", PAGES["README.md"])
        near |= {there for page in near for there in linked(page, PAGES.get(page, ""))}
        for question, place in QUESTIONS.items():
            page, _, heading = place.partition("#")
            with self.subTest(question=question):
                self.assertIn(page, near)
                self.assertTrue(not heading or heading in anchors(PAGES[page]))

    def test_pages_that_sources_name_are_there(self):
        self.assertEqual({page: files for page, files in named_in_sources().items() if page not in PAGES}, {})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
