"""Fitting parameters of a user-defined test. usage: test_problem.py PROGRAM SOURCE_DIR [unittest options]"""

import concurrent.futures as futures
import contextlib
import json
import math
import random
import sqlite3
import threading
import time

from studies import Desk, height, main
import pastefit as pf


def repose(**changes):
    """A test that pastefit does not know: the angle of repose and the time of flow of an EDEM deck."""
    return {"title": "Sand in a drum", "parameters": {
                "sliding": {"free": [0.05, 0.8]}, "surface_energy_j_m2": {"free": [0.01, 10], "scale": "log"}},
            "measurements": {"angle_deg": {"value": 32, "standard_deviation": 1, "repeats": 3},
                             "flow_time_s": {"value": 4, "standard_deviation": 0.3}},
            "tolerances": {"angle_deg": 2},
            "search": {"budget_simulations": 60, "screening": 8, "packings": 1, "confirmation_packings": 2,
                       "examination_simulations": 4}, **changes}


def rows_of(store):
    with contextlib.closing(sqlite3.connect(store)) as database:
        return database.execute("SELECT * FROM evaluations").fetchall()


def fnv1a(text):
    value = 0xcbf29ce484222325
    for byte in text.encode():
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return f"{value:016x}"


def forge(store, column, value, signed):
    """Changes the first answer; `signed`: with the checksum that belongs to what it says then."""
    with contextlib.closing(sqlite3.connect(store)) as database:
        database.execute(f"UPDATE evaluations SET {column} = ? WHERE sequence = 1", (value,))
        if signed:
            *row, _ = database.execute("SELECT * FROM evaluations WHERE sequence = 1").fetchone()
            content = "".join(f"{len(str(one).encode())}:{one}" for one in row)
            database.execute("UPDATE evaluations SET checksum = ? WHERE sequence = 1", (fnv1a(content),))
        database.commit()


def drum(candidate):
    noise = (candidate["seed"] * 7919 % 11 - 5) / 20
    return {"angle_deg": 18 + 25 * candidate["sliding"] + noise,
            "flow_time_s": 3 + candidate["surface_energy_j_m2"] ** 0.5 + 2 * candidate["sliding"] + noise / 10}


class Problem(Desk):
    def test_a_problem_of_any_parameters_and_readings_is_fitted_and_confirmed(self):
        result = pf.Search(pf.Problem(repose())).run(drum)
        self.assertEqual(result.status, "confirmed", result.reason)
        self.assertIsNone(result.card)
        self.assertAlmostEqual(result.parameters["sliding"], 14 / 25, delta=0.1)
        self.assertLess(abs(result.readings["difference"][0]), 2)
        sliding = result.intervals[0]
        self.assertLess(sliding["lower"], 14 / 25)
        self.assertGreater(sliding["upper"], 14 / 25)
        self.assertLess(sliding["upper"] - sliding["lower"], 0.4)
        self.assertIn("surface_energy_j_m2", result.evaluations.dtype.names)
        for part in ("<svg", "angle_deg", "sliding"):
            self.assertIn(part, result._repr_html_())

    def test_every_fault_of_a_problem_comes_at_once(self):
        content = repose(measurments={})
        content["parameters"]["sliding"] = {"free": [0.8, 0.05]}
        del content["measurements"]["flow_time_s"]["standard_deviation"]
        places = [fault.where for fault in self.faults(pf.Problem, content)]
        self.assertEqual(sorted(places), ["measurements.flow_time_s.standard_deviation", "measurments",
                                          "parameters.sliding.free"])

    def test_names_that_candidates_answers_and_evaluations_have_themselves_are_refused(self):
        search = pf.Search(pf.Problem(repose()))
        candidate, = search.suggest(1)
        search.stop()
        names = {*candidate, *search.result().evaluations.dtype.names, "error", "traceback", ""}
        self.assertLess({"seed", "packing", "wall_s"}, names)
        for name in names - {*search.variables, *search.observables}:
            fault, = self.faults(pf.Problem, repose(parameters={name: {"free": [0, 1]}}))
            self.assertIn(f"parameters.{name}", fault.where)
            self.assertIn("name", fault.remedy)
            measurements = {name: {"value": 1, "standard_deviation": 1}}
            fault, = self.faults(pf.Problem, repose(measurements=measurements, tolerances={}))
            self.assertIn(f"measurements.{name}", fault.where)
        fault, = self.faults(pf.Problem, repose(parameters={"angle_deg": {"free": [0, 1]}}))
        self.assertIn("angle_deg", fault.where)

    def test_whatever_a_store_holds_it_is_read_or_refused(self):
        problem, file = pf.Problem(repose()), self.folder / "answers.sqlite"
        pf.Search(problem, store=file, engine="drum").run(drum)
        whole, dice = file.read_bytes(), random.Random(1)
        for attack in range(300):
            broken = bytearray(whole)
            for _ in range(dice.randint(1, 6)):
                at = dice.randrange(max(len(broken), 1))
                kind = dice.randrange(4)
                if kind == 0 and broken:
                    broken[at % len(broken)] ^= 1 << dice.randrange(8)
                elif kind == 1:
                    del broken[at:at + dice.randint(1, 200)]
                elif kind == 2:
                    broken[at:at] = dice.choice([b"\n", b"null", b"[]", b"1e999", b"-1", b'"', b"}", b"{", b"NaN"])
                else:
                    broken[at:at] = broken[at:at + dice.randint(1, 300)]
            file.write_bytes(broken)
            with self.subTest(attack=attack):
                try:
                    pf.Search(problem, store=file, engine="drum")
                except pf.InputError as refused:
                    self.assertTrue(refused.faults)

    def test_answers_that_are_damaged_or_forged_are_asked_again_and_never_believed(self):
        problem, file = pf.Problem(repose()), self.folder / "answers"
        whole = pf.Search(problem, store=file, engine="drum").run(drum)
        untouched = file.read_bytes()
        forged = (("point", "[]"), ("point", json.dumps([0.5] * 500)), ("observables", "{}"), ("packing", "-1"),
                  ("observables", '{"angle_deg": 1e300, "flow_time_s": 1}'), ("checksum", "0" * 16), ("observables", "7"))
        for column, value in forged:
            for signed in (False, True):
                file.write_bytes(untouched)
                forge(file, column, value, signed and column != "checksum")
                calls = []
                again = pf.Search(problem, store=file, engine="drum").run(lambda one: calls.append(1) or drum(one))
                self.assertEqual((again.status, again.parameters, len(calls)), (whole.status, whole.parameters, 1), column)

    def test_a_broken_simulator_is_asked_three_times_and_leaves_nothing_behind(self):
        calls, file = [], self.folder / "answers"

        def broken(candidate):
            calls.append(1)
            return {"angle_deg": undefined_name}  # noqa: F821

        search = pf.Search(pf.Problem(repose()), store=file, engine="drum")
        with self.assertRaisesRegex(RuntimeError, "(?s)3 times and never answered.*Traceback.*undefined_name"):
            search.run(broken)
        self.assertEqual(len(calls), 3)
        self.assertEqual(len(rows_of(file)), 0)
        self.assertEqual(search.run(drum).status, "confirmed")

    def test_a_simulator_that_never_answers_is_stopped_whatever_its_messages_say(self):
        def varying(candidate):
            raise FileNotFoundError(2, "no such file", f"/tmp/run-{candidate['seed']}-{candidate['_id']}/out.txt")

        def alternating(candidate):
            raise (ValueError if candidate["_id"] % 2 else KeyError)("mixed")

        def giving(value):
            return lambda _: {"angle_deg": value, "flow_time_s": value}

        for number, (simulator, most, message) in enumerate((
                (varying, 3, "(?s)run-.*run-.*run-.*Traceback"), (alternating, 5, "(?s)KeyError.*ValueError"),
                (giving(math.nan), 8, "no number for angle_deg"), (giving(None), 8, "no number for angle_deg"),
                (giving("31.2"), 8, "'31.2'"), (giving(1e300), 8, "1e.300"), (lambda _: {}, 8, "no number for angle_deg"),
                (lambda _: {"error": "it flowed away"}, 8, "it flowed away"))):
            calls, file = [], self.folder / f"answers {number}"
            search = pf.Search(pf.Problem(repose()), store=file, engine="drum")
            with self.assertRaisesRegex(RuntimeError, message):
                search.run(lambda one: calls.append(1) or simulator(one))
            self.assertEqual((len(calls), len(rows_of(file))), (most, 0), message)

    def test_a_simulator_that_answers_the_last_candidate_of_the_screening_is_not_stopped(self):
        found = pf.Search(pf.Problem(repose())).run(
            lambda candidate: {"error": "it flowed away"} if candidate["_id"] < 7 else drum(candidate))
        self.assertEqual(found.failures, {"engine_failed": 7})

    def test_failures_that_are_quicker_than_the_first_answer_do_not_stop_the_search(self):
        failures, enough = [], threading.Event()

        def simulator(candidate):
            if candidate["_id"] == 0:
                enough.wait(20)
                time.sleep(0.3)  # until the search has seen them
            elif candidate["_id"] <= 3:
                failures.append(1)
                if len(failures) == 3:
                    enough.set()
                raise ValueError("it flowed away")
            return drum(candidate)

        with futures.ThreadPoolExecutor(4) as four:
            found = pf.Search(pf.Problem(repose())).run(simulator, executor=four)
        self.assertEqual(found.failures, {"engine_failed": 3})

    def test_errors_alone_are_told_once_to_who_ingests_them_and_are_kept(self):
        file = self.folder / "answers"
        search = pf.Search(pf.Problem(repose()), store=file, engine="drum")
        for count in range(8):
            candidate, = search.suggest(1)
            answer = {**candidate, "error": f"failed at {count}"}
            if count < 7:
                search.ingest([answer, answer])
        with self.assertRaisesRegex(RuntimeError, "(?s)8 times.*failed at 0"):
            search.ingest([answer])
        self.assertEqual(len(rows_of(file)), 8)
        candidate, = search.suggest(1)
        search.ingest([{**candidate, "error": "failed again"}])

    def test_an_answer_without_its_readings_or_with_a_key_that_is_no_text_is_a_failed_simulation(self):
        for wrong, message in (({}, "angle_deg"), ({"angle_deg": 30}, "flow_time_s"),
                               ({"angle_deg": 30, "flow_time_s": 4, "\ud800": 1}, "ud800")):
            calls = []

            def simulator(candidate):
                calls.append(1)
                return wrong if len(calls) == 3 else drum(candidate)

            found = pf.Search(pf.Problem(repose()), engine="drum").run(simulator)
            failed, = [one["message"] for one in found.evaluations if one["failure"]]
            self.assertIn(message, failed)

    def test_what_is_no_number_is_a_failed_simulation_with_its_message(self):
        for value in (None, "", "18", [18], 10**400, True, "\ud800", math.nan):
            calls = []

            def simulator(candidate):
                calls.append(1)
                return {**drum(candidate), **({"angle_deg": value} if len(calls) == 3 else {})}

            found = pf.Search(pf.Problem(repose()), engine="drum").run(simulator)
            failed = [one["message"] for one in found.evaluations if one["failure"]]
            self.assertEqual(len(failed), 1, value)
            self.assertIn("angle_deg", failed[0])

    def test_a_reading_that_no_parameter_moves_and_that_is_far_off_ends_the_search_with_a_result(self):
        for off in (1e3, 1e9):
            measurements = {**repose()["measurements"], "temperature": {"value": off, "standard_deviation": 1}}
            problem = pf.Problem(repose(measurements=measurements))
            found = pf.Search(problem, engine="drum").run(lambda candidate: {**drum(candidate), "temperature": 0.0})
            self.assertIn(found.status, ("out_of_reach", "unconfirmed"))

    def test_a_response_that_jumps_is_found_by_halving(self):
        def jumps(candidate):
            return {"height": 10 + 290 / (1 + math.exp(-12 * (math.log10(candidate["strength"]) - 4.3)))}

        problem = pf.Problem({
            "title": "threshold", "parameters": {"strength": {"free": [1, 1e6], "scale": "log"}},
            "measurements": {"height": {"value": 120, "standard_deviation": 7}},
            "search": {"budget_simulations": 80, "packings": 1, "confirmation_packings": 2, "examination_simulations": 12}})
        found = pf.Search(problem, engine="closed form").run(jumps)
        self.assertEqual(found.status, "confirmed", found.reason)
        self.assertLess(abs(jumps(found.parameters)["height"] - 120), 7)

    def test_a_problem_goes_on_where_its_file_ends(self):
        store, asked = self.folder / "answers.sqlite", []

        def cut(candidate):
            if len(asked) == 9:
                raise KeyboardInterrupt
            asked.append(candidate)
            return drum(candidate)

        with self.assertRaises(KeyboardInterrupt):
            pf.Search(pf.Problem(repose()), store=store, engine="drum 1").run(cut)
        resumed = pf.Search(pf.Problem(repose()), store=store, engine="drum 1").run(drum)
        whole = pf.Search(pf.Problem(repose())).run(drum)
        self.assertEqual(resumed.known, 9)
        self.assertEqual(resumed.parameters, whole.parameters)
        self.assertEqual(list(resumed.intervals["upper"]), list(whole.intervals["upper"]))
        self.assertEqual(pf.Search(pf.Problem(repose()), store=store, engine="drum 1").run(drum).simulated, 0)
        fault, = self.faults(pf.Search, pf.Problem(repose()), store=store, engine="drum 2")
        self.assertIn("drum 2", fault.what)
        other = pf.Problem(repose(measurements={"angle_deg": {"value": 41, "standard_deviation": 1}}))
        fault, = self.faults(pf.Search, other, store=store, engine="drum 1")
        self.assertIn("another problem", fault.what)


if __name__ == "__main__":
    main()
