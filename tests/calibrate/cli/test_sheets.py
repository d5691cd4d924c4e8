"""What people bring from their laboratories: decimal commas, inches, misread repeats, a radius for a width. It is
refused, or named before anything runs, in the words of who typed it.

usage: test_sheets.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import sys
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
                     "is 33; a number from 196 to 900 mm", "33 cm are 330 mm", "33 in are 838.2 mm")
        result = run("simulate", self.lab({"step1.slump_mm": {"value": 7.25, "standard_deviation": 7.5}}))
        self.assertIn("7.25 in are 184.15 mm", result.stderr)
        self.assertIn("7.25 cm are 72.5 mm", result.stderr)

    def test_a_bare_reading_is_answered_with_its_form(self):
        self.refused(self.lab({"step1.slump_mm": 120, "step1.spread_mm": [300, 310]}),
                     'write {"value": 120, "standard_deviation": 7.5}', 'write {"repeats": [300,310]}')

    def test_a_radius_given_as_a_width_is_named_first(self):
        lab = self.lab({"step1.height_mm": {"value": 107, "standard_deviation": 7.5},
                        "step1.spread_mm": {"value": 236, "standard_deviation": 25}})
        words = ("no heap of this volume is 107 mm high and 236 mm wide", "256 mm wide",
                 "if 236 mm is a radius, the width is 472 mm")
        result = run("simulate", lab)
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        document = json.loads(lab.read_text())
        document["measurements"]["step1.spread_mm"]["standard_deviation"] = 5
        lab.write_text(json.dumps(document))
        self.refused(lab, "contradicts", "if 236 mm is a radius, the width is 472 mm")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
