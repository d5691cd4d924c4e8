"""A study: the laboratory's tests, the parameters to fit, and how to search."""

import json
import os
from typing import Any, Dict, List, Mapping, Tuple, Union

import numpy as np

from . import _core
from .documents import merged, table, text_of


class Described:
    """What is fitted, and to what."""

    _description: Dict[str, Any]

    @property
    def title(self) -> str:
        return self._description["title"]

    @property
    def free(self) -> Dict[str, Tuple[float, float]]:
        """The bounds of each parameter that is fitted, by name, in the parameter's unit."""
        return {one["name"]: (one["lower"], one["upper"]) for one in self._description["parameters"] if one["free"]}

    @property
    def fixed(self) -> Dict[str, float]:
        """The value of each parameter that the study fixes, by name."""
        return {one["name"]: one["value"] for one in self._description["parameters"] if not one["free"]}

    @property
    def readings(self) -> np.ndarray:
        """What the laboratory measured, a table: name, measured, standard_deviation, repeats, weight, tolerance; each in
        the unit that the name says."""
        return table(self._description["readings"], [
            ("name", object), ("measured", float), ("standard_deviation", float), ("repeats", int), ("weight", float),
            ("tolerance", float)])

    @property
    def budget_simulations(self) -> int:
        """Simulations that a calibration may spend in all."""
        return self._description["budget_simulations"]

    @property
    def screening(self) -> int:
        """Candidates that are spread over the bounds to begin with."""
        return self._description["screening"]


class Study(Described):
    """The laboratory's tests of one material, its parameters free and fixed, and how to search for them.

    `content`: what a study file says (data/schema/study.md), as a dict. Where a file names a laboratory file ("lab"), the
    dict may hold what that file says. `path`: the file whose folder relative names are looked for in; "" is the working
    directory.

    Errors: `InputError` with every fault of the study and its laboratory files.
    """

    def __init__(self, content: Mapping[str, Any], path: Union[str, "os.PathLike[str]"] = "") -> None:
        self._path = os.fspath(path)
        self._study = _core.Study.from_json(text_of(content), self._path)
        self._description = json.loads(self._study.description())

    @classmethod
    def load(cls, path: Union[str, "os.PathLike[str]"]) -> "Study":
        """Reads a study file and the laboratory files that it names."""
        study = cls.__new__(cls)
        study._path = os.fspath(path)
        study._study = _core.Study.load(study._path)
        study._description = json.loads(study._study.description())
        return study

    @property
    def path(self) -> str:
        """The file that it was read from; "" if it was not."""
        return self._path

    @property
    def content(self) -> Dict[str, Any]:
        """What the study file says."""
        return json.loads(self._study.content)

    def changed(self, changes: Mapping[str, Any]) -> "Study":
        """A study with these changes of its content, merged key by key: `{"search": {"seed": 2}}`. None takes a key
        away."""
        return Study(merged(self.content, changes), self._path)

    def __repr__(self) -> str:
        free = ", ".join(self.free)
        return f"<Study {self.title!r}: fits {free} to {', '.join(_names(self._description['readings']))}>"


def _names(rows: List[Dict[str, Any]]) -> List[str]:
    return [row["name"] for row in rows]
