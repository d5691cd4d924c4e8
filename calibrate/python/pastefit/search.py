"""The search of a study whose simulations anybody may run."""

import concurrent.futures as futures
import json
import math
import numbers
import os
import shutil
import tempfile
import traceback
import weakref
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

from . import _core, progress as progress_module
from .calibration import OWN_NAMES, CalibrationResult
from .documents import number_of, printable, text_of
from .faults import InputError, whole_number_faults
from .problem import Problem
from .progress import Show
from .study import Study
from .workers import WorkerDied, Workers

Candidate = Dict[str, Any]
Simulator = Callable[[Candidate], Mapping[str, float]]
_MOST_EXCEPTIONS = 3  # of one type, with which a simulator may begin


class Search:
    """Suggests candidates and ingests what any simulator answers: LIGGGHTS, EDEM, an experiment.

        search = pf.Search(study, engine="liggghts 3.8")
        while candidates := search.suggest(4):
            search.ingest([{**one, **simulate_with_liggghts(one)} for one in candidates])
        result = search.result()

    Verbs and data are those of gest-api (libEnsemble, Xopt): lists of dicts of variables, and of variables with
    observables. It is not one of its generators: `suggest(n)` gives fewer than n while the search waits for answers, and
    the constructor takes a study. What it suggests depends on the answers only, not on their order or the number of
    workers.

    study: whose laboratory readings are to be met, or its path; or a `Problem`, whose parameters and readings pastefit need
    not know. store: file in which every answer is kept before it is used; a search of the same study and engine with the
    same file goes on where it was. engine: name and version of the simulator. Errors: `InputError`.
    """

    returns_id = True  # of gest-api: candidates have an "_id", and answers give it back

    def __init__(self, study: Union[Study, Problem, str, "os.PathLike[str]"], *,
                 store: Union[str, "os.PathLike[str]", None] = None, engine: str = "another engine") -> None:
        self.study: Union[Study, Problem] = study if isinstance(study, (Study, Problem)) else Study.load(study)
        if store is None:
            folder = tempfile.mkdtemp(prefix="pastefit-")
            weakref.finalize(self, shutil.rmtree, folder, True)
            store = os.path.join(folder, "answers")
        file = os.fspath(store)
        if isinstance(self.study, Problem):
            self._search = _core.Search.of_problem(self.study._problem, file, engine)
        else:
            self._search = _core.Search.of_study(self.study._study, self.study.path, file, engine)
        self._asked: Dict[int, Candidate] = {}
        self._given_back: List[Candidate] = []  # by a run that was interrupted
        self._beginning = _Beginning(self.study.screening)

    @property
    def variables(self) -> Dict[str, Tuple[float, float]]:
        """The bounds of each variable, by name."""
        return self.study.free

    @property
    def observables(self) -> List[str]:
        """The readings that an answer has to give."""
        return list(self.study.readings["name"])

    @property
    def vocs(self) -> Dict[str, Any]:
        """What a VOCS of gest-api is made of, `VOCS(**search.vocs)`; the seed is one of its variables, so that frameworks
        hand it on."""
        bounds = {name: list(ends) for name, ends in self.variables.items()}
        return {"variables": {**bounds, "seed": [0, 2**53]}, "observables": self.observables}

    @property
    def finished(self) -> bool:
        """True when there is nothing more to simulate: `result()` is known."""
        return self._search.finished()

    def suggest(self, num_points: Optional[int] = None) -> List[Candidate]:
        """At most so many candidates (without a number: all that can be simulated now) that were not suggested before.

        Each is a dict of the variables by name, with "seed", of the random packing: the same variables on another seed are
        a repetition of the test; and "_id". There are fewer, or none, while the search waits for answers, and none at its
        end.
        """
        count = 2**31 if num_points is None else num_points
        if faults := whole_number_faults("num_points", count, 2**31, "a whole number, or None for all"):
            raise InputError(faults)
        candidates, self._given_back = self._given_back[:count], self._given_back[count:]
        if candidates:
            return candidates
        for one in json.loads(self._search.suggest(count)):
            candidate = {**one["variables"], "seed": one["seed"], "_id": one["_id"]}
            self._asked[one["_id"]] = candidate
            candidates.append(dict(candidate))
        return candidates

    def ingest(self, results: Sequence[Mapping[str, Any]]) -> None:
        """Takes answers, in any order: the candidate's keys ("_id", or else its variables and "seed") and every reading of
        `observables`; or in place of the readings "error", why the simulation failed. NaN is a failure, too. An answer
        that is known already is ignored.

        Errors: `InputError` for every answer to what nobody asked for, or without a reading; nothing is then taken.
        RuntimeError, once, when as many candidates as "screening" says have failed and none was answered otherwise; the
        failures are taken.
        """
        answers = [self._answer_of(result, place) for place, result in enumerate(results)]
        self._search.ingest(text_of(answers))
        self._beginning.see(answers)

    def _answer_of(self, result: Mapping[str, Any], place: int) -> Dict[str, Any]:
        answer: Dict[str, Any] = {"_id": self._id_of(result, place)}
        error = _error_in(result, self.observables)
        if error is not None:
            return {**answer, "error": printable(error), "traceback": printable(str(result.get("traceback", "")))}
        own = {"", *OWN_NAMES, *self.variables}
        return {**answer, "readings": {name: number_of(value) for name, value in result.items()
                                       if isinstance(name, str) and name not in own and _is_reading(number_of(value))}}

    def _id_of(self, result: Mapping[str, Any], place: int) -> int:
        given = result.get("_id")
        if isinstance(given, numbers.Integral) and not isinstance(given, bool) and given >= 0:
            return int(given)
        if given is not None:
            raise InputError([(f"results[{place}]._id", f"is {given!r:.60}", "the whole number that suggest() gave")])
        keys = [*self.variables, "seed"]
        for number, asked in self._asked.items():
            if all(result.get(key) == asked[key] for key in keys):
                return number
        raise InputError([(f"results[{place}]", "answers what nobody asked for",
                           'the "_id", or the variables and the seed, of a candidate that suggest() gave')])

    def stop(self) -> None:
        """Ends the search with the best so far; what is not answered yet counts as cut off."""
        self._search.stop()

    finalize = stop  # of gest-api

    def result(self) -> CalibrationResult:
        """Card, intervals and evaluations, from the answers alone. Errors: RuntimeError before the search has finished."""
        if not self.finished:
            raise RuntimeError("the search has not finished: go on with suggest() and ingest(), or end it with stop()")
        return CalibrationResult(json.loads(self._search.result()), json.loads(self._search.evaluations()), self.study)

    def run(self, simulator: Simulator, *, executor: Any = None, progress: Show = None) -> CalibrationResult:
        """Has every candidate simulated, to the end.

        simulator: a function that takes a candidate and returns its readings by name, or {"error": why there are none}.
        An error in it is a failed simulation with its message, as is a reading that is missing or no number. executor:
        whatever has `submit` and gives futures, several simulations at a time; a process pool needs a function of a
        module. A worker that dies is asked again; the third time it is a failed simulation. progress: as `calibrate`.
        Ctrl-C: KeyboardInterrupt; what was answered is in the store.

        Errors: RuntimeError with the first messages, and nothing kept, for a broken simulator: before any answer, three
        candidates end with an exception of the same type, or as many as "screening" says fail in whatever way.
        """
        workers = Workers(executor) if executor is not None else None
        show = progress_module.shown_by(progress)
        try:
            with futures.ThreadPoolExecutor(workers.count if workers else 1) as pool:
                self._drive(pool, workers.count if workers else 1, _caller(simulator, workers), show)
        finally:
            progress_module.close(show)
            if workers is not None:
                workers.close()
        return self.result()

    def _drive(self, pool: futures.Executor, at_once: int, call: Callable[[Candidate], Dict[str, Any]],
               show: Callable[[Dict[str, Any]], None]) -> None:
        under_way: Dict[futures.Future, Candidate] = {}
        held: List[Dict[str, Any]] = []  # the failures with which it begins: a broken simulator leaves nothing in the store
        beginning = _Beginning(self.study.screening)
        try:
            while True:
                if len(under_way) < at_once:
                    under_way.update({pool.submit(call, one): one for one in self.suggest(at_once - len(under_way))})
                if not under_way and not held:
                    return
                done = futures.wait(under_way, return_when=futures.FIRST_COMPLETED).done
                held += [self._answer_of({**dict.fromkeys(self.observables), **one.result()}, 0) for one in done]
                for one in done:
                    del under_way[one]
                beginning.see(held, [one["_id"] for one in under_way.values()])
                if beginning.over or not done:  # or the search waits for them
                    self._search.ingest(text_of(held))
                    held = []
                told = json.loads(self._search.progress())
                show({**told, "budget": told["budget"] or self.study.budget_simulations})
        finally:
            waiting = {answer["_id"]: dict(self._asked[answer["_id"]]) for answer in held}
            self._given_back += {**waiting, **{one["_id"]: one for one in under_way.values()}}.values()


class _Beginning:
    """The failures with which a simulator begins, before it has answered once.

    screening: failures after which it is broken; three exceptions of one type are enough.
    """

    def __init__(self, screening: int) -> None:
        self._most = max(screening, _MOST_EXCEPTIONS)
        self._failures: Dict[int, Dict[str, Any]] = {}
        self.over = False

    def see(self, answers: Sequence[Dict[str, Any]], unanswered: Iterable[int] = ()) -> None:
        """Judges the failures of candidates before those that are `unanswered`: failures may be quicker than readings.

        Errors: RuntimeError for a broken simulator."""
        self.over = self.over or any("error" not in one for one in answers)
        if self.over:
            return
        self._failures.update({one["_id"]: one for one in answers})
        first = min(unanswered, default=math.inf)
        failures = [one for number, one in sorted(self._failures.items()) if number < first]
        types = [one["error"].partition(":")[0] for one in failures if one["traceback"]]
        if len(failures) >= self._most or any(types.count(one) >= _MOST_EXCEPTIONS for one in types):
            self.over = True
            raise RuntimeError(_broken(failures))


def _broken(failures: Sequence[Dict[str, Any]]) -> str:
    messages = list(dict.fromkeys(one["error"] for one in failures))[:_MOST_EXCEPTIONS]
    shown = "".join(f"\n  {one:.500}" for one in messages)
    traceback_of_first = next((one["traceback"] for one in failures if one["traceback"]), "")
    return (f"The simulator failed {len(failures)} times and never answered. Try it on one candidate; where it cannot "
            'simulate a part of the bounds, move them, or return {"error": why} there and raise "screening".'
            f" Its messages:{shown}\n{traceback_of_first}").rstrip()


def _is_reading(number: Optional[float]) -> bool:
    return number is not None and abs(number) <= _core.largest_reading()


def _error_in(result: Mapping[str, Any], observables: Sequence[str]) -> Optional[str]:
    """Why an answer is a failed simulation; None if what it has of the readings are numbers."""
    if result.get("error") is not None:
        return str(result["error"]) or "The simulator failed."
    for name in result:
        if isinstance(name, str) and printable(name) != name:
            return f"The simulator gave a reading with the name {name!r:.60}, which is not text."
    for name, value in ((name, result[name]) for name in observables if name in result):
        number = number_of(value)
        if value is None or (number is not None and not math.isfinite(number)):
            return f"The simulator gave no number for {name}."
        if number is None:
            return f"The simulator gave {value!r:.60} for {name}, which is not a number."
        if not _is_reading(number):
            return f"The simulator gave {number:.3g} for {name}, which is not a reading."
    return None


def _answer(simulator: Simulator, candidate: Candidate) -> Dict[str, Any]:
    """What a simulator says of a candidate; its error in place of the readings if it raises one."""
    try:
        return {**simulator(dict(candidate)), "_id": candidate["_id"]}
    except Exception as error:
        return {"_id": candidate["_id"], "error": f"{type(error).__name__}: {error}", "traceback": traceback.format_exc()}


def _caller(simulator: Simulator, workers: Optional[Workers]) -> Callable[[Candidate], Dict[str, Any]]:
    def call(candidate: Candidate) -> Dict[str, Any]:
        if workers is None:
            return _answer(simulator, candidate)
        try:
            return workers.call(_answer, simulator, candidate)
        except WorkerDied as death:
            return {"_id": candidate["_id"], "error": str(death)}
    return call
