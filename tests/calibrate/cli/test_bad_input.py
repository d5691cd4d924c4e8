"""Bad input gives one message with every error and exit status 2, and nothing is written.

usage: test_bad_input.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import os
import subprocess
import sys
import time
import unittest

from desk import PROGRAM, SOURCE, STUDY, CARD, LAB, APPARATUS, Desk, run


def numbers_in(schema, place=""):
    """Every number of an object's schema: its place and its bounds."""
    for key, inner in schema.get("properties", {}).items():
        if inner.get("type") == "number":
            yield place + key, inner
        else:
            yield from numbers_in(inner, f"{place}{key}.")


class BadInput(Desk):
    def test_unknown_verbs_and_options_are_bad_input(self):
        self.fails(run("simulat", STUDY), 2, "did you mean 'simulate'")
        self.fails(run("simulate"), 2, "FILE")
        self.fails(run("simulate", APPARATUS, "--sed", "3"), 2, "--sed")
        self.fails(run("export", CARD, "--out", self.out), 2, "--to")
        self.fails(run("calibrate", STUDY, "--out", self.out, "--force", "--resume"), 2, "--force")
        self.assertFalse(self.out.exists())

    def test_threads_that_are_no_number_are_bad_input(self):
        for threads in ("0", "-3", "two", "1.5", "99999999999999999999"):
            for verb in (["calibrate", STUDY, "--out", self.out], ["check", CARD], ["rescale", CARD, "--radius", "7"], ["simulate", APPARATUS]):
                self.fails(run(*verb, "--threads", threads), 2, "--threads", threads, "give a whole number")
        self.assertFalse(self.out.exists())

    def test_a_scene_beyond_the_memory_is_refused_before_anything_is_computed(self):
        start = time.monotonic()
        self.fails(run("simulate", APPARATUS, "--set", "grains.radius_mm=0.02", "--out", self.out), 2, "grains", "GB", "larger")
        lab = json.loads(LAB.read_text())
        lab["grains"] = {"distribution": "mono", "radius_mm": 0.02}
        study = self.study()
        (self.folder / "lab.json").write_text(json.dumps(lab))
        self.fails(run("calibrate", study, "--out", self.out), 2, "grains", "GB", "larger")
        self.fails(run("rescale", CARD, "--radius", "0.02"), 2, "grains", "GB", "larger")
        self.assertLess(time.monotonic() - start, 20)
        self.assertFalse(self.out.exists())

    def test_schema_and_program_agree_on_the_bounds_of_every_apparatus(self):
        # Where another length or the granules say how far one may go, the program may be stricter at that end.
        stricter = {"top_diameter_mm", "probe_diameter_mm", "die_diameter_mm", "length_mm", "width_mm", "fill_height_mm",
                    "sag_window_mm", "lift_height_mm", "pressed_height_mm", "ribs", "speed_mm_s", "speedup",
                    "flow.diameter_mm", "flank."}
        schema = json.loads((SOURCE / "data/schema/lab.schema.json").read_text())
        presets, _, *others = schema["properties"]["apparatus"]["oneOf"]
        checked = 0
        for template, apparatus in zip(("lab", "drop-lab", "pellet-lab", "shear-lab"), (presets, *others)):
            lab = self.folder / f"{template}.json"
            confirmed = json.dumps(["apparatus.mould.height_mm", "material.bulk_density_kg_m3"])
            lab.write_text(run("template", template).stdout.replace('"abrams"', '"en12350-5"')  # that has a drop plate
                           .replace('"title"', f'"confirmed": {confirmed}, "title"', 1))
            for place, number in numbers_in(apparatus):
                bounds = [(number["maximum"], 1)]
                bounds += [(number[key], -1) for key in ("minimum", "exclusiveMinimum") if key in number]
                for bound, outwards in bounds:
                    beyond = bound + outwards * max(abs(bound), 1e-3) * 1e-3
                    self.assertTrue(self.refused(lab, place, beyond, 60), f"{template}: {place} = {beyond}")
                    checked += 1
                    if not any(word in place for word in stricter):
                        within = bound if "exclusiveMinimum" not in number or outwards > 0 else bound + 1e-3
                        self.assertFalse(self.refused(lab, place, within, 0.5), f"{template}: {place} = {within}")
        self.assertGreater(checked, 60)

    def refused(self, lab, place, value, patience_s):
        """Whether that value is refused for itself; what is not is simulated, and stopped."""
        command = [PROGRAM, "simulate", str(lab), "--set", f"apparatus.{place}={value!r}"]
        try:
            result = subprocess.run(command, capture_output=True, text=True, timeout=patience_s)
        except subprocess.TimeoutExpired:
            return False
        return f"apparatus.{place}: " in result.stderr

    def test_every_fault_of_a_study_is_listed_and_nothing_is_written(self):
        study = self.study(tittle="x", parameters={"strength_pa": {"free": [5, 1]}, "frction": {"value": 1}})
        result = run("calibrate", study, "--out", self.out)
        self.fails(result, 2, "tittle", "strength_pa", "did you mean \"friction\"")
        self.assertEqual(result.stdout, "")
        self.assertFalse(self.out.exists())

    def test_parameters_of_laws_that_were_not_chosen_are_bad_input(self):
        study = self.study(contact={"normal": "jkr", "attraction": "exponential"},
                           parameters={"strength_pa": {"free": [300, 40000]}, "curvature": {"free": [-0.5, 1]},
                                       "rupture_force_ratio": {"value": 0}, "adhesion_pa": {"free": [100, 10000]}})
        for verb in (["calibrate", study, "--out", self.out], ["simulate", study]):
            result = run(*verb)
            self.fails(result, 2, "study.json: parameters.curvature: belongs to attraction \"polynomial\"",
                       "study.json: parameters.rupture_force_ratio: belongs to attraction \"polynomial\"",
                       "chosen is attraction \"exponential\"", "\"contact\": {\"attraction\": \"polynomial\"}")
            self.assertNotIn("strength_pa", result.stderr)
            self.assertNotIn("adhesion_pa", result.stderr)
            self.assertEqual(result.stdout, "")
        self.assertFalse(self.out.exists())
        for file in (CARD, LAB, APPARATUS):
            self.fails(run("simulate", file, "--set", "parameters.adhesion_pa=500"), 2,
                       "--set parameters.adhesion_pa", "belongs to normal \"jkr\", \"dmt\"")

    def test_an_apparatus_for_granules_that_cannot_work_is_bad_input_in_one_message(self):
        pellet, shear = self.folder / "pellet.json", self.folder / "shear.json"
        pellet.write_text(run("template", "pellet-lab").stdout)
        shear.write_text(run("template", "shear-lab").stdout)
        cases = (
            (pellet, ["apparatus.die_diameter_mm=8"], "grains.radius_mm", "of a few granules says nothing", "at most"),
            (pellet, ["apparatus.press_speedup=5000"], "apparatus.press_speedup", "sound in a bed", "slower punch"),
            (pellet, ["apparatus.platen_speed_mm_s=9000"], "apparatus.platen_speed_mm_s", "sound in a bed", "slower"),
            (shear, ["apparatus.normal_stress_pa=-2000"], "apparatus.normal_stress_pa", "is -2000 Pa", "1 to 1e+07 Pa"),
            (pellet, ["grains.standard_deviation_mm=0.01", "grains.radius_mm=1.2", "grains.smallest_mm=0.5",
                      "grains.largest_mm=1.2", "grains.smallest_mm=1.19999"],
             "grains.standard_deviation_mm", "% of the grains between smallest and largest", "widen the bounds"))
        for file, settings, *words in cases:
            with self.subTest(settings):
                options = [word for setting in settings for word in ("--set", setting)]
                result = run("simulate", file, *options, "--out", self.out)
                self.fails(result, 2, *words)
                self.assertEqual(result.stderr.count("pastefit: "), 1, result.stderr)
                self.assertEqual(result.stdout, "")
                self.assertFalse(self.out.exists())

    def test_laws_that_do_not_go_together_are_bad_input(self):
        study = self.study(contact={"normal": "dmt", "attraction": "linear"},
                           parameters={"friction": {"free": [0.1, 1]}})
        self.fails(run("calibrate", study, "--out", self.out), 2, "contact.attraction", "beside normal \"dmt\"",
                   "\"attraction\": \"none\"")
        self.assertFalse(self.out.exists())

    def test_a_missing_file_and_a_file_that_is_no_json_are_bad_input(self):
        broken = self.folder / "broken.json"
        broken.write_text("{,}")
        for file in (self.folder / "missing.json", broken):
            for verb in (["calibrate", file, "--out", self.out], ["simulate", file]):
                self.fails(run(*verb), 2, file.name)
        self.assertFalse(self.out.exists())

    def test_an_impossible_budget_is_bad_input(self):
        self.fails(run("calibrate", self.study(), "--out", self.out, "--budget", "1"), 2, "budget")
        self.assertFalse(self.out.exists())

    def test_a_folder_that_cannot_be_made_is_reported_before_anything_runs(self):
        blocked = self.folder / "file"
        blocked.write_text("x")
        self.fails(run("calibrate", self.study(), "--out", blocked / "out"), 2, "--out")
        self.fails(run("calibrate", self.study(), "--out", "/proc/pastefit"), 2, "--out")
        self.fails(run("simulate", APPARATUS, "--out", blocked), 2, "--out")

    def test_an_earlier_result_is_left_alone(self):
        self.out.mkdir()
        card = self.out / "card.json"
        card.write_text("precious")
        self.fails(run("calibrate", self.study(), "--out", self.out), 2, "earlier result", "--resume", "--force")
        self.fails(run("calibrate", self.study(title=3), "--out", self.out, "--force"), 2, "title")
        self.assertEqual(card.read_text(), "precious")
        self.assertEqual(os.listdir(self.out), ["card.json"])

    def test_a_store_that_is_damaged_or_of_another_study_is_left_alone(self):
        self.out.mkdir()
        store = self.out / "evaluations.sqlite"
        store.write_text("not a database" * 100)
        self.fails(run("calibrate", self.study(), "--out", self.out, "--resume"), 2, "evaluations.sqlite")
        self.assertEqual(store.read_text(), "not a database" * 100)

    # settings

    def test_faults_of_settings_name_the_setting(self):
        result = run("simulate", STUDY, "--set", "parameters.frction=1", "--set", "parameters.friction=9", "--set",
                     "nonsense", "--set", "frction=1", "--set", "grains.radus_mm=6")
        self.fails(result, 2, "did you mean \"friction\"", "must be 0 to 2", "path=value", "radius_mm",
                   "--set frction: is neither a parameter nor")
        self.assertEqual(result.stderr.count("--set frction"), 1)
        self.fails(run("simulate", APPARATUS, "--set", "title.x=1"), 2, "title.x")
        self.fails(run("simulate", APPARATUS, "--set", "apparatus.mould.height_mm=-1"), 2, "height_mm")

    def test_vtk_needs_a_folder(self):
        self.fails(run("simulate", APPARATUS, "--vtk", "0.1"), 2, "--out")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
