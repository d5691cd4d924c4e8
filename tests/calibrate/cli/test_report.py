#!/usr/bin/env python3
"""The page of a calibration as written by the program; tests/page opens it in a browser.

usage: test_report.py PROGRAM SOURCE_DIR
"""

import base64
import json
import re
import shutil
import sys
import unittest
import zlib

from desk import CARD, Desk, run

MOST_BYTES = 3_000_000


def element_of(page, name):
    found = re.search(rf'<script type="[^"]*" id="{name}">(.*?)</script>', page, re.S)
    return found.group(1) if found else None


def content_of(folder):
    return json.loads(element_of((folder / "report.html").read_text(), "content"))


class Report(Desk):
    def page_of(self, folder, *options):
        result = run("report", folder, *options)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result, content_of(folder)

    def test_calibrate_writes_the_page_of_its_card_and_report_writes_it_again(self):
        self.calibrates(self.study(budget=12, screening=6))
        file = self.out / "report.html"
        self.assertLess(file.stat().st_size, MOST_BYTES)
        first = content_of(self.out)
        card = json.loads((self.out / "card.json").read_text())
        self.assertEqual(first["title"], card["title"])
        self.assertEqual(first["missing"], [])
        self.assertEqual({one["name"]: one["value"] for one in first["parameters"]}.items()
                         & card["material"]["parameters"].items(),
                         {one["name"]: one["value"] for one in first["parameters"]}.items())
        for reading in first["tests"][0]["readings"]:
            known = card["tests"][0]["readings"][reading["name"]]
            self.assertEqual(reading["simulated"], known["simulated"])
        self.assertTrue(first["tests"][0]["run_shown"]["same_as_card"])
        self.assertEqual(len(first["search"]["history"]), card["search"]["simulations"])
        file.unlink()
        _, second = self.page_of(self.out)
        # What is inferred is worked out anew, of all that the folder holds, and the curves reach as far as its materials.
        for content in (first, second):
            content.pop("inference", None)
            content["search"].pop("map")
            content["law"] = [(curve["role"], curve["points"][-1]) for curve in content["law"]
                              if curve["role"] != "equivalent"]
        self.assertEqual(first, second)

    def test_the_map_has_a_field_at_the_recommended_material(self):
        self.calibrates(self.study(budget=12, screening=6))
        drawn = content_of(self.out)["search"]["map"]
        for axis, value in zip((drawn["x"], drawn["y"]), drawn["equivalent"][0]):
            nearest = min(axis["places"], key=lambda place: abs(place - value))
            self.assertAlmostEqual(nearest / value, 1, delta=1e-4)
        self.assertEqual(len(drawn["miss"]), len(drawn["x"]["places"]) * len(drawn["y"]["places"]))

    def test_the_page_says_what_a_fifth_more_of_each_parameter_does_to_each_measured_reading(self):
        self.calibrates(self.study(budget=12, screening=6))
        content = content_of(self.out)
        measured = content["search"]["measured"].keys()
        free = {one["name"]: one for one in content["parameters"] if one["free"]}
        told = content["inference"]["sensitivities"]
        self.assertEqual([one["parameter"] for one in told], list(free))
        for one in told:
            bounds = free[one["parameter"]]
            self.assertAlmostEqual(one["from"] / bounds["value"], 1, delta=1e-4)
            self.assertTrue(bounds["lower"] <= one["to"] <= bounds["upper"])
            self.assertNotEqual(one["to"], one["from"])
            self.assertLessEqual(one["changes"].keys(), measured)
            for change, deviation in one["changes"].values():
                self.assertGreaterEqual(deviation, 0)

    def test_each_heap_of_a_drawing_names_its_packing(self):
        self.calibrates(self.study())
        content = content_of(self.out)
        lines = content["tests"][0]["drawings"][0]["lines"]
        drawn = [line["packing"] for line in lines if line["by"] in ("run", "rejected")]
        self.assertEqual(drawn, content["verdict"]["packings"])

    def test_a_folder_of_calibrations_has_a_page_of_verdicts_sheared_shares_and_predictions(self):
        card = json.loads(CARD.read_text())
        fitted = card["tests"][0]
        card["tests"] = [{**fitted, "name": "fitted"}, {**fitted, "name": "held", "hold_out": True, "within_noise": True}]
        for name, text in (("seed-1", CARD.read_text()), ("seed-2", json.dumps(card)), ("seed-3", "{")):
            (self.out / name).mkdir(parents=True)
            (self.out / name / "card.json").write_text(text)
        result = run("report", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        page = (self.out / "report.html").read_text()
        self.assertNotIn("<script", page)
        heads = re.findall("<th>(.*?)</th>", page)
        rows = [dict(zip(heads, re.findall("<td.*?>(.*?)</td>", row))) for row in re.findall('<tr class=.*?</tr>', page)]
        links = [re.search('href="(.*?)"', row["study"]).group(1) for row in rows]
        self.assertEqual(links, [f"seed-{k}/report.html" for k in (3, 1, 2)])
        self.assertEqual([row["verdict"] for row in rows], ["failed", "confirmed", "confirmed"])
        self.assertIn("its card is damaged", rows[0]["reasons"])
        self.assertEqual([row["sheared_share"] for row in rows[1:]], ["0", "0"])
        self.assertEqual([row["prediction"] for row in rows[1:]], ["", "held: predicted within the noise of both"])

    def test_the_film_holds_every_grain_of_every_frame(self):
        self.calibrates(self.study())
        page = (self.out / "report.html").read_text()
        film = content_of(self.out)["tests"][0]["film"]
        data = zlib.decompress(base64.b64decode(element_of(page, "film-0")))
        self.assertEqual(len(data), sum(reel["grains"] * (2 + 9 * len(reel["frames"])) for reel in film["reels"]))
        phases = {frame["phase"] for reel in film["reels"] for frame in reel["frames"]}
        self.assertEqual(phases, {"fill.grow", "fill.sink", "fill.strike", "fill.rest", "fill.settle", "step1.lift", "step1.rest"})

    def test_the_film_is_kept_beside_the_card_and_simulated_anew_only_where_it_is_not_whole(self):
        self.calibrates(self.study())
        first, views = content_of(self.out), self.out / "views.json"
        result, second = self.page_of(self.out, "--quick")
        self.assertEqual(result.stderr, "")
        self.assertEqual(first["tests"], second["tests"])
        whole = views.read_bytes()
        for spoil, words in ((lambda: views.write_bytes(whole[:len(whole) // 2]), "not JSON"),
                             (lambda: views.write_bytes(whole.replace(b'"packing"', b'"Packing"')), "is damaged"),
                             (views.unlink, "there is no such file")):
            spoil()
            result, third = self.page_of(self.out, "--quick")
            self.assertNotIn("film", third["tests"][0])
            self.assertIn(words, third["missing"][0])
        result, third = self.page_of(self.out)
        self.assertIn("the tests are simulated anew", result.stderr)
        self.assertEqual(first["tests"], third["tests"])
        self.assertEqual(views.read_bytes(), whole)

    def test_every_simulation_has_a_sketch_of_its_heap(self):
        self.calibrates(self.study())
        for point in content_of(self.out)["search"]["history"]:
            self.assertTrue(point["sketch"]["heap"])
            if not point.get("ended_early"):
                self.assertAlmostEqual(max(z for _, z in point["sketch"]["points"]), point["readings"]["step1.height_max_mm"], delta=8)

    def test_a_card_alone_has_a_page_that_says_what_it_lacks(self):
        self.out.mkdir()
        shutil.copy(CARD, self.out / "card.json")
        result, content = self.page_of(self.out, "--quick")
        self.assertIn("The simulations of the search are not shown", result.stderr)
        self.assertEqual(content["search"]["history"], [])
        self.assertNotIn("film", content["tests"][0])

    def test_a_store_alone_has_a_page_of_its_search(self):
        self.calibrates(self.study())
        (self.out / "card.json").unlink()
        result, content = self.page_of(self.out)
        self.assertIn("There is no card.json", result.stderr)
        self.assertEqual(len(content["search"]["history"]), 4)
        self.assertNotIn("verdict", content)

    def test_hostile_texts_stay_texts(self):
        self.out.mkdir()
        card = json.loads(CARD.read_text())
        card["title"] = "</script><script>alert(1)</script>"
        (self.out / "card.json").write_text(json.dumps(card))
        _, content = self.page_of(self.out, "--quick")
        self.assertEqual(content["title"], card["title"])
        self.assertNotIn("<script>alert", (self.out / "report.html").read_text())

    def test_what_is_no_result_is_refused_and_nothing_is_written(self):
        self.out.mkdir()
        self.fails(run("report", self.out), 2, "holds neither card.json nor evaluations.sqlite")
        self.assertEqual(list(self.out.iterdir()), [])
        self.fails(run("report", self.out / "none"), 2, "is not a folder")
        self.fails(run("report", CARD), 2, "is not a folder")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
