"""A problem of any engine and test: parameters and readings that pastefit does not know."""

import json
from typing import Any, Dict, Mapping

from . import _core
from .calibration import OWN_NAMES
from .documents import text_of
from .study import Described


class Problem(Described):
    """Parameters and readings of any name, for a `Search` whose simulator knows what they mean.

    `content`: a dict of "title"; "parameters", each {"free": [lower, upper]} with "scale" ("linear" or "log") and "prior";
    "measurements", each {"value", "standard_deviation", "repeats"}; and, if you like, "tolerances" (how far off a reading
    may be; without one its standard deviation), "weights" and "search", as in a study (data/schema/study.md).

    Errors: `InputError` with every fault: also a name that candidates, answers or evaluations use themselves, as "seed".
    """

    def __init__(self, content: Mapping[str, Any]) -> None:
        self._problem = _core.Problem.from_json(text_of(content), OWN_NAMES)
        self._description = json.loads(self._problem.description())

    @property
    def content(self) -> Dict[str, Any]:
        """What it was made of."""
        return json.loads(self._problem.content)

    def __repr__(self) -> str:
        return f"<Problem {self.title!r}: fits {', '.join(self.free)} to {', '.join(self.readings['name'])}>"
