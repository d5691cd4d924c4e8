"""A calibration: study in, card out."""

import json
import math
import os
import tempfile
import uuid
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _core, html, interrupt, progress as progress_module
from .card import Card, reading_table
from .documents import number_of, table
from .faults import InputError, threads_faults
from .progress import Show
from .study import Described, Study
from .workers import WorkerDied, Workers

_INTERVALS = [("parameter", object), ("recommended", float), ("lower", float), ("upper", float), ("lower_known", bool),
              ("upper_known", bool), ("bound_lower", float), ("bound_upper", float), ("uncertainty", float)]
_BEFORE = [("number", int), ("packing", int)]  # columns of the evaluations, before and after parameters and readings
_AFTER = [("failure", object), ("message", object), ("ended_early", bool), ("wall_s", float)]
OWN_NAMES = ["_id", "seed", "error", "traceback", *(name for name, _ in _BEFORE + _AFTER)]
"""Keys of candidates, answers and evaluations that no parameter or reading may have."""


class CalibrationResult:
    """What a calibration brought.

    status: "confirmed", "unconfirmed", "out_of_reach", "stopped" or "failed"; reason: the same in sentences. card: None if
    no candidate could be simulated, or the test is none that a card can hold (`Problem`). parameters: the free ones of the
    material that is reported, by name. intervals: what the readings say of each free parameter, a table: parameter,
    recommended, lower and upper (95 %), whether the data set either end (lower_known, upper_known), the study's bounds,
    uncertainty (standard deviation after the measurement over before). readings: measured against simulated, as
    `Card.readings`. evaluations: every simulation, a table: number,
    packing, the free parameters, the readings, failure ("" if none), message, ended_early, wall_s. summary: for a person.
    """

    def __init__(self, result: Dict[str, Any], evaluations: List[Dict[str, Any]], study: Described) -> None:
        self.status: str = result["status"]
        self.reason: str = result["reason"]
        self.simulated: int = result["simulated"]
        self.known: int = result["known"]
        self.failures: Dict[str, int] = result["failures"]
        self.card: Optional[Card] = Card(result["card"]) if result["card"] else None
        known = self.card.parameters if self.card else result.get("parameters", {})
        self.parameters: Dict[str, float] = {name: known[name] for name in study.free if name in known}
        self.readings: np.ndarray = self.card.readings if self.card else reading_table(result.get("readings", []))
        self.summary: str = result["summary"]
        self.intervals: np.ndarray = table(result["intervals"], _INTERVALS)
        self.correlation: np.ndarray = np.array(result["correlation"], dtype=float)
        self.evaluations: np.ndarray = _evaluation_table(evaluations, study)

    @property
    def confirmed(self) -> bool:
        """Whether the material reproduces the measurement on packings that the search has not used."""
        return self.status == "confirmed"

    def to_pandas(self) -> Any:
        """The evaluations as a pandas.DataFrame. Errors: ImportError where there is no pandas."""
        import pandas
        return pandas.DataFrame(self.evaluations)

    def plot(self, axes: Any = None) -> Any:
        """Draws with Matplotlib what each simulated reading differs from the laboratory, in tolerances: the mean and twice
        its standard error, the band of the tolerance behind; returns the axes.

        Errors: ImportError where there is no Matplotlib.
        """
        from matplotlib import pyplot
        axes = axes or pyplot.gca()
        judged = self.readings[self.readings["tolerance"] > 0]
        rows = -np.arange(len(judged))  # the first on top
        errors = 2 * np.nan_to_num(judged["standard_error"]) / judged["tolerance"]
        axes.axvspan(-1, 1, color="#e6eef5")
        axes.axvline(0, color="#888888", linewidth=1)
        axes.errorbar(judged["difference"] / judged["tolerance"], rows, xerr=errors, fmt="o", color="#1b6ca8")
        axes.set_yticks(rows, [f"{one['name']}: {one['simulated']:.4g} for {one['measured']:.4g}" for one in judged])
        axes.set_xlabel("simulated less measured [tolerances]")
        return axes

    def __repr__(self) -> str:
        return f"<CalibrationResult {self.status}: {self.reason}>"

    def _repr_html_(self) -> str:
        fitted = html.rows(("parameter", "recommended", "lower", "upper"), (
            (one["parameter"], one["recommended"], one["lower"], one["upper"]) for one in self.intervals))
        shown = html.card(self.card) if self.card else html.readings(self.status, self.reason, self.readings)
        return shown + fitted


def _evaluation_table(evaluations: List[Dict[str, Any]], study: Described) -> np.ndarray:
    readings = list(dict.fromkeys(name for one in evaluations for name in one["readings"]))
    columns = [*_BEFORE, *((name, float) for name in [*study.free, *readings]), *_AFTER]
    return table([{**one, **one["parameters"], **one["readings"]} for one in evaluations], columns)


def simulate_task(task: str) -> str:
    """Simulates what a calibration asks for, on any machine with the same pastefit: what an executor is given. A task and
    its answer are JSON."""
    return _core.simulate_task(task)


def _asked_of(workers: Workers) -> Callable[[str, Callable[[], bool]], Optional[str]]:
    def ask(task: str, goes_on: Callable[[], bool]) -> Optional[str]:
        try:
            return workers.call(simulate_task, task, goes_on=goes_on)
        except WorkerDied as death:
            return _core.failed_task(str(death))
    return ask


def _faults_of(resume: bool, force: bool, threads: int, wall_budget_s: float) -> List[Tuple[str, str, str]]:
    faults = []
    if resume and force:
        faults.append(("resume", "is given with force=True, which would delete what is to be resumed", "one of both"))
    faults += threads_faults(threads)
    if number_of(wall_budget_s) is None or not 0 <= wall_budget_s < math.inf:
        faults.append(("wall_budget_s", f"is {wall_budget_s!r}", "seconds, 0 for no limit"))
    return faults


def calibrate(study: Union[Study, str, "os.PathLike[str]"], *, out: Union[str, "os.PathLike[str]", None] = None,
              executor: Any = None, progress: Show = None, resume: bool = False, force: bool = False, threads: int = 0,
              wall_budget_s: float = 0, page: bool = True) -> CalibrationResult:
    """Calibrates a study, as the program `pastefit calibrate` does: the same card, to the byte.

    study: or the path of its file. out: folder for card.json, summary.txt, report.html (unless `page` is False) and
    evaluations.sqlite; without it nothing is kept. executor: whatever has `submit` and gives futures; the simulations run
    there, and the card is the same with any number of workers. Without it they run on `threads` threads (0: one for each
    core). progress: True for a bar (tqdm where that is there), or a function that is told, ten times a second, a dict with
    phase, simulations, budget, best_miss (in tolerances; None before the first) and note. resume: go on with what the
    folder holds. force: replace it. wall_budget_s: end after this time with the best so far.

    Errors: `InputError` before anything is simulated. Ctrl-C ends cleanly: `out` holds the best so far and every finished
    simulation, and KeyboardInterrupt is raised; the same call with `resume=True` goes on. Other errors of an executor are
    raised as RuntimeError.
    """
    faults = _faults_of(resume, force, threads, wall_budget_s)
    if faults:
        raise InputError(faults)
    if not isinstance(study, Study):
        study = Study.load(study)
    if out is None:
        with tempfile.TemporaryDirectory() as folder:
            return _calibrate(study, folder, executor, progress, resume, force, threads, wall_budget_s, page=False)
    return _calibrate(study, os.fspath(out), executor, progress, resume, force, threads, wall_budget_s, page)


def _calibrate(study: Study, out: str, executor: Any, progress: Show, resume: bool, force: bool, threads: int,
               wall_budget_s: float, page: bool) -> CalibrationResult:
    workers = Workers(executor) if executor is not None else None
    engine = None
    if workers is not None:
        threads = threads or workers.count
        engine = (_asked_of(workers), uuid.uuid4().hex)
    stop = _core.Stop()
    run = _core.CalibrationRun(study._study, study.path, out, resume, force, page, threads, wall_budget_s, stop, engine)
    show = progress_module.shown_by(progress)

    def poll() -> None:
        told = json.loads(run.progress())
        show({**told, "budget": told["budget"] or study.budget_simulations})

    try:
        interrupt.run(run.run, stop, poll)
        poll()
    finally:
        progress_module.close(show)
        if workers is not None:
            workers.close()
    return CalibrationResult(json.loads(run.result()), json.loads(run.evaluations()), study)
