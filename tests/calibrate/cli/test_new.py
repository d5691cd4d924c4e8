"""`pastefit new`: from a measuring sheet, entered on a terminal or as options, to a laboratory file and a study that run.

usage: test_new.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import os
import re
import select
import subprocess
import sys
import unittest

from desk import PROGRAM, SOURCE, Desk, run

ABRAMS = ["--mould", "abrams", "--density", "2350", "--slump", "180, 175, 190", "--spread", "330"]


def document(file):
    return json.loads("\n".join(line for line in file.read_text().splitlines() if not line.lstrip().startswith("//")))


class New(Desk):
    def files(self, *arguments):
        result = run("new", self.out, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return document(self.out / "lab.json"), document(self.out / "study.json"), result.stdout

    def test_options_make_two_files_that_run_and_the_next_command(self):
        lab, study, said = self.files(*ABRAMS)
        self.assertEqual(lab["material"]["bulk_density_kg_m3"], 2350)
        self.assertEqual(lab["grains"], {"distribution": "uniform", "smallest_mm": 6, "largest_mm": 10})
        self.assertEqual(lab["measurements"]["step1.slump_mm"], {"repeats": [180, 175, 190], "standard_deviation": 7.5})
        self.assertEqual(lab["measurements"]["step1.spread_mm"], {"value": 330, "standard_deviation": 27})
        self.assertEqual(len(study["parameters"]["friction"]["free"]), 2)
        for words in ("height 300 mm", "step1.height_mm", "within 7.64 mm",
                      f"pastefit calibrate {self.out}/study.json --out {self.out}/out", "--to lammps"):
            self.assertIn(words, said)
        self.assertEqual(run("simulate", self.out / "study.json", "--set", "grains.largest_mm=12").returncode, 0)

    def test_values_may_have_their_unit(self):
        lab, _, _ = self.files("--mould", "8/4/12 in", "--density", "145.2 lb/ft3", "--slump", "7.25, 7, 7.5 in",
                               "--spread", "36 cm; 365 mm")
        self.assertEqual(lab["apparatus"]["mould"], {"base_diameter_mm": 203.2, "top_diameter_mm": 101.6, "height_mm": 304.8})
        self.assertAlmostEqual(lab["material"]["bulk_density_kg_m3"], 2325.88)
        self.assertEqual(lab["measurements"]["step1.slump_mm"]["repeats"], [184.15, 177.8, 190.5])
        self.assertEqual(lab["measurements"]["step1.spread_mm"]["repeats"], [360, 365])

    def test_grains_and_tolerances_follow_from_the_mould(self):
        lab, study, said = self.files("--mould", "haegermann", "--density", "2.1 kg/l", "--spread", "155, 157, 153")
        self.assertEqual(lab["grains"], {"distribution": "uniform", "smallest_mm": 2.25, "largest_mm": 3.75})
        self.assertEqual(lab["measurements"], {"step1.spread_mm": {"repeats": [155, 157, 153], "standard_deviation": 5.4}})
        self.assertEqual(study["parameters"]["friction"], {"value": 0.15})  # a spread alone does not tell it
        self.assertRegex(said, r"step1.spread_mm +155 within 5.4 mm")

    def test_a_plate_has_readings_after_its_drop(self):
        lab, _, _ = self.files("--mould", "en12350-5", "--density", "1850", "--height", "120", "--height2", "105",
                               "--sag", "8")
        self.assertEqual(sorted(lab["measurements"]), ["step1.height_mm", "step2.height_mm",
                                                       "step2.plateau_sag_mm"])

    def test_a_jolting_table_has_a_flow_after_its_drops(self):
        lab, study, said = self.files("--mould", "haegermann-table", "--density", "2100", "--spread", "112", "--flow", "163, 167")
        self.assertEqual(lab["measurements"]["after_drops.spread_mm"], {"repeats": [163, 167], "standard_deviation": 5.4})
        self.assertEqual(len(study["parameters"]["friction"]["free"]), 2)  # two spreads tell it from the strength
        self.assertIn("dropped 15 times by 10 mm, upright", said)
        refused = run("new", self.folder / "other", "--mould", "haegermann", "--density", "2100", "--flow", "163")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no plate or table that drops", refused.stderr)

    def test_a_flow_in_per_cent_of_the_base_is_a_width(self):
        mortar = ["--mould", "astm-c1437", "--density", "2100"]
        self.fails(run("new", self.out, *mortar, "--flow", "110"), 2, "per cent of the mould's base", "210 mm", '"110 mm"')
        for flow in ("110 %, 112 %", "110, 112 percent", "110 Per cent; 112 per cent"):
            lab, _, _ = self.files(*mortar, "--flow", flow, "--force")
            self.assertEqual(lab["measurements"]["after_drops.spread_mm"]["repeats"], [210, 212])
        table = self.folder / "book.csv"
        table.write_text("sample;flow (per cent)\nx;110\n")
        lab, _, _ = self.files(*mortar, "--from", table, "--force")
        self.assertEqual(lab["measurements"]["after_drops.spread_mm"]["value"], 210)
        lab, _, _ = self.files(*mortar, "--flow", "205 mm", "--force")
        self.assertEqual(lab["measurements"]["after_drops.spread_mm"]["value"], 205)

    def test_the_strokes_of_a_standard_are_named_and_can_be_given(self):
        table = ["--mould", "en12350-5", "--density", "2350"]
        _, _, said = self.files(*table, "--spread2", "400")
        self.assertIn("15 drops", " ".join(said.split()))
        self.fails(run("new", self.folder / "x", *table, "--flow", "400"), 2, "--drops", "15")
        lab, _, said = self.files(*table, "--flow", "400", "--drops", "15", "--force")
        self.assertEqual(lab["apparatus"]["drop_plate"], {"drops": 15})
        self.assertIn("dropped 15 times", said)
        self.assertNotIn("drops its plate once", said)
        self.assertNotIn("the first of", said)
        _, _, said = self.files(*table, "--spread2", "400", "--drops", "15", "--force")
        self.assertIn("step2.spread_mm is of the heap after the first of 15 drops", " ".join(said.split()))
        self.assertIn("--flow", said)

    def test_the_rig_that_drops_once_has_a_name_of_its_own(self):
        for mould, words in (("hinged-plate", "drops its plate once"), ("en12350-5", "is now called hinged-plate")):
            with self.subTest(mould=mould):
                lab, _, said = self.files("--mould", mould, "--density", "2350", "--spread2", "400", "--force")
                self.assertIn(words, " ".join(said.split()))
                self.assertIn("15 drops", " ".join(said.split()))
        titles = [json.loads((SOURCE / f"data/apparatus/{name}.json").read_text())["title"]
                  for name in ("hinged-plate", "en12350-5")]
        self.assertTrue(all("dropped once" in title for title in titles), titles)

    def test_a_program_is_known_however_its_name_is_written(self):
        cone = ["--mould", "abrams", "--density", "2350", "--slump", "180", "--force"]
        laws = [self.files(*cone, "--for", word)[1]["contact"] for word in ("edem", "EDEM", "Edem")]
        self.assertEqual(laws, laws[:1] * 3)

    def test_numbers_as_people_write_them_are_read_or_answered_with_what_to_write(self):
        cone = ["--density", "2350"]
        for arguments, words in ((["--slump", "180,175,190"], '"180, 175, 190"'), (["--spread", "500 x 510"], '"500, 510"'),
                                 (["--slump", "180 +- 10"], '"standard_deviation"'),
                                 (["--spread", "500*510"], '"500, 510"'), (["--spread", "500 by 510"], '"500, 510"'),
                                 (["--spread", "500/510"], '"500, 510"'), (["--slump", "~180"], "--sd"),
                                 (["--slump", "about 180 mm"], "--sd"), (["--slump", "180-190"], '"180, 190"'),
                                 (["--slump", "180 to 190 mm"], '"180, 190"'), (["--slump", "18/19 cm"], '"7 1/4 in"'),
                                 (["--spread", "110 %"], "--flow"), (["--spread", "110 percent"], "--flow"), (["--slump", "\u00bd"], '"7 1/4 in"'),
                                 (["--slump", "18 cm, 17.5, 19"], "a unit for some numbers"), (["--slump", "At least 250"], "of a limit"),
                                 *((["--slump", limit], "of a limit it is only known that the reading lies beyond it")
                                   for limit in ("> 250", "at least 250", "\u2265 250", "250+", "max 250 mm")),
                                 (["--slump", "180", "--mould", "Abrams"], 'did you mean "abrams"?')):
            with self.subTest(arguments=arguments):
                mould = [] if "--mould" in arguments else ["--mould", "abrams"]
                self.fails(run("new", self.folder / "x", *cone, *mould, *arguments), 2, words)
        for text, mm in (("7 1/4 in", 184.15), ("7-1/4 in", 184.15), ("7\u00bc in", 184.15), ("7 \u00bc\"", 184.15), ("1/4 in", 6.35)):
            with self.subTest(text=text):
                lab, _, _ = self.files(*cone, "--mould", "abrams", "--slump", text, "--force")
                self.assertEqual(lab["measurements"]["step1.slump_mm"]["value"], mm)

    def test_the_end_of_a_reading_s_key_is_answered_with_the_key(self):
        for name, key in (("t500", "step1.t500_s"), ("T500", "step1.t500_s"), ("t500_s", "step1.t500_s"),
                          ("angle_of_repose_deg", "step1.angle_of_repose_deg"), ("Slump", "step1.slump_mm"), ("sprad", "spread")):
            with self.subTest(name=name):
                self.fails(run("new", self.out, *ABRAMS, "--reading", f"{name}=2.1"), 2, f"did you mean {key}?")

    def test_a_mould_as_people_write_it_is_known_or_answered_with_what_to_write(self):
        cone = ["--density", "2350", "--slump", "180"]
        self.files(*cone, "--mould", "abrams ")
        for mould, *words in (("ABRAMS", 'did you mean "abrams"?'), ("8 in/100/300 mm", "no three lengths in one unit or with a unit each"),
                              ("200x100x300", "no preset, and no three lengths", '"200/100/300"'), ("200/100", '"200/100/300"')):
            with self.subTest(mould=mould):
                self.fails(run("new", self.folder / "x", *cone, "--mould", mould), 2, *words)

    def test_a_standard_is_known_as_the_preset_of_its_apparatus(self):
        cone = ["--density", "2350", "--slump", "180", "--force"]
        for mould, preset in (("ASTM C143", "abrams"), ("astm c143/C143M-20", "abrams"), ("C143", "abrams"), ("EN 12350-2", "abrams-en"),
                              ("DIN EN 12350-2:2019-09", "abrams-en"), ("BS EN12350-2", "abrams-en"), ("DIN EN 12350-8", "abrams-en")):
            with self.subTest(mould=mould):
                lab, _, _ = self.files(*cone, "--mould", mould)
                self.assertEqual(lab["apparatus"]["preset"], preset)
        for mould, preset in (("DIN EN 12350-5", "hinged-plate"), ("EN 1015-3", "haegermann-table"), ("ASTM C1437", "astm-c1437")):
            with self.subTest(mould=mould):
                lab, _, _ = self.files("--density", "2100", "--spread", "210", "--force", "--mould", mould)
                self.assertEqual(lab["apparatus"]["preset"], preset)
        for mould in ("EN 12350-22", "ASTM C14", "EN 206"):
            with self.subTest(mould=mould):
                self.fails(run("new", self.folder / "x", *cone, "--mould", mould), 2, "there is no preset", "resets: ")
        self.assertIn('"preset": "hinged-plate"', run("template", "lab", "--mould", "EN 12350-5").stdout)

    def test_a_time_to_a_width_that_the_heap_does_not_reach_is_refused(self):
        flow = ["--mould", "abrams", "--density", "2350", "--reading", "step1.t500_s=2.1"]
        self.fails(run("new", self.out, *flow, "--spread", "450"), 2, "step1.t500_s (2.1) contradicts step1.spread_mm (450)",
                   "never 500 mm wide")
        self.files(*flow, "--spread", "490")

    def test_a_title_that_is_no_utf_8_is_one_all_the_same(self):
        for verb in (["new", self.out, "--mould", "abrams", "--density", "2350", "--slump", "180", "--title", b"caf\xe9"],):
            result = subprocess.run([PROGRAM.encode(), *(word if isinstance(word, bytes) else str(word).encode() for word in verb)],
                                    capture_output=True, timeout=60)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(document(self.out / "lab.json")["title"].startswith("caf"))

    def test_a_time_has_the_deviation_of_a_time_and_frees_the_viscosity(self):
        flow = ["--mould", "abrams", "--density", "2350", "--spread", "650"]
        lab, study, _ = self.files(*flow, "--reading", "step1.t500_s=2.1, 2.4, 1.9")
        self.assertEqual(lab["measurements"]["step1.t500_s"]["standard_deviation"], 0.24)
        self.assertIn("free", study["parameters"]["viscosity_pa_s"])
        self.assertEqual(run("simulate", self.out / "study.json", "--set", "grains.largest_mm=12").returncode in (0, 1), True)
        lab, _, _ = self.files(*flow, "--reading", "step1.flow_time_s=12", "--force")
        self.assertEqual(lab["measurements"]["step1.flow_time_s"]["standard_deviation"], 1.2)

    def test_numbers_that_contradict_themselves_are_refused(self):
        for arguments, words in (
                (["--density", "2350, 1200", "--slump", "180"], ["density", "2 numbers"]),
                (["--density", "2350", "--slump", "180", "--reading", "slump=175"], ["slump", "is given twice"]),
                (["--density", "2350", "--slump", "102", "--spread", "600"], ["contradicts", "600"]),
                (["--density", "2350", "--slump", "180", "--mass", "10"], ["fill.mass_kg", "kg/m3"]),
                (["--density", "2350", "--slump", "180", "--angle", "0.6"], ["0.6 rad are 34.3775 degrees"])):
            with self.subTest(arguments=arguments):
                self.fails(run("new", self.out, "--mould", "abrams", *arguments), 2, *words)
        table = ["--mould", "en12350-5", "--density", "2350"]
        for arguments in (["--height", "100", "--height2", "112"], ["--spread", "360", "--spread2", "320"],
                          ["--height", "118", "--sag", "150"]):
            with self.subTest(arguments=arguments):
                self.fails(run("new", self.out, *table, *arguments), 2, "contradicts", "swapped")
        cone = ["--density", "2350", "--slump", "180"]
        self.fails(run("new", self.out, "--mould", "100/200/300", *cone), 2, "mould", "at its top", "--confirm mould")
        self.fails(run("new", self.out, "--mould", "8 in/100/300 mm", *cone), 2, "8 in/100/300 mm")
        self.assertFalse(self.out.exists())
        lab, _, _ = self.files("--mould", "8 in/100 mm/300 mm", *cone)
        self.assertEqual(lab["apparatus"]["mould"]["base_diameter_mm"], 203.2)

    def test_defaults_are_no_limits(self):
        lab, _, said = self.files("--mould", "haegermann", "--density", "2100", "--spread", "310")
        self.assertGreater(lab["apparatus"]["table_length_mm"], 310)
        self.assertIn("is assumed", lab["provenance"]["notes"])
        self.assertIn("mm thick on the average", " ".join(said.split()))  # the grains are thicker
        lab, _, said = self.files("--mould", "200/100/300", "--density", "2350", "--slump", "180", "--force")
        self.assertEqual(lab["assumed"], ["apparatus.lift_velocity_mm_s"])
        preset, _, of_preset = self.files("--mould", "abrams", "--density", "2350", "--slump", "180", "--force")
        grains = [re.search(r"about (\d+) of", text)[1] for text in (said, of_preset)]
        self.assertLess(abs(int(grains[0]) - int(grains[1])), 300)
        table = run("new", self.folder / "x", "--mould", "haegermann-table", "--density", "2100", "--flow", "310")
        self.fails(table, 2, "apparatus.drop_plate.length_mm")

    def test_the_commands_that_are_printed_can_be_pasted(self):
        self.out = self.folder / "my mix; touch planted"
        _, _, said = self.files(*ABRAMS)
        self.assertIn(f"'{self.out}/study.json'", said)

    def test_the_template_of_a_preset_runs_and_says_what_it_lacks(self):
        for preset, words in (("haegermann-table", "15 strokes"), ("haegermann", "has no strokes"), ("mini-cone", "Kantro")):
            with self.subTest(preset):
                made = run("template", "lab", "--mould", preset)
                self.assertEqual(made.returncode, 0, made.stderr)
                self.assertIn(words, made.stdout)
                lab = self.folder / "lab.json"
                lab.write_text(made.stdout)
                ran = run("simulate", lab)
                self.assertEqual(ran.returncode, 0, ran.stderr)
                self.assertEqual("has no strokes" in ran.stderr, preset == "haegermann")
        self.assertEqual(run("template", "lab", "--mould", "haegerman").returncode, 2)
        self.assertIn("haegerman", run("template", "study", "--mould", "haegerman").stderr)

    def test_an_angle_of_repose_is_that_of_dry_grains(self):
        lab, study, said = self.files("--mould", "lifted-cylinder", "--density", "780", "--angle", "26.1, 28, 26.9")
        self.assertEqual(lab["measurements"], {"step1.angle_of_repose_deg": {"repeats": [26.1, 28, 26.9],
                                                                              "standard_deviation": 1.5}})
        self.assertEqual(study["contact"]["attraction"], "none")
        self.assertEqual([name for name, one in study["parameters"].items() if "free" in one],
                         ["friction", "rolling_friction"])
        self.assertIn("Many pairs of sliding and rolling friction give the same angle", said)

    def test_a_yield_stress_alone_predicts_the_reading_that_is_fitted_and_the_file_says_so(self):
        lab, study, said = self.files("--mould", "abrams", "--density", "1850", "--yield-stress", "0.61, 0.59, 0.6 kPa")
        self.assertEqual(lab["material"]["yield_stress_pa"], {"repeats": [610, 590, 600]})
        self.assertEqual(list(lab["measurements"]), ["step1.height_mm"])
        self.assertGreater(lab["measurements"]["step1.height_mm"]["standard_deviation"], 30)
        self.assertIn("was not measured: it is what Schowalter 1998 predicts", lab["provenance"]["notes"])
        self.assertEqual(study["parameters"]["friction"], {"value": 0.15})
        lab, _, _ = self.files("--mould", "abrams", "--density", "1850", "--yield-stress", "60", "--force")
        self.assertEqual(list(lab["measurements"]), ["step1.spread_mm"])
        self.assertEqual(lab["material"]["yield_stress_pa"], {"value": 60, "standard_deviation": 6})
        self.assertIn("is assumed", lab["provenance"]["notes"])
        lab, _, _ = self.files(*ABRAMS, "--yield-stress", "900, 950", "--force")
        self.assertEqual(list(lab["measurements"]), ["step1.slump_mm", "step1.spread_mm"])
        self.assertNotIn("notes", lab["provenance"])
        ran = run("simulate", self.out / "lab.json", "--set", "grains.largest_mm=12")
        self.assertIn("the yield stress of 925 Pa is compared, not fitted", ran.stderr)
        for stress, words in (("0", "is not above 0"), ("soft", "not a number"), ("60 mm", "is in mm"), ("90000", "predicts no reading")):
            self.fails(run("new", self.folder / "other", "--mould", "abrams", "--density", "1850", "--yield-stress", stress), 2,
                       "yield stress", words)
        self.assertFalse((self.folder / "other").exists())

    def test_the_target_has_its_own_law(self):
        epa, bridge = ("epa", "none", "adhesion_ratio"), ("hertz", "polynomial", "strength_pa")
        laws = {("lammps",): bridge, ("lammps", "--law", "epa"): epa, ("liggghts", "--law", "epa"): epa,
                ("liggghts", "--law", "sjkr"): ("sjkr", "none", "cohesion_energy_density_pa"), ("yade",): bridge,
                ("edem", "--law", "epa"): epa, ("edem",): ("jkr", "none", "adhesion_pa")}
        for target, (normal, attraction, strength) in laws.items():
            with self.subTest(target):
                _, study, said = self.files(*ABRAMS, "--for", *target, "--force")
                self.assertEqual((study["contact"]["normal"], study["contact"]["attraction"]), (normal, attraction))
                self.assertIn("free", study["parameters"][strength])
                export = re.search(r"export \S+ --to (\S+)", said)[1]
                self.assertIn(export, run("export", "--help").stdout)
                self.assertEqual(run("simulate", self.out / "study.json", "--set", "grains.largest_mm=12").returncode, 0)
                (self.folder / "lab.json").write_text(run("template", "lab").stdout)
                template = self.folder / "study.json"
                template.write_text(run("template", "study", "--for", *target).stdout)
                self.assertIn(f'"normal":"{normal}"', template.read_text().replace(" ", ""))
                self.assertEqual(run("simulate", template, "--set", "grains.largest_mm=12").returncode, 0)

    def test_the_sheet_chooses_the_law_unless_one_is_named(self):
        def normal_of(*options):
            _, study, _ = self.files("--mould", "abrams", "--density", "2300", *options, "--force")
            return study["contact"]["normal"], (self.out / "study.json").read_text().splitlines()[0]

        self.assertEqual(normal_of("--slump", "100", "--spread", "270")[0], "epa")
        self.assertEqual(normal_of("--slump", "100")[0], "epa")
        stiff, why = normal_of("--height", "151")
        self.assertEqual(stiff, "epa")
        self.assertIn("More than half of the height is left", why)
        self.assertEqual(normal_of("--height", "149", "--spread", "310")[0], "hertz")
        self.assertEqual(normal_of("--spread", "310")[0], "hertz")
        narrow, why = normal_of("--height", "140", "--spread", "260")
        self.assertEqual((narrow, document(self.out / "study.json")["parameters"]["table_cohesion_factor"]), ("epa", {"value": 1}))
        self.assertIn("stick to the table", why)
        for height, spread, most in (("90", "400", 0.3), ("90", "510", 0.8), ("60", "600", 0.3)):  # 0.83, 1.06, 1.02 of a cone's width
            normal_of("--height", height, "--spread", spread)
            friction = document(self.out / "study.json")["parameters"]["friction"]
            self.assertEqual((friction["free"][1], friction["scale"]), (most, "log"))
        self.files("--mould", "hinged-plate", "--density", "1900", "--height", "135", "--height2", "118", "--spread", "255", "--force")
        self.assertEqual(document(self.out / "study.json")["parameters"]["friction"], {"free": [0.05, 0.3], "scale": "log"})
        timed, why = normal_of("--slump", "240", "--spread", "500", "--reading", "step1.t500_s=3")
        self.assertEqual(timed, "hertz")
        self.assertIn("only a bridge has a viscosity", why)
        self.assertEqual(normal_of("--height", "90", "--spread", "510", "--law", "epa")[0], "epa")
        self.assertEqual(normal_of("--height", "90", "--spread", "400", "--for", "edem")[0], "jkr")
        self.assertEqual(normal_of("--height", "90", "--spread", "510", "--for", "liggghts")[0], "sjkr")  # 1.06 of a cone's width
        self.assertEqual(normal_of("--height", "60", "--spread", "510", "--for", "liggghts")[0], "epa")  # 0.87
        self.assertEqual(normal_of("--height", "90", "--for", "liggghts")[0], "sjkr")
        ordinary, why = normal_of("--height", "90", "--spread", "400", "--for", "liggghts")
        self.assertEqual(ordinary, "epa")
        self.assertIn("more heights and spreads", why)
        for program, law in (("liggghts", "epa"), ("edem", "epa"), ("yade", "hertz")):  # Yade's decks have no law of this kind
            self.assertEqual(normal_of("--slump", "100", "--spread", "270", "--for", program)[0], law)
        self.fails(run("new", self.folder / "other", *ABRAMS, "--for", "yade", "--law", "epa"), 2, "yade does not run", "one of bridge")
        self.fails(run("new", self.folder / "other", *ABRAMS, "--law", "ebridge"), 2, "one of bridge, epa, jkr, sjkr")

    def test_what_is_known_of_deviations_grains_and_parameters_is_taken(self):
        lab, study, said = self.files(*ABRAMS, "--sd", "spread=10", "--sd", "slump=0.5 cm", "--grains", "0.8, 1.2 cm", "--fix", "friction=0.2",
                                      "--prior", "rolling_friction=0.2+-0.1")
        self.assertEqual(lab["measurements"]["step1.spread_mm"], {"value": 330, "standard_deviation": 10})
        self.assertEqual(lab["measurements"]["step1.slump_mm"]["standard_deviation"], 5)
        self.assertEqual(lab["grains"], {"distribution": "uniform", "smallest_mm": 8, "largest_mm": 12})
        self.assertEqual(study["parameters"]["friction"], {"value": 0.2})
        self.assertEqual(study["parameters"]["rolling_friction"]["prior"], {"value": 0.2, "standard_deviation": 0.1})
        lab, _, _ = self.files(*ABRAMS, "--grains", "9", "--force")
        self.assertEqual(lab["grains"], {"distribution": "mono", "radius_mm": 9})

    def test_what_cannot_be_known_of_them_is_refused_before_anything_is_written(self):
        self.fails(run("new", self.folder / "none", *ABRAMS, "--sd", "flow=3", "--sd", "slump=-1", "--grains", "8, 9, 10"), 2,
                   "sd flow", "sd slump", "grains: are 3 numbers")
        self.fails(run("new", self.folder / "none", *ABRAMS, "--fix", "friction=much", "--prior", "friction=2", "--prior",
                       "curvature=0.2+-0.1", "--sd", "slump"), 2, "--sd slump: is not NAME=VALUE")
        self.fails(run("new", self.folder / "none", *ABRAMS, "--fix", "friction=much", "--prior", "friction=2", "--prior",
                       "curvature=0.2+-0.1"), 2, "fix friction", "prior friction", "prior curvature: is of a parameter that is not searched")
        self.fails(run("new", self.folder / "none", *ABRAMS, "--fix", "frction=0.2", "--fix", "friction=3"), 2,
                   'did you mean "friction"?', "\nparameters.friction.value: is 3.0; must be 0 to 2")
        self.assertFalse((self.folder / "none").exists())

    def test_each_row_of_a_table_is_a_study_and_all_of_them_a_batch(self):
        table = self.folder / "book.csv"
        table.write_bytes("Probe;Form;Rohdichte (kg/dm\u00b3);Setzma\u00df (cm);Breite (mm);Wasser (kg/m\u00b3);Pr\u00fcfer\n"
                          "A/12;;2,35;18,0;330;180,5;M\nA/13;;2,28;10,0;270;175;M\n;;;;;;\n".encode("cp1252"))
        result = run("new", self.out, "--from", table, "--mould", "abrams")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("columns ignored: Pr\u00fcfer", result.stderr)
        self.assertIn("columns of the mix: Wasser (kg/m\u00b3)", result.stderr)
        self.assertIn(f"pastefit batch {self.out}/*/study.json --out {self.out}/out", result.stdout)
        lab = document(self.out / "a-12" / "lab.json")
        self.assertEqual(lab["title"], "A/12")
        self.assertEqual(lab["provenance"]["source"], "book.csv, line 2")
        self.assertEqual(lab["material"]["bulk_density_kg_m3"], 2350)
        self.assertEqual(lab["measurements"]["step1.slump_mm"]["value"], 180)
        self.assertEqual(lab["mix"], {"wasser_kg_m3": 180.5})
        self.assertEqual(run("simulate", self.out / "a-13" / "study.json").returncode, 0)

    def test_a_table_of_one_row_is_as_if_it_had_been_typed(self):
        typed = self.files(*ABRAMS, "--title", "x")
        table = self.folder / "book.csv"
        table.write_text('sample,mould,density,slump,spread\nx,abrams,2350,"180, 175, 190",330\n')
        read = self.files("--from", table, "--force")
        read[0]["provenance"] = typed[0]["provenance"]
        self.assertEqual(read[0], typed[0])
        self.assertEqual(read[1], typed[1])

    def test_faults_of_a_table_are_listed_with_their_lines_and_nothing_is_written(self):
        table = self.folder / "book.csv"
        table.write_text("sample;slump;spread\nx;180;abc\nx;170;330\ny;180;330\n")
        result = run("new", self.out, "--from", table, "--mould", "abrams", "--density", "2350")
        self.fails(result, 2, "book.csv: line 3", "as line 2 has", "line 2: reading spread", "abc")
        self.fails(run("new", self.out, "--from", table, "--mould", "abrams"), 2, "lines 2, 3, 4: --density: is missing")
        self.assertFalse(self.out.exists())

    def test_every_fault_is_named_and_nothing_is_written(self):
        self.fails(run("new", self.out, stdin=subprocess.DEVNULL), 2, "--mould: is missing", "--density: is missing",
                   "--slump: is missing")
        self.fails(run("new", self.out, "--mould", "abrahms", "--density", "heavy", "--slump", "162,5", "--reading", "sprad=3",
                       "--for", "edm"), 2, 'did you mean "abrams"?', '"heavy"', "lammps, liggghts, yade, edem")
        self.fails(run("new", self.out, "--mould", "abrams", "--density", "145.2", "--slump", "162,5", "--reading",
                       "sprad=3"), 2, "a decimal point", "did you mean spread?")
        self.fails(run("new", self.out, "--mould", "abrams", "--density", "145.2", "--slump", "180"), 2,
                   "145.2 lb/ft3 are 2325.88 kg/m3")
        self.fails(run("new", self.out, "--mould", "abrams", "--density", "2350 mm", "--slump", "180"), 2, "is in mm")
        # A cone of 30 cm that is taken for one of 30 mm.
        self.fails(run("new", self.out, "--mould", "20/10/30", "--density", "2350", "--slump", "180"), 2,
                   "apparatus.mould.height_mm: is 30 mm, far from", "30 cm are 300 mm", "step1.slump_mm")
        self.fails(run("new", self.out, "--mould", "8/4/12", "--density", "2350", "--slump", "7"), 2, "12 in are 304.8 mm")
        self.assertFalse(self.out.exists())
        self.files(*ABRAMS)
        before = (self.out / "lab.json").read_text()
        self.fails(run("new", self.out, "--mould", "abrams", "--density", "2000", "--slump", "180"), 2, "lab.json", "study.json")
        self.assertEqual((self.out / "lab.json").read_text(), before)

    def test_other_tests_get_their_starting_files(self):
        result = run("new", self.out, "--test", "shear")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.out / "lab.json").read_text(), run("template", "shear-lab").stdout)
        self.fails(run("new", self.folder / "other", "--test", "sheer"), 2, "sheer")

    def test_on_a_terminal_it_asks_and_asks_again(self):
        outer, inner = self.terminal()
        process = subprocess.Popen([PROGRAM, "new", str(self.out)], stdin=inner, stdout=inner, stderr=inner)
        os.close(inner)
        said = b""

        def wait_for(words):
            nonlocal said
            while words not in said:
                self.assertTrue(select.select([outer], [], [], 60)[0], said)
                said += os.read(outer, 4096)

        for words, answer in ((b"mould", b"abrms"), (b"did you mean", b"abrams"), (b"density", b"2350"),
                              (b"slump", b"180, 175, 190"), (b"spread", b"330"), (b"program", b"edem")):
            wait_for(words)
            said = said[said.rindex(words) + len(words):]
            os.write(outer, answer + b"\n")
        wait_for(b"pastefit export")
        self.assertEqual(process.wait(60), 0)
        os.close(outer)
        self.assertEqual(document(self.out / "study.json")["contact"]["normal"], "jkr")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
