"""Typical errors in laboratory data: decimal commas, inches, misread repeats, a radius for a width. They are refused, or
reported before any run, in the user's terms.

usage: test_sheets.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import sys
import time
import unittest

from desk import Desk, run

PARAMETERS = {"strength_pa": {"free": [10, 40000]}, "friction": {"value": 0.15}, "rolling_friction": {"value": 0.02}}
SEARCH = {"screening": 2, "budget_simulations": 4, "packings": 1, "confirmation_packings": 1,
          "examination_simulations": 0}


class Sheets(Desk):
    def lab(self, measurements, density=2300, preset="abrams", name="lab.json", **changes):
        """A laboratory file with coarse grains."""
        apparatus = changes.pop("apparatus", {"preset": preset})
        radius_mm = changes.pop("radius_mm", 12)
        document = {"format": "pastefit-lab-1", "title": "a sheet", "provenance": {"source": "a laboratory"},
                    "apparatus": apparatus, "material": {"bulk_density_kg_m3": density},
                    "grains": {"distribution": "mono", "radius_mm": radius_mm}, "measurements": measurements, **changes}
        file = self.folder / name
        file.write_text(json.dumps(document))
        return file

    def study_of(self, **changes):
        document = {"format": "pastefit-study-1", "title": "a sheet", "lab": "lab.json", "parameters": PARAMETERS,
                    "search": SEARCH, **changes}
        file = self.folder / "study.json"
        file.write_text(json.dumps(document))
        return file

    def refused(self, lab, *words):
        self.fails(run("simulate", lab), 2, *words)

    def test_decimal_commas_between_readings_are_refused_with_what_was_meant(self):
        lab = self.lab({"step1.slump_mm": {"repeats": [162, 5, 165, 0, 160, 5]}})
        self.refused(lab, "measurements.step1.slump_mm.repeats", "decimal comma", "[162.5, 165.0, 160.5]")
        self.fails(run("calibrate", self.study_of(), "--out", self.out), 2, "[162.5, 165.0, 160.5]")
        self.assertFalse(self.out.exists())

    def test_a_decimal_comma_in_a_value_or_a_text_is_named(self):
        lab = self.lab({"step1.slump_mm": {"repeats": ["162,5", "165,0"]}})
        self.refused(lab, "write 162.5, with a decimal point", "write 165, with a decimal point")
        text = self.lab({"step1.slump_mm": {"value": 162.5, "standard_deviation": 7.5}}).read_text()
        lab.write_text(text.replace("162.5", "162,5"))
        self.refused(lab, "line 1", "decimal comma", "write 162.5")

    def test_decimal_commas_in_bounds_are_named(self):
        self.lab({"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}})
        study = self.study_of(parameters={"friction": {"free": [0, 1, 0, 6]}})
        self.fails(run("simulate", study), 2, "parameters.friction.free", "[0.1, 0.6]")

    def test_an_outlier_among_repeats_is_refused_until_it_is_confirmed(self):
        readings = {"step1.slump_mm": {"repeats": [158, 165, 163, 40]}}
        place = "measurements.step1.slump_mm"
        self.refused(self.lab(readings), place, "differ by 125 mm", "27 mm", "40 mm is an outlier", "ASTM C143",
                     f'"confirmed": ["{place}"]')
        result = run("simulate", self.lab(readings, confirmed=[place]))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("40 mm is an outlier", result.stderr)

    def test_repeats_beyond_the_published_repeatability_are_named_before_anything_runs(self):
        # Three slumps of one concrete differ by up to 25 mm in 95 of 100 cases, of a spread by up to 89 mm.
        for name, repeats, named in (("step1.slump_mm", [150, 165, 172], False), ("step1.slump_mm", [150, 165, 185], True),
                                     ("step1.spread_mm", [600, 640, 680], False), ("step1.spread_mm", [600, 640, 700], True)):
            with self.subTest(repeats=repeats):
                result = run("simulate", self.lab({name: {"repeats": repeats}}))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual("repeatability explains" in result.stderr, named, result.stderr)

    def test_small_moulds_scatter_in_proportion(self):
        lab = self.lab({"step1.slump_mm": {"repeats": [20, 27, 26]}}, 1950, "mini-cone", radius_mm=2)
        result = run("simulate", lab)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("repeatability explains 5 mm", result.stderr)

    def test_keys_in_other_units_are_answered_with_the_conversion(self):
        lab = self.lab({"step1.slump_in": {"repeats": [7.25, 7.0, 7.5]}, "step1.spread_cm": {"value": 37}})
        document = json.loads(lab.read_text())
        document["material"] = {"unit_weight_lbs_ft3": 145.2}
        lab.write_text(json.dumps(document))
        self.refused(lab, 'measurements.step1.slump_in: unknown key; give "step1.slump_mm" in mm: 1 in is 25.4 mm',
                     'give "step1.spread_mm" in mm: 1 cm is 10 mm',
                     'give "bulk_density_kg_m3" in kg/m3: 1 lb/ft3 is 16.0185 kg/m3')

    def test_a_density_in_another_unit_is_asked_back(self):
        slump = {"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}}
        self.refused(self.lab(slump, 145.2), "material.bulk_density_kg_m3: is 145.2 kg/m3",
                     "145.2 lb/ft3 are 2325.88 kg/m3")
        self.refused(self.lab(slump, 2.35), "2.35 kg/l are 2350 kg/m3")
        lab = self.lab(slump, 145.2, confirmed=["material.bulk_density_kg_m3"])
        result = run("simulate", lab)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("145.2 kg/m3", result.stderr)

    def test_a_mould_far_from_all_others_is_asked_back(self):
        slump = {"step1.slump_mm": {"value": 6, "standard_deviation": 0.5}}
        mould = {"base_diameter_mm": 8, "top_diameter_mm": 4, "height_mm": 12}
        lab = self.lab(slump, apparatus={"preset": "abrams", "mould": mould, "reading": {"probe_diameter_mm": 4}},
                       radius_mm=0.5)
        self.refused(lab, "apparatus.mould.height_mm: is 12 mm", "12 in are 304.8 mm")

    def test_readings_out_of_range_are_answered_in_other_units(self):
        self.refused(self.lab({"step1.spread_mm": {"value": 33, "standard_deviation": 2}}),
                     "is 33 mm; must be 196 to 900 mm", "33 cm are 330 mm", "33 in are 838.2 mm")
        result = run("simulate", self.lab({"step1.slump_mm": {"value": 7.25, "standard_deviation": 7.5}}))
        self.assertIn("7.25 in are 184.15 mm", result.stderr)
        self.assertIn("7.25 cm are 72.5 mm", result.stderr)

    def test_a_bare_reading_is_answered_with_its_form(self):
        self.refused(self.lab({"step1.slump_mm": 120, "step1.spread_mm": [300, 310]}),
                     'write {"value": 120, "standard_deviation": 7.5}', 'write {"repeats": [300,310]}')

    def test_a_radius_given_as_a_width_is_named_first(self):
        lab = self.lab({"step1.height_mm": {"value": 107, "standard_deviation": 7.5},
                        "step1.spread_mm": {"value": 236, "standard_deviation": 25}})
        words = ("no heap of this volume is 107 mm high and 236 mm wide", "255.8 mm wide",
                 "if 236 mm is a radius, the width is 472 mm")
        result = run("simulate", lab)
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        document = json.loads(lab.read_text())
        for name, deviation in (("height", 2), ("spread", 5)):
            document["measurements"][f"step1.{name}_mm"]["standard_deviation"] = deviation
        lab.write_text(json.dumps(document))
        self.refused(lab, "contradicts", "if 236 mm is a radius, the width is 472 mm")

    TUBE = {"mould": {"base_diameter_mm": 20, "top_diameter_mm": 20, "height_mm": 40}, "table_length_mm": 80,
            "lift_velocity_mm_s": 100, "drop_plate": None, "reading": {"height": "highest", "probe_diameter_mm": 4}}
    TALL = {"step1.height_max_mm": {"value": 24, "standard_deviation": 2}}

    def test_a_default_that_nothing_reads_is_not_in_the_way(self):
        # Without a drop plate nothing reads the sag, whose window of 100 mm is wider than this table.
        result = run("simulate", self.lab(self.TALL, 1150, apparatus=self.TUBE, radius_mm=1.5), "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        plate = {"length_mm": 80, "mass_kg": 1, "lift_height_mm": 5}
        lab = self.lab(self.TALL, 1150, apparatus={**self.TUBE, "drop_plate": plate}, radius_mm=1.5)
        self.refused(lab, "apparatus.reading.sag_window_mm: is 100 mm (the default)", "add the key")

    def test_settings_mend_the_laboratory_file_of_a_study(self):
        self.lab(self.TALL, 1150, apparatus=self.TUBE, radius_mm=9)  # too coarse as it stands
        study = self.study_of()
        self.fails(run("simulate", study), 2, "grains.radius_mm")
        result = run("simulate", study, "--set", "grains.radius_mm=1.5", "--set", "apparatus.lift_velocity_mm_s=80")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("lifted at 80 mm/s", result.stderr)

    def test_settings_change_the_study_itself(self):
        self.lab({"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}})
        study = self.study_of(contact={"rolling_model": "none"}, parameters={"friction": {"free": [0.1, 0.6]}})
        self.fails(run("simulate", study, "--set", "contact.rolling_model=spring"), 2, "spring_dashpot")
        result = run("simulate", study, "--set", "contact.rolling_model=spring_dashpot", "--set", "rolling_friction=0.3")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_parameters_of_surfaces_belong_to_tests_that_have_them(self):
        for name in ("lab", "study"):
            (self.folder / f"{name}.json").write_text(run("template", f"shear-{name}").stdout)
        study = self.folder / "study.json"
        study.write_text(study.read_text().replace('"friction": {"free"', '"table_friction": {"value": 0.3}, "friction": {"free"'))
        self.fails(run("infer", study, "--from", self.folder), 2, "parameters.table_friction: acts on the table",
                   "which the test's apparatus has not")

    def test_outlines_and_spread_curves_in_another_frame_are_named_before_anything_runs(self):
        heap = [[-165, 4], [-125, 60], [-65, 130], [0, 145], [65, 130], [125, 60], [165, 4]]

        def profile(points):
            return self.lab({"step1.profile": {"points": points, "standard_deviation": 8}})

        self.assertEqual(run("simulate", profile(heap)).returncode, 0)
        self.refused(profile([[x + 165, z] for x, z in heap]), "step1.profile", "one side of the mould's axis")
        self.refused(profile([[x, 154 - z] for x, z in heap]), "step1.profile", "higher at its ends")
        self.refused(profile([[x / 10, z / 10] for x, z in heap]), "step1.profile", "as cm")

        def curve(points):
            return self.lab({"step1.spread_curve": {"points": points, "standard_deviation": 10}},
                            apparatus={"preset": "abrams", "lift_velocity_mm_s": 100})

        self.refused(curve([[0.5, 125], [1, 140], [3, 150]]), "step1.spread_curve", "if it is a radius")
        self.refused(curve([[0.5, 25], [1, 28], [3, 30]]), "step1.spread_curve", "if it is in cm")
        self.refused(curve([[1, 300], [2, 280], [3, 260]]), "step1.spread_curve", "shrinks from 300 to 260 mm")

    def test_a_cone_upside_down_is_lifted(self):
        # ASTM C1611, procedure B; the same material spreads as wide from either end of the cone.
        upright = {"mould": {"base_diameter_mm": 200, "top_diameter_mm": 100, "height_mm": 300}, "table_length_mm": 1200,
                   "lift_velocity_mm_s": 100, "drop_plate": None, "reading": {"height": "axis", "probe_diameter_mm": 40}}
        inverted = {**upright, "mould": {"base_diameter_mm": 100, "top_diameter_mm": 200, "height_mm": 300}}
        weak = [word for setting in ("strength_pa=20", "friction=0.05", "rolling_friction=0", "table_friction=0.3")
                for word in ("--set", setting)]
        readings = []
        for apparatus in (upright, inverted):
            lab = self.lab({"step1.spread_mm": {"value": 650, "standard_deviation": 25}}, apparatus=apparatus, radius_mm=10)
            result = run("simulate", lab, "--json", *weak)
            self.assertEqual(result.returncode, 0, result.stderr)
            readings.append(json.loads(result.stdout)["observables"])
        spreads = [reading["step1.spread_mm"] for reading in readings]
        solid = [reading["fill.solid_fraction"] for reading in readings]
        # Equal grains lie looser by 0.026 +- 0.003 where the narrow end is below (six packings of 12 mm).
        self.assertAlmostEqual(solid[0], solid[1], delta=0.035)
        self.assertAlmostEqual(spreads[0], spreads[1], delta=0.15 * spreads[0])

    def test_times_that_are_not_read_are_refused_with_those_that_are(self):
        lab = self.lab({"step1.spread_mm": {"value": 700, "standard_deviation": 25}, "step1.t50": {"value": 2.6}})
        self.refused(lab, "measurements.step1.t50: is a time", "step1.t500_s")

    def test_a_time_to_a_width_that_the_heap_does_not_reach_is_refused(self):
        times = {"step1.t500_s": {"value": 2.1, "standard_deviation": 0.3}}
        lab = self.lab({**times, "step1.spread_mm": {"value": 450, "standard_deviation": 25}})
        self.refused(lab, "measurements: step1.t500_s (2.1) contradicts step1.spread_mm (450)", "never 500 mm wide")
        lab = self.lab({**times, "step1.spread_mm": {"value": 450, "standard_deviation": 25}},
                       apparatus={"preset": "abrams", "reading": {"flow": {"diameter_mm": 400}}})
        self.assertEqual(run("simulate", lab).returncode, 0)

    def test_a_flow_that_may_be_in_per_cent_is_named_before_anything_runs(self):
        for preset, width_mm, named in (("astm-c1437", 110, True), ("astm-c1437", 205, False), ("haegermann-table", 150, False)):
            with self.subTest(preset=preset, width_mm=width_mm):
                lab = self.lab({"after_drops.spread_mm": {"value": width_mm, "standard_deviation": 5}}, 2100, preset, radius_mm=4)
                result = run("simulate", lab)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual("a flow of 110 % is a width of 210 mm" in " ".join(result.stderr.split()), named, result.stderr)

    def test_a_table_or_a_workbook_in_place_of_a_study_is_named(self):
        table, workbook, text = (self.folder / name for name in ("q.csv", "q.xlsx", "q.txt"))
        workbook.write_bytes(b"PK\x03\x04\x14\0\x06\0")
        for content in (b"a,b\n1,2\n", b"\xef\xbb\xbfa;b\r\n1;2\r\n", "a\tb\n1\t2\n".encode("utf-16"), b"Pr\xfcfbuch; 3\nProbe;Breite;x\n"):
            table.write_bytes(content)
            for verb in (["calibrate", table, "--out", self.out], ["simulate", table], ["show", table]):
                with self.subTest(content=content, verb=verb[0]):
                    self.fails(run(*verb), 2, f"is a table; pastefit new --from {table} makes a study of each of its rows")
        for verb in (["calibrate", workbook, "--out", self.out], ["simulate", workbook], ["show", workbook]):
            self.fails(run(*verb), 2, "is a workbook; pastefit new --from")
        for content in ("{a, b\n1, 2\n}", "// a, b\n1, 2", "a\nb\n", '"title": "a",\n"lab": "b",\n', ""):
            text.write_text(content)
            self.fails(run("simulate", text), 2, "not JSON")

    def test_a_laboratory_file_in_place_of_its_study_is_named(self):
        lab = self.lab({"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}})
        self.fails(run("calibrate", lab, "--out", self.out), 2, "give the study of this laboratory file")

    def test_a_laboratory_file_of_20000_unknown_readings_is_read_in_seconds(self):
        lab = self.lab({f"step1.extra_{k}_mm": {"value": 160, "standard_deviation": 7.5} for k in range(20000)})
        start = time.monotonic()
        self.refused(lab, "step1.extra_19999_mm")
        self.assertLess(time.monotonic() - start, 10)

    def test_texts_of_windows_programs_are_read_or_named(self):
        lab = self.lab({"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}}, title="M\u00f6rtel")
        text = json.dumps(json.loads(lab.read_text()), ensure_ascii=False, indent=1)
        lab.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
        self.assertEqual(run("simulate", lab, "--quiet").returncode, 0)
        for content, words in (("\ufeff" + text).encode("utf-16-le"), ("UTF-16", "save the file as UTF-8")), \
                (text.encode("utf-16-be"), ("UTF-16",)), (text.encode("latin-1"), ("UTF-8",)), \
                (text.replace("160,", "160,\u00a0").encode(), ("a no-break space",)), \
                (text.replace('"value"', "\u201cvalue\u201d").encode(), ("a typographic quotation mark",)), \
                (text.replace("160", "\u2212160").encode(), ("a typographic minus sign",)):
            with self.subTest(words=words):
                lab.write_bytes(content)
                self.refused(lab, *words)

    def test_slips_at_the_command_line_are_answered_with_what_was_meant(self):
        lab = self.lab({"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}})
        self.fails(run("calibrate", self.study_of(), "--ot", self.out), 2, "--ot: is not an option", "did you mean --out?")
        self.fails(run("simulate", lab, "--set", "frction=0.3"), 2, 'did you mean "friction"?')
        self.fails(run("simulate", self.study_of(), "--set", "frction=0.3"), 2, 'did you mean "friction"?')
        (self.folder / "card.json").write_text("{}")
        self.fails(run("show", self.folder), 2, "is a folder; give a file of it", "card.json")

    def test_weights_of_readings_that_were_not_taken_are_left_out(self):
        self.lab({"step1.spread_mm": {"repeats": [330, 338]}})
        weights = {"step1.height_mm": 1, "step1.spread_mm": 1, "step1.lateral_shift_mm": 1}
        study = self.study_of(weights=weights, tolerances={name: 25 for name in weights})
        result = self.calibrates(study)
        self.assertIn("of readings that were not measured: step1.height_mm, step1.lateral_shift_mm", result.stderr)
        study.write_text(run("template", "study").stdout.replace('"budget_simulations": 150', '"budget_simulations": 30'))
        self.assertEqual(run("simulate", study).returncode, 0)

    def test_a_calibration_says_what_it_understood_before_it_starts(self):
        self.lab({"step1.slump_mm": {"value": 160, "standard_deviation": 7.5}})
        study = self.study_of(parameters={**PARAMETERS, "friction": {"free": [0.1, 0.6]}})
        said = self.calibrates(study).stderr
        for words in ("mould                    base 200 mm, top 100 mm, height 300 mm", "of 12 mm radius",
                      "step1.height_mm          140 within 7.5 mm", "4 simulations of about",
                      "Free without a reading of the spread: friction"):
            self.assertIn(words, said)
        self.assertLess(said.index("Fitted readings"), said.index("wrote"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
