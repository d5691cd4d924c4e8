"""The search with a user-defined simulator. usage: test_search.py PROGRAM SOURCE_DIR [unittest options]"""

import concurrent.futures as futures
import functools
import math
import os

import numpy as np
from studies import Desk, coarse_study, height, main
import pastefit as pf

WEAK_PA = 3000  # strength below which some simulators of these tests fail


def fails_when_weak(candidate):
    if candidate["strength_pa"] < WEAK_PA:
        raise ValueError("it flowed away")
    return height(candidate)


def no_number_when_weak(candidate):
    return {"step1.height_mm": math.nan} if candidate["strength_pa"] < WEAK_PA else height(candidate)


def dies_once(marks, candidate):
    """Kills its process the first time that it is asked for this candidate; leaves a mark in the folder."""
    mark = marks / str(candidate["_id"])
    if candidate["_id"] == 1 and not mark.exists():
        mark.touch()
        os._exit(1)
    return height(candidate)


def dies_always(candidate):
    if candidate["_id"] == 1:
        os._exit(1)
    return height(candidate)


def study(**search):
    return pf.Study(coarse_study(tolerance_mm=15, **search))


class Search(Desk):
    def search(self, **options):
        return pf.Search(study(), engine="toy 1", **options)

    def test_suggest_and_ingest_find_and_confirm_a_material(self):
        search = self.search()
        while candidates := search.suggest(2):
            self.assertLessEqual(len(candidates), 2)
            search.ingest([{**one, **height(one)} for one in candidates])
        self.assertTrue(search.finished)
        result = search.result()
        self.assertEqual(result.status, "confirmed", result.reason)
        self.assertLess(abs(result.card.readings["difference"][0]), 15)
        self.assertEqual(list(result.intervals["parameter"]), ["strength_pa"])
        self.assertIn("toy 1", result.card.content["provenance"]["program"])

    def test_the_engine_behind_it_gives_the_card_of_a_calibration(self):
        content = coarse_study(end_early=False)
        content["parameters"] |= {name: {"value": value} for name, value in (
            ("mould_friction", 0.1), ("table_friction", 0.5))}
        whole = pf.Study(content)

        def engine(candidate):
            return pf.simulate(whole, seed=candidate["seed"], set={"strength_pa": candidate["strength_pa"]}).readings

        found, calibrated = pf.Search(whole, engine="pastefit").run(engine), pf.calibrate(whole)
        cards = [result.card.content for result in (found, calibrated)]
        for card in cards:
            del card["provenance"]["program"]
            for test in card["tests"]:
                del test["baseline"]["program"]
        self.assertEqual(cards[0], cards[1])

    def test_the_card_is_the_same_whatever_the_order_of_the_answers(self):
        one, other = self.search(), self.search()
        while candidates := one.suggest(1):
            one.ingest([{**candidates[0], **height(candidates[0])}])
        while candidates := other.suggest():
            other.ingest([{**candidate, **height(candidate)} for candidate in reversed(candidates)])
        self.assertEqual(one.result().card, other.result().card)

    def test_the_card_is_the_same_with_one_and_four_workers(self):
        with futures.ThreadPoolExecutor(4) as four:
            cards = [self.search().run(height).card, self.search().run(height, executor=four).card]
        self.assertEqual(cards[0], cards[1])

    def test_an_answer_without_its_id_is_known_by_its_variables(self):
        search = self.search()
        candidate, = search.suggest(1)
        answer = {**candidate, **height(candidate)}
        del answer["_id"]
        search.ingest([answer])
        self.assertNotEqual(search.suggest(1)[0]["_id"], candidate["_id"])

    def test_a_framework_that_passes_arrays_of_named_fields_on_drives_it(self):
        # As libEnsemble does: only what the VOCS names survives, as numbers of NumPy.
        search = self.search()
        fields = [*search.vocs["variables"], *search.vocs["observables"]]
        while candidates := search.suggest(3):
            rows = np.zeros(len(candidates), dtype=[(name, float) for name in fields])
            for row, candidate in zip(rows, candidates):
                for name in search.vocs["variables"]:
                    row[name] = candidate[name]
            for row in rows:
                row["step1.height_mm"] = height(row)["step1.height_mm"]
            search.ingest([{name: row[name] for name in fields} for row in rows])
        self.assertEqual(search.result().card, self.search().run(height).card)

    def test_an_answer_that_nobody_asked_for_is_told_and_nothing_is_taken(self):
        search = self.search()
        candidate, = search.suggest(1)
        good = {**candidate, **height(candidate)}
        fault, = self.faults(search.ingest, [good, {**good, "_id": 77}])
        self.assertEqual(fault.where, "results[1]")
        self.assertIn("nobody asked for", fault.what)
        fault, = self.faults(search.ingest, [{"strength_pa": 1.0, "step1.height_mm": 3.0}])
        self.assertIn("nobody asked for", fault.what)
        fault, = self.faults(search.ingest, [candidate])
        self.assertIn("step1.height_mm", fault.what)
        search.stop()
        while search.suggest():
            pass
        self.assertEqual(search.result().simulated, 0)

    def test_an_id_is_the_whole_number_that_was_given(self):
        search = pf.Search(study(), engine="closed form")
        one, = search.suggest(1)
        for wrong in (1.9, str(one["_id"]), True, -1):
            fault, = self.faults(search.ingest, [{**one, **height(one), "_id": wrong}])
            self.assertIn("_id", fault.where)
        search.ingest([{**one, **height(one), "_id": np.int64(one["_id"])}])

    def test_errors_and_nan_are_failed_runs_with_their_message(self):
        for simulator, message in ((fails_when_weak, "ValueError: it flowed away"),
                                   (no_number_when_weak, "no number for step1.height_mm")):
            result = self.search().run(simulator)
            weak = result.evaluations[result.evaluations["strength_pa"] < WEAK_PA]
            self.assertGreater(len(weak), 0)
            self.assertEqual(set(weak["failure"]), {"engine_failed"})
            self.assertIn(message, weak["message"][0])
            self.assertEqual(result.failures["engine_failed"], len(weak))
            self.assertTrue(result.confirmed, result.reason)

    def test_what_a_simulator_gives_besides_the_readings_never_takes_the_place_of_a_column(self):
        more = {"": 1.5, "packing": 1.5, "failure": 1.5, "number": 1.5, "wall_s": 1.5, "too_large": 1e300, "width_mm": 2.5}
        result = self.search().run(lambda candidate: {**height(candidate), **more, ("no", "text"): 1.5})
        self.assertEqual(result.evaluations.dtype.names, ("number", "packing", "strength_pa", "step1.height_mm", "width_mm",
                                                          "failure", "message", "ended_early", "wall_s"))
        self.assertEqual(result.parameters, self.search().run(height).parameters)

    def test_a_number_of_points_is_a_whole_number(self):
        for wrong in (-1, 1.5, True, "2"):
            fault, = self.faults(self.search().suggest, wrong)
            self.assertEqual(fault.where, "num_points")

    def test_a_search_goes_on_where_its_store_ends(self):
        store, asked = self.folder / "search.sqlite", []

        def cut(candidate):
            if len(asked) == 3:
                raise KeyboardInterrupt
            asked.append(candidate)
            return height(candidate)

        with self.assertRaises(KeyboardInterrupt):
            self.search(store=store).run(cut)
        result = self.search(store=store).run(height)
        self.assertEqual(result.known, 3)
        self.assertEqual(result.card, self.search().run(height).card)

    def test_a_run_that_was_interrupted_goes_on_with_the_same_search(self):
        search, asked = self.search(), []

        def cut(candidate):
            asked.append(candidate)
            if len(asked) == 3:
                raise KeyboardInterrupt
            return height(candidate)

        with self.assertRaises(KeyboardInterrupt):
            search.run(cut)
        self.assertEqual(search.run(height).card, self.search().run(height).card)

    def test_answers_of_another_engine_are_no_answers(self):
        store = self.folder / "search.sqlite"
        self.search(store=store).run(height)
        fault, = self.faults(pf.Search, study(), engine="toy 2", store=store)
        self.assertIn("toy 1", str(fault))

    def test_a_worker_that_dies_is_asked_again(self):
        with futures.ProcessPoolExecutor(2) as pool:
            result = self.search().run(functools.partial(dies_once, self.folder), executor=pool)
        self.assertEqual(result.card, self.search().run(height).card)

    def test_a_run_that_kills_its_worker_three_times_is_a_failure_with_its_name(self):
        with futures.ProcessPoolExecutor(2) as pool:
            result = self.search().run(dies_always, executor=pool)
        failed = result.evaluations[result.evaluations["failure"] != ""]
        self.assertEqual(len(failed), 1)
        self.assertEqual(failed["failure"][0], "engine_failed")
        self.assertIn("died 3 times", failed["message"][0])
        self.assertIsNotNone(result.card)


if __name__ == "__main__":
    main()
