"""Broken or malicious input.

usage: test_hostile_input.py PROGRAM SOURCE_DIR [unittest options]
"""

import ast
import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as xml

from desk import CARD, coarse_card, LAB, PROGRAM, APPARATUS, SOURCE, STUDY, Desk, run, size_of, told_to_end

# A line break, commands of the decks, quotation marks, an encoding of Python, and controls of a terminal.
TITLE = ('paste\nshell touch pwned\r\nprint("""x""")\n"""\nimport os; os.mkdir("pwned")\n# coding: utf-7\n'
         '<b>&amp;${x}` & \u001b]0;owned\u0007\u009b2J\u2028\u202e\\')


class HostileInput(Desk):
    def changed(self, file, name, change):
        """A copy of a shipped file, changed."""
        document = json.loads(file.read_text())
        change(document)
        copy = self.folder / name
        copy.write_text(json.dumps(document))
        return copy

    def titled(self, file):
        return self.changed(file, "titled.json", lambda document: document.update(title=TITLE))

    def assert_harmless_in_terminal(self, text):
        for character in text:
            code = ord(character)
            self.assertTrue(character in "\n\t" or 0x20 <= code < 0x7f or code >= 0xa0, f"U+{code:04X}")
            self.assertNotIn(character, "\u2028\u2029\u202a\u202b\u202c\u202d\u202e")

    # titles

    def test_a_title_in_a_deck_is_a_comment_of_one_line(self):
        plain, titled = coarse_card(), self.titled(coarse_card())
        for target, decks in (("lammps", ("in.slump", "in.two_grains", "material.inc")),
                              ("liggghts", ("in.slump", "in.two_grains", "material.inc")), ("yade", ("material.py",))):
            with self.subTest(target):
                for name, card in (("plain", plain), ("titled", titled)):
                    result = run("export", "--unconfirmed", card, "--to", target, "--out", self.folder / target / name)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assert_harmless_in_terminal(result.stdout)
                for deck in decks:
                    before, after = ((self.folder / target / name / deck).read_text() for name in ("plain", "titled"))
                    # The reader of a deck goes by lines: nothing but one comment differs.
                    different = [pair for pair in zip(before.split("\n"), after.split("\n")) if pair[0] != pair[1]]
                    self.assertEqual(len(before.split("\n")), len(after.split("\n")))
                    self.assertEqual(len(different), 1)
                    comment = different[0][1]
                    self.assertRegex(comment, r'^# [^"&$\\`]*$')
                    self.assert_harmless_in_terminal(comment)

    def test_a_title_in_a_module_of_python_runs_nothing(self):
        result = run("export", "--unconfirmed", self.titled(coarse_card()), "--to", "yade", "--out", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        module = (self.out / "material.py").read_bytes()
        self.assertNotIn(b"coding", b"\n".join(module.split(b"\n")[:2]))
        for statement in ast.walk(ast.parse(module)):
            self.assertNotIn("pwned", ast.dump(statement) if isinstance(statement, ast.stmt) else "")

    def test_a_title_drives_no_terminal(self):
        card = self.titled(CARD)
        shown = run("show", card).stdout
        self.assert_harmless_in_terminal(shown)
        self.assertIn("paste shell touch pwned", shown.split("\n")[0])
        checked = run("check", "--quick", card, "--junit", self.folder / "checked.xml")
        self.assert_harmless_in_terminal(checked.stdout)
        xml.parse(self.folder / "checked.xml")
        answer = run("check", "--quick", "--json", card).stdout
        self.assert_harmless_in_terminal(answer)
        self.assertEqual(json.loads(answer)["cards"][0]["title"], TITLE)
        self.assert_harmless_in_terminal(run("simulate", self.folder / "\u001b[2J.json").stderr)

    def test_bytes_that_are_no_text_are_no_bug(self):
        name = os.fsencode(self.folder) + b"/card-\xff.json"
        shutil.copy(CARD, name)
        for arguments in (["show"], ["check", "--quick", "--json"]):
            result = subprocess.run([PROGRAM, *arguments, name], capture_output=True, timeout=120)
            self.assertEqual(result.returncode, 0, result.stderr)
            result.stdout.decode()
        shutil.copy(coarse_card(), name)
        reasons = [PROGRAM, "check", name, "--rebaseline", "--packings", "2", "--why", b"grains \xff"]
        self.assertEqual(subprocess.run(reasons, capture_output=True, timeout=120).returncode, 0)
        self.assertEqual(json.loads(pathlib.Path(os.fsdecode(name)).read_text())["rebaselined"][-1]["why"], "grains \ufffd")
        table = [PROGRAM, "batch", "--table", STUDY, "--out", os.fsencode(self.folder) + b"/\xff"]
        self.assertEqual(subprocess.run(table, capture_output=True, timeout=120).returncode, 0)
        result = subprocess.run([PROGRAM, "simulate", CARD, "--set", b"title=\xff"], capture_output=True, timeout=120)
        self.assertEqual(result.returncode, 2, result.stderr)
        result.stderr.decode()

    # scenes that lack something

    def test_a_case_without_what_its_formula_needs_is_bad_input(self):
        for case in sorted((SOURCE / "tests/cases").glob("*.json")):
            document = json.loads(case.read_text())
            for key, least in (("walls", 0), ("grains", 0), ("grains", 1)):
                if len(document.get("scene", {}).get(key, [])) <= least:
                    continue
                with self.subTest(f"{case.name}: {least} {key}"):
                    lacking = self.folder / "case.json"
                    scene = {**document["scene"], key: document["scene"][key][:least]}
                    lacking.write_text(json.dumps({**document, "scene": scene}))
                    result = run("verify", lacking)
                    self.assertIn(result.returncode, (0, 1, 2), result.stderr)

    def test_the_softest_grains_are_a_classified_failure(self):
        result = run("simulate", STUDY, "--set", "parameters.youngs_modulus_pa=100000")
        self.fails(result, 1, "the simulation failed: excessive_overlap")

    def test_grains_that_are_no_objects_are_bad_input(self):
        case = SOURCE / "tests/cases/free-fall.json"
        self.fails(run("verify", self.changed(case, "case.json", lambda one: one["scene"].update(grains=[0.1]))), 2,
                   "grains[0]")

    # files that are there

    def test_no_verb_replaces_a_file_that_is_there_without_force(self):
        precious = self.folder / "lab.json"
        precious.write_text("precious")
        for verb in (["rescale", CARD, "--radius", "9", "--packings", "0", "--out", precious],
                     ["check", "--quick", CARD, "--junit", precious]):
            with self.subTest(verb[0]):
                self.fails(run(*verb), 2, str(precious), "--force")
                self.assertEqual(precious.read_text(), "precious")
                self.assertEqual(run(*verb, "--force").returncode, 0)
                self.assertNotEqual(precious.read_text(), "precious")
                precious.write_text("precious")
                verb[-1] = self.folder / "no" / "where"
                self.fails(run(*verb), 2, "no/where")
                verb[-1] = self.folder
                self.fails(run(*verb), 2, "is a folder")

    def test_resuming_replaces_nothing_that_is_not_of_the_run(self):
        self.out.mkdir()
        (self.out / "card.json").write_text("precious")
        self.fails(run("calibrate", STUDY, "--out", self.out, "--resume"), 2, "card.json", "evaluations.sqlite")
        self.assertEqual((self.out / "card.json").read_text(), "precious")

    # numbers and paths

    def with_lab(self, change):
        return self.changed(LAB, "lab.json", change)

    def test_options_take_no_more_and_no_less_than_a_number_in_its_range(self):
        calibrate, export = ["calibrate", STUDY, "--out", self.out], ["export", CARD, "--to", "csv", "--out", self.out]
        for verb, option in ((calibrate, "--wall-budget"), (calibrate, "--core-budget"), (calibrate, "--seed"),
                             (calibrate, "--budget"), (["simulate", APPARATUS], "--seed"), (["simulate", APPARATUS], "--time-step"),
                             (["simulate", APPARATUS, "--out", self.out], "--vtk"), (["check", CARD], "--false-alarm"),
                             (["rescale", CARD], "--radius"), (export, "--packing")):
            for value in ("nan", "-nan", "inf", "-1", "1e999", "0x10", "7x", "9" * 300):
                with self.subTest(f"{verb[0]} {option} {value[:9]}"):
                    result = run(*verb, f"{option}={value}")
                    self.fails(result, 2, option, "give")
                    self.assertLess(max(map(len, result.stderr.split("\n"))), 200)
        self.assertFalse(self.out.exists())

    @unittest.skipUnless(shutil.which("taskset"), "no taskset")
    def test_threads_are_no_more_than_the_processors_that_are_allowed(self):
        one = str(min(os.sched_getaffinity(0)))
        command = ["taskset", "-c", one, PROGRAM, "simulate", str(APPARATUS), "--set", "grains.radius_mm=14", "--threads", "2"]
        self.assertIn("this machine has 1 processors", subprocess.run(command, capture_output=True, text=True).stderr)

    def test_a_budget_that_is_too_small_is_blamed_on_the_option(self):
        result = run("calibrate", STUDY, "--out", self.out, "--budget", "2")
        self.fails(result, 2, "--budget: 2; at least")
        self.assertNotIn(STUDY.name, result.stderr)

    def test_a_deviation_without_a_size_is_bad_input(self):
        def height(**reading):
            return self.with_lab(lambda lab: lab["measurements"].update({"step1.height_mm": reading}))
        self.fails(run("simulate", height(value=150, standard_deviation=1e-300)), 2, "must be 1e-06 to 10000")
        self.fails(run("simulate", height(repeats=[150, 150.0000000001])), 2, "repeats are all the same")

    def test_bytes_behind_the_end_of_a_file_are_bad_input(self):
        for tail in ("{}", "x", "\0", "\0\0 {}"):
            file = self.folder / "lab.json"
            file.write_text(LAB.read_text() + tail)
            self.fails(run("simulate", file), 2, "not JSON")

    def test_faults_speak_in_the_unit_and_the_quantity_of_the_key(self):
        def mould(**size):
            return self.changed(APPARATUS, "apparatus.json", lambda apparatus: apparatus["apparatus"]["mould"].update(size))
        self.fails(run("simulate", mould(base_diameter_mm=5000)), 2,
                   "apparatus.mould.base_diameter_mm: is 5000 mm; give a number from 2 to 4000 mm",
                   "apparatus.table_length_mm: is 900 mm; give a number from 5000 to 10000 mm")
        self.fails(run("simulate", mould(height_mm=3000)), 2, "is 3000 mm; give a number from 1 to 2000 mm")

    def test_paths_that_lead_nowhere_are_called_what_they_are(self):
        circle = self.folder / "circle.json"
        circle.symlink_to(self.folder / "other.json")
        (self.folder / "other.json").symlink_to(circle)
        self.fails(run("simulate", circle), 2, "a symbolic link that goes in a circle")
        study = self.changed(STUDY, "study.json", lambda study: study.update(lab=f"{LAB}\0x"))
        self.fails(run("calibrate", study, "--out", self.out), 2, "holds a null byte")

    # where an apparatus comes from

    def test_a_preset_beside_the_laboratory_file_is_named(self):
        (self.folder / "apparatus").mkdir()
        apparatus = json.loads(APPARATUS.read_text())
        apparatus["grains"] = {"distribution": "mono", "radius_mm": 14}
        own = self.folder / "apparatus" / "abrams.json"
        own.write_text(json.dumps(apparatus))
        (self.folder / "mine").mkdir()

        def lab_of(document):
            document["apparatus"] = {"preset": "abrams"}
            document.pop("grains", None)
        lab = self.changed(LAB, "mine/lab.json", lab_of)
        told = f"the preset abrams is {own}, not the shipped one"
        self.assertIn(told, run("simulate", lab).stderr)
        study = self.small_study()
        study.write_text(study.read_text().replace("lab.json", "mine/lab.json"))
        self.assertIn(told, self.calibrates(study).stderr)
        self.assertIn(told, json.loads((self.out / "card.json").read_text())["tests"][0]["lab"]["notes"])
        shutil.rmtree(self.folder / "apparatus")
        self.assertNotIn("preset", run("simulate", lab, "--set", "grains.radius_mm=14").stderr)

    # signals

    def signalled(self, command, name, when):
        process = subprocess.Popen([PROGRAM, *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 60
        while not when() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.05)
        *output, used_s = told_to_end(process, name)
        self.assertLess(used_s, 5)
        return process.returncode, *output

    def test_a_stiff_simulation_gives_a_sign_of_life_and_ends_with_a_word(self):
        command = ["simulate", APPARATUS, "--set", "parameters.youngs_modulus_pa=100000000000"]
        process = subprocess.Popen([PROGRAM, *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        sign = next(line for line in process.stderr if "gone" in line)
        # A phase that has just begun has no rate yet; at its end least and most are the same.
        left = r"( \((\d+( \w+)? to )?\d+ \w+ left\))?"
        self.assertRegex(sign, rf"^fill\.(grow|sink){left}, \S+ s simulated, step \d+, \d+ s gone$")
        _, errors, used_s = told_to_end(process)
        self.assertLess(used_s, 5)
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("the run was asked to stop", errors)

    def test_a_hangup_ends_a_calibration_with_the_best_so_far(self):
        study = self.small_study(budget_simulations=400, screening=4, tolerance_mm=0.001)
        log = self.out / "evaluations.sqlite-wal"
        status, output, errors = self.signalled(["calibrate", study, "--out", self.out], signal.SIGHUP,
                                                lambda: size_of(log) > 100_000)
        self.assertEqual(status, 1, errors)
        self.assertEqual(json.loads((self.out / "card.json").read_text())["search"]["status"], "stopped")

    def test_an_interrupt_in_the_first_screening_leaves_the_best_so_far(self):
        study = self.small_study(budget_simulations=400, screening=390, tolerance_mm=0.001)

        def some_are_stored():
            file = self.out / "evaluations.sqlite"
            if size_of(file.with_name("evaluations.sqlite-wal")) == 0:
                return False
            with contextlib.closing(sqlite3.connect(file)) as store, contextlib.suppress(sqlite3.Error):
                rows = store.execute("SELECT run FROM evaluations WHERE failure = 'null'").fetchall()
                return sum(not json.loads(run).get("ended_early", False) for (run,) in rows) >= 2

        command = ["calibrate", study, "--out", self.out, "--threads", "1"]
        status, output, errors = self.signalled(command, signal.SIGINT, some_are_stored)
        self.assertEqual(status, 1, errors)
        self.assertIn("screening", errors)
        self.assertNotIn("confirmation", errors)
        self.assertEqual(json.loads((self.out / "card.json").read_text())["search"]["status"], "stopped")
        self.assertIn("this is the best material so far", output)

    def test_an_interrupt_before_the_first_simulation_is_through_says_that_resume_goes_on(self):
        study = self.small_study(budget_simulations=100, screening=60)
        self.changed(study, study.name, lambda one: one["parameters"].update(youngs_modulus_pa={"value": 1e11}))
        log = self.out / "evaluations.sqlite-wal"
        status, output, errors = self.signalled(["calibrate", study, "--out", self.out], signal.SIGINT, log.exists)
        self.assertEqual((status, output), (1, ""), errors)
        said = [line for line in errors.splitlines() if line.startswith("pastefit: ")]
        self.assertEqual(len(said), 1, errors)
        self.assertIn("no material to report: The search was stopped before a simulation had all its readings; --resume "
                      "continues", said[0])
        self.assertFalse((self.out / "card.json").exists())

    def test_an_output_folder_that_goes_away_is_seen_at_once(self):
        study = self.small_study(budget_simulations=400, screening=4, tolerance_mm=0.001)
        process = subprocess.Popen([PROGRAM, "calibrate", study, "--out", self.out], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while not (self.out / "evaluations.sqlite-wal").exists() and process.poll() is None:
            time.sleep(0.05)
        shutil.rmtree(self.out.rename(self.folder / "gone"))  # at once, whatever is being made in it
        start = time.monotonic()
        _, errors = process.communicate(timeout=60)
        self.assertLess(time.monotonic() - start, 30)
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("gone", errors)

    # exit status

    def small_study(self, **search):
        """A study of coarse grains with few simulations."""
        self.changed(LAB, "lab.json", lambda lab: lab.update(grains={"distribution": "mono", "radius_mm": 14}))
        few = dict(screening=2, budget_simulations=4, packings=1, confirmation_packings=1, examination_simulations=0,
                   rejected_share=1)

        def change(study):
            study["lab"] = "lab.json"
            study["search"].update({**few, **search})
        return self.changed(STUDY, "study.json", change)

    def test_only_a_confirmed_material_ends_in_status_0(self):
        result = run("calibrate", self.small_study(tolerance_mm=250, budget_simulations=8, confirmation_packings=4), "--out",
                     self.out)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        verdict = " ".join((self.out / "summary.txt").read_text().split())  # as lines are broken
        self.assertIn("The material reproduces the measurement", verdict)
        self.assertRegex(verdict, r"step1\.spread_mm was not fitted and is [0-9.]+ mm off, [0-9.]+ standard deviations\.$")

    def test_an_unconfirmed_material_is_written_and_ends_in_status_1(self):
        result = run("calibrate", self.small_study(tolerance_mm=0.001), "--out", self.out)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn(json.loads((self.out / "card.json").read_text())["search"]["status"],
                      ("unconfirmed", "out_of_reach"))

    def test_an_interrupted_calibration_ends_in_status_1(self):
        study = self.small_study(budget_simulations=400, screening=4, tolerance_mm=0.001)
        for budget_s in (1, 2, 4, 8, 16, 32, 64):  # until there is a material, however fast the machine is
            result = run("calibrate", study, "--out", self.out, "--force", "--wall-budget", budget_s)
            self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
            if (self.out / "card.json").exists():
                break
        self.assertEqual(json.loads((self.out / "card.json").read_text())["search"]["status"], "stopped")

    # the store

    def test_a_flipped_bit_of_the_store_changes_no_card(self):
        study = self.small_study(budget_simulations=8, screening=5)
        self.calibrates(study)
        card = (self.out / "card.json").read_text()
        store = self.out / "evaluations.sqlite"
        content = bytearray(store.read_bytes())
        place = re.search(rb'"step1\.height_mm":\d\d+\.\d', content).end()
        content[place] ^= 1  # a digit of a reading
        store.write_bytes(content)
        result = self.calibrates(study, "--resume")
        self.assertIn("damaged", result.stderr)
        self.assertEqual((self.out / "card.json").read_text(), card)

    def test_a_store_of_zero_bytes_is_said(self):
        study = self.small_study()
        self.calibrates(study)
        card = (self.out / "card.json").read_text()
        (self.out / "evaluations.sqlite").write_bytes(b"")
        result = self.calibrates(study, "--resume")
        self.assertIn("was empty", result.stderr)
        self.assertEqual((self.out / "card.json").read_text(), card)

    # standard output

    def test_a_full_or_closed_standard_output_is_an_error(self):
        verbs = (["--help"], ["--version"], ["template", "lab"], ["show", CARD], ["verify", "free-fall"],
                 ["rescale", CARD, "--radius", "9", "--packings", "0"],
                 ["simulate", APPARATUS, "--time-step", "0.01", "--json"],
                 ["export", CARD, "--to", "csv", "--out", self.out, "--force"])
        for verb in verbs:
            with self.subTest(verb[0]):
                with open("/dev/full", "w") as full:
                    result = subprocess.run([PROGRAM, *map(str, verb)], stdout=full, stderr=subprocess.PIPE, text=True)
                self.fails_with_output(result, "standard output")
                closed = " ".join(["exec", PROGRAM, *map(str, verb), ">&-"])
                self.fails_with_output(subprocess.run(closed, shell=True, stderr=subprocess.PIPE, text=True),
                                       "standard output")

    def fails_with_output(self, result, word):
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn(word, result.stderr)

    def test_a_reader_that_stops_reading_ends_no_run(self):
        piped = f"{PROGRAM} template lab | head -1"
        result = subprocess.run(piped, shell=True, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
