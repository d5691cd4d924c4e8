"""Studies, cards, export and checks from Python. usage: test_study.py PROGRAM SOURCE_DIR [unittest options]"""

import json
import pickle
import subprocess

import numpy as np
from studies import CARD, PROGRAM, STUDY, Desk, coarse_study, main
import pastefit as pf


class Study(Desk):
    def test_a_study_file_says_what_is_fitted_to_what(self):
        study = pf.Study.load(STUDY)
        self.assertEqual(study.free["strength_pa"], (300, 40000))
        self.assertEqual(study.fixed["friction"], 0.15)
        self.assertIn("step1.height_mm", study.readings["name"])
        self.assertEqual(study.budget_simulations, 80)

    def test_a_dict_holds_its_laboratory_and_numbers_of_numpy(self):
        study = pf.Study(coarse_study(seed=np.int64(3)))
        self.assertEqual(list(study.free), ["strength_pa"])
        self.assertEqual(study.readings["measured"][0], 150)
        self.assertEqual(study.content["search"]["seed"], 3)

    def test_changes_are_merged_key_by_key(self):
        study = pf.Study(coarse_study()).changed({"search": {"budget_simulations": 20}})
        self.assertEqual(study.budget_simulations, 20)
        self.assertEqual(study.content["search"]["screening"], 3)

    def test_every_fault_of_study_and_laboratory_comes_at_once(self):
        content = coarse_study(screening=-1)
        content["parameters"]["fricton"] = {"value": 0.1}
        content["lab"]["material"]["bulk_density_kg_m3"] = -5
        faults = self.faults(pf.Study, content)
        places = [fault.where for fault in faults]
        self.assertIn("search.screening", places)
        self.assertIn("parameters.fricton", places)
        self.assertIn("lab: material.bulk_density_kg_m3", places)
        self.assertTrue(all(fault.remedy for fault in faults))

    def test_a_key_that_is_no_text_is_told_with_its_place(self):
        for key in ("\ud800", 3, (1, 2)):
            content = coarse_study()
            content["parameters"][key] = {"value": 1}
            fault, = self.faults(pf.Study, content)
            self.assertEqual(fault.where, "parameters")
            self.assertIn(repr(key), fault.what)

    def test_the_message_has_a_line_for_each_fault_and_survives_another_process(self):
        with self.assertRaises(pf.InputError) as raised:
            pf.Study.load(self.folder / "nowhere.json")
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual(str(again), str(raised.exception))
        self.assertEqual(again.faults[0], raised.exception.faults[0])
        self.assertIn("nowhere.json", again.faults[0].where)


class Card(Desk):
    def test_a_card_says_its_parameters_and_how_well_it_meets_the_laboratory(self):
        card = pf.Card.load(CARD)
        self.assertTrue(card.meets_laboratory)
        self.assertIn("friction", card.parameters)
        self.assertEqual(list(card.readings["name"]), ["step1.height_mm", "step1.spread_mm"])
        self.assertIn("reproduces the measurement", card.verdict)

    def test_a_saved_card_is_the_same_card(self):
        card = pf.Card.load(CARD)
        card.save(self.folder / "card.json")
        self.assertEqual(pf.Card.load(self.folder / "card.json"), card)
        self.assertEqual(subprocess.run([PROGRAM, "show", self.folder / "card.json"], capture_output=True).returncode, 0)

    def test_a_card_shows_itself_as_table_and_drawing(self):
        shown = pf.Card.load(CARD)._repr_html_()
        for part in ("<table>", "<svg", "step1.spread_mm"):
            self.assertIn(part, shown)

    def test_an_export_has_the_files_of_the_program(self):
        there = self.folder / "program"
        subprocess.run([PROGRAM, "export", CARD, "--to", "csv", "--out", there], check=True, capture_output=True)
        written = pf.export(CARD, to="csv", out=self.out)
        names = sorted(file.name for file in there.iterdir())
        self.assertEqual(sorted(written.files), names)
        for name in names:
            self.assertEqual((self.out / name).read_bytes(), (there / name).read_bytes(), name)

    def test_an_unconfirmed_card_is_exported_only_when_asked_for(self):
        card = json.loads(CARD.read_text())
        card["confirmation"].update(fresh=False, meets_laboratory=False)
        fault, = self.faults(pf.export, pf.Card(card), to="csv")
        self.assertIn("unconfirmed=True", fault.remedy)
        written = pf.export(pf.Card(card), to="csv", unconfirmed=True)
        for name, content in written.files.items():
            self.assertIn("NOT CONFIRMED", content.split("\n")[0], name)

    def test_an_export_to_an_unknown_program_names_the_known_ones(self):
        fault, = self.faults(pf.export, CARD, to="lamps")
        self.assertIn("lammps", fault.remedy)
        self.assertIn("lammps", pf.export_targets())

    def test_an_earlier_export_is_replaced_only_by_force(self):
        pf.export(CARD, to="edem-notes", out=self.out)
        fault, = self.faults(pf.export, CARD, to="edem-notes", out=self.out)
        self.assertIn("force=True", fault.remedy)
        pf.export(CARD, to="edem-notes", out=self.out, force=True)

    def test_every_option_of_a_check_or_export_that_is_wrong_is_told_with_its_remedy(self):
        for call, wrong in ((pf.check, {"threads": -1}), (pf.check, {"threads": 1.5}), (pf.check, {"false_alarm": -3}),
                            (pf.check, {"false_alarm": float("nan")}), (pf.export, {"to": "csv", "packing": -1}),
                            (pf.export, {"to": "csv", "packing": True})):
            fault, = self.faults(call, CARD, **wrong)
            self.assertEqual(fault.where, list(wrong)[-1])
            self.assertTrue(fault.remedy)

    def test_a_physics_case_holds(self):
        verified = pf.verify(["chung-ooi-1"])
        self.assertGreater(verified.checks, 0)
        self.assertEqual(verified.failed, 0)
        self.assertEqual(set(verified.rows["case"]), {"chung-ooi-1"})


if __name__ == "__main__":
    main()
