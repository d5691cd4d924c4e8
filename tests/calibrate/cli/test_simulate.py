"""`pastefit simulate`: outcome, repetition, outline, yield stress and the series for ParaView.

usage: test_simulate.py PROGRAM SOURCE_DIR [unittest options]
"""

import base64
import json
import math
import struct
import sys
import unittest
import xml.etree.ElementTree as xml

from desk import APPARATUS, COARSE, Desk, LAB, SOURCE, run


class Simulate(Desk):
    def test_simulate_prints_its_outcome_as_json_and_repeats_itself(self):
        arguments = ["simulate", APPARATUS, *COARSE, "--set", "parameters.strength_pa=3000", "--seed", "5", "--json"]
        first, second = (json.loads(run(*arguments).stdout) for _ in range(2))
        self.assertEqual(set(first["run"]), {"particles", "steps", "time_step_s", "simulated_s", "wall_s",
                                             "particle_steps_per_s", "settled", "failure", "advised_step_s",
                                             "energy_error"})
        self.assertIsNone(first["run"]["failure"])
        self.assertTrue(50 < first["observables"]["step1.height_mm"] <= 300)
        self.assertEqual(first["observables"], second["observables"])
        arguments[arguments.index("5")] = "6"
        self.assertNotEqual(first["observables"], json.loads(run(*arguments).stdout)["observables"])

    def test_simulate_takes_impacts_which_have_no_energy_balance(self):
        taken = 0
        for case in sorted((SOURCE / "tests/cases").glob("*.json")):
            document = json.loads(case.read_text())
            if document.get("format") != "pastefit-case-1" or "points" in document or "grid" in document:
                continue
            scene = self.out.parent / case.name
            scene.write_text(json.dumps({"format": "pastefit-impact-1", "title": case.stem, **document["scene"]}))
            with self.subTest(case.name):
                result = run("simulate", scene, "--json")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("energy_error", json.loads(result.stdout)["run"])
                self.assertEqual(run("simulate", scene).returncode, 0)
            taken += 1
        self.assertGreater(taken, 3)

    def test_the_outline_that_simulate_prints_is_a_profile_that_a_laboratory_file_takes(self):
        arguments = ["--set", "grains.radius_mm=12", "--seed", "5", "--json"]
        points = json.loads(run("simulate", LAB, *arguments).stdout)["outlines_mm"]["step1"]
        document = json.loads(LAB.read_text())
        document["measurements"]["step1.profile"] = {"points": points, "standard_deviation": 6}
        photographed = self.out.parent / "photographed.json"
        photographed.write_text(json.dumps(document))
        again = json.loads(run("simulate", photographed, *arguments).stdout)["observables"]
        self.assertLess(again["step1.profile_mm"], 0.01)

    def test_simulate_says_the_yield_stress_of_a_fluid_with_its_readings_and_the_formula(self):
        arguments = ["--set", "grains.radius_mm=12", "--seed", "5", "--json"]
        outcome = json.loads(run("simulate", LAB, *arguments).stdout)
        height, spread = (outcome["yield_stress_pa"][f"step1.{one}_mm"] for one in ("height", "spread"))
        self.assertEqual((height["formula"], spread["formula"]), ("Schowalter 1998", "Roussel 2005 (heap not flat)"))
        self.assertGreater(height["simulated"], 0)
        lab = json.loads(LAB.read_text())
        preset = json.loads((SOURCE / f"data/apparatus/{lab['apparatus']['preset']}.json").read_text())["apparatus"]["mould"]
        base, top = preset["base_diameter_mm"] / 2000, preset["top_diameter_mm"] / 2000
        volume = math.pi * preset["height_mm"] / 3000 * (base * base + base * top + top * top)
        radius = outcome["observables"]["step1.spread_mm"] / 2000
        stress = 225 * lab["material"]["bulk_density_kg_m3"] * 9.81 * volume**2 / (128 * math.pi**2 * radius**5)
        self.assertAlmostEqual(spread["simulated"] / stress, 1, places=6)

    def test_simulate_writes_a_series_that_a_reader_understands(self):
        result = run("simulate", APPARATUS, *COARSE, "--out", self.out, "--vtk", "0.25")
        self.assertEqual(result.returncode, 0, result.stderr)
        frames = xml.parse(self.out / "grains.pvd").getroot().findall("./Collection/DataSet")
        times = [float(frame.get("timestep")) for frame in frames]
        self.assertGreater(len(times), 3)
        piece = xml.parse(self.out / frames[-1].get("file")).getroot().find("./PolyData/Piece")
        grains = json.loads((self.out / "outcome.json").read_text())["run"]["particles"]
        self.assertEqual(int(piece.get("NumberOfPoints")), grains)
        data = base64.b64decode(piece.find("./PointData/DataArray[@Name='radius']").text)
        self.assertEqual(struct.unpack("<Q", data[:8])[0], 8 * grains)
        radii = set(struct.unpack(f"<{grains}d", data[8:]))
        self.assertEqual(len(radii), 1)
        self.assertAlmostEqual(radii.pop(), 0.012, delta=0.02 * 0.012)
        # One scene with one clock a file, and the last picture is of the heap that was read.
        for series in ("filling.pvd", "grains.pvd"):
            sets = xml.parse(self.out / series).getroot().findall("./Collection/DataSet")
            clock = [float(entry.get("timestep")) for entry in sets]
            self.assertEqual(clock[0], 0)
            self.assertEqual(clock, sorted(clock))
        outcome = json.loads((self.out / "outcome.json").read_text())
        self.assertAlmostEqual(times[-1], outcome["run"]["simulated_s"], delta=1e-6)
        self.fails(run("simulate", APPARATUS, *COARSE, "--out", self.out), 2, "earlier result")

    def test_a_parameter_is_set_by_its_name_alone(self):
        by_place = run("simulate", LAB, *COARSE, "--set", "parameters.friction=1", "--json")
        by_name = run("simulate", LAB, *COARSE, "--set", "friction=1", "--json")
        self.assertEqual(by_name.returncode, 0, by_name.stderr)
        self.assertEqual(json.loads(by_name.stdout)["observables"], json.loads(by_place.stdout)["observables"])
        self.fails(run("simulate", LAB, "--set", "friction=9"), 2, "--set parameters.friction: is 9")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
