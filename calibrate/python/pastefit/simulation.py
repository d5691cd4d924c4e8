"""One simulation of a laboratory test."""

import json
import os
from typing import Any, Dict, List, Mapping, Optional, Union

import numpy as np

from . import _core, interrupt
from .card import Card
from .documents import number_of, text_of
from .faults import InputError, seed_faults, threads_faults
from .study import Study
from .workers import processors

Scene = Union[str, "os.PathLike[str]", Study, Card, Mapping[str, Any]]


class Frame:
    """The grains at one moment. The arrays are views of the engine's memory, without a copy, and cannot be written to.

    phase: of the test, e.g. "step1.lift". time_s: simulated time since the stage began [s].
    positions: shape (grains, 3) [m]. radii: shape (grains,) [m]. velocities: shape (grains, 3) [m/s].
    identities: shape (grains,); a grain keeps its own, while its place in the arrays changes from frame to frame.
    """

    def __init__(self, frame: _core.Frame) -> None:
        self.phase: str = frame.phase
        self.time_s: float = frame.time_s
        self.positions: np.ndarray = frame.positions
        self.radii: np.ndarray = frame.radii
        self.velocities: np.ndarray = frame.velocities
        self.identities: np.ndarray = frame.identities

    def __repr__(self) -> str:
        return f"<Frame {self.phase} at {self.time_s:.4g} s: {len(self.radii)} grains>"


class Simulation:
    """What a simulation answered.

    readings: by name, each in the unit that its name says; empty after a failure. failure: None, or why there are no
    readings, a dict with "reason" and "message". frames: the moments that were asked for, or the last one. notes: what a
    person should know of the input. run: particles, steps, simulated time and so on.
    """

    def __init__(self, run: _core.SimulationRun) -> None:
        outcome = json.loads(run.outcome())
        self.readings: Dict[str, float] = {name: float(value) for name, value in outcome["readings"].items()}
        self.failure: Optional[Dict[str, Any]] = outcome["failure"]
        self.run: Dict[str, Any] = outcome["run"]
        self.curve: Optional[Dict[str, Any]] = outcome.get("curve")
        self.frames: List[Frame] = [Frame(frame) for frame in run.frames]
        self.notes: List[str] = list(run.notes)

    @property
    def positions(self) -> np.ndarray:
        """Of the grains in the last frame, shape (grains, 3) [m]."""
        return self.frames[-1].positions

    @property
    def radii(self) -> np.ndarray:
        """Of the grains in the last frame, shape (grains,) [m]."""
        return self.frames[-1].radii

    def plot(self, axes: Any = None) -> Any:
        """Draws the last frame from the side with Matplotlib, lengths in mm; returns the axes.

        Errors: ImportError where there is no Matplotlib.
        """
        from matplotlib import collections, pyplot
        axes = axes or pyplot.gca()
        order = np.argsort(-self.positions[:, 1])  # the nearest last
        places, sizes = 1e3 * self.positions[order], 1e3 * self.radii[order]
        axes.add_collection(collections.EllipseCollection(
            2 * sizes, 2 * sizes, np.zeros(len(sizes)), units="xy", offsets=places[:, [0, 2]],
            transOffset=axes.transData, facecolor="#d8c7a9", edgecolor="#6b5b43", linewidth=0.3))
        axes.set(aspect="equal", xlabel="x [mm]", ylabel="z [mm]")
        axes.autoscale_view()
        return axes

    def __repr__(self) -> str:
        if self.failure:
            return f"<Simulation failed: {self.failure['reason']}: {self.failure['message']}>"
        return "<Simulation " + ", ".join(f"{name}={value:.4g}" for name, value in self.readings.items()) + ">"


def _settings(changes: Mapping[str, Any]) -> List[str]:
    return [f"{path}={value if isinstance(value, str) else text_of(value)}" for path, value in changes.items()]


def simulate(scene: Scene, *, seed: Optional[int] = None, set: Optional[Mapping[str, Any]] = None, test: str = "",
             frames: Optional[float] = None, threads: int = 1) -> Simulation:
    """Simulates a laboratory test once, on one packing.

    scene: a study (its free parameters in the middle of their bounds), a card, or the path or the content of a study,
    card, laboratory, apparatus or impact file. seed: of the random packing. set: changes of the content by path, e.g.
    `{"strength_pa": 3000, "grains.radius_mm": 6}`. test: which one of a study or card that has several. frames: simulated
    time between two frames [s]; without it only the last moment is kept. threads: that share the grains (0: one for each
    core); the result is the same.

    A simulation that fails is a result (`failure`), not an error. Errors: `InputError`; KeyboardInterrupt at Ctrl-C.
    """
    faults = seed_faults("seed", seed) + threads_faults(threads)
    if frames is not None and not (number_of(frames) or 0) > 0:
        faults.append(("frames", f"is {frames!r:.60}", "a simulated time above 0 s, or None"))
    if faults:
        raise InputError(faults)
    used = min(threads or processors(), processors())
    stop, options = _core.Stop(), (_settings(set or {}), test, seed, frames, used)
    text, path = None, ""
    if isinstance(scene, (Study, Card)):
        text, path = text_of(scene.content), scene.path if isinstance(scene, Study) else ""
    elif isinstance(scene, Mapping):
        text = text_of(scene)
    else:
        path = os.fspath(scene)
    run = _core.SimulationRun(text, path, *options, stop)
    interrupt.run(run.run, stop)
    return Simulation(run)
