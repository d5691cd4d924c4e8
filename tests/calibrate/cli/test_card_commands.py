"""The commands for cards: show, rescale, export, check.

usage: test_card_commands.py PROGRAM SOURCE_DIR [unittest options]
"""

import json
import pathlib
import re
import statistics
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

from desk import CARD as SHIPPED, coarse_card, SOURCE, Desk, run

CARD = SOURCE / "tests/calibrate/card/card.json"
SEVERAL = CARD.with_name("several_tests.json")
TARGETS = ["lammps", "liggghts", "yade", "mercurydpm", "csv", "edem-notes"]


class CardCommands(Desk):
    def coarse(self, **changes):
        """The card carried to grains of 11 mm, which take a moment to simulate, with a baseline of its own."""
        file = self.folder / "coarse.json"
        result = run("rescale", CARD, "--radius", "11", "--packings", "0", "--out", file)
        self.assertEqual(result.returncode, 0, result.stderr)
        result = run("check", file, "--rebaseline", "--why", "coarse grains", "--packings", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        card = json.loads(file.read_text())
        card.update(changes)
        file.write_text(json.dumps(card))
        return file

    def test_show_prints_the_card_of_every_version(self):
        for file in sorted(CARD.parent.glob("*.json")):
            result = run("show", file)
            self.assertEqual(result.returncode, 0, result.stderr)
            for words in ("Type this into your DEM program", "density of a grain", "Intervals of the parameters", "Fitted in", "Baseline of checks"):
                self.assertIn(words, result.stdout)

    def test_bad_cards_are_bad_input_for_every_verb_and_nothing_is_written(self):
        cut, newer, impossible, unit, edited, unknown = (
            self.folder / name for name in ("cut", "newer", "impossible", "unit", "edited", "unknown"))
        text = CARD.read_text()
        cut.write_text(text[: len(text) // 2])
        newer.write_text(text.replace("pastefit-card-6", "pastefit-card-7"))
        card = json.loads(text)
        card["material"]["contact"]["bridge"]["b_n_m"] = -3
        impossible.write_text(json.dumps(card))
        card = json.loads(text)
        card["material"]["grains"]["radius"] = card["material"]["grains"].pop("radius_m")
        unit.write_text(json.dumps(card))
        card = json.loads(text)
        card["material"]["contact"]["friction"] += 0.1
        edited.write_text(json.dumps(card))
        card = json.loads(text)
        card["tests"][0]["test"]["kind"] = "pellet_crush"
        unknown.write_text(json.dumps(card))
        words = {cut: "not JSON", newer: "newer", impossible: "material.contact.bridge.b_n_m",
                 unit: "material.grains.radius_m", edited: "material.contact.friction", unknown: "tests[0].test.kind"}
        out = self.folder / "out"
        for file, word in words.items():
            for verb in (["show", file], ["rescale", file, "--radius", "9", "--out", out],
                         ["export", "--unconfirmed", file, "--to", "lammps", "--out", out]):
                self.fails(run(*verb), 2, word)
            result = run("check", file)
            self.assertEqual(result.returncode, 2)
            self.assertIn(word, result.stdout)
            self.assertFalse(out.exists())

    def test_every_file_to_type_from_has_one_density_of_a_grain(self):
        on_card = json.loads(CARD.read_text())["material"]["grain_density_kg_m3"]
        shown = run("show", CARD).stdout
        self.assertEqual(float(re.search(r"density of a grain +([0-9.]+)", shown)[1]), float(f"{on_card:.4g}"), shown)
        for target in TARGETS:
            out = self.folder / target
            self.assertEqual(run("export", "--unconfirmed", CARD, "--to", target, "--out", out).returncode, 0)
            said = [found[0] or found[1] for file in out.rglob("*") if file.suffix in (".csv", ".txt", ".inc", ".py")
                    for found in re.findall(r"grain_density_kg_m3[ ,]+([0-9.]+)|density of a grain,? [^(\n]*\(([0-9.]+) on the card", file.read_text())]
            self.assertTrue(said, target)
            for name in ("material.inc", "material.py", "parameters.csv", "edem.txt", "mercurydpm.txt"):
                text = (out / name).read_text() if (out / name).exists() else ""
                for number in re.findall(r"\b\d\.\d{12,}\b", text):  # 0.29999999999999999 is 0.3
                    self.assertLessEqual(len(number), len(repr(float(number))), name)
            for value in said:
                self.assertAlmostEqual(float(value), on_card, delta=1e-4, msg=target)

    def test_export_writes_every_target_whole_and_replaces_nothing(self):
        for target in TARGETS:
            out = self.folder / target
            result = run("export", "--unconfirmed", coarse_card(), "--to", target, "--out", out)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("NOTES.txt", result.stdout)
            if target in ("lammps", "liggghts", "yade"):
                self.assertIn(f"pastefit read heap.dump --card {coarse_card()}\n", result.stdout)
            self.fails(run("export", "--unconfirmed", coarse_card(), "--to", target, "--out", out), 2, "earlier result")
        for word, meant in (("lamps", "lammps"), ("EDEM", "edem-notes")):
            self.fails(run("export", CARD, "--to", word, "--out", self.folder / "x"), 2, f"did you mean '{meant}'")
        self.assertFalse((self.folder / "x").exists())

    def filled(self, card):
        """The grains of the card's mould: x, y, z, radius."""
        deck = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "deck"
        result = run("export", card, "--to", "csv", "--out", deck, "--unconfirmed")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = (deck / "grains.csv").read_text().splitlines()
        return [[float(number) for number in row.split(",")] for row in rows if not row.startswith(("#", "x_m"))]

    def dump(self, name, rows, scale=1):
        lines = [f"{i} {' '.join(str(scale * number) for number in row)}\n" for i, row in enumerate(rows, 1)]
        (self.folder / name).write_text(f"ITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: ATOMS id x y z radius\n" + "".join(lines))
        return self.folder / name

    def test_a_heap_is_accepted_rejected_or_refused(self):
        filled = self.filled(SHIPPED)
        self.dump("filled.dump", filled)
        # the mould pressed flat to a heap of the card's height and width
        heap = [[(1.58 + 1.3 * z) * x + 0.05 * z, (1.58 + 1.3 * z) * y, r + 0.45 * (z - r), r] for x, y, z, r in filled]

        def read(rows, scale=1, *options):
            return run("read", self.dump("heap.dump", rows, scale), "--card", SHIPPED, *options)

        result = read(heap)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("The heap agrees with the card.", result.stdout)
        self.assertRegex(result.stdout, r"spilled_share .* none\n")  # it does not vary
        self.assertEqual(json.loads(read(heap, 1, "--json").stdout)["readings"]["step1.spilled_share"]["noise"], 0)
        result = read([[x + 0.2 * z, *rest, z, r] for x, *rest, z, r in heap])
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("the heap sheared off", result.stdout)
        self.assertIn("The heap sheared off, so it is not compared", result.stdout)
        self.fails(read([[*at, 1.5 * r] for *at, r in heap]), 2, "1 error", "the heap of step 1", "about 1.5 times")
        self.fails(read(heap, 100), 2, "1 error", "the heap of step 1", "about 99 times")
        self.fails(read([[x, y, z + 1, r] for x, y, z, r in heap]), 2, "the heap of step 1", "mm above the table")
        self.dump("filled.dump", filled, 100)
        self.fails(read(heap, 100), 2, "the filled mould", "the heap of step 1", "about 99 times")
        self.fails(read(heap), 2, "1 error", "the filled mould", "about 99 times")

    def test_the_card_of_few_accepted_heaps_says_of_how_many_its_readings_are(self):
        for packings in (3, 2):
            card = self.sheared(packings)
            words = f"mean +- standard deviation of {packings} of the card's 8 packings"
            for target, of in (("lammps", "The heap to expect"), ("liggghts", "The card's heap, which this law does not reproduce")):
                out = self.folder / f"{target}{packings}"
                result = run("export", card, "--to", target, "--out", out, "--unconfirmed")
                for text in (result.stdout, (out / "NOTES.txt").read_text()):
                    self.assertIn(f"{of} ({words}):", text)
        heap = self.dump("filled.dump", self.filled(card))  # as high as the mould
        result = run("read", heap, "--card", card)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn(f"Card: {words}.\nNot compared: the card has no readings of three packings or more.", result.stdout)
        self.assertRegex(result.stdout, r"step1.height_mm .* unknown\n")
        answer = json.loads(run("read", heap, "--card", card, "--json").stdout)
        self.assertIsNone(answer["agrees"])
        self.assertNotIn("agrees", answer["readings"]["step1.height_mm"])

    def test_the_heap_of_a_deck_is_read_beside_the_card(self):
        rows = self.filled(CARD)
        standing = self.dump("heap.dump", rows)
        self.fails(run("read", standing, "--card", CARD), 2, "filled.dump", "--filled")
        self.dump("filled.dump", rows)
        self.fails(run("read", standing, "--card", coarse_card()), 2, "grains, that of the card")  # another card's
        result = run("read", standing, "--card", CARD, "--json")
        self.assertEqual(result.returncode, 1, result.stderr)  # it did not slump
        answer = json.loads(result.stdout)
        height = answer["readings"]["step1.height_mm"]
        self.assertAlmostEqual(height["read"], 300, delta=6)
        card = json.loads(CARD.read_text())["tests"][0]["readings"]["step1.height_mm"]
        self.assertEqual(height["simulated"], card["simulated"])
        self.assertEqual(height["measured"], card["measured"])
        # One reading of a heap of the same material is beyond its noise in one heap of twenty, over all of its readings.
        scattering = sum(one.get("noise", 0) > 0 for one in answer["readings"].values())
        self.assertGreater(scattering, 3)
        least = statistics.NormalDist().inv_cdf(1 - 0.025 / scattering)
        self.assertGreater(height["noise"], least * height["simulated_standard_deviation"])
        self.assertFalse(height["agrees"])
        text = run("read", standing, "--card", CARD).stdout
        self.assertIn("differs", text)
        self.assertLessEqual(max(map(len, text.splitlines())), 110)
        bad = self.dump("bad.dump", [[float("nan"), *rows[0][1:]], *rows[1:]])
        self.fails(run("read", bad, "--card", self.folder / "none.json"), 2, "bad.dump line 4", "none.json")
        self.fails(run("read", self.dump("short.dump", rows[1:]), "--card", CARD), 2, "grains")

    def test_of_several_tests_the_one_that_is_named_is_exported_and_simulated(self):
        first, named = self.folder / "first", self.folder / "named"
        result = run("export", "--unconfirmed", SEVERAL, "--to", "csv", "--out", first)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("the card's test slow. The card has others: fast, coarse", result.stdout)
        result = run("export", "--unconfirmed", SEVERAL, "--to", "csv", "--out", named, "--test", "coarse")
        self.assertEqual(result.returncode, 0, result.stderr)
        radius = [float((folder / "parameters.csv").read_text().split("grain_radius_m,")[1].split(",")[0])
                  for folder in (first, named)]
        self.assertEqual(radius, [0.012, 0.014])
        heights = {name: json.loads(run("simulate", SEVERAL, "--json", *choice).stdout)["observables"]["step1.height_mm"]
                   for name, choice in {"": [], "slow": ["--test", "slow"], "fast": ["--test", "fast"]}.items()}
        self.assertEqual(heights[""], heights["slow"])
        self.assertNotEqual(heights["slow"], heights["fast"])
        for verb in (["export", "--unconfirmed", SEVERAL, "--to", "csv", "--out", self.folder / "x"], ["simulate", SEVERAL]):
            self.fails(run(*verb, "--test", "quick"), 2, "--test quick", "slow, fast, coarse")
        self.fails(run("simulate", CARD, "--test", "slow"), 2, "--test slow", "leave it out")
        self.fails(run("simulate", SOURCE / "data/apparatus/abrams.json", "--test", "slow"), 2, "--test", "leave it out")
        self.assertFalse((self.folder / "x").exists())

    def test_settings_of_a_card_are_of_todays_form_whatever_its_version(self):
        for card, lift in ((CARD, 0), (SEVERAL, 1)):
            place = f"tests[{lift}].test.lift_velocity_m_s"
            self.fails(run("simulate", card, "--set", f"{place}=-1"), 2, place, "-1")
            self.fails(run("simulate", card, "--set", "tests[9].test.lift_velocity_m_s=1"), 2, "does not lead to a place")

    def sheared(self, packings=3):
        """A card whose readings are met by heaps of which five of eight sheared off, or more."""
        card = json.loads((SOURCE / "data/cards/concrete-mix-20.json").read_text())
        card["confirmation"]["rejected_share"] = 0.2
        for reading in card["tests"][0]["readings"].values():
            reading["packings"] = packings
        file = self.folder / "sheared.json"
        file.write_text(json.dumps(card))
        return file

    def test_an_unconfirmed_card_leaves_only_when_asked_for_and_every_file_begins_with_why(self):
        sheared, cause = self.sheared(), "5 of 8 heaps sheared off, 1 in 5 allowed"
        coarse = self.folder / "coarse.json"
        run("rescale", sheared, "--radius", "11", "--packings", "0", "--out", coarse)
        self.assertEqual(run("show", sheared).stdout.split("\n")[0], f"NOT CONFIRMED: {cause}")
        self.assertTrue(run("show", coarse).stdout.startswith("NOT CONFIRMED: converted from grains of"))
        self.assertNotIn("NOT CONFIRMED", run("show", CARD).stdout)
        for target in TARGETS:
            out = self.folder / target
            self.fails(run("export", coarse, "--to", target, "--out", out), 2, "--unconfirmed", "not confirmed")
            self.assertFalse(out.exists())
            result = run("export", coarse, "--to", target, "--out", out, "--unconfirmed")
            self.assertEqual(result.returncode, 0, result.stderr)
            files = [file for file in out.glob("*") if file.is_file()]
            self.assertGreater(len(files), 1)
            for file in files:
                with self.subTest(file=file.name):
                    self.assertIn("NOT CONFIRMED: converted", file.read_text().split("\n")[0])

    def test_what_the_target_lacks_and_that_a_card_is_unconfirmed_are_said_at_once(self):
        card = json.loads(coarse_card().read_text())
        card["material"]["contact"]["restitution"] = card["material"]["parameters"]["restitution"] = 0.02
        file = self.folder / "card.json"
        file.write_text(json.dumps(card))
        self.fails(run("export", file, "--to", "liggghts", "--out", self.out), 2, "2 errors", "not confirmed", "restitution")

    def test_the_verdict_names_the_cause_and_what_to_try(self):
        text = " ".join(run("show", self.sheared()).stdout.split())
        self.assertIn("The readings are within their tolerances, but 5 of 8 heaps sheared off, 1 in 5 allowed: largest error 1.25 mm of the 5 mm allowed", text)
        self.assertIn("What to try now: ", text)
        self.assertNotIn("does not reproduce the measurement", text)

    def test_doctor_says_of_each_property_whether_it_is_fine_and_which_page_explains_it(self):
        result = run("doctor", SHIPPED, "--json")
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        told = json.loads(result.stdout)
        states = {one["name"]: one["state"] for one in told["diagnoses"]}
        self.assertEqual((states["readings within tolerance"], states["heaps sheared off"], states["intervals"]), ("fine", "fine", "doubtful"))
        self.assertEqual(told["doubtful"], list(states.values()).count("doubtful"))
        manual = SOURCE / "calibrate/manual"
        for one in told["diagnoses"]:
            page, _, heading = one["page"].partition("#")
            headings = [re.sub(r"[^a-z -]", "", line.strip("# \n").lower()).replace(" ", "-")
                        for line in (manual / page).read_text().splitlines() if line.startswith("#")]
            self.assertIn(heading, [*headings, ""], one["name"])
        text = run("doctor", SHIPPED).stdout
        self.assertIn("May be ignored if", text)
        self.assertIn("readings within tolerance: fine", text)
        sheared = run("doctor", self.sheared())
        self.assertTrue(sheared.stdout.startswith("NOT CONFIRMED: 5 of 8 heaps sheared off"))

    def test_doctor_exits_with_0_where_all_is_fine(self):
        card = json.loads(SHIPPED.read_text())
        del card["not_identified"]
        spread = card["tests"][0]["readings"]["step1.spread_mm"]  # unusual beside the height
        card["tests"][0]["readings"]["step1.spread_mm"] = {key: spread[key] for key in spread if key.startswith(("sim", "standard_e"))} | {"measured": None}
        file = self.folder / "card.json"
        file.write_text(json.dumps(card))
        result = run("doctor", file)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("\n0 of ", result.stdout)
        self.fails(run("doctor", self.folder / "nothing.json"), 2, "nothing.json")
        self.out.mkdir()
        self.fails(run("doctor", self.out), 2, "neither card.json nor evaluations.sqlite")

    def test_a_law_the_target_lacks_is_bad_input(self):
        card = json.loads(CARD.read_text())
        card["material"]["contact"].update(normal="jkr", surface_energy_j_m2=8)  # the usual adhesion of 1000 Pa times R
        file = self.folder / "card.json"
        file.write_text(json.dumps(card))
        self.fails(run("export", "--unconfirmed", file, "--to", "csv", "--out", self.folder / "x"), 2, "jkr", "hertz")
        self.assertFalse((self.folder / "x").exists())

    def test_rescale_measures_its_bias_and_the_new_card_is_a_card(self):
        coarse, out = self.coarse(), self.folder / "coarser.json"
        result = run("rescale", coarse, "--radius", "10", "--packings", "2", "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("bias", result.stdout)
        card = json.loads(out.read_text())
        self.assertEqual(card["rescaled"][-1]["from_radius_m"], 0.011)
        self.assertGreater(card["rescaled"][-1]["bias"]["step1.height_axis_mm"]["standard_error"], 0)
        self.assertEqual(run("check", out, "--quick").returncode, 0)
        self.fails(run("rescale", coarse, "--radius", "40"), 2, "radius")

    def test_a_card_of_one_packing_shows_that_its_error_is_unknown_wherever_it_is_shown(self):
        self.calibrates(self.study())  # which confirms on one packing
        card = self.out / "card.json"
        filled = self.dump("filled.dump", self.filled(card))
        page = (self.out / "report.html").read_text().split('id="content">')[1].split("</script>")[0]
        for text in ((self.out / "summary.txt").read_text(), run("show", card).stdout, run("simulate", card).stdout, page,
                     run("read", filled, "--card", card).stdout):
            self.assertIn("ne packing, error unknown", text)
            self.assertNotRegex(text, r"\+- ?0\b(?!\.)")
        self.assertNotIn("standard_error", json.loads(card.read_text())["tests"][0]["readings"]["step1.height_mm"])

    def test_check_answers_by_status_text_json_and_junit(self):
        card, report = self.coarse(), self.folder / "report.xml"
        result = run("check", card, "--quick", "--json", "--junit", report)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        answer = json.loads(result.stdout)["cards"][0]
        self.assertEqual((answer["verdict"], answer["bits"]), ("agrees", "same"))
        self.assertEqual(xml.parse(report).getroot().get("failures"), "0")
        self.assertGreater(float(xml.parse(report).find("testcase").get("time")), 0)

        changed = json.loads(card.read_text())
        baseline = changed["tests"][0]["baseline"]
        heights = baseline["readings"]["step1.height_axis_mm"]
        baseline["readings"]["step1.height_axis_mm"] = [height + 1e-9 for height in heights]
        card.write_text(json.dumps(changed))
        result = run("check", card, "--quick", "--junit", report)
        self.assertEqual(result.returncode, 2)  # a report that is there already
        result = run("check", card, "--quick", "--junit", report, "--force")
        self.assertEqual(result.returncode, 1)
        self.assertIn("same bits", " ".join(result.stdout.split()))  # as lines are broken
        self.assertEqual(xml.parse(report).getroot().get("failures"), "1")
        baseline["program"] = "an older pastefit"
        card.write_text(json.dumps(changed))
        self.assertEqual(run("check", card, "--quick").returncode, 0)
        self.assertEqual(run("check", card, "--quick", "--bits").returncode, 1)
        self.assertEqual(run("check", card, self.folder / "missing.json", "--quick").returncode, 2)

    def test_a_rebaseline_needs_a_reason_and_records_it(self):
        card = self.coarse()
        before = card.read_text()
        self.fails(run("check", card, "--rebaseline"), 2, "--why")
        self.assertEqual(card.read_text(), before)
        self.assertEqual(json.loads(before)["rebaselined"][-1]["why"], "coarse grains")
        self.assertIn("coarse grains", run("show", card).stdout)

    def test_a_card_is_judged_by_a_laboratory(self):
        card = self.coarse()
        lab = SOURCE / "data/lab/concrete-mix-02.json"  # it stands; the card's material flows
        result = run("check", card, "--against", lab)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.fails(run("check", card, "--against", self.folder / "none.json"), 2, "none.json")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
