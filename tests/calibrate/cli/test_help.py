"""Help texts, man pages, and shell completion.

usage: test_help.py PROGRAM SOURCE_DIR [unittest options]
"""

import fcntl
import os
import re
import shutil
import struct
import subprocess
import sys
import termios
import unittest

from desk import CARD, PROGRAM, Desk, run, shown_on


def verbs():
    return re.findall(r"^  ([a-z-]+)  +\S", run("--help").stdout.split("\nStart:")[1], flags=re.M)


def options_of(verb):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", run(verb, "--help").stdout))


class Help(Desk):
    def written(self):
        self.assertEqual(run("help", "--write", self.folder / "manual").returncode, 0)
        return self.folder / "manual"

    def test_the_program_alone_prints_its_help_with_verbs_by_what_one_wants(self):
        alone = run()
        self.assertEqual((alone.returncode, alone.stdout), (0, run("--help").stdout))
        self.assertEqual(re.findall(r"^([A-Z][a-z ]+):$", alone.stdout, flags=re.M),
                         ["Options", "Start", "Calibrate", "Look", "Use elsewhere", "Check", "Many studies"])

    def test_help_of_a_verb_is_what_the_verb_says_itself(self):
        self.assertEqual(run("help").stdout, run("--help").stdout)
        for verb in verbs():
            self.assertEqual(run("help", verb).stdout, run(verb, "--help").stdout)
        self.fails(run("help", "calibrat"), 2, "calibrat", "did you mean 'calibrate'?")

    def test_lines_of_help_and_of_a_card_fit_80_columns(self):
        for arguments in (["--help"], ["show", CARD], *([verb, "--help"] for verb in verbs())):
            for line in run(*arguments).stdout.splitlines():
                self.assertLessEqual(len(line), 80, f"{arguments}: {line}")

    def test_a_bare_terminal_without_a_locale_gets_plain_lines(self):
        bare = {"PATH": os.environ["PATH"], "TERM": "dumb"}
        for arguments in ([], ["help", "new"], ["show", CARD], ["doctor", CARD], ["calibrat"], ["new", self.folder / "x", "--mould", "abrams"]):
            ours, theirs = self.terminal()
            with self.subTest(arguments=arguments), open(ours, "rb", buffering=0) as screen:
                result = subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=theirs, env=bare, timeout=60)
                os.write(theirs, b"end")
                os.close(theirs)
                shown = b""
                while not shown.endswith(b"end"):
                    shown += screen.read(65536)
                self.assertIn(result.returncode, (0, 1, 2))
                text = (result.stdout + shown).replace(b"\r\n", b"\n").decode("ascii")
                self.assertRegex(text, r"\A[\x20-\x7e\n]+\Z")

    def test_messages_on_a_terminal_are_broken_between_words(self):
        ours, theirs = self.terminal()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 40, 0, 0))
        arguments = ["simulate", CARD, "--set", "parameters.friction=7", "--seed", "1"]
        subprocess.run([PROGRAM, *map(str, arguments)], stderr=theirs, env={**os.environ, "TERM": "xterm"}, timeout=60)
        os.close(theirs)
        shown = shown_on(ours).replace("\r", "")
        plain = run(*arguments).stderr
        self.assertEqual(shown.split(), plain.split())
        self.assertIn("1 error\n", plain)
        self.assertGreater(max(map(len, plain.splitlines())), 40)
        for line in shown.splitlines():
            self.assertTrue(len(line) <= 40 or " " not in line.strip(), line)

    def test_every_verb_has_a_page_with_every_option(self):
        folder = self.written()
        self.assertGreaterEqual(len(verbs()), 11)
        for verb in verbs():
            page = (folder / f"pastefit-{verb}.1").read_text().replace("\\-", "-")
            for option in options_of(verb):
                self.assertIn(option, page)
            self.assertIn(f"pastefit-{verb}", (folder / "pastefit.1").read_text().replace("\\-", "-"))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_groff_has_nothing_to_say_of_the_pages(self):
        for page in self.written().glob("*.1"):
            result = subprocess.run(["groff", "-man", "-ww", "-z", page], capture_output=True, text=True, timeout=60)
            self.assertEqual((result.returncode, result.stderr), (0, ""), page.name)

    def test_bash_completes_verbs_and_the_options_of_each(self):
        script = self.written() / "pastefit.bash"

        def completed(*words):
            ask = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _pastefit; printf "%s\\n" "${COMPREPLY[@]}"'
            return set(subprocess.run(["bash", "-c", ask, "bash", script, "pastefit", *words], capture_output=True,
                                      text=True, check=True, timeout=60).stdout.split())

        self.assertEqual(completed("") - {"--help", "--version"}, set(verbs()))
        self.assertEqual(completed("cal"), {"calibrate"})
        for verb in verbs():
            self.assertEqual(completed(verb, "--"), options_of(verb))

    def test_zsh_and_fish_know_every_verb_and_option(self):
        folder = self.written()
        zsh, fish = (folder / "pastefit.zsh").read_text(), (folder / "pastefit.fish").read_text()
        for verb in verbs():
            of_zsh = set(re.search(rf"^  {verb}\) compadd -- (.*) ;;$", zsh, flags=re.M)[1].split())
            of_fish = set(re.findall(rf"subcommand_from {verb}' -l ([a-z0-9-]+)", fish))
            self.assertEqual(of_zsh, options_of(verb))
            self.assertEqual({f"--{name}" for name in of_fish}, options_of(verb))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
