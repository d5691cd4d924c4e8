"""The command line: exit statuses, messages, and written files.

usage: test_command_line.py PROGRAM SOURCE_DIR [unittest options]
"""

import contextlib
import fcntl
import json
import os
import re
import resource
import sqlite3
import struct
import subprocess
import sys
import termios
import time
import unittest

import jsonschema
from desk import CARD, PROGRAM, SOURCE, LAB, APPARATUS, TWO, COARSE, Desk, run, shown_on, size_of, told_to_end
import schemas


class CommandLine(Desk):
    # what every command line has

    def test_help_and_version_are_answered(self):
        self.assertRegex(run("--version").stdout, r"^pastefit \d+\.\d+\.\d+\ncontact kernels: (AVX-512|AVX2|SSE2.*)\n$")
        for arguments in (["--help"], ["calibrate", "--help"], ["simulate", "--help"], ["template", "--help"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 0)
            self.assertIn("Usage: pastefit", result.stdout)

    def test_the_kernels_are_those_that_the_environment_names_and_a_wrong_name_is_an_error(self):
        bare = {name: value for name, value in os.environ.items() if name != "PASTEFIT_KERNELS"}
        for word, shown in (("sse2", "SSE2"), ("avx2", "AVX2"), ("avx512", "AVX-512")):
            result = run("--version", env={**bare, "PASTEFIT_KERNELS": word})
            if result.returncode == 2:  # another processor
                self.fails(result, 2, "PASTEFIT_KERNELS", word, "one of")
            else:
                self.assertIn(f"contact kernels: {shown}", result.stdout)
        for word in ("neon", "AVX2", "sse2 "):
            self.fails(run("verify", env={**bare, "PASTEFIT_KERNELS": word}), 2, "PASTEFIT_KERNELS", "sse2")
        self.assertEqual(run("--version", env={**bare, "PASTEFIT_KERNELS": ""}).returncode, 0)

    # runs

    def test_what_goes_to_one_file_stands_there_in_the_order_in_which_it_was_said(self):
        both = self.folder / "both.txt"
        with both.open("w") as file:
            arguments = ["simulate", APPARATUS, *COARSE, "--set", "parameters.strength_pa=3000", "--out", self.out]
            subprocess.run([PROGRAM, *map(str, arguments)], stdout=file, stderr=file, timeout=300, check=True)
        text = both.read_text()
        self.assertLess(text.index("particle-steps a second"), text.index("wrote "), text)

    def test_a_dry_run_tells_the_plan_and_writes_nothing_and_results_go_beside_the_study(self):
        study = self.study()
        plan = run("calibrate", study, "--dry-run")
        self.assertEqual((plan.returncode, plan.stderr), (0, ""))
        for word in ("Fitted readings", "step1.height_mm", "simulations of about", f"Results go to {study.with_suffix('')}"):
            self.assertIn(word, plan.stdout)
        self.assertEqual(sorted(os.listdir(self.folder)), ["lab.json", "study.json"])
        self.fails(run("calibrate", self.folder / "nothing.json", "--dry-run"), 2, "nothing.json")
        self.assertIn(run("calibrate", study, "--quiet").returncode, (0, 1))
        self.assertTrue((study.with_suffix("") / "card.json").exists())

    def test_calibrate_writes_a_card_that_simulate_reads_and_resume_repeats(self):
        result = self.calibrates(self.study(), "--threads", TWO)
        self.assertEqual(sorted(os.listdir(self.out)), ["card.json", "evaluations.sqlite", "report.html", "summary.txt", "views.json"])
        self.assertNotIn("\r", result.stderr)
        for word in ("screening", "simulations", "card.json"):
            self.assertIn(word, result.stderr)
        for word in ("strength_pa", "attraction at touch", "step1.height_mm", "measurement"):
            self.assertIn(word, result.stdout)
        card = json.loads((self.out / "card.json").read_text())
        jsonschema.validate(card, schemas.schema(SOURCE / "data", "card"))
        with contextlib.closing(sqlite3.connect(self.out / "evaluations.sqlite")) as store:
            (stored,) = store.execute("SELECT count(*) FROM evaluations").fetchone()
        self.assertEqual(stored, card["search"]["simulations"])

        again = run("simulate", self.out / "card.json", "--json")
        self.assertEqual(again.returncode, 0, again.stderr)
        height = json.loads(again.stdout)["observables"]["step1.height_mm"]
        self.assertEqual(len(card["confirmation"]["packings"]), 1)
        self.assertEqual(height, card["tests"][0]["readings"]["step1.height_mm"]["simulated"])

        self.fails(run("calibrate", self.study(), "--out", self.out), 2, "earlier result")
        kept = {file: (self.out / file).read_bytes() for file in ("card.json", "evaluations.sqlite", "report.html", "summary.txt", "views.json")}
        other = self.study(radius_mm=13)
        self.fails(run("calibrate", other, "--out", self.out, "--resume"), 2, "none of its", "grains", "--force")
        self.assertEqual({file: (self.out / file).read_bytes() for file in kept}, kept)
        resumed = self.calibrates(self.study(), "--resume")
        self.assertIn(f"{stored} known", resumed.stderr)
        with contextlib.closing(sqlite3.connect(self.out / "evaluations.sqlite")) as store:
            self.assertEqual(store.execute("SELECT count(*) FROM evaluations").fetchone(), (stored,))
        self.assertEqual(json.loads((self.out / "card.json").read_text()), card)

    def test_a_setting_of_the_study_is_checked_as_its_file_is_recorded_on_the_card_and_resumed_as_a_changed_study(self):
        study = self.study()
        self.fails(run("calibrate", study, "--out", self.out, "--set", "search.buget_simulations=3"), 2,
                   "study.json: search.buget_simulations", "did you mean")
        self.fails(run("calibrate", study, "--out", self.out, "--set", "parameters.friction.upper=-2"), 2, "parameters.friction")
        self.fails(run("calibrate", study, "--out", self.out, "--set", "friction"), 2, "is not path=value")
        self.assertFalse(self.out.exists())
        self.calibrates(study)
        plain = json.loads((self.out / "card.json").read_text())
        self.assertNotIn("settings", plain["provenance"])
        settings = ["parameters.strength_pa.upper=9000", "title=Another bound"]
        changed = [word for one in settings for word in ("--set", one)]
        result = self.calibrates(study, "--resume", *changed)
        self.assertIn("Changed since the last run: study.parameters.strength_pa", " ".join(result.stderr.split()))
        card = json.loads((self.out / "card.json").read_text())
        jsonschema.validate(card, schemas.schema(SOURCE / "data", "card"))
        self.assertEqual(card["provenance"]["settings"], settings)
        self.assertNotEqual(card["provenance"]["study_hash"], plain["provenance"]["study_hash"])
        self.assertEqual(card["material"]["free"]["strength_pa"]["upper"], 9000)
        self.assertIn("with parameters.strength_pa.upper=9000", run("show", self.out / "card.json").stdout)
        self.assertNotIn("made from another study", run("infer", study, "--from", self.out).stderr)

    def test_a_run_that_is_not_confirmed_ends_with_commands_that_run(self):
        study = self.study()
        study.write_text(study.read_text().replace('"tolerance_mm": 5', '"tolerance_mm": 0.001'))
        result = self.calibrates(study, "--threads", TWO)
        self.assertEqual(result.returncode, 1)
        end = result.stdout[result.stdout.index("Not confirmed: "):]
        self.assertIn("step1.height_mm is off by", end)
        commands = [line.strip() for line in end.splitlines() if line.startswith("    pastefit ")]
        self.assertIn(len(commands), (2, 3))
        self.assertNotIn("Ready to run", (self.out / "summary.txt").read_text())
        path = f"{os.path.dirname(os.path.abspath(PROGRAM))}:{os.environ['PATH']}"
        for command in commands:
            ran = subprocess.run(command, shell=True, capture_output=True, text=True, env={**os.environ, "PATH": path}, timeout=300)
            self.assertIn(ran.returncode, (0, 1), command + ran.stderr)

    def test_several_seeds_are_searched_each_in_its_folder_and_their_cards_compared(self):
        study = self.study()
        result = run("calibrate", study, "--seeds", "2", "--seed", "5", "--out", self.out, "--json")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        table = json.loads(result.stdout)
        self.assertEqual([(one["file"], one["seed"]) for one in table["cards"]], [("seed-5", 5), ("seed-6", 6)])
        self.assertIn("strength_pa", table["parameters"])
        self.assertEqual(table["without_card"], [])
        self.assertEqual(result.returncode == 0, all(one["confirmed"] for one in table["cards"]))
        alone = json.loads(run("compare", *(self.out / f"seed-{seed}/card.json" for seed in (5, 6)), "--json").stdout)
        self.assertEqual(alone["parameters"], table["parameters"])
        self.fails(run("calibrate", study, "--seeds", "2", "--seed", "5", "--out", self.out), 2, "earlier result", "seed-5")
        again = run("calibrate", study, "--seeds", "2", "--seed", "5", "--out", self.out, "--resume")
        self.assertIn("seed-6: finished before", again.stderr)
        self.assertIn("Parameters that differ", again.stdout)
        self.assertIn("of 2 searches confirmed a material", again.stdout)

    def test_coarse_grains_first_are_stored_beside_the_fine_ones_and_resume_repeats_nothing(self):
        search = dict(screening=2, budget_simulations=4, packings=1, confirmation_packings=1, rejected_share=1, coarse_first=True)
        study = self.study(search=search)
        result = self.calibrates(study)
        self.assertRegex((self.out / "summary.txt").read_text(), r"\d+ simulations and \d+ with coarse grains")
        card = json.loads((self.out / "card.json").read_text())
        with contextlib.closing(sqlite3.connect(self.out / "evaluations.sqlite")) as store:
            query = "SELECT count(*), sum(CAST(packing AS INTEGER) >= 1 << 40) FROM evaluations"
            stored, coarse = store.execute(query).fetchone()
        self.assertGreaterEqual(coarse, 2)
        self.assertEqual(stored - coarse, card["search"]["simulations"])
        self.assertTrue(all(packing < 1 << 40 for packing in card["confirmation"]["packings"]))
        resumed = self.calibrates(study, "--resume")
        self.assertEqual(json.loads((self.out / "card.json").read_text()), card)
        # As of a search that was stopped while it had looked with coarse grains only.
        with contextlib.closing(sqlite3.connect(self.out / "evaluations.sqlite")) as store:
            store.execute("DELETE FROM evaluations WHERE CAST(packing AS INTEGER) < 1 << 40")
            store.commit()
        self.calibrates(study, "--resume")
        self.assertEqual(json.loads((self.out / "card.json").read_text()), card)

        lab = json.loads((self.folder / "lab.json").read_text())
        lab["grains"] = {"distribution": "mono", "radius_mm": 15}  # half as large again, two would fill the mould's mouth
        (self.folder / "lab.json").write_text(json.dumps(lab))
        other = self.folder / "other"
        self.fails(run("calibrate", study, "--out", other), 2, "coarse_first", "grains")
        self.assertFalse(other.exists())

    def test_an_interrupt_ends_within_seconds_and_resume_ends_where_an_undisturbed_run_does(self):
        study = self.study(budget=8, screening=5)
        command = [PROGRAM, "calibrate", str(study), "--out", str(self.out), "--threads", "1"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        store = self.out / "evaluations.sqlite-wal"
        while size_of(store) <= 30000 and process.poll() is None:
            time.sleep(0.05)
        _, errors, used_s = told_to_end(process)
        self.assertLess(used_s, 2)
        self.assertIn(process.returncode, (0, 1), errors)
        self.calibrates(study, "--resume", "--threads", "1")
        undisturbed = self.folder / "undisturbed"
        self.calibrates(study, "--threads", TWO, out=undisturbed)
        self.assertEqual((self.out / "card.json").read_text(), (undisturbed / "card.json").read_text())

    def test_a_changed_study_goes_on_with_what_still_holds_and_names_what_changed(self):
        self.calibrates(self.study(budget=12, screening=8))
        file = self.study(budget=12, screening=8)
        study = json.loads(file.read_text())
        study["parameters"]["strength_pa"]["free"] = [400, 30000]
        file.write_text(json.dumps(study))
        lab = json.loads((self.folder / "lab.json").read_text())
        lab["measurements"]["step1.height_mm"] = {"repeats": [148, 151, 158]}
        (self.folder / "lab.json").write_text(json.dumps(lab))
        result = self.calibrates(file, "--resume")
        self.assertIn("study.parameters.strength_pa.free", result.stderr)
        self.assertIn("measurements.step1.height_mm", result.stderr)
        self.assertRegex(result.stderr, r"[1-9][0-9]* stored candidates lie within")
        card = json.loads((self.out / "card.json").read_text())
        self.assertEqual(card["material"]["free"]["strength_pa"]["lower"], 400)
        self.assertEqual(card["tests"][0]["readings"]["step1.height_mm"]["repeats"], 3)
        again = run("calibrate", file, "--out", self.out, "--resume")
        self.assertNotIn("Changed since", again.stderr)
        self.assertEqual(json.loads((self.out / "card.json").read_text()), card)

    def test_several_tests_are_fitted_together_and_a_hold_out_is_predicted(self):
        file = self.study(budget=30, screening=4)
        lab = json.loads((self.folder / "lab.json").read_text())
        lab["apparatus"]["lift_velocity_mm_s"] = 300
        (self.folder / "fast.json").write_text(json.dumps(lab))
        study = json.loads(file.read_text())
        weights = study.pop("weights")
        del study["lab"]
        study["tests"] = [{"name": "later", "lab": "fast.json", "hold_out": True, "weights": weights},
                          {"name": "slow", "lab": "lab.json", "weights": weights},
                          {"name": "fast", "lab": "fast.json", "weights": weights}]
        study["search"]["confirmation_packings"] = 2
        study["parameters"]["formation_ratio"]["prior"] = {"value": 0.8, "standard_deviation": 0.1}
        file.write_text(json.dumps(study))
        result = self.calibrates(file)
        for words in ("slow/step1.height_mm", "Test fast", "Test later, validation test", "Validation test later",
                      "formation_ratio had the prior 0.8 +- 0.1"):
            self.assertIn(words, result.stdout)
        card = json.loads((self.out / "card.json").read_text())
        jsonschema.validate(card, schemas.schema(SOURCE / "data", "card"))
        self.assertEqual([test["name"] for test in card["tests"]], ["slow", "fast", "later"])
        slow, fast, later = card["tests"]
        self.assertNotIn("within_noise", slow)
        self.assertIn("within_noise", later)
        self.assertNotIn("within_noise", fast)
        self.assertEqual(fast["readings"]["step1.height_mm"]["simulated"],
                         later["readings"]["step1.height_mm"]["simulated"])  # the same test, fitted and predicted
        self.assertLessEqual(card["search"]["simulations"], 30)
        self.assertEqual(run("check", self.out / "card.json").returncode, 0)
        self.assertEqual(run("export", "--unconfirmed", self.out / "card.json", "--to", "csv", "--out", self.folder / "csv").returncode, 0)
        self.assertEqual(run("simulate", file, *COARSE).returncode, 0)
        heights = [json.loads(run("simulate", file, "--json", "--test", name).stdout)["observables"]["step1.height_mm"]
                   for name in ("fast", "later")]
        self.assertEqual(heights[0], heights[1])  # the same laboratory file

    def test_core_seconds_end_a_run_with_the_best_so_far(self):
        result = run("calibrate", self.study(budget=500, screening=400), "--out", self.out, "--core-budget", "1.5")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertIn("stopped", result.stdout + result.stderr)

    def test_the_summary_says_what_the_data_determine_and_the_card_keeps_it(self):
        result = self.calibrates(self.study(budget=16, screening=6))
        self.assertIn("5 parameters are free, and 1 fitted reading fixes at most 1 combination", result.stderr)
        for words in ("What the readings determine", "What to measure next", "Materials expected to fit these readings"):
            self.assertIn(words, (self.out / "summary.txt").read_text())
        card = json.loads((self.out / "card.json").read_text())
        named = set(card.get("not_identified", {})) | set(card.get("intervals", {}).get("parameters", {}))
        self.assertEqual(named, {"strength_pa", "rupture_force_ratio", "curvature", "rupture_gap_ratio",
                                 "formation_ratio"})
        with contextlib.closing(sqlite3.connect(self.out / "evaluations.sqlite")) as store:
            (stored,) = store.execute("SELECT count(*) FROM evaluations").fetchone()
        self.assertLessEqual(stored, 16)

    def test_infer_says_what_the_stored_simulations_tell_and_simulates_nothing(self):
        study = self.study(budget=16, screening=6)
        self.calibrates(study)
        files = ("card.json", "evaluations.sqlite", "summary.txt")
        kept = {file: (self.out / file).read_bytes() for file in files}
        result = run("infer", study, "--from", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("What the readings determine", result.stdout)
        self.fails(run("infer", study, "--from", self.out, "--out", self.out), 2, "earlier result", "--force")
        self.assertEqual({file: (self.out / file).read_bytes() for file in files}, kept)

        card = json.loads(kept["card.json"])
        spoiled = {key: value for key, value in card.items() if key not in ("intervals", "not_identified")}
        (self.out / "card.json").write_text(json.dumps(spoiled))
        result = run("infer", study, "--from", self.out, "--out", self.out, "--force")
        self.assertEqual(result.returncode, 0, result.stderr)
        again = json.loads((self.out / "card.json").read_text())
        self.assertEqual({**again, "intervals": 0, "not_identified": 0, "correlation": 0},
                         {**card, "intervals": 0, "not_identified": 0, "correlation": 0})
        self.assertEqual((self.out / "evaluations.sqlite").read_bytes(), kept["evaluations.sqlite"])

        self.fails(run("infer", study, "--from", self.folder / "none"), 2, "card.json")
        other = self.study(budget=16, screening=6, title="another")
        self.fails(run("infer", other, "--from", self.out), 2, "another study", "--resume")

    def test_a_wall_budget_ends_a_run_with_the_best_so_far(self):
        start = time.monotonic()
        result = run("calibrate", self.study(budget=500, screening=400), "--out", self.out, "--wall-budget", "3")
        self.assertLess(time.monotonic() - start, 20)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertTrue((self.out / "evaluations.sqlite").exists())

    # what people expect of a command line

    def test_json_is_the_answer_alone_and_quiet_says_nothing_besides(self):
        study = self.study(budget=4, screening=2, radius_mm=14)
        study.write_text(study.read_text().replace('"tolerance_mm": 5', '"tolerance_mm": 250'))  # within reach
        result = run("calibrate", study, "--out", self.out, "--json")
        self.assertIn("screening", result.stderr)
        self.assertEqual(json.loads(result.stdout), json.loads((self.out / "card.json").read_text()))
        quiet = run("calibrate", study, "--out", self.out, "--resume", "--quiet")
        self.assertEqual((quiet.stdout, quiet.stderr), ((self.out / "summary.txt").read_text(), ""))
        self.assertIn(quiet.returncode, (0, 1))
        for verb in (["infer", study, "--from", self.out], ["show", self.out / "card.json"],
                     ["rescale", self.out / "card.json", "--radius", "13", "--packings", "0"],
                     ["simulate", APPARATUS, *COARSE], ["check", "--quick", CARD], ["verify", "free-fall"]):
            with self.subTest(verb[0]):
                result = run(*verb, "--json", "--quiet")
                self.assertIn(result.returncode, (0, 1))
                self.assertEqual(result.stderr, "")
                self.assertTrue(json.loads(result.stdout))

    def test_more_threads_than_processors_are_as_many_as_there_are_with_a_word(self):
        result = run("simulate", LAB, *COARSE, "--threads", "6400", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"--threads 6400: this machine has \d+ processors")

    def shown_by_calibrate(self, study, width, **environment):
        """What a calibration writes to a terminal of this width."""
        ours, theirs = self.terminal()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        process = subprocess.Popen([PROGRAM, "calibrate", str(study), "--out", str(self.out), "--force"],
                                   stdout=subprocess.DEVNULL, stderr=theirs, env={**os.environ, **environment})
        os.close(theirs)
        shown = shown_on(ours)
        self.assertIn(process.wait(), (0, 1))
        return shown

    def test_progress_fits_the_window(self):
        for width, fewest in ((30, 8), (80, 24)):
            with self.subTest(width):
                for budget in (fewest, 4 * fewest, 16 * fewest):  # a fast machine is through with few before a line is due
                    study = self.study(budget=budget, screening=3 * budget // 4, radius_mm=14)
                    shown = self.shown_by_calibrate(study, width, TERM="xterm", NO_COLOR="1")
                    rewritten = [line for line in shown.split("\r") if line.endswith("\x1b[K")]
                    if len(rewritten) > 5:
                        break
                self.assertGreater(len(rewritten), 5)
                for line in rewritten:
                    self.assertLess(len(line.removesuffix("\x1b[K")), width)
                self.assertTrue(any(re.search(rf"screening( \[#*-*\])? \d+ of {budget}\b", line) for line in rewritten))
                self.assertNotIn("\x1b[3", shown)  # no colour
                if width == 80:
                    bars = [found[1] for line in rewritten if (found := re.search(r" \[([#-]+)\] ", line))]
                    self.assertGreater(bars[-1].count("#") / len(bars[-1]), bars[0].count("#") / len(bars[0]))
                    self.assertTrue(any(re.search(r"\d+ (s|min) left$", line.removesuffix("\x1b[K")) for line in rewritten))

    def test_a_terminal_that_cannot_rewrite_a_line_gets_plain_ones(self):
        self.assertNotIn("\x1b", self.shown_by_calibrate(self.study(radius_mm=14), 80, TERM="dumb"))

    def test_little_memory_is_enough_for_a_verb_that_simulates_nothing(self):
        for verb in (["--version"], ["--help"], ["template", "lab"], ["show", CARD]):
            with self.subTest(verb[0]):
                def limit():
                    resource.setrlimit(resource.RLIMIT_AS, (200_000 * 1024, 200_000 * 1024))
                alone = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}  # a BLAS may begin with a stack for each processor
                result = subprocess.run([PROGRAM, *map(str, verb)], capture_output=True, text=True, timeout=20,
                                        preexec_fn=limit, env=alone)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertTrue(result.stdout)

    def test_two_runs_do_not_share_a_folder(self):
        study = self.study(budget=1000, screening=900)  # which is not over before the other begins
        command = [PROGRAM, "calibrate", str(study), "--out", str(self.out)]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        while not (self.out / "evaluations.sqlite").exists() and process.poll() is None:
            time.sleep(0.01)
        self.fails(run("calibrate", study, "--out", self.out, "--resume"), 2, "in use")

    def test_templates_are_printed(self):
        self.assertIn("lifted-cylinder", run("template", "lab", "--mould", "lifted-cylinder").stdout)
        self.assertEqual(run("template", "study", "--mould", "abrams").stdout, run("template", "study").stdout)
        self.assertNotEqual(run("template", "study", "--mould", "lifted-cylinder").stdout, run("template", "study").stdout)
        self.fails(run("template", "study", "--mould", "none-such"), 2, "none-such")
        self.fails(run("template", "pellet-lab", "--mould", "lifted-cylinder"), 2, "pellet-lab")
        self.fails(run("template", "nonsense"), 2, "nonsense")
        self.assertIn("pastefit-study-1", run("template", "study").stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
